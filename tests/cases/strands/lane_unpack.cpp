#include "lane_inputs.hpp"

#include <algorithm>

namespace plait::cases {

// Sums of values below 8 m, whose 2e-7 m of rounding turn a segment of a centimetre by 4e-5.
Case lane_unpack_case() {
    Case result = {PLAIT_STAGE_lane_unpack,
                   {},
                   {{"position", 1e-6}, {"position_prev", 1e-6}, {"tangent", 1e-4}}};
    for (const Size& size : sizes()) {
        LaneHair lanes = make_lane_hair(size, 36);
        if (size.stride == 16) // a segment without a direction
            std::copy_n(lanes.x.begin() + 3 * 5, 3, lanes.x.begin() + 3 * 6);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {null_array(),
                         uints(lanes.hair.vertex_count),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.v, 3),
                         float4s(lanes.hair.position),
                         float4s(lanes.hair.position_prev),
                         unwritten_float4s(lanes.hair.vertices())};
        result.setups.push_back(
            setup.with(plait_lane_unpack_params{size.stride, 1, size.stride, 1.0f / 60, 1}));
        // all strands but one, in another order
        setup.name += ", reordered";
        setup.items -= 1;
        setup.buffers[0] = uints(other_order(size.strands, size.strands - 1));
        result.setups.push_back(setup);
        setup.name += ", not to be shown";
        setup.buffers[6] = null_array();
        result.setups.push_back(
            setup.with(plait_lane_unpack_params{size.stride, 1, size.stride, 1.0f / 60, 0}));
    }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
