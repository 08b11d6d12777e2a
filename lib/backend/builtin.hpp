// The backends compiled into the library.
#pragma once

#include <plait/plait_backend.h>

namespace plait {

const plait_backend_api* reference_backend(); // float64, Eigen: the specification
const plait_backend_api* opencl_backend();    // only with PLAIT_OPENCL

} // namespace plait
