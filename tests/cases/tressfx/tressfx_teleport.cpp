#include "inputs.hpp"

namespace plait::cases {

// Two rotations and two sums of values below 2 m.
Case tressfx_teleport_case() {
    Case result = {PLAIT_STAGE_tressfx_teleport,
                   {},
                   {{"position", 2e-6}, {"position_prev", 2e-6}, {"position_prev2", 2e-6}},
                   {"position.w"}}; // what is pinned goes, too
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 2);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.pose), float4s(hair.pose_other), float4s(hair.position),
                         float4s(hair.position_prev), float4s(hair.position_prev2)};
        result.setups.push_back(setup.with(plait_layout_params{size.stride}));
    }
    return result;
}

} // namespace plait::cases
