#include "lane_inputs.hpp"

namespace plait::cases {

Case gather_case() {
    Case result = {PLAIT_STAGE_gather, {}, {}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 38);
        for (const bool poses : {false, true}) {
            const uint32_t width = poses ? PLAIT_POSE_STRIDE : size.stride;
            Setup setup;
            setup.name = name_of(size) + (poses ? ", poses" : ", rows");
            setup.items = (size.strands + 1) / 2;
            setup.buffers = {uints(other_order(size.strands, setup.items)),
                             float4s(poses ? hair.pose : hair.rest),
                             unwritten_float4s(size_t{setup.items} * width)};
            result.setups.push_back(setup.with(plait_layout_params{width}));
        }
    }
    return result;
}

} // namespace plait::cases
