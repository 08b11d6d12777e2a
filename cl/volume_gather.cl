/* volume_gather: what pressure and viscosity do at nodes, to vertices.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, grid_velocity, volume_change, volume_push.
 * Moves   lane_v, with BDF2 lane_v_before by as much; never of a root.
 * Writes  lane_pressure: the acceleration by pressure, in the world, for the step to come; 0 of a
 *         root, past the tip and outside the grid.
 * Source  a vertex keeps its own velocity and takes the nodes' change of it: Brackbill & Ruppel
 *         1986 (FLIP); of the nodes' velocity it takes the share `blend`.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_grid.clh"

typedef struct {
    vec3 velocity; /* before the change; along the grid's axes */
    vec3 change;
    vec3 push;
} lane_pressed;

static inline lane_pressed pressed_at(const lane_grid* grid, lane_cell cell,
                                      __global const float4* grid_velocity,
                                      __global const float4* volume_change,
                                      __global const float4* volume_push) {
    lane_pressed at;
    const mask low = lane_cell_voxel(grid, cell);
    const int n = grid->count, corners = n > 1 ? 8 : 1;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        const int first = LANE_OF_MASK(low, k);
        const float3 high =
            (float3)(LANE(cell.high.x, k), LANE(cell.high.y, k), LANE(cell.high.z, k));
        float4 velocity = (float4)(0.0f), change = velocity, push = velocity;
        for (int corner = 0; corner < corners; ++corner) {
            const int node =
                first + (corner & 1 ? 1 : 0) + (corner & 2 ? n * n : 0) + (corner & 4 ? n : 0);
            const float x = corner & 1 ? high.x : 1.0f - high.x;
            const float y = corner & 2 ? high.y : 1.0f - high.y;
            const float z = corner & 4 ? high.z : 1.0f - high.z;
            const float weight = x * y * z;
            velocity += weight * grid_velocity[node];
            change += weight * volume_change[node];
            push += weight * volume_push[node];
        }
        LANE(at.velocity.x, k) = velocity.x;
        LANE(at.velocity.y, k) = velocity.y;
        LANE(at.velocity.z, k) = velocity.z;
        LANE(at.change.x, k) = change.x;
        LANE(at.change.y, k) = change.y;
        LANE(at.change.z, k) = change.z;
        LANE(at.push.x, k) = push.x;
        LANE(at.push.y, k) = push.y;
        LANE(at.push.z, k) = push.z;
    }
    return at;
}

__kernel void plait_volume_gather(const uint item_count, const plait_lane_volume_params params,
                                  __global const uint* lane_strand,
                                  __global const uint* vertex_count, __global const real* lane_x,
                                  __global const float4* grid_velocity,
                                  __global const float4* volume_change,
                                  __global const float4* volume_push, __global real* lane_v,
                                  __global real* lane_v_before, __global real* lane_pressure) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const mask counts = lane_counts(vertex_count, &strands);
    const lane_grid grid = lane_grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    const vec3 root = load3(lane_x, place, 0);
    const vec3 zero = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    store3(lane_pressure, place, 0, zero);
    for (int i = 1; i < (int)params.vertex_stride; ++i) {
        const vec3 g = lane_grid_coordinates(&grid, add3(root, load3(lane_x, place, i)));
        const mask inside = ((mask)(i) < counts) & lane_grid_contains(&grid, g);
        const lane_cell cell = lane_cell_of(&grid, g, inside, PLAIT_TENT_TRILINEAR);
        const lane_pressed at = pressed_at(&grid, cell, grid_velocity, volume_change, volume_push);
        store3(lane_pressure, place, i, pick3(inside, lane_grid_world(&grid, at.push), zero));
        if (!params.moves)
            continue;
        const vec3 before = load3(lane_v, place, i);
        const vec3 drawn = sub3(at.velocity, lane_grid_components(&grid, before));
        const vec3 change = axpy3((real)(params.blend), drawn, at.change);
        const vec3 gained = pick3(inside, lane_grid_world(&grid, change), zero);
        store3(lane_v, place, i, add3(before, gained));
        if (params.history)
            store3(lane_v_before, place, i, add3(load3(lane_v_before, place, i), gained));
    }
}
