#include "inputs.hpp"

namespace plait::cases {

// A turn is a product of up to 256 rounded quaternions between directions whose rounding is that of
// a difference of positions of up to 2 m, over a segment of 2 cm.
Case guide_turns_case() {
    Case result = {PLAIT_STAGE_guide_turns,
                   {},
                   {{"guide_turn", 5e-5}},
                   {"pose.t", "position.w"}}; // directions only
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 51);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.buffers = {float4s(hair.rest), float4s(hair.pose), uints(hair.vertex_count),
                         float4s(hair.position), unwritten_float4s(hair.vertices())};
        result.setups.push_back(setup.with(plait_layout_params{size.stride}));
    }
    return result;
}

} // namespace plait::cases
