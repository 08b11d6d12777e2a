#include "inputs.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size, uint32_t form) {
    const Hair hair = make_hair(size, 5);
    Setup setup;
    setup.name = name_of(size) + (form ? ", continuous" : ", threshold");
    setup.items = size.strands;
    setup.buffers = {float4s(hair.position), float4s(hair.position_prev),
                     float4s(hair.position_prev2), unwritten_float4s(2 * size.strands)};
    // The strands' second differences lie on both sides of 4 mm and of twice that.
    return setup.with(plait_strand_data_params{size.stride, 0.6f, 0.004f, form});
}

} // namespace

// The direction of a 2 cm segment between float32 points 1 m from the origin is good to 1e-7 /
// 0.02; the same relative error of the second difference over its threshold of 4 mm reaches the
// blend. The root segment moves with its root, pinned or not.
Case strand_data_case() {
    Case result = {PLAIT_STAGE_strand_data, {}, {{"strand_motion", 5e-5}}, {"position.w"}};
    for (const Size& size : sizes())
        for (uint32_t form : {PLAIT_SHOCK_CONTINUOUS, PLAIT_SHOCK_THRESHOLD})
            result.setups.push_back(make(size, form));
    return result;
}

} // namespace plait::cases
