#include "inputs.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size, float stiffness) {
    const Hair hair = make_hair(size, 3);
    Setup setup;
    setup.name = name_of(size) + ", stiffness " + std::to_string(stiffness);
    setup.items = hair.vertices();
    setup.buffers = {float4s(hair.rest),          uints(hair.vertex_count),
                     float4s(hair.pose),          float4s(accelerations(size, 10)),
                     float4s(hair.position),      float4s(hair.position_prev),
                     float4s(hair.position_prev2)};
    const plait_integrate_params params = {size.stride,          1.0f / 60, 0.5f, stiffness, 0.5f,
                                           {1.5f, -9.81f, 2.5f}, 1};
    return setup.with(params);
}

} // namespace

// A handful of float32 operations on values below 2 m; the histories are shifted, not computed, and
// the oldest is lost.
Case integrate_case() {
    Case result = {PLAIT_STAGE_integrate, {}, {{"position", 1e-6}}, {"position_prev2"}};
    for (const Size& size : sizes())
        for (float stiffness : {0.0f, 0.4f})
            result.setups.push_back(make(size, stiffness));
    return result;
}

} // namespace plait::cases
