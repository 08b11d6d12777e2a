// Which OpenCL devices there are, and why the others are not among them.
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <string>
#include <vector>

namespace plait::opencl {

struct Candidate {
    cl_platform_id platform;
    cl_device_id device;
    plait_device_info info;
    double rank; // higher is better
};

struct Candidates {
    std::vector<Candidate> usable;     // best first
    std::vector<std::string> rejected; // one sentence each
};

Candidates find_devices();

// The width of kernels over lanes, and the tile that goes with it. @errors INVALID_ARGUMENT
Status set_lanes(plait_device_info& info, uint32_t lanes);

// @errors UNSUPPORTED: what plait needs and the device lacks
Result<Candidate> examine_device(cl_device_id device);

} // namespace plait::opencl
