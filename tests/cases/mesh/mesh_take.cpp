#include "inputs.hpp"

#include <limits>

namespace plait::cases {
namespace {

Setup make(uint32_t vertices, uint32_t words) {
    Random random(vertices + words);
    std::vector<float> taken, at;
    for (uint32_t i = 0; i < vertices; ++i) {
        for (uint32_t k = 0; k < words; ++k)
            taken.push_back(static_cast<float>(random.uniform(-2, 2)));
        for (int k = 0; k < 3; ++k)
            at.push_back(static_cast<float>(random.uniform(-2, 2)));
        at.push_back(0);
    }
    const float none[] = {std::numeric_limits<float>::quiet_NaN(),
                          -std::numeric_limits<float>::infinity(), 2e6f};
    for (uint32_t k = 0; k < 3 && 5 * k < vertices; ++k) // places that are none
        taken[size_t{5} * k * words + k] = none[k];
    Setup setup;
    setup.name = std::to_string(vertices) + " vertices of " + std::to_string(words) + " words";
    setup.items = vertices;
    setup.buffers = {floats(taken), float4s(at), unwritten_float4s(vertices)};
    return setup.with(plait_mesh_take_params{words, words == 4 ? 1.0f : 0.6f});
}

} // namespace

// Within 2 m of the origin.
Case mesh_take_case() {
    Case result = {PLAIT_STAGE_mesh_take, {}, {{"mesh_target", 1e-6}}};
    for (const uint32_t vertices : {1u, 12u, 300u})
        for (const uint32_t words : {3u, 4u, 8u})
            result.setups.push_back(make(vertices, words));
    return result;
}

} // namespace plait::cases
