/* mesh_field: of each vertex the plane of a mesh that it may meet in a substep.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, collider, mesh_grid, mesh_nodes, mesh_field,
 *         mesh_clearance, lane_acceleration, lane_pin, lane_x, lane_v, and the steps before.
 * Writes  lane_plane.
 * Source  Baerentzen & Aanaes 2005 (signs of the field, made on the host); ours: the way from where
 *         the mesh would carry the vertex to where inertia puts it, walked by distances; strands
 *         looked through by what a distance says of the places around.
 */
#include "mesh/lane_mesh.clh"

/* A mesh over a substep. */
typedef struct {
    mesh_field field;
    mesh_motion motion;
} mesh_body;

/* ---- which vertices are near -------------------------------------------------------------- */

/* Cells. A plane is taken where a sample is at most mesh_room(): in a cell with a node of at most that, so
 * less than a cell's diagonal farther from the mesh. The rest is for rounding. */
#define MESH_NEAR (1.7321f + 0.05f)

/* Lists all vertices that may have a plane: of the others a distance looked up at one before them
 * says that their ways do not come near. What is not finite is listed. */
static inline void mesh_list_near(const mesh_body* body, const mesh_ways* ways, mesh_list* list) {
    const vec3 root = ways->step->pose.root;
    const float moves = length(body->motion.to - body->motion.from),
                turns = 2.0f * length(body->motion.turn.xyz);
    const float reach = mesh_room(&body->field) + MESH_NEAR * body->field.edge + moves;
    const real arm = mesh_arm(&body->motion, root);
    real least = (real)(-1.0f); /* m: the distance of the vertex before is no less */
    real along = (real)(0.0f);  /* m, of the chain of vertices */
    list->count = 0;
    for (int i = 1; i <= ways->step->segments; ++i) {
        const real chord = mesh_length(sub3(ways->end[i], ways->end[i - 1]));
        const real way = mesh_length(sub3(ways->end[i], mesh_begin(ways, i)));
        least -= chord;
        along += chord;
        const real meets = way + turns * (arm + along + way) + reach;
        if (!any_lane(!(least > meets)))
            continue;
        least = fmax(least, mesh_field_least(&body->field,
                                             mesh_own(&body->motion, add3(root, ways->end[i]))));
        const mask near = (!(least > meets)) &
                          (lane_material_at(ways->step, i - 1, PLAIT_LANE_LENGTH) > (real)(0.0f));
        if (any_lane(near))
            mesh_list_add(list, i, near);
    }
}

/* ---- their planes --------------------------------------------------------------------------- */

static inline mesh_touch mesh_meet(const mesh_body* body, mesh_vertex* vertex) {
    mesh_touch touch;
    touch.anchor =
        add3(vertex->begin, mesh_carry(&body->motion, add3(vertex->root, vertex->begin)));
    const vec3 from = mesh_own(&body->motion, add3(vertex->root, touch.anchor));
    const vec3 to = mesh_own(&body->motion, add3(vertex->root, vertex->end));
    mesh_cells cells;
    const mesh_sample first = mesh_field_first_sample(&body->field, from, &cells);
    touch.start = first.distance - vertex->offset;
    touch.some = !(touch.start > mesh_length(sub3(to, from)) + (real)(mesh_room(&body->field)));
    mesh_plane plane =
        mesh_march(&body->field, from, to, vertex->offset, first, &cells, touch.some);
    touch.some &= mesh_plane_is(plane);
    if (!any_lane(touch.some))
        return touch;
    plane = mesh_plane_at_foot(&body->field, mesh_plane_unit(plane), to, vertex->offset, &cells);
    const real gap = mesh_plane_height(plane, to);
    touch.some &= !(gap >= vertex->gap);
    touch.normal = mesh_turned(&body->motion, plane.normal);
    touch.height = mesh_plane_height(plane, from);
    touch.tip = touch.some & vertex->tip;
    if (any_lane(touch.tip)) {
        touch.crease =
            mesh_crease(&body->field, plane, vertex->offset, from, to, touch.tip, &cells);
        touch.crease.normal = mesh_turned(&body->motion, touch.crease.normal);
    }
    return touch;
}

static inline void mesh_find(const mesh_body* body, const mesh_ways* ways, const mesh_list* list,
                             mesh_planes* planes) {
    mesh_cells cells;
    planes->depth = mesh_field_first_sample(&body->field,
                                            mesh_own(&body->motion, ways->step->pose.root), &cells)
                        .distance;
    for (uint first = 0; first < list->count; first += PLAIT_LANES) {
        const uint count = min(list->count - first, (uint)PLAIT_LANES);
        mesh_vertex vertex = mesh_gather(ways, planes, &list->at[first], count);
        const mesh_touch touch = mesh_meet(body, &vertex);
        mesh_scatter(ways, planes, &list->at[first], count, body->motion.friction, &touch);
    }
}

__kernel PLAIT_WIDE void
plait_mesh_field(const uint item_count, const plait_lane_params params,
                 __global const uint* lane_strand, __global const float4* rest,
                 __global const float4* pose, __global const real* lane_material,
                 __global const float4* collider, __global const float4* mesh_grid,
                 __global const uint* mesh_nodes, __global const float* mesh_values,
                 __global const float* mesh_clearance, __global const real* lane_acceleration,
                 __global const real* lane_pin, __global const real* lane_x,
                 __global const real* lane_v, __global const real* lane_x_before,
                 __global const real* lane_v_before, __global real* lane_plane) {
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    /* which lane_predict_vertex() does not write */
    const lane_buffers state = {(__global real*)lane_x, (__global real*)lane_v,
                                (__global real*)lane_x_before, (__global real*)lane_v_before};
    mask last = (mask)(0);
    mesh_planes planes;
    planes.params = &params;
    planes.clearance = mesh_clearance;
    planes.strands = lane_strands_of(lane_strand, step.place, item_count);
    planes.last = &last;
    planes.lane_plane = lane_plane;
    mesh_fetch_clearance(&planes);
    mesh_ways ways;
    mesh_ways_of(&ways, &step, &params, state);
    mesh_list list;
    mesh_clear_creases(lane_plane, step.place);
    for (uint mesh = 0; mesh < params.collider_count; ++mesh) {
        const mesh_body body = {mesh_field_at(mesh_grid, mesh_nodes, mesh_values, mesh),
                                mesh_motion_at(collider, params.collider_first + mesh)};
        mesh_list_near(&body, &ways, &list);
        planes.mesh = mesh;
        planes.others = mesh > 0;
        if (list.count > 0)
            mesh_find(&body, &ways, &list, &planes);
    }
    lane_plane[lane_index(step.place, PLAIT_LANE_PLANE_COMPONENTS, 0, PLAIT_LANE_PLANE_LAST)] =
        LANE_REAL(last);
}
