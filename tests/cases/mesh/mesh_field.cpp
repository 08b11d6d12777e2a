#include "mesh/field_inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

struct Meshes : FieldMeshes {
    std::vector<float> clearance;
};

Meshes make_meshes(const LaneHair& lanes, uint32_t seed) {
    Meshes meshes;
    Random random(seed);
    const Size& size = lanes.hair.size;
    for (size_t s = 0; s < size.strands; ++s) {
        meshes.add(random);
        const size_t first = s * size.stride;
        if (s % 3 == 1) // around the root
            add_mesh_row(meshes.rows, random, lanes, first + 1, -0.025);
        else
            add_mesh_row(meshes.rows, random, lanes, first + lanes.hair.vertex_count[s] / 2,
                         s % 3 == 2 ? -0.006 : 0.006);
    }
    for (size_t i = 0; i < size_t{size.strands} * size.stride * size.strands; ++i)
        append_floats(meshes.clearance, {random.uniform(-0.002, 0.001)});
    return meshes;
}

// The buffers of a stage over lanes without orientations, and those of the meshes among them.
Setup mesh_setup(const Size& size, uint32_t bdf2, uint32_t seed) {
    const LaneHair lanes = make_lane_hair(size, seed);
    const Meshes meshes = make_meshes(lanes, seed + 1);
    Setup setup = lane_setup(size, lanes, lane_params(size, 1, bdf2), false);
    auto& buffers = setup.buffers;
    buffers.erase(buffers.begin() + 7);                // lane_plane, which comes last here
    std::vector<float> rows(meshes.rows.size(), 0.5f); // of the substep before
    rows.insert(rows.end(), meshes.rows.begin(), meshes.rows.end());
    buffers[4] = float4s(rows);
    const Array of_meshes[] = {float4s(meshes.grid), uints(meshes.nodes), floats(meshes.values),
                               floats(meshes.clearance)};
    buffers.insert(buffers.begin() + 5, std::begin(of_meshes), std::end(of_meshes));
    buffers.push_back(lane_floats(
        std::vector<float>(size_t{PLAIT_LANE_PLANE_COMPONENTS} * size.strands * size.stride, 9),
        PLAIT_LANE_PLANE_COMPONENTS));
    auto params = setup.params_as<plait_lane_params>();
    params.collider_count = params.collider_first = size.strands;
    return setup.with(params);
}

} // namespace

// A plane turns by what its foot moves over the radius of the ball.
Case mesh_field_case() {
    Case result = {PLAIT_STAGE_mesh_field, {}, {{"lane_plane", 3e-5}}};
    result.unread = {"iterations",
                     "contact_rate",
                     "contact_slip",
                     "planes",
                     "hollows",
                     "collider.begin.a.radius",
                     "collider.end.a.radius",
                     "collider.end.b",
                     "collider.kind",
                     "lane_material.stretch",
                     "lane_material.bend",
                     "lane_material.twist",
                     "lane_material.cross",
                     "lane_material.friction",
                     "lane_material.wetness"};
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u}) {
            result.setups.push_back(mesh_setup(size, bdf2, 61));
            result.setups.push_back(result.setups.back());
            pin_tips(result.setups.back(), 10);
        }
    for (const Size& size : contact_sizes())
        result.setups.push_back(reordered_too(mesh_setup(size, 0, 62), {8}));
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
