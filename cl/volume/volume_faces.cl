/* volume_faces: the pressure's equations at the nodes.
 *
 * Items   voxels, whose centres are the nodes.
 * Reads   grid_density, grid_velocity, volume_rest, volume_wetness, volume_solid,
 *         volume_before.
 * Writes  volume_link, volume_node, volume_pressure.
 *
 * Hair of density r and rest density R times the share to keep. A face between a and b has the
 * density (r_a + r_b)/2 and the mean velocity of the hair of both; one to a collider is closed and
 * has the collider's. p is the pressure. What pushed at the hair in the step that ends was the
 * gradient of p over density. p_before is what of p has stayed with that hair: none where it has
 * gone, no more where other hair has come. With d = p - p_before and h the step, a node of hair wants
 *     0 <= p - least,   h div v' - s >= 0,   and one of both 0,
 *     v' = v - h (d_b - d_a)/(density e)  at open faces,
 *     s = 1 - R/r where there is room, else the lesser of most_recovery and
 *         recovery c^2/(c + onset), c = max(0, 1 - R/r - slack).
 * Divided by (h/e)^2 that is one row of the matrix whose off-diagonals are the links, 1/density, and
 * `wanted` what is left for p = 0. `least` is minus R times the cohesion, to which wetness w adds its
 * own times w. Nodes with hardly any hair, and the outermost ones, are air, p = 0.
 * Source  contact condition of Narain et al. 2010; p carried over: van Kan 1986; faces: ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/vec3.clh"
#include "volume/volume.clh"

typedef struct {
    float density;
    float rest; /* to keep */
    vec3 velocity;
    vec3 wall; /* velocity of the collider */
    bool solid;
} volume_hair;

static inline volume_hair hair_at(const plait_volume_params* params, int node,
                                  __global const float* grid_density,
                                  __global const float4* grid_velocity,
                                  __global const float* volume_rest,
                                  __global const float4* volume_solid) {
    volume_hair hair;
    hair.density = grid_density[node];
    hair.rest = params->share * volume_rest[node];
    const vec3 fall = vec3_of(params->fall[0], params->fall[1], params->fall[2]);
    hair.velocity = add3(unpack3(grid_velocity[node]), fall);
    hair.wall = unpack3(volume_solid[node]);
    hair.solid = volume_solid[node].w > 0.0f;
    return hair;
}

static inline float along(vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* 1/density, 0 where it is closed or nobody is there. */
static inline float link_between(volume_hair a, volume_hair b) {
    const float density = 0.5f * (a.density + b.density);
    return a.solid || b.solid || !(density > 0.0f) ? 0.0f : 1.0f / density;
}

static inline float speed_between(volume_hair a, volume_hair b, int axis) {
    if (b.solid)
        return along(b.wall, axis);
    const float density = a.density + b.density;
    const float flow = a.density * along(a.velocity, axis) + b.density * along(b.velocity, axis);
    return density > 0.0f ? flow / density : 0.0f;
}

/* s: the share by which the hair of a node is to part; negative: by which it may close up. */
static inline float room_of(const plait_volume_params* params, volume_hair hair) {
    const float excess = 1.0f - hair.rest / hair.density;
    if (excess <= 0.0f)
        return excess;
    const float beyond = fmax(excess - params->slack, 0.0f);
    const float eased = beyond * beyond / (beyond + params->onset);
    return fmin(params->recovery * eased, params->most_recovery);
}

/* Pressure of the step before, of the hair that is still there. */
static inline float carried_at(const plait_volume_params* params, int node, float density,
                               __global const float* volume_before) {
    if (!params->carried)
        return 0.0f;
    const float2 before = vload2((size_t)node, volume_before);
    return before.x * fmin(density, before.y);
}

/* m^2/s^2: tension that the hair of a node bears, over its density at rest. */
static inline float cohesion_at(const plait_volume_params* params, int node,
                                __global const float* volume_wetness) {
    return params->wet ? params->cohesion + params->wet_cohesion * volume_wetness[node]
                       : params->cohesion;
}

/* Most nodes have no hair, and neither have the next ones, whose faces they keep. */
static inline bool nobody_near(const volume_place* place, int node,
                               __global const float* grid_density) {
    float density = grid_density[node];
#pragma unroll
    for (int axis = 0; axis < 3; ++axis)
        if (volume_has_next(place, axis))
            density += grid_density[node + volume_stride(place->count, axis)];
    return !(density > 0.0f);
}

__kernel void plait_volume_faces(const uint item_count, const plait_volume_params params,
                                 __global const float* grid_density,
                                 __global const float4* grid_velocity,
                                 __global const float* volume_rest,
                                 __global const float* volume_wetness,
                                 __global const float4* volume_solid,
                                 __global const float* volume_before, __global float4* volume_link,
                                 __global float4* volume_node, __global float* volume_pressure) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const volume_place place = volume_place_of(item, params.edge_count);
    const int node = (int)item;
    if (nobody_near(&place, node, grid_density)) {
        volume_link[node] = (float4)(0.0f);
        volume_node[node] = (float4)(0.0f);
        volume_pressure[node] = 0.0f;
        return;
    }
    const volume_hair own =
        hair_at(&params, node, grid_density, grid_velocity, volume_rest, volume_solid);
    const float own_before = carried_at(&params, node, own.density, volume_before);
    float link[3], divergence = 0.0f, links = 0.0f, carried = 0.0f;
    bool inner = true;
#pragma unroll
    for (int axis = 0; axis < 3; ++axis) {
        link[axis] = 0.0f;
        for (int side = -1; side <= 1; side += 2) {
            if (!(side > 0 ? volume_has_next(&place, axis) : volume_has_previous(&place, axis))) {
                inner = false;
                continue;
            }
            const int other = node + side * volume_stride(place.count, axis);
            const volume_hair hair =
                hair_at(&params, other, grid_density, grid_velocity, volume_rest, volume_solid);
            const float between = link_between(own, hair);
            if (side > 0)
                link[axis] = between;
            divergence += (float)side * speed_between(own, hair, axis);
            links += between;
            carried +=
                between * (own_before - carried_at(&params, other, hair.density, volume_before));
        }
    }
    const bool is_hair = inner && !own.solid && links > 0.0f &&
                         own.density > PLAIT_VOLUME_LEAST_DENSITY &&
                         own.density > PLAIT_VOLUME_AIR * own.rest;
    volume_link[node] = (float4)(link[0], link[1], link[2], own_before);
    volume_pressure[node] = is_hair ? own_before : 0.0f;
    if (!is_hair) {
        volume_node[node] = (float4)(0.0f);
        return;
    }
    const float edges = params.voxel_edge / params.h;
    const float wanted = edges * divergence - edges * edges * room_of(&params, own) - carried;
    const bool coheres = own.density > PLAIT_VOLUME_COHESIVE * own.rest;
    const float least = coheres ? -cohesion_at(&params, node, volume_wetness) * own.rest : 0.0f;
    volume_node[node] = (float4)(wanted, least, PLAIT_VOLUME_RELAXATION / links, 0.0f);
}
