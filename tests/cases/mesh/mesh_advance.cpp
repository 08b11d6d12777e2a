#include "inputs.hpp"

namespace plait::cases {
namespace {

std::vector<float> places(Random& random, uint32_t vertices) {
    std::vector<float> list;
    for (uint32_t i = 0; i < vertices; ++i) {
        for (int k = 0; k < 3; ++k)
            list.push_back(static_cast<float>(random.uniform(-2, 2)));
        list.push_back(0);
    }
    return list;
}

Setup make(uint32_t vertices, uint32_t begins, float part) {
    Random random(vertices + begins);
    const uint32_t all = begins + vertices + 3; // of meshes before and after
    Setup setup;
    setup.name = std::to_string(vertices) + " vertices, " + std::to_string(part) + " of the way";
    setup.items = vertices;
    setup.buffers = {float4s(places(random, vertices)), float4s(places(random, vertices)),
                     float4s(places(random, all)), float4s(places(random, all))};
    return setup.with(plait_mesh_advance_params{begins, part, 1.25f, 0.7f});
}

} // namespace

// Within 2 m of the origin. At the end of the way it is exact.
Case mesh_advance_case() {
    Case result = {
        PLAIT_STAGE_mesh_advance, {}, {{"mesh_from", 0}, {"mesh_to", 1e-6}}, {"mesh_from"}};
    for (const uint32_t vertices : {1u, 12u, 300u})
        for (const float part : {0.25f, 0.8f})
            result.setups.push_back(make(vertices, vertices == 12 ? 7 : 0, part));
    return result;
}

} // namespace plait::cases
