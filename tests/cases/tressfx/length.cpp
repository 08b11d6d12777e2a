#include "inputs.hpp"

namespace plait::cases {

// Every iteration rounds positions below 2 m twice; corrections are below 1 cm.
Case length_case() {
    Case result = {PLAIT_STAGE_length, {}, {{"position", 2e-6}}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 9);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {floats(hair.rest_length), uints(hair.vertex_count),
                         float4s(hair.position)};
        result.setups.push_back(setup.with(plait_length_params{size.stride, 3}));
    }
    return result;
}

} // namespace plait::cases
