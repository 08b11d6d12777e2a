#include "inputs.hpp"

namespace plait::cases {

// Two rotations and blends of values below 2 m.
Case velocity_shock_case() {
    Case result = {PLAIT_STAGE_velocity_shock, {}, {{"position", 2e-6}, {"position_prev", 2e-6}}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 6);
        std::vector<float> motion = hair.pose;
        for (size_t s = 0; s < size.strands; ++s)
            motion[8 * s + 7] = s % 4 ? 0.3f : 1.0f; // blend c
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {uints(hair.vertex_count), float4s(motion), float4s(hair.position),
                         float4s(hair.position_prev)};
        result.setups.push_back(setup.with(plait_layout_params{size.stride}));
    }
    return result;
}

} // namespace plait::cases
