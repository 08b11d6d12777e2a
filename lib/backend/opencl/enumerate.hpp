// Which OpenCL devices there are, and why the others are not among them.
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace plait::opencl {

// Which device is taken where none is asked for; the greater one, members in order.
struct Rank {
    int kind = 0;          // GPUs, then accelerators, then CPUs
    bool discrete = false; // a GPU with memory of its own
    uint64_t memory = 0;   // bytes, of a GPU: vendors count units and widths in different ways
    double arithmetic = 0; // of CPUs, which share their memory: MHz x units x width

    auto operator<=>(const Rank&) const = default;
};

// `unified` is CL_DEVICE_HOST_UNIFIED_MEMORY, `clock` in MHz.
Rank rank_of(const plait_device_info& info, bool unified, uint32_t clock);

struct Candidate {
    cl_platform_id platform;
    cl_device_id device;
    plait_device_info info;
    Rank rank;
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
