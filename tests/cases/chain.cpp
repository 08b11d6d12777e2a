#include "lane_inputs.hpp"

namespace plait::cases {

// A length solve divides by w_i + w_(i+1) - ..., which folds make small: 1e-5 of a strand of up to
// 5 m, and h' = 1/45 s carries it to the velocity.
Case chain_case() {
    Case result = {
        PLAIT_STAGE_chain, {}, {{"lane_x", 2e-5}, {"lane_v", 1e-3}, {"lane_x_before", 1e-6}}};
    for (const Size& size : sizes())
        for (const uint32_t bdf2 : {0u, 1u})
            result.setups.push_back(
                lane_setup(size, make_lane_hair(size, 31), lane_params(size, 1, bdf2), false));
    return result;
}

} // namespace plait::cases
