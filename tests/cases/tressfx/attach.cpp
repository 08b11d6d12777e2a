#include "inputs.hpp"

namespace plait::cases {

// Arc lengths of up to 5 m and positions below 2 m: 1e-6 m. A reach of a third draws most vertices
// in.
Case attach_case() {
    Case result = {PLAIT_STAGE_attach, {}, {{"position", 2e-6}}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 21);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.buffers = {floats(hair.rest_length), uints(hair.vertex_count),
                         float4s(hair.position)};
        result.setups.push_back(setup.with(plait_attach_params{size.stride, 0.3f}));
    }
    return result;
}

} // namespace plait::cases
