#include "inputs.hpp"

namespace plait::cases {

// One rotation and one sum of values below 2 m.
Case tressfx_reset_case() {
    Case result = {PLAIT_STAGE_tressfx_reset,
                   {},
                   {{"position", 1e-6}, {"position_prev", 1e-6}, {"position_prev2", 1e-6}},
                   {"position.x", "position.y", "position.z"}}; // written, only w is kept
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 1);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.rest), float4s(hair.pose), float4s(hair.position),
                         unwritten_float4s(hair.vertices()), unwritten_float4s(hair.vertices())};
        result.setups.push_back(setup.with(plait_layout_params{size.stride}));
    }
    return result;
}

} // namespace plait::cases
