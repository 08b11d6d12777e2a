#include "mesh/mesh_inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

// Of every vertex and mesh what the substep before knew of sheets: nothing, or a side, kept or strayed from,
// and a place, from where the way here passes through the surface or does not.
std::vector<float> make_sides(const Size& size, Random& random) {
    std::vector<float> sides;
    constexpr double known[] = {0, 1, -1, double{PLAIT_MESH_SIDE_ASTRAY},
                                -double{PLAIT_MESH_SIDE_ASTRAY}};
    for (size_t i = 0; i < size_t{size.strands} * size.stride * size.strands; ++i) {
        const auto from = random.direction();
        const double out = random.uniform(0.01, 0.09);
        const double some = known[i % 5] != 0 ? out : 0;
        append_floats(sides, {some * from[0], some * from[1], some * from[2], known[i % 5]});
    }
    return sides;
}

NearestMeshes make_meshes(const LaneHair& lanes, uint32_t seed) {
    NearestMeshes meshes;
    Random random(seed);
    const Size& size = lanes.hair.size;
    for (size_t s = 0; s < size.strands; ++s) {
        add_ball(meshes, random, s % 4 == 3, s % 2 == 0);
        const size_t first = s * size.stride;
        const size_t middle = first + lanes.hair.vertex_count[s] / 2;
        const std::array<double, 2> shares = {random.uniform(0.1, 0.4), random.uniform(0.5, 0.9)};
        if (s % 3 == 1) // around the root
            add_mesh_row(meshes.rows, random, lanes, first + 1, -0.035, shares);
        else
            add_mesh_row(meshes.rows, random, lanes, middle, s % 3 == 2 ? -0.006 : 0.006, shares);
    }
    for (size_t i = 0; i < size_t{size.strands} * size.stride * size.strands; ++i)
        append_floats(meshes.clearance, {random.uniform(-0.002, 0.001)});
    return meshes;
}

Setup nearest_setup(const Size& size, uint32_t bdf2, bool after_others, uint32_t seed) {
    const LaneHair lanes = make_lane_hair(size, seed);
    const NearestMeshes meshes = make_meshes(lanes, seed + 1);
    Setup setup = lane_setup(size, lanes, lane_params(size, 1, bdf2), false);
    if (after_others)
        setup = on_planes(std::move(setup), lanes, 100.0f, false);
    auto& buffers = setup.buffers;
    Array planes = std::move(buffers[7]); // lane_plane, which comes last here
    buffers.erase(buffers.begin() + 7);
    std::vector<float> rows(meshes.rows.size(), 0.5f); // of the substep before
    rows.insert(rows.end(), meshes.rows.begin(), meshes.rows.end());
    buffers[4] = float4s(rows);
    const auto of_meshes = meshes.buffers();
    buffers.insert(buffers.begin() + 5, of_meshes.begin(), of_meshes.end());
    buffers.push_back(std::move(planes));
    Random random(seed + 2);
    buffers.push_back(float4s(make_sides(size, random)));
    buffers.push_back(lane_floats(
        std::vector<float>(size_t{PLAIT_LANE_HOLLOW_COMPONENTS} * size.strands * size.stride, 9),
        PLAIT_LANE_HOLLOW_COMPONENTS));
    auto params = setup.params_as<plait_lane_params>();
    params.collider_count = params.collider_first = size.strands;
    params.hollows = 1;
    return setup.with(params);
}

} // namespace

// The way from an edge a millimetre off has no direction to more than 1e-4, places being known to 1e-7 m.
Case mesh_nearest_case() {
    Case result = {PLAIT_STAGE_mesh_nearest,
                   {},
                   {{"lane_plane", 1e-4}, {"mesh_side", 1e-5}, {"lane_hollow", 1e-4}}};
    result.unread = {"iterations",
                     "contact_rate",
                     "contact_slip",
                     "collider.end.b",
                     "collider.kind",
                     "lane_material.stretch",
                     "lane_material.bend",
                     "lane_material.twist",
                     "lane_material.cross",
                     "lane_material.friction",
                     "lane_material.wetness",
                     "mesh_box",   // bounds, which the reference does without
                     "mesh_bends", // a bound, too, and whether there is anything to bend
                     "mesh_side.x",
                     "mesh_side.y",
                     "mesh_side.z",     // a way from there passes through a triangle, or does not
                     "mesh_side.side"}; // one of five
    result.decides = {
        "lane_plane"}; // the deeper stays: both are there, and which it is is compared
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u}) {
            result.setups.push_back(nearest_setup(size, bdf2, bdf2 == 1, 71));
            result.setups.push_back(result.setups.back());
            pin_tips(result.setups.back(), 15);
        }
    for (const Size& size : contact_sizes())
        result.setups.push_back(reordered_too(nearest_setup(size, 0, false, 72), {13, 21}));
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
