#include "contact/colliders.hpp"
#include "inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

plait_wind_obstacle_params params_of(uint32_t edge_count, uint32_t colliders) {
    Random random(edge_count);
    const auto q = random.rotation();
    plait_wind_obstacle_params params{};
    params.edge_count = edge_count;
    params.voxel_edge = 1.6f / static_cast<float>(edge_count);
    std::copy(q.begin(), q.end(), params.q);
    const auto corner = rotate(q, {-0.8, -0.75, -0.85});
    std::copy(corner.begin(), corner.end(), params.t);
    params.extinction = 0.7f;
    params.collider_count = colliders;
    params.collider_first = colliders > 0 ? 1 : 0;
    return params;
}

std::vector<float> densities(uint32_t nodes) {
    Random random(nodes);
    std::vector<float> list;
    for (uint32_t node = 0; node < nodes; ++node)
        list.push_back(node % 5 == 1 ? 0.0f : static_cast<float>(random.uniform(0, 90)));
    return list;
}

// Many, so that some nodes lie near the thin ends of some.
std::vector<Collider> crowd() {
    Random random(11);
    std::vector<Collider> colliders;
    for (int i = 0; i < 16; ++i) {
        Collider collider = tapered;
        for (size_t axis = 0; axis < 3; ++axis) {
            const auto shift = static_cast<float>(random.uniform(-0.5, 0.5));
            collider.to[axis] += shift;
            collider.to[4 + axis] += shift;
        }
        colliders.push_back(collider);
    }
    return colliders;
}

// A prism that goes through all of the grid: three faces leave free where a row has what is not read.
Collider long_prism() {
    Collider prism = hull;
    prism.faces.resize(3);
    prism.to[6] = 2;
    return prism;
}

// Of every third node; how meshes move there is nothing to the wind.
Array in_meshes(uint32_t nodes) {
    std::vector<float> list;
    for (uint32_t node = 0; node < nodes; ++node)
        list.insert(list.end(), {1, 2, 3, node % 3 == 1 ? 1.0f : 0.0f});
    return float4s(std::move(list));
}

Setup make(uint32_t edge_count, std::vector<Collider> colliders, bool meshes) {
    const auto count = static_cast<uint32_t>(colliders.size());
    if (count > 0)
        colliders.insert(colliders.begin(), sphere); // of the substep before
    Setup setup;
    setup.name = std::to_string(edge_count) + " voxels, " + std::to_string(count) + " colliders" +
                 (meshes ? ", meshes" : "");
    setup.items = edge_count * edge_count * edge_count;
    setup.buffers = {floats(densities(setup.items)),
                     count > 0 ? float4s(pack(colliders)) : null_array(),
                     meshes ? in_meshes(setup.items) : null_array(), unwritten_floats(setup.items)};
    auto params = params_of(edge_count, count);
    params.meshes = meshes ? 1 : 0;
    return setup.with(params);
}

} // namespace

// A node is in a collider or not: shells of thousands of them notice where a collider ends.
Case wind_obstacle_case() {
    Case result = {PLAIT_STAGE_wind_obstacle,
                   {},
                   {{"wind_extinction", 1e-4}},
                   {"collider.begin.a", "collider.turn", "collider.friction", "mesh_solid.x",
                    "mesh_solid.y", "mesh_solid.z"}};
    result.flags.insert(result.flags.end(), {"collider.kind", "mesh_solid.inside"});
    const std::vector<Collider> list[] = {
        {},
        crowd(),
        {box},
        {plane},
        {sharp_box, tapered, box},
        {long_prism()},
        {inward(tapered), sharp_box, inward(box), inward(long_prism())}};
    for (const std::vector<Collider>& colliders : {std::vector<Collider>{}, crowd()})
        result.setups.push_back(make(31, colliders, true));
    for (const uint32_t edge_count : {1u, 5u, 31u})
        for (const std::vector<Collider>& colliders : list)
            result.setups.push_back(make(edge_count, colliders, false));
    return result;
}

} // namespace plait::cases
