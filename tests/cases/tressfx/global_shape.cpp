#include "inputs.hpp"

namespace plait::cases {

// One rotation, a sum and a blend of values below 2 m.
Case global_shape_case() {
    Case result = {PLAIT_STAGE_global_shape, {}, {{"position", 1e-6}}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 4);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.rest), uints(hair.vertex_count), float4s(hair.pose),
                         float4s(hair.position)};
        // 0.5 V is a whole number for even V: 1 % more takes one vertex more.
        result.setups.push_back(setup.with(plait_global_shape_params{size.stride, 0.6f, 0.5f}));
    }
    return result;
}

} // namespace plait::cases
