// Does a kernel have the arguments its stage declares?
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <string>
#include <vector>

namespace plait::opencl {

// As they are written in OpenCL C: "__global const float4* position".
std::vector<std::string> expected_arguments(const plait_stage_info& stage);

// COMPILE names the first argument that differs, what was expected and what was found. UNSUPPORTED
// if the driver keeps no argument information; then only their number was compared.
Status check_arguments(cl_kernel kernel, const plait_stage_info& stage, const std::string& file);

} // namespace plait::opencl
