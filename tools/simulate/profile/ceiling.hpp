// What a device's memory gives at the most.
#pragma once

#include <plait/plait.h>

namespace simulate {

// Bytes/s, read and written, of the stage that only copies, over arrays that no cache holds. 0: the
// driver's events carry no times. Throws Failure.
double copy_rate(const plait_device_info& device);

} // namespace simulate
