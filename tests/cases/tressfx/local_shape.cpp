#include "inputs.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size, float stiffness, uint32_t iterations) {
    const Hair hair = make_hair(size, 7);
    Setup setup;
    setup.name = name_of(size) + ", stiffness " + std::to_string(stiffness);
    setup.items = size.strands;
    setup.buffers = {float4s(hair.rest), uints(hair.vertex_count), float4s(hair.pose),
                     float4s(hair.position)};
    return setup.with(plait_local_shape_params{size.stride, stiffness, iterations});
}

} // namespace

// A joint turns a 2 cm segment by a rotation good to 1e-7 / 0.02, that is 1e-7 m; a few add up.
Case local_shape_case() {
    Case result = {PLAIT_STAGE_local_shape, {}, {{"position", 2e-6}}, {"pose.t"}}; // it turns only
    for (const Size& size : sizes()) {
        result.setups.push_back(make(size, 0.7f, 2));
        result.setups.push_back(make(size, 1.0f, 1)); // limited to 0.95
    }
    return result;
}

} // namespace plait::cases
