#include "inputs.hpp"

namespace plait::cases {

// One difference and one rotation of values below 2 m.
Case output_keep_case() {
    Case result = {PLAIT_STAGE_output_keep, {}, {{"position_local", 1e-6}}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 12);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.pose), float4s(hair.position),
                         unwritten_float4s(hair.vertices())};
        result.setups.push_back(setup.with(plait_layout_params{size.stride}));
    }
    return result;
}

} // namespace plait::cases
