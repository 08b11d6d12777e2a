#include "backend/opencl/group_sums.hpp"

#include <algorithm>

namespace plait::opencl {
namespace {

constexpr uint64_t usual_edge_count = 8; // the default of plait_sim_params.grid_edge_count

template <typename Params> uint64_t edge_count_in(const void* params) {
    return params ? static_cast<const Params*>(params)->edge_count : usual_edge_count;
}

// Voxels along each edge of the grid that the stage adds to; 0: it adds to none.
uint64_t edge_count(const plait_dispatch& dispatch) {
    switch (dispatch.stage) {
    case PLAIT_STAGE_grid_splat:
        return edge_count_in<plait_grid_params>(dispatch.params);
    case PLAIT_STAGE_lane_splat:
        return edge_count_in<plait_lane_grid_params>(dispatch.params);
    case PLAIT_STAGE_volume_splat:
        return edge_count_in<plait_lane_volume_params>(dispatch.params);
    default:
        return 0;
    }
}

} // namespace

uint32_t group_sums(const plait_dispatch& dispatch, const plait_device_info& info) {
    const uint64_t most = std::min(most_group_sum_bytes, info.local_memory_bytes / 2);
    const uint64_t n = std::min<uint64_t>(edge_count(dispatch), 1u << 16); // no overflow
    const uint64_t words = n * n * n * PLAIT_SUM_STRIDE;
    return info.lanes == 1 && words * sizeof(uint32_t) <= most ? static_cast<uint32_t>(words) : 0;
}

} // namespace plait::opencl
