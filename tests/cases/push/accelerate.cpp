#include "inputs.hpp"

namespace plait::cases {

// Zeros, whatever the hair does.
Case accelerate_case() {
    Case result = {PLAIT_STAGE_accelerate,
                   {},
                   {},
                   {"h", "time", "value", "position", "position_prev", "acceleration"}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 40);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {uints(hair.vertex_count), float4s(hair.position),
                         float4s(hair.position_prev), float4s(accelerations(size, 10))};
        plait_accelerate_params params = {size.stride, 1.0f / 60, 2, {}};
        for (float& value : params.value)
            value = 3;
        result.setups.push_back(setup.with(params));
    }
    return result;
}

} // namespace plait::cases
