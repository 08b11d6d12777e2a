// Distances to a cube and to a bent tube, sides among them, against a table that another program made.
#include "closed_forms.hpp"
#include "mesh/mesh_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plait::conformance {

using namespace cases;

namespace {

struct TablePoint {
    int tube;
    Point at;
    double distance;
    Point outward;
};
const TablePoint points[] = {
#include "mesh_points.inc"
};
const std::array<double, 6> tube_vertices[] = {
#include "mesh_tube.inc"
};
const std::array<uint32_t, 3> tube_triangles[] = {
#include "mesh_tube_triangles.inc"
};

constexpr double scale[2] = {0.06, 0.4}; // all within PLAIT_MESH_ROOM

Point scaled(const Point& p, double by) {
    return {by * p[0], by * p[1], by * p[2]};
}

void add_cube(NearestMeshes& meshes, double half) {
    std::vector<Point> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(
            scaled({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0}, half));
    meshes.add({{0, 2, 3},
                {0, 3, 1},
                {4, 5, 7},
                {4, 7, 6},
                {0, 1, 5},
                {0, 5, 4},
                {2, 6, 7},
                {2, 7, 3},
                {0, 4, 6},
                {0, 6, 2},
                {1, 3, 7},
                {1, 7, 5}},
               corners, corners, false);
}

// Straight at the begin of the step, bent at its end.
void add_tube(NearestMeshes& meshes) {
    std::vector<Point> from, to;
    for (const auto& v : tube_vertices) {
        from.push_back(scaled({v[0], v[1], v[2]}, scale[1]));
        to.push_back(scaled({v[3], v[4], v[5]}, scale[1]));
    }
    meshes.add(MeshCorners(std::begin(tube_triangles), std::end(tube_triangles)), from, to, false);
}

// One strand of a root far away and a vertex at each point of the table, at rest; the substep is the
// last of its step, and so short that nothing moves in it, nor the mesh.
void a_table_of_distances(Bench& bench) {
    for (const int tube : {0, 1}) {
        NearestMeshes meshes;
        tube ? add_tube(meshes) : add_cube(meshes, 0.1 * scale[0]);
        std::vector<float> x, rest, pose, material;
        std::vector<TablePoint> here;
        const Point root = {0.2, 0.3, 0.25};
        for (const TablePoint& point : points) {
            if (point.tube != tube)
                continue;
            here.push_back(point);
            const Point p = scaled(point.at, scale[tube]);
            append_floats(x, {root[0], root[1], root[2]});
            append_floats(x, {p[0] - root[0], p[1] - root[1], p[2] - root[2]});
            append_floats(rest, {root[0], root[1], root[2], 0, p[0], p[1], p[2], 0});
            append_floats(pose, {0, 0, 0, 1, 0, 0, 0, 0});
            append_floats(material, {0.4, 1, 1, 1e-6, 0, 0, 0, 1, 1, 1e-6, 0, 0});
            append_floats(meshes.clearance, {0, 0});
        }
        append_floats(meshes.rows, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0,   0,
                                    1, 0, 0, 0, 0, 0, 0, 0, 1, 0.3, double{PLAIT_KIND_MESH},
                                    0, 0});
        const auto strands = static_cast<uint32_t>(here.size());
        plait_lane_params params{};
        params.vertex_stride = params.row_stride = 2;
        params.tile = 1;
        params.h = 1e-4f;
        params.collider_count = 1;
        std::vector<Array> buffers = {null_array(), float4s(rest), float4s(pose),
                                      lane_floats(material, PLAIT_LANE_MATERIAL_COMPONENTS),
                                      float4s(meshes.rows)};
        const auto of_mesh = meshes.buffers();
        buffers.insert(buffers.end(), of_mesh.begin(), of_mesh.end());
        const std::vector<float> still(x.size(), 0);
        for (const Array& each :
             {null_array(), null_array(), lane_floats(x, 3), lane_floats(still, 3), null_array(),
              null_array(),
              lane_floats(std::vector<float>(size_t{2} * PLAIT_LANE_PLANE_COMPONENTS * strands, 9),
                          PLAIT_LANE_PLANE_COMPONENTS),
              float4s(std::vector<float>(size_t{8} * strands, 0)), // no side of a closed mesh
              null_array()})
            buffers.push_back(each);
        const Outputs out =
            bench.run(PLAIT_STAGE_mesh_nearest, strands, 2, params, std::move(buffers));
        ASSERT_FALSE(out.empty());
        const std::vector<float>& planes = out[out.size() - 3].floats;
        for (size_t i = 0; i < here.size(); ++i) {
            const float* row = &planes[2 * PLAIT_LANE_PLANE_COMPONENTS * i];
            ASSERT_EQ(row[PLAIT_LANE_PLANE_LAST], 1.0f) << "point " << i;
            row += PLAIT_LANE_PLANE_COMPONENTS;
            EXPECT_NEAR(double(row[PLAIT_LANE_PLANE_START]), scale[tube] * here[i].distance, 1e-7)
                << "point " << i;
            EXPECT_NEAR(double(row[PLAIT_LANE_PLANE_HEIGHT]), scale[tube] * here[i].distance, 1e-7)
                << "point " << i;
            for (size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(double(row[k]), here[i].outward[k], 1e-3) << "point " << i;
        }
    }
}

// ---- which nodes of a grid lie in a cube ---------------------------------------------------------

constexpr uint32_t solid_nodes = 33; // along an edge: bits of a row begin inside of words
constexpr float solid_voxel = 0.01f, solid_h = 1.0f / 60;
constexpr Point cube_way = {0.005, -0.01, 0.0025}; // m, in the substep

// Seven nodes and three quarters from the middle one of the grid in each direction. Lines of nodes pass
// exactly through the diagonals of its faces.
constexpr double cube_half = 0.0775;

template <typename Params> Params solid_params() {
    Params params{};
    params.edge_count = solid_nodes;
    params.q[3] = 1;
    if constexpr (requires { params.voxel_edge; }) {
        params.voxel_edge = solid_voxel;
        std::fill_n(params.t, 3, -0.5f * solid_nodes * solid_voxel);
    }
    if constexpr (requires { params.h; })
        params.h = solid_h;
    params.collider_count = 1;
    return params;
}

std::vector<float> cube_row() {
    std::vector<float> row;
    append_floats(row, {-cube_way[0], -cube_way[1], -cube_way[2], 0});
    append_floats(row, {0, 0, 0, 1});
    append_floats(row, {0, 0, 0, 1});
    append_floats(row, {0, 0, 0, 0});
    append_floats(row, {0, 0, 0, 1});
    append_floats(row, {0.5, double{PLAIT_KIND_MESH}, 0, 0});
    return row;
}

// Each component by its own rule: where the node is, and what moves there.
std::vector<float> nodes_in_cube(bool deep_too) {
    std::vector<float> solid;
    for (uint32_t node = 0; node < solid_nodes * solid_nodes * solid_nodes; ++node) {
        const uint32_t cell[] = {node % solid_nodes, node / (solid_nodes * solid_nodes),
                                 node / solid_nodes % solid_nodes};
        uint32_t most = 0; // voxels from the middle
        for (const uint32_t i : cell)
            most = std::max(most, i > solid_nodes / 2 ? i - solid_nodes / 2 : solid_nodes / 2 - i);
        const bool inside = most <= 7, moves = inside && (deep_too || most == 7);
        for (const double way : cube_way)
            solid.push_back(moves ? static_cast<float>(way / double(solid_h)) : 0.0f);
        solid.push_back(inside ? 1.0f : 0.0f);
    }
    return solid;
}

// By its triangles: what lies deeper than one node has met none.
void nodes_in_a_cube_of_triangles(Bench& bench) {
    NearestMeshes meshes;
    add_cube(meshes, cube_half);
    const uint32_t nodes = solid_nodes * solid_nodes * solid_nodes;
    const auto crossed = bench.run(
        PLAIT_STAGE_grid_solid_cross, 12, 1, solid_params<plait_grid_solid_cross_params>(),
        {float4s(cube_row()), uints(meshes.first), uints(meshes.triangle), float4s(meshes.from),
         float4s(meshes.to), uints(std::vector<uint32_t>((nodes + 31) / 32, 0u)),
         uints(std::vector<uint32_t>(nodes, 0u))});
    const auto filled = bench.run(PLAIT_STAGE_grid_solid_fill, solid_nodes * solid_nodes, 1,
                                  solid_params<plait_grid_solid_fill_params>(),
                                  {float4s(cube_row()), uints(meshes.first), uints(meshes.triangle),
                                   float4s(meshes.from), float4s(meshes.to), crossed[5], crossed[6],
                                   unwritten_float4s(nodes)});
    expect_near(filled[7], nodes_in_cube(false), 2e-5);
}

// By its distances: those of a cube with rounded edges are the greatest of its six.
void nodes_in_a_cube_of_distances(Bench& bench) {
    constexpr uint32_t along = 25;
    constexpr double cell = 0.009;
    std::vector<float> grid, values;
    append_floats(grid, {-12 * cell, -12 * cell, -12 * cell, cell});
    for (uint32_t i = 0; i < along * along * along; ++i) {
        double most = 0;
        for (const uint32_t k : {i % along, i / along % along, i / (along * along)})
            most = std::max(most, cell * std::abs(double(k) - 12));
        append_floats(values, {most - cube_half});
    }
    const uint32_t nodes = solid_nodes * solid_nodes * solid_nodes;
    const auto found =
        bench.run(PLAIT_STAGE_grid_solid_field, solid_nodes * solid_nodes, 1,
                  solid_params<plait_grid_solid_field_params>(),
                  {float4s(cube_row()), float4s(grid), uints({along, along, along, 0}),
                   floats(values), unwritten_float4s(nodes)});
    expect_near(found[4], nodes_in_cube(true), 2e-5);
}

} // namespace

const std::vector<ClosedForm>& mesh_closed_forms() {
    static const std::vector<ClosedForm> list = {PLAIT_CLOSED_FORM(a_table_of_distances),
                                                 PLAIT_CLOSED_FORM(nodes_in_a_cube_of_triangles),
                                                 PLAIT_CLOSED_FORM(nodes_in_a_cube_of_distances)};
    return list;
}

} // namespace plait::conformance
