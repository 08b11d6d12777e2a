// The devices there are, as the programs list them.
#pragma once

#include <plait/plait.h>

namespace common {

const char* type_name(plait_device_type type);
void print_devices();

} // namespace common
