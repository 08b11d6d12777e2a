#include "inputs.hpp"

namespace plait::cases {

// A rotation and a sum of values below 2 m.
Case tressfx_carry_case() {
    Case result = {PLAIT_STAGE_tressfx_carry,
                   {},
                   {{"position", 2e-6}, {"position_prev", 2e-6}, {"position_prev2", 2e-6}},
                   {"tile", "history", "turns", "position.w"}, // what is pinned goes, too
                   {},
                   {},
                   {},
                   {"q"}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 48);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.position), float4s(hair.position_prev),
                         float4s(hair.position_prev2)};
        result.setups.push_back(setup.with(plait_carry_params{
            size.stride, 1, 1, 1, {0.48f, 0.6f, 0, 0.64f}, {0.3f, -0.2f, 0.7f, 0}}));
    }
    return result;
}

} // namespace plait::cases
