#include "inputs.hpp"

namespace plait::cases {

// Two rotations, a blend and two sums of values below 2 m.
Case output_case() {
    Case result = {PLAIT_STAGE_output, {}, {{"position_out", 2e-6}}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 13);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.rest), float4s(hair.position), float4s(hair.pose),
                         float4s(hair.pose_other), unwritten_float4s(hair.vertices())};
        result.setups.push_back(setup.with(plait_output_params{size.stride, 0.35f}));
    }
    return result;
}

} // namespace plait::cases
