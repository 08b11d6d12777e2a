#include "lane_inputs.hpp"

namespace plait::cases {

// Sums of values below 8 m.
Case lane_unpack_case() {
    Case result = {PLAIT_STAGE_lane_unpack, {}, {{"position", 1e-6}, {"position_prev", 1e-6}}};
    for (const Size& size : sizes()) {
        const LaneHair lanes = make_lane_hair(size, 36);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {null_array(),
                         uints(lanes.hair.vertex_count),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.v, 3),
                         float4s(lanes.hair.position),
                         float4s(lanes.hair.position_prev)};
        result.setups.push_back(
            setup.with(plait_lane_layout_params{size.stride, 1, size.stride, 1.0f / 60}));
        // all strands but one, in another order
        setup.name += ", reordered";
        setup.items -= 1;
        setup.buffers[0] = uints(other_order(size.strands, size.strands - 1));
        result.setups.push_back(setup);
    }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
