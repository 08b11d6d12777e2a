#include "inputs.hpp"

namespace plait::cases {

// A displacement of millimetres, scaled and added to a position below 2 m.
Case clamp_case() {
    Case result = {PLAIT_STAGE_clamp, {}, {{"position", 1e-6}}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 11);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.position_prev), float4s(hair.position)};
        // Displacements are spread over 0..8 mm.
        result.setups.push_back(setup.with(plait_clamp_params{size.stride, 0.004f}));
    }
    return result;
}

} // namespace plait::cases
