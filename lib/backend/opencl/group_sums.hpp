// Sums of the grid in a work-group's local memory.
#pragma once

#include <plait/plait_backend.h>

#include <cstdint>

namespace plait::opencl {

// Bytes of local memory that a work-group's sums may take at most, where the device has twice as many:
// as much is left for another group.
inline constexpr uint64_t most_group_sum_bytes = 32768;

// Words of sums that a work-group of this dispatch keeps in local memory before they go to the grid's:
// all of the grid's, where each strand has a work-item of its own and they fit; 0: none. Each number
// is a kernel of its own (PLAIT_GROUP_SUMS): the memory that a group takes is no more than its grid's.
// Without parameters, of the usual grid: to prepare for it.
uint32_t group_sums(const plait_dispatch& dispatch, const plait_device_info& info);

} // namespace plait::opencl
