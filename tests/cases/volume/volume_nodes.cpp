#include "volume/volume_inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

void put_sum(std::vector<uint32_t>& words, double value, float scale) {
    const auto bits = static_cast<uint64_t>(static_cast<int64_t>(value * double(scale)));
    words.push_back(static_cast<uint32_t>(bits));
    words.push_back(static_cast<uint32_t>(bits >> 32));
}

// Of thousands of vertices, some nodes empty.
std::vector<uint32_t> sums(uint32_t nodes) {
    Random random(nodes);
    std::vector<uint32_t> words;
    for (uint32_t node = 0; node < nodes; ++node) {
        const double density = node % 4 == 2 ? 0 : random.uniform(0.01, 3000);
        put_sum(words, density, PLAIT_SUM_DENSITY_SCALE);
        for (int axis = 0; axis < 3; ++axis)
            put_sum(words, density * random.uniform(-3, 3), PLAIT_SUM_MOMENTUM_SCALE);
        put_sum(words, density * random.uniform(1, 20), PLAIT_SUM_REST_SCALE);
    }
    return words;
}

// Of two in five nodes.
Array in_meshes(uint32_t nodes) {
    Random random(nodes + 1);
    std::vector<float> list;
    for (uint32_t node = 0; node < nodes; ++node) {
        const bool inside = node % 5 < 2;
        for (int axis = 0; axis < 3; ++axis)
            list.push_back(inside ? static_cast<float>(random.uniform(-2, 2)) : 0.0f);
        list.push_back(inside ? 1.0f : 0.0f);
    }
    return float4s(std::move(list));
}

Setup make(uint32_t edge_count, bool colliders, bool meshes) {
    plait_volume_nodes_params params{};
    params.edge_count = edge_count;
    params.voxel_edge = 1.1f / static_cast<float>(edge_count);
    Random random(11);
    const auto q = random.rotation();
    std::copy(q.begin(), q.end(), params.q);
    const Point corner = rotate(q, {-.53, -.56, -.54}); // the colliders are around the origin
    std::copy(corner.begin(), corner.end(), params.t);
    params.collider_count = colliders ? 5 : 0;
    params.collider_first = 1;
    params.meshes = meshes ? 1 : 0;
    params.h = 1.0f / 30;
    Setup setup;
    const uint32_t nodes = edge_count * edge_count * edge_count;
    setup.name = std::to_string(edge_count) + " nodes" + (colliders ? ", colliders" : "") +
                 (meshes ? ", meshes" : "");
    setup.items = nodes;
    setup.buffers = {uints(sums(nodes)),
                     float4s(colliders_among_nodes()),
                     meshes ? in_meshes(nodes) : null_array(),
                     unwritten_floats(nodes),
                     unwritten_float4s(nodes),
                     unwritten_floats(nodes),
                     unwritten_float4s(nodes)};
    return setup.with(params);
}

} // namespace

// Velocities of colliders are differences of positions over a thirtieth of a second. No node lies so
// near a surface that rounding decides on which side.
Case volume_nodes_case() {
    Case result = {PLAIT_STAGE_volume_nodes,
                   {},
                   {{"grid_density", 5e-4},
                    {"grid_velocity", 4e-6},
                    {"volume_rest", 1e-4},
                    {"volume_solid", 1e-4}},
                   unread_of_colliders()};
    result.unread.push_back("collider.friction");
    result.flags.insert(result.flags.end(), {"collider.kind", "mesh_solid.inside"});
    for (const bool meshes : {true, false})
        for (const uint32_t edge_count : {1u, 3u, 7u, 20u})
            for (const bool colliders : {true, false})
                result.setups.push_back(make(edge_count, colliders, meshes));
    return result;
}

} // namespace plait::cases
