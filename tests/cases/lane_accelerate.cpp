#include "lane_inputs.hpp"

namespace plait::cases {

// A copy.
Case lane_accelerate_case() {
    Case result = {PLAIT_STAGE_lane_accelerate, {}, {}, {"acceleration.w"}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 41);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {
            null_array(), uints(hair.vertex_count), float4s(accelerations(size, 10)),
            lane_floats(std::vector<float>(size_t{3} * size.strands * size.stride, 9), 3)};
        result.setups.push_back(setup.with(plait_lane_tile_params{size.stride, 1}));
        setup.name += ", reordered";
        setup.buffers[0] = uints(other_order(size.strands, size.strands));
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
