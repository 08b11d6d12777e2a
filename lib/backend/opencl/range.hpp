// How a dispatch is spread over work-items.
#pragma once

#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <cstddef>

namespace plait::opencl {

struct GroupLimits {
    size_t device_items;   // CL_DEVICE_MAX_WORK_GROUP_SIZE
    size_t kernel_items;   // CL_KERNEL_WORK_GROUP_SIZE
    uint64_t local_memory; // CL_DEVICE_LOCAL_MEM_SIZE, bytes
    size_t lanes = 1;      // strands per work-item, and per tile, of the stages over lanes
    size_t tile = 1;
    bool advice = false; // kernel_items is only what the driver likes best
    bool sums = false;   // a group's sums are in its local memory: group_sums() > 0
};

// CL_KERNEL_WORK_GROUP_SIZE is a limit by the standard. The rusticl of Mesa 22.3 (Debian 12) gives
// its favourite multiple instead, 32, and runs groups of 1024.
bool gives_advice_for_limit(const plait_device_info& info);

struct WorkRange {
    size_t global;
    size_t local;
};

size_t element_size(plait_element element);

// VERTEX, STRAND, VOXEL, WORD: one work-item per item; in groups of 64, of vertices and words on
// devices without lanes of 256, of strands whose sums a group adds up of 128. STRAND_GROUP: short strands share a group of
// about 64 work-items, as in TressFX; with S strands in a group, work-item l is vertex l/S of
// strand l mod S, so a kernel derives S = get_local_size(0) / V. VOXEL_GROUP: one group per voxel,
// with as many of the wished work-items as the device allows. LANES: one work-item per `lanes`
// strands of every tile. @errors UNSUPPORTED
Result<WorkRange> work_range(const plait_stage_info& stage, const plait_dispatch& dispatch,
                             const GroupLimits& limits);

} // namespace plait::opencl
