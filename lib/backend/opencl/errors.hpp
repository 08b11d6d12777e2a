// OpenCL's error codes as plait's.
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <string>

namespace plait::opencl {

// "CL_OUT_OF_RESOURCES (-5)"
std::string error_name(cl_int code);

// A call made now failed: `what` says which, on what.
Error failure(cl_int code, const std::string& what);

// Work enqueued earlier turned out to have failed. Unlike in failure(), CL_OUT_OF_RESOURCES means
// that the device is gone: it is what drivers report for a kernel that faulted or was killed.
Error late_failure(cl_int code, const std::string& what);

} // namespace plait::opencl
