/* grid_solid_cross: where a mesh that bends passes between nodes of a grid, along each axis.
 *
 * Items   triangles of the mesh.
 * Reads   collider (here the mesh), mesh_first, mesh_triangle, mesh_from, mesh_to.
 * Moves   mesh_passed: a bit for every node, that changes with each triangle that passes between it
 *         and the one before along x; mesh_met: the greatest of 1 + the triangles that pass beside the
 *         node along any axis. Neither depends on the order of triangles.
 * Source  parity along a line, and edges that both their triangles see alike, as in Schwarz & Seidel
 *         2010, Fast parallel surface and solid voxelization on GPUs; the triangles met: ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "grid/grid.clh"
#include "grid/mesh_solid.clh"

typedef struct {
    int count;   /* nodes per edge */
    int3 stride; /* from a node to the next, along the three axes of the corners */
    uint met;    /* 1 + the triangle */
    bool passes; /* along x */
    __global uint* passed;
    __global uint* nodes_met;
} solid_grid;

/* A corner in units of nodes, node 0 in 0. */
typedef struct {
    float3 at;
    uint vertex; /* of two the one with the lower number comes first */
} solid_corner;

/* Does the edge between two corners pass a line along x on one side? To the bit the same for both
 * triangles that share it, so that no line slips through between them. */
static inline bool solid_beside(const solid_corner* a, const solid_corner* b, float y, float z) {
    const bool ordered = a->vertex < b->vertex;
    const float3 from = ordered ? a->at : b->at, to = ordered ? b->at : a->at;
    if ((from.z > z) == (to.z > z))
        return false;
    return from.y + (z - from.z) / (to.z - from.z) * (to.y - from.y) > y;
}

static inline float solid_least(float a, float b, float c) {
    return fmin(a, fmin(b, c));
}
static inline float solid_most(float a, float b, float c) {
    return fmax(a, fmax(b, c));
}
/* Nodes from `low` on, up to `high`. */
static inline int solid_first(float low, int count) {
    return (int)clamp(ceil(low), 0.0f, (float)count);
}
static inline int solid_last(float high, int count) {
    return (int)clamp(floor(high), -1.0f, (float)(count - 1));
}

/* Passes through the line of nodes along x at y, z. */
static inline void solid_pass(const solid_grid* grid, float x, int y, int z) {
    const int behind = solid_first(x, grid->count);
    const int row = y * grid->stride.y + z * grid->stride.z;
    if (behind < grid->count) {
        const uint node = (uint)(row + behind * grid->stride.x);
        if (grid->passes)
            atomic_xor(&grid->passed[node / 32u], 1u << node % 32u);
        atomic_max(&grid->nodes_met[node], grid->met);
    }
    if (behind > 0)
        atomic_max(&grid->nodes_met[row + (behind - 1) * grid->stride.x], grid->met);
}

/* All lines along x of a triangle. */
static inline void solid_lines(const solid_grid* grid, const solid_corner* a, const solid_corner* b,
                               const solid_corner* c) {
    const int last_y = solid_last(solid_most(a->at.y, b->at.y, c->at.y), grid->count),
              last_z = solid_last(solid_most(a->at.z, b->at.z, c->at.z), grid->count);
    const float low = solid_least(a->at.x, b->at.x, c->at.x),
                high = solid_most(a->at.x, b->at.x, c->at.x);
    const float3 ab = b->at - a->at, ac = c->at - a->at;
    const float3 normal = (ab.yzx * ac.zxy - ab.zxy * ac.yzx);
    for (int z = solid_first(solid_least(a->at.z, b->at.z, c->at.z), grid->count); z <= last_z; ++z)
        for (int y = solid_first(solid_least(a->at.y, b->at.y, c->at.y), grid->count); y <= last_y;
             ++y) {
            const float fy = (float)y, fz = (float)z;
            if (!(solid_beside(a, b, fy, fz) ^ solid_beside(b, c, fy, fz) ^
                  solid_beside(c, a, fy, fz)))
                continue;
            const float rise = normal.y * (fy - a->at.y) + normal.z * (fz - a->at.z);
            const float x = normal.x != 0.0f ? a->at.x - rise / normal.x : low;
            solid_pass(grid, clamp(x, low, high), y, z);
        }
}

static inline solid_corner solid_turned(solid_corner corner) {
    solid_corner turned = corner;
    turned.at = corner.at.yzx;
    return turned;
}

__kernel void
plait_grid_solid_cross(const uint item_count, const plait_grid_solid_cross_params params,
                       __global const float4* collider, __global const uint* mesh_first,
                       __global const uint* mesh_triangle, __global const float4* mesh_from,
                       __global const float4* mesh_to, __global uint* mesh_passed,
                       __global uint* mesh_met) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const grid_frame frame = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    const solid_mesh mesh = solid_mesh_at(collider, params.collider_first, mesh_first,
                                          mesh_triangle, mesh_from, mesh_to, params.mesh);
    __global const uint* vertex = solid_corners(&mesh, item);
    const int n = (int)params.edge_count;
    solid_grid grid = {n, (int3)(1, n * n, n), item + 1u, true, mesh_passed, mesh_met};
    const vec3 centre = vec3_of(0.5f, 0.5f, 0.5f); /* centres of voxels are nodes */
    solid_corner a = {sub3(grid_coordinates(&frame, solid_place(&mesh, vertex[0])), centre),
                      vertex[0]},
                 b = {sub3(grid_coordinates(&frame, solid_place(&mesh, vertex[1])), centre),
                      vertex[1]},
                 c = {sub3(grid_coordinates(&frame, solid_place(&mesh, vertex[2])), centre),
                      vertex[2]};
    for (int axis = 0; axis < 3; ++axis) {
        solid_lines(&grid, &a, &b, &c);
        a = solid_turned(a);
        b = solid_turned(b);
        c = solid_turned(c);
        grid.stride = grid.stride.yzx;
        grid.passes = false;
    }
}
