#include "inputs.hpp"

namespace plait::cases {

// A product of three poses, and of five for the step before the last, of places below 2 m.
Case tressfx_set_off_case() {
    Case result = {PLAIT_STAGE_tressfx_set_off,
                   {},
                   {{"position_prev", 6e-6}, {"position_prev2", 1e-5}},
                   {"tile", "history", "position_prev.w", "position_prev2.w"},
                   {},
                   {},
                   {},
                   {"jump", "h", "rest"}}; // 0: all strands
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 46), other = make_hair(size, 47);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.rest),          float4s(other.pose),
                         float4s(other.pose_other),   float4s(hair.pose),
                         float4s(hair.pose_other),    float4s(hair.position_prev),
                         float4s(hair.position_prev2)};
        result.setups.push_back(
            setup.with(plait_set_off_params{size.stride, 1, size.stride, 1, 1.0f / 60, 0}));
    }
    return result;
}

} // namespace plait::cases
