// The backends of this process: those compiled in, then those registered at run time.
#pragma once

#include "base/result.hpp"

#include <plait/plait_backend.h>

namespace plait {

// Never shrinks, so an index or pointer stays good for the process. Safe from any thread.
size_t backend_count();
const plait_backend_api* backend_at(size_t index); // nullptr: out of range

Status register_backend(const plait_backend_api* api);
Status load_backend(const char* path);

} // namespace plait
