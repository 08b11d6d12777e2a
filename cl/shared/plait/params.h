/* Parameter blocks and constants shared by the host and every kernel.
 *
 * Compiled as C99, C++20 and OpenCL C 1.2. Only 4-byte scalars and arrays of them, so that every
 * compiler lays the structs out alike; `tests/conformance/layout.cpp` checks it on each device.
 * Arrays have one dimension: rusticl 22.3 miscounts the size of a by-value struct with nested ones.
 *
 * Conventions: SI units, right-handed axes. A quaternion is stored (x, y, z, w), w the scalar part.
 * A pose maps a point p of the rest (groom) space to q*p + t in the world. Vertex 0 is the root.
 */
#ifndef PLAIT_PARAMS_H
#define PLAIT_PARAMS_H

#ifdef __OPENCL_C_VERSION__
typedef uint plait_u32;
#else
#include <stdint.h>
typedef uint32_t plait_u32;
#endif

/* Per-strand vertex limits. */
#define PLAIT_MIN_VERTICES 2
#define PLAIT_MAX_VERTICES 256

/* m/s^2: where a component of a vertex's acceleration is beyond it, or not finite, it has none. */
#define PLAIT_MOST_ACCELERATION 1e4f

/* Other segments that are kept of a segment, and one that is none. */
#define PLAIT_PAIR_COUNT 4u
#define PLAIT_PAIR_NONE 0xffffffffu

/* cell_line: segments in the order of cell_segment, a component of all of them after the other, with
 * room behind each, as CPUs read several at a time. */
#define PLAIT_PAIR_MIDDLE 0u  /* x y z, m: of the box around it */
#define PLAIT_PAIR_HALF 3u    /* x y z, m: half the edges of that */
#define PLAIT_PAIR_MOVES 6u   /* x y z, m: what its middle has moved by in a substep */
#define PLAIT_PAIR_SPREAD 9u  /* m: the most by which another point of it has moved otherwise */
#define PLAIT_PAIR_FROM 10u   /* x y z, m: its first vertex */
#define PLAIT_PAIR_WAY 13u    /* x y z, m: from there to its second */
#define PLAIT_PAIR_CHANGE 16u /* x y z, m: what its second vertex has moved by, less its first */
#define PLAIT_PAIR_COMPONENTS 19u
#define PLAIT_PAIR_PADDING 16u

/* cell_moves: one for so many cells each way. */
#define PLAIT_PAIR_BLOCK 4u

/* A slot of the voxel grid that holds no vertex. */
#define PLAIT_SLOT_EMPTY 0xffffffffu

/* float4 elements per item in packed buffers. */
#define PLAIT_POSE_STRIDE 2   /* pose: quaternion (x,y,z,w); translation (x,y,z,0) */
#define PLAIT_MOTION_STRIDE 2 /* strand_motion: quaternion; (translation, blend c) */
#define PLAIT_COLLIDER_STRIDE 6

/* Elements of a collider, in the buffers that stages call `collider`; they
 * hold all colliders of a step's first substep, then all of its second, and so on. What moves is
 * rigid: its first point goes from BEGIN to END and all turns about it.
 *
 *            capsule          plane                     box
 *   BEGIN    (a,ra)           (point,0)                 (centre,rounding)
 *     + 1    (b,rb)           (normal,0)                its orientation at the end, x y z w
 *   END      (a,ra)           (point,0)                 (centre,rounding)
 *     + 1    (b,rb)           (normal,0)                (half extents,0)
 * Normals are unit and outward; half extents are of the box before it is rounded. A hull is a box around
 * all of it, its margin in place of a rounding; its faces, (normal, distance from the centre) in its
 * axes, lie FACES float4 after its row begins, behind all rows. */
#define PLAIT_COLLIDER_BEGIN 0    /* at the substep's begin; only its xyz is read of all kinds */
#define PLAIT_COLLIDER_END 2      /* at its end */
#define PLAIT_COLLIDER_TURN 4     /* the quaternion that turns the one into the other */
#define PLAIT_COLLIDER_FRICTION 5 /* (friction,kind,faces,their number), the last two of a hull */

/* Kinds, as floats; a plane is all that lies under it. */
#define PLAIT_KIND_CAPSULE 0.0f
#define PLAIT_KIND_PLANE 1.0f
#define PLAIT_KIND_BOX 2.0f
/* A mesh, which only mesh_field and mesh_nearest read, after all others of a substep: a is the origin
 * of its own frame, BEGIN + 1 its orientation at the end. The w of BEGIN and END are the shares of the
 * fixed step at which the substep begins and ends. */
#define PLAIT_KIND_MESH 3.0f
/* All that lies under each of its faces. */
#define PLAIT_KIND_HULL 4.0f
/* Added to the kind of a capsule, a box or a hull that hair stays inside of; the margin of such a hull is
 * negative. */
#define PLAIT_KIND_INWARD 8.0f

/* mesh_nearest: of each mesh where in the other buffers its own begins, counted in nodes, triangles,
 * vertices and words of mesh_ring; indices in them are of this mesh alone. */
#define PLAIT_MESH_FIRST_NODE 0
#define PLAIT_MESH_FIRST_TRIANGLE 1
#define PLAIT_MESH_FIRST_VERTEX 2
#define PLAIT_MESH_FIRST_RING 3
#define PLAIT_MESH_FIRST_TWO_SIDED 4 /* 1: a sheet, met from the side where a vertex is */
#define PLAIT_MESH_FIRST_COUNT 5     /* not where: its triangles */
#define PLAIT_MESH_FIRST_STRIDE 6
/* mesh_side: of a vertex and a sheet where the vertex was at the begin of the last substep, carried to its
 * end, in the sheet's own frame; and as w on which side it belongs, 1 or -1, twice that where it was on
 * the other one all the same; 0: the sheet was out of reach. */
#define PLAIT_MESH_SIDE_ASTRAY 2.0f
#define PLAIT_MESH_TRIANGLE_STRIDE 6 /* corners; the triangles across the edges that begin there */
#define PLAIT_MESH_NO_TRIANGLE 0xffffffffu
#define PLAIT_MESH_TREE_DEPTH 32  /* nodes on the way down */
#define PLAIT_MESH_UNDER_STRIDE 3 /* under a node: first triangle, triangles, nodes and itself */
#define PLAIT_MESH_MOST_COORDINATE 1e6f /* m: what is beyond, or not finite, is no place */

/* grid_sum: per voxel, five 64-bit sums as (low, high) words: density, momentum xyz, tent*|v|^2. */
#define PLAIT_SUM_COUNT 5
#define PLAIT_SUM_STRIDE 10
#define PLAIT_SUM_DENSITY_SCALE 16777216.0f    /* 2^24 per unit of tent weight */
#define PLAIT_SUM_MOMENTUM_SCALE 1073741824.0f /* 2^30 per m/s of weighted velocity */
#define PLAIT_SUM_ENERGY_SCALE 1073741824.0f   /* 2^30 per m^2/s^2 of weighted squared speed */
#define PLAIT_SUM_REST_SCALE 65536.0f          /* 2^16 per weighted density (volume_splat) */
/* m/s; components beyond are clamped before the sum. The energy of 600,000 vertices that fast still
 * fits a sum, and that of one at 1 mm/s has three digits. */
#define PLAIT_SUM_MAX_SPEED 64.0f

/* Named choices. */
#define PLAIT_WIND_PUBLISHED 0u
#define PLAIT_WIND_DRAG 1u
#define PLAIT_FOLLOW_PUBLISHED 0u
#define PLAIT_FOLLOW_ROTATING 1u
#define PLAIT_SHOCK_THRESHOLD 0u  /* c jumps from vsp_coeff to 1 at the threshold (published) */
#define PLAIT_SHOCK_CONTINUOUS 1u /* c rises linearly to 1 between once and twice the threshold */
#define PLAIT_SLOT_HASH_THESIS 0u
#define PLAIT_SLOT_HASH_PCG 1u
#define PLAIT_TENT_VOXEL 0u     /* eq. 4.1: 1 at the voxel centre, 0 at its faces; own voxel only */
#define PLAIT_TENT_TRILINEAR 1u /* half-width one edge, nodes at voxel centres; 8 per vertex */
#define PLAIT_DIFFUSE_THESIS 0u /* |v_c| > ratio * |mean_c| */
#define PLAIT_DIFFUSE_FLOORED 1u /* |v_c| > ratio * max(|mean_c|, floor * rms) */

/* roots: pose of every strand at fraction `alpha` of a step.
 * The head pose is interpolated from -> to (nlerp, shorter arc; translation linearly), or with `bends`
 * by the parabola through before, from and to; with per_root != 0 each strand's own pose, interpolated
 * likewise, comes first (pose = head * root). */
typedef struct plait_roots_params {
    float head_before_q[4];
    float head_before_t[4];
    float head_from_q[4];
    float head_from_t[4];
    float head_to_q[4];
    float head_to_t[4];
    float alpha;        /* [0, 1] */
    plait_u32 per_root; /* 0: root_before, root_from and root_to are null and not read */
    plait_u32 bends;    /* 0: the path is straight, and `before` is not read */
} plait_roots_params;

/* skin, skin_mesh, tressfx_reset, tressfx_teleport, velocity_shock, guide_turns, output_keep, stats: stages
 * that need only the layout. */
typedef struct plait_layout_params {
    plait_u32 vertex_stride; /* V: vertices per strand row, 2..256 */
} plait_layout_params;

/* last_frame: positions, as they were or at another size. */
typedef struct plait_last_frame_params {
    plait_u32 vertex_stride;
    float scale; /* times positions */
} plait_last_frame_params;

/* tressfx_set_off, lane_set_off: the motion of a head whose motion was not known. */
typedef struct plait_set_off_params {
    plait_u32 vertex_stride;
    plait_u32 tile;       /* lane_set_off; 1 in tressfx_set_off */
    plait_u32 row_stride; /* V of `rest` */
    plait_u32 history; /* 1: BDF2's step before is kept; 0: lane_x_before, lane_v_before are null */
    float h;           /* s, the substep */
    float jump;        /* m/s: strands whose motions differ by less are left alone */
} plait_set_off_params;

/* tressfx_carry, lane_carry: the rigid motion p -> q*p + t, of all strands. */
typedef struct plait_carry_params {
    plait_u32 vertex_stride;
    plait_u32 tile;    /* lane_carry; 1 in tressfx_carry */
    plait_u32 history; /* 1: BDF2's step before is kept; 0: lane_x_before, lane_v_before are null */
    plait_u32 turns;   /* 0: q is the identity, and only what is a place in the world changes */
    float q[4];
    float t[4];
} plait_carry_params;

/* mesh_take: vertices of a mesh from a buffer of the caller's. */
typedef struct plait_mesh_take_params {
    plait_u32 words; /* from one vertex to the next, at least 3 */
    float scale;     /* times what is taken: to the groom's units */
} plait_mesh_take_params;

/* mesh_advance: where the vertices of a mesh are at the end of a fixed step. */
typedef struct plait_mesh_advance_params {
    plait_u32 begins;   /* in mesh_from and mesh_to: where this mesh's vertices begin */
    float part;         /* of their way, [0, 1] */
    float at_scale;     /* times mesh_at: to the groom's units */
    float target_scale; /* times mesh_target */
} plait_mesh_advance_params;

/* mesh_refit: boxes of a tree's nodes that have more than `least` and at most `most` triangles under them. */
typedef struct plait_mesh_refit_params {
    plait_u32 mesh;  /* of mesh_first */
    plait_u32 least; /* 0: by the triangles; else by nodes with no more, whose boxes are there */
    plait_u32 most;
} plait_mesh_refit_params;

/* integrate: Verlet step and, if global_stiffness > 0, the global shape constraint. */
typedef struct plait_integrate_params {
    plait_u32 vertex_stride;
    float h;                /* s */
    float damping;          /* d in exp(-60 d h), dimensionless at 60 Hz */
    float global_stiffness; /* s_G, [0, 1] */
    float global_range;     /* fraction of a strand's vertices, [0, 1] */
    float gravity[3];       /* m/s^2 */
    plait_u32 accelerates;  /* 1: vertices have accelerations; 0: `acceleration` is null */
} plait_integrate_params;

/* accelerate: what a caller's own kernel is told. */
typedef struct plait_accelerate_params {
    plait_u32 vertex_stride;
    float h;         /* s: velocity = (position - position_prev) / h */
    float time;      /* s simulated, at the begin of the step */
    float value[16]; /* plait_sim_params.accelerate_values */
} plait_accelerate_params;

/* global_shape: the global shape constraint alone (order = shock_before_global). */
typedef struct plait_global_shape_params {
    plait_u32 vertex_stride;
    float stiffness; /* [0, 1] */
    float range;     /* [0, 1] */
} plait_global_shape_params;

/* strand_data: rigid motion of the root segment over the step. */
typedef struct plait_strand_data_params {
    plait_u32 vertex_stride;
    float vsp_coeff;           /* c below the threshold, [0, 1] */
    float vsp_accel_threshold; /* m; compared with |x1 - 2 prev1 + prev2_1| */
    plait_u32 shock_form;      /* PLAIT_SHOCK_* */
} plait_strand_data_params;

/* local_shape: rest-shape constraint, root to tip. */
typedef struct plait_local_shape_params {
    plait_u32 vertex_stride;
    float stiffness; /* s_L, [0, 1]; k = min(s_L, 0.95) / 2 */
    plait_u32 iterations;
} plait_local_shape_params;

/* tressfx_wind: published cone of four winds, or aerodynamic drag. */
typedef struct plait_tressfx_wind_params {
    plait_u32 vertex_stride;
    float h;          /* s */
    plait_u32 form;   /* PLAIT_WIND_* */
    float drag;       /* PLAIT_WIND_DRAG: rho_air C_d d / (2 rho A), 1/m */
    float wind[4];    /* PLAIT_WIND_DRAG: air velocity, m/s (w unused) */
    float corner[16]; /* PLAIT_WIND_PUBLISHED: the four winds blended per strand, xyz_ each */
} plait_tressfx_wind_params;

/* length: red/black edge-length constraint. */
typedef struct plait_length_params {
    plait_u32 vertex_stride;
    plait_u32 iterations;
} plait_length_params;

/* tressfx_collide: push out of colliders with Coulomb friction. */
typedef struct plait_tressfx_collide_params {
    plait_u32 vertex_stride;
    plait_u32 collider_count;
    plait_u32 collider_first; /* where in `collider` those of the substep begin */
} plait_tressfx_collide_params;

/* clamp: limit the displacement of a vertex per substep. */
typedef struct plait_clamp_params {
    plait_u32 vertex_stride;
    float max_displacement; /* C, m */
} plait_clamp_params;

/* attach: bound the distance of a vertex to its root. */
typedef struct plait_attach_params {
    plait_u32 vertex_stride;
    float reach; /* farthest, as a share of the arc length from the root, > 0 */
} plait_attach_params;

/* tressfx_follow: place follow strands beside their guides. */
typedef struct plait_tressfx_follow_params {
    plait_u32 vertex_stride;
    plait_u32 guide_count;
    float tip_separation;
    plait_u32 form; /* PLAIT_FOLLOW_* */
} plait_tressfx_follow_params;

/* follow_turns: follow strands by the turns of their guides. */
typedef struct plait_follow_turns_params {
    plait_u32 vertex_stride;
    plait_u32 tile; /* strands per tile of the lane layout */
    plait_u32 guide_count;
} plait_follow_turns_params;

/* follow_clump: draw follow strands to the centres of their clumps. Ramps have knots at the root, a
 * third, two thirds of the length and the tip. */
typedef struct plait_follow_clump_params {
    plait_u32 vertex_stride;
    plait_u32 guide_count;
    float clump[4]; /* share of the way to the centre, [0, 1] */
    plait_u32
        wet; /* 1: that, times 0.8 the wetness of the centre, a guide; 0: strand_wetness is null */
} plait_follow_clump_params;

/* follow_collide, follow_field, follow_nearest: follow strands out of colliders. */
typedef struct plait_follow_collide_params {
    plait_u32 vertex_stride;
    plait_u32 guide_count;
    plait_u32 collider_count;
    plait_u32 collider_first; /* where in `collider` those begin */
} plait_follow_collide_params;

/* follow_curl: offsets from the strand, in a frame that it carries along. */
typedef struct plait_follow_curl_params {
    plait_u32 vertex_stride;
    plait_u32 guide_count;
    float curl[4];      /* m, radius of the helix, the same knots */
    float pitch;        /* m of hair per turn */
    float scatter;      /* share of a turn by which strands of a clump differ, [0, 1] */
    float frizz[4];     /* m, rms of either component, the same knots */
    float frizz_length; /* m of hair per cell of the noise */
    plait_u32 seed;
} plait_follow_curl_params;

/* grid_clear: fill words of a grid buffer. */
typedef struct plait_grid_clear_params {
    plait_u32 value;
} plait_grid_clear_params;

/* All other grid_* stages. A world point x has grid coordinates p = conj(q)*(x - t); the grid spans
 * [0, edge_count*voxel_edge) in each; velocities in the grid are components in this frame. */
typedef struct plait_grid_params {
    plait_u32 vertex_stride;
    plait_u32 edge_count;   /* voxels per edge nv, 1..64 */
    plait_u32 capacity;     /* slots per voxel C, 1..65536 */
    float voxel_edge;       /* e, m */
    float q[4];             /* grid orientation */
    float t[4];             /* world position of the grid's corner (w unused) */
    float h;                /* s: velocity = (position - position_prev) / h */
    plait_u32 slot_hash;    /* PLAIT_SLOT_HASH_* */
    plait_u32 frame;        /* step counter, mixed into the pcg hash */
    plait_u32 seed;         /* mixed into the pcg hash */
    plait_u32 tent;         /* PLAIT_TENT_* (grid_splat, grid_diffuse) */
    plait_u32 diffuse_rule; /* PLAIT_DIFFUSE_* */
    float diffuse_ratio;    /* thesis: 2 */
    float diffuse_factor;   /* remaining share of the velocity component, thesis: 0.9 */
    float diffuse_floor;    /* PLAIT_DIFFUSE_FLOORED: share of the voxel's rms speed */
} plait_grid_params;

/* lane_splat, lane_diffuse: the grid as above, seen from the lanes, which keep velocities. */
typedef struct plait_lane_grid_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 edge_count;
    float voxel_edge;
    float q[4];
    float t[4];
    plait_u32 tent;
    plait_u32 each;         /* lane_splat: 1: sums do not depend on who shares a work-item */
    plait_u32 diffuse_rule; /* this and the rest: lane_diffuse */
    float diffuse_ratio;
    float diffuse_factor;
    float diffuse_floor;
    plait_u32 history; /* 1: BDF2's step before is kept; 0: lane_v_before is null */
} plait_lane_grid_params;

/* Stages over lanes have two strides: `vertex_stride` is V of the lanes, that of the longest strand
 * in them; `row_stride`, V or more, that of buffers which hold all strands of the sim, one after
 * the other: rest, position, accelerations, pins.
 *
 * articulated: one substep of strands over lanes. mesh_field,
 * mesh_nearest: the planes for one; there `collider_count` and `collider_first` are of their meshes. */
typedef struct plait_lane_params {
    plait_u32 vertex_stride;
    plait_u32 tile; /* strands per tile of the lane layout */
    plait_u32 row_stride;
    float h;              /* s */
    plait_u32 iterations; /* Newton steps */
    plait_u32 bdf2;       /* 0: backward Euler; 1: BDF2, needs the step before */
    float drag;           /* c, 1/s, relative to the air */
    float gravity[3];     /* m/s^2 */
    float air[3];         /* velocity of the air, m/s */
    plait_u32 collider_count;
    plait_u32 collider_first; /* where in `collider` those of the substep begin */
    float contact_rate; /* 1/s^2: stiffness of contact over mass; a load of m a sinks a/rate in */
    float contact_slip; /* m: the displacement per substep at which friction is all of mu N */
    plait_u32 accelerates; /* 1: vertices have accelerations; 0: lane_acceleration is null */
    plait_u32 pins;        /* 1: vertices may be pinned; 0: lane_pin is null */
    plait_u32 planes;  /* 1: vertices may have planes of meshes, 2: and of strands; 0: lane_plane
                              is null, and of mesh_nearest not read */
    plait_u32 hollows; /* 1: there may be sheets, and lane_hollow is there; 0: it is null */
} plait_lane_params;

/* contact_pair_count, contact_pair_fill, contact_pair_find. */
typedef struct plait_pair_params {
    plait_u32 vertex_stride;
    plait_u32 edge_count; /* cells each way, a power of two up to 64 */
    float voxel_edge;     /* m, of a cell */
    float longest;        /* m: no segment is longer (this and the rest: contact_pair_find) */
    float diameter;       /* m: how far apart strands stay */
    float room;           /* m: a pair that comes nearer by more may be missed */
    float steps; /* how often strands move on by position - position_prev until the next search */
} plait_pair_params;

typedef struct plait_contact_pair_scan_params {
    plait_u32 edge_count;
} plait_contact_pair_scan_params;

/* strand_contact: planes for one substep. */
typedef struct plait_strand_contact_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    plait_u32 meshes; /* 1: lane_plane holds the planes of meshes; 0: it is not read */
    float friction;   /* Coulomb coefficient */
} plait_strand_contact_params;

/* pins: where the targets of pins are at the end of a fixed step. */
typedef struct plait_pins_params {
    plait_u32 vertex_stride;
    float alpha;        /* [0, 1]: share of the way from pin_at to pin */
    float at_scale;     /* times targets of pin_at that are in the world: to the groom's units */
    float target_scale; /* the same of pin */
} plait_pins_params;

/* lane_pin: pins of one substep to the lanes. */
typedef struct plait_lane_pin_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    float share; /* [0, 1]: of the way from pin_from to pin_to, at the substep's end */
    /* A pin is at most as stiff as holds the strand's mass at this acceleration, m/s^2, within the
     * length of the segment before it, or its vertex' mass times the rate, 1/s^2, if that is more.
     */
    float hold;
    float rate;
    float h;    /* s, of the substep */
    float pull; /* m/s^2: it pulls at its vertex with at most the strand's mass times this */
} plait_lane_pin_params;

/* lane_groom: the groom's springs of one substep. */
typedef struct plait_lane_groom_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    plait_u32 pins; /* 1: lane_spring holds pins; 0: it is not read */
    float slider;   /* times PLAIT_LANE_GROOM_DROOP, [0, 1e4] */
    float h;        /* s, of the substep */
    float rate;     /* 1/s^2: a spring is at most as stiff as its vertex' mass times this */
    float pull;     /* m/s^2: and pulls at it with at most that mass times this */
} plait_lane_groom_params;

/* wind_field: turbulence at the centres of the voxels of a grid, w((x - U t)/s) of docs/wind.md. */
typedef struct plait_wind_field_params {
    plait_u32 edge_count; /* voxels per edge n, 1..64 */
    float voxel_edge;     /* of a voxel, in units of the largest eddies' scale s */
    float q[4];           /* grid orientation */
    plait_u32 cell[3];    /* of the noise's coarsest lattice: the grid's corner, modulo 2^32 */
    float fraction[3];    /* its place in that cell, [0, 1] */
    float amplitude;      /* m/s, of the first octave */
    plait_u32 octaves;    /* [1, 8] */
    float gain;           /* amplitude of an octave over that of the one before */
    plait_u32 seed;
} plait_wind_field_params;

/* grid_solid_field: which nodes of a grid, its voxels' centres, lie in meshes of form FIELD. */
typedef struct plait_grid_solid_field_params {
    plait_u32 edge_count; /* voxels per edge n */
    float voxel_edge;     /* m */
    float q[4];           /* grid orientation */
    float t[4];           /* world position of the grid's corner (w unused) */
    plait_u32 collider_count;
    plait_u32 collider_first; /* where in `collider` those meshes begin */
    float h;                  /* s, of their substep */
} plait_grid_solid_field_params;

/* grid_solid_cross: where a mesh of form NEAREST passes between nodes of the same grid. */
typedef struct plait_grid_solid_cross_params {
    plait_u32 edge_count;
    float voxel_edge;
    float q[4];
    float t[4];
    plait_u32 mesh;           /* of mesh_first */
    plait_u32 collider_count; /* 1 */
    plait_u32 collider_first; /* where in `collider` the mesh is */
} plait_grid_solid_cross_params;

/* grid_solid_fill: which nodes lie in it. */
typedef struct plait_grid_solid_fill_params {
    plait_u32 edge_count;
    float q[4];
    plait_u32 mesh;
    plait_u32 collider_count;
    plait_u32 collider_first;
    float h;          /* s, of the substep */
    plait_u32 others; /* 1: mesh_solid holds other meshes; 0: it is not read */
} plait_grid_solid_fill_params;

/* wind_obstacle: extinction of wind at the nodes of a grid, its voxels' centres. */
typedef struct plait_wind_obstacle_params {
    plait_u32 edge_count; /* voxels per edge n */
    float voxel_edge;     /* m */
    float q[4];           /* grid orientation */
    float t[4];           /* world position of the grid's corner (w unused) */
    float extinction;     /* 1/m, of a density of 1 */
    plait_u32 collider_count;
    plait_u32 collider_first; /* where in `collider` those of the substep begin */
    plait_u32 meshes;         /* 1: mesh_solid says which nodes lie in meshes; 0: it is null */
} plait_wind_obstacle_params;

/* wind_shelter: one plane of nodes of the same grid; planes go one after the other as the wind does. */
typedef struct plait_wind_shelter_params {
    plait_u32 edge_count;
    float voxel_edge;   /* m */
    float q[4];         /* grid orientation */
    plait_u32 axis;     /* of the grid, 0 to 2: across which its planes lie */
    plait_u32 plane;    /* where the sweep begins; 0: the first that the wind meets */
    plait_u32 reversed; /* 1: the wind goes against the axis */
    float foot[2]; /* voxels along the others: the wind's way from the plane before to a node */
    float way;     /* m, its length */
    plait_u32 turbulent; /* 1: wind_velocity holds turbulence; 0: it is not read */
    float air[3];        /* m/s, in the world: of the wind where nothing stops it */
    float still[3];      /* m/s: of what there is no hair in */
} plait_wind_shelter_params;

/* lane_wind: drag of the air, before each substep. */
typedef struct plait_lane_wind_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    float h;               /* s, of the substep */
    plait_u32 bdf2;        /* 0: backward Euler; 1: BDF2, reads the step before */
    plait_u32 pins;        /* 1: lane_spring holds pins, to which the spring is added */
    plait_u32 accelerates; /* 1: vertices have accelerations; 0: `acceleration` is null */
    plait_u32 pressure;    /* 1: lane_pressure is added; 0: it is null */
    float drag;            /* rho d/2, kg/m^2: drag per length and squared speed at C = 1 */
    float viscous;         /* 10 (nu/d)^(2/3), (m/s)^(2/3) */
    float tangential;      /* drag along the strand over that across it */
    float air[3];          /* m/s */
    float jump[3];   /* m/s: by how much the air's velocity has jumped since the substep before */
    plait_u32 field; /* 1: wind_velocity is added; 0: it is null */
    plait_u32 edge_count; /* of the grid that it lies on, with voxel centres as nodes */
    float voxel_edge;     /* m */
    float q[4];
    float t[4]; /* world position of the grid's corner (w unused) */
} plait_lane_wind_params;

/* volume_splat, volume_gather: the grid as in plait_lane_grid_params; the tent is trilinear. */
typedef struct plait_lane_volume_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 edge_count;
    float voxel_edge;
    float q[4];
    float t[4];
    plait_u32 moves;   /* 1: velocities change; 0: lane_pressure alone is written (volume_gather) */
    plait_u32 history; /* 1: BDF2's step before is kept; 0: lane_v_before is null (volume_gather) */
    plait_u32 wet;     /* 1: strands have a wetness; 0: strand_wetness is null (volume_splat) */
    plait_u32 soaked;  /* 1, where wet: the fifth sum is of wetness (volume_splat) */
} plait_lane_volume_params;

typedef struct plait_volume_nodes_params {
    plait_u32 edge_count;
    float voxel_edge;
    float q[4];
    float t[4]; /* world position of the grid's corner (w unused) */
    plait_u32 collider_count;
    plait_u32 collider_first; /* where in `collider` those of the substep begin */
    plait_u32 meshes;         /* 1: mesh_solid says which nodes lie in meshes; 0: it is null */
    float h;                  /* s, of that substep */
} plait_volume_nodes_params;

typedef struct plait_volume_params {
    plait_u32 edge_count;
    float voxel_edge;    /* m */
    float h;             /* s, of the fixed step */
    float fall[3];       /* m/s, along the grid's axes, added to the velocity of hair */
    float share;         /* density to keep, over that at rest */
    float slack;         /* [0, 1): share of its room by which hair may be too dense */
    float recovery;      /* [0, 1]: share of what is far denser that parts in a step */
    float onset;         /* what is denser by this parts at half that rate; > 0 with a slack */
    float most_recovery; /* and at most this share of the volume */
    float cohesion;      /* m^2/s^2: what hair bears in tension, over its density at rest */
    float wet_cohesion;  /* m^2/s^2: what wetness 1 adds to it */
    plait_u32 carried;   /* 1: pressure starts as it was; 0: volume_before is null */
    plait_u32 wet;       /* 1: hair has a wetness; 0: volume_wetness is null */
} plait_volume_params;

typedef struct plait_volume_sweep_params {
    plait_u32 edge_count;
    plait_u32 colour; /* 0: nodes of even x + y + z; 1: of odd */
} plait_volume_sweep_params;

typedef struct plait_volume_impulse_params {
    plait_u32 edge_count;
    float voxel_edge; /* m */
    float h;          /* s, of the fixed step */
    float viscosity;  /* 1/s: hair takes the velocity of the hair around it at this rate */
} plait_volume_impulse_params;

/* lane_groom: per vertex, N/m. */
#define PLAIT_LANE_GROOM_OWN 0   /* of its strand's material */
#define PLAIT_LANE_GROOM_DROOP 1 /* with which half of a level strand's droop is left */
#define PLAIT_LANE_GROOM_COMPONENTS 2

/* lane_share: per vertex. */
#define PLAIT_LANE_SHARE_HAIR 0 /* hair that it stands for, over that of the mean vertex */
#define PLAIT_LANE_SHARE_REST 1 /* density of such shares around it at rest, per voxel */
#define PLAIT_LANE_SHARE_COMPONENTS 2

/* lane_reset, lane_teleport. */
typedef struct plait_lane_state_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    plait_u32 history; /* 1: BDF2's step before is kept; 0: lane_x_before, lane_v_before are null */
} plait_lane_state_params;

/* lane_accelerate. */
typedef struct plait_lane_tile_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    plait_u32 pressure; /* 1: lane_pressure is added; 0: it is null */
} plait_lane_tile_params;

/* lane_unpack. */
typedef struct plait_lane_unpack_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    float h;         /* s: position_prev = position - h v */
    plait_u32 shown; /* 1: tangent, and padding of it and of position, are written, too */
} plait_lane_unpack_params;

/* wetness. */
typedef struct plait_wetness_params {
    float left; /* [0, 1]: e^(-t/tau), t since the wetness was given */
} plait_wetness_params;

/* lane_wetness. */
typedef struct plait_lane_wetness_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
} plait_lane_wetness_params;

/* bounds: item i takes the elements [i*share, (i+1)*share) of `count`. */
typedef struct plait_bounds_params {
    plait_u32 count;
    plait_u32 share;
    plait_u32 boxes; /* 1: elements are boxes, two points each */
} plait_bounds_params;

typedef struct plait_lane_fit_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    float h; /* s: the step before is h ago */
} plait_lane_fit_params;

/* level_wake: lanes from strand_first on. */
typedef struct plait_level_wake_params {
    plait_u32 vertex_stride; /* V of the lanes */
    plait_u32 tile;
    plait_u32 row_stride; /* V of `rest` and of positions */
    plait_u32 strand_first;
    plait_u32 history; /* 1: BDF2's step before is kept; 0: lane_x_before, lane_v_before are null */
    float h;           /* s, the substep */
    float step;        /* s, the fixed one */
} plait_level_wake_params;

/* level_keep, level_show. */
typedef struct plait_level_params {
    plait_u32 vertex_stride;
    plait_u32 whole; /* 1: places in the frame of the root; 0: what is lacking to them */
    float share;     /* of that, [0, 1]; level_show */
} plait_level_params;

/* lane_orient. */
typedef struct plait_lane_orient_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    /* 1: of the substep before, of which velocities were changed; 0: of both, of strands that were put
       elsewhere, and lane_x_before is null */
    plait_u32 before;
} plait_lane_orient_params;

/* lane_pack. */
typedef struct plait_lane_history_params {
    plait_u32 vertex_stride;
    plait_u32 tile;
    plait_u32 row_stride;
    float h; /* s: the step before is h ago */
    /* 0: lane_x_before, lane_v_before are null; 1: BDF2's step before goes along with what is changed;
       2: a vertex had the velocity that it gains for a step, too */
    plait_u32 history;
} plait_lane_history_params;

/* lane_move. */
typedef struct plait_lane_move_params {
    plait_u32 vertex_stride;
    plait_u32 tile;       /* of both buffers */
    plait_u32 components; /* of a vertex row */
} plait_lane_move_params;

/* lane_material: per vertex row, components of the lane layout. */
#define PLAIT_LANE_LENGTH 0  /* l_i of the segment after vertex i, m; 0 past the tip */
#define PLAIT_LANE_STRETCH 1 /* EA_i/l_i, N/m; 0 past the tip; bounds friction */
#define PLAIT_LANE_BEND 2    /* 4EI/lbar of the joint before segment i, N m; 0 past the tip */
#define PLAIT_LANE_MASS 3    /* m_i, kg; 1 past the tip */
/* 0 where a strand is round and twists as it bends. The
 * joint's axes are those of q_(i-1) r_i: x along the segment, about y a strand bends by EI, about z
 * by EI2. */
#define PLAIT_LANE_TWIST 4 /* 4(GJ - EI)/lbar of the joint before segment i, N m */
#define PLAIT_LANE_CROSS 5 /* 4(EI2 - EI)/lbar, N m */
#define PLAIT_LANE_MATERIAL_COMPONENTS 6
/* Of row V - 1, after whose vertex no strand has a segment: two scales of the whole strand. */
#define PLAIT_LANE_DRAG 1     /* of params.drag */
#define PLAIT_LANE_FRICTION 2 /* of the coefficient of whatever the strand touches */
/* And in that row, where hair may be wet: the wetness that a strand's rows are scaled by; and, of
 * lane_dry, 1 where EA was chosen by weight, and so grows with it. */
#define PLAIT_LANE_WETNESS 4
#define PLAIT_LANE_WEIGHED 5

/* lane_plane: of each vertex the plane of a mesh or a strand that it may meet in the substep. Rows after the last one
 * with a plane hold anything. Row 0, for the root has none, holds LAST, and a second plane of a tip: CREASE. */
#define PLAIT_LANE_PLANE_LAST 0     /* of row 0: the last vertex with a plane; 0: none has one */
#define PLAIT_LANE_PLANE_CREASE 3   /* of row 0: xyz, as NORMAL; m, of the tip's ANCHOR above it */
#define PLAIT_LANE_PLANE_NORMAL 0   /* xyz, in the world, out of the mesh; 0: none */
#define PLAIT_LANE_PLANE_ANCHOR 3   /* xyz, m, relative to the root: the vertex, if it stuck */
#define PLAIT_LANE_PLANE_HEIGHT 6   /* m, of the anchor above the plane */
#define PLAIT_LANE_PLANE_START 7    /* m, of the anchor above the mesh */
#define PLAIT_LANE_PLANE_FRICTION 8 /* Coulomb coefficient */
#define PLAIT_LANE_PLANE_COMPONENTS 9
/* lane_hollow: of each vertex near a sheet what keeps it on its side: of one that has the sheet's plane and is
 * fast, the planes around that one, for in a hollow the wall rises from a plane; of one that has none, how far it may
 * go off its way. */
#define PLAIT_LANE_HOLLOW_KIND 0 /* one of these; the others hold anything that it does not name: */
#define PLAIT_HOLLOW_NONE 0.0f
#define PLAIT_HOLLOW_PLANES 1.0f
#define PLAIT_HOLLOW_ROOM 2.0f
#define PLAIT_LANE_HOLLOW_PLANE 1  /* the first: xyz as NORMAL; m, of ANCHOR above it */
#define PLAIT_LANE_HOLLOW_STRIDE 4 /* from one to the next */
#define PLAIT_LANE_HOLLOW_PLANES 6
#define PLAIT_LANE_HOLLOW_ANCHOR 1 /* xyz, as ANCHOR: where its way begins */
#define PLAIT_LANE_HOLLOW_ROOM 4   /* m: no place on its way is nearer to the sheet */
#define PLAIT_LANE_HOLLOW_COMPONENTS 25

/* output: interpolate the finished steps and attach the result to the roots of now. */
typedef struct plait_output_params {
    plait_u32 vertex_stride;
    float alpha; /* [0, 1]: 0 shows the step before the last, 1 the last */
} plait_output_params;

/* tangents. */
typedef struct plait_tangents_params {
    plait_u32 vertex_stride;
    plait_u32 strand_first; /* of which item 0 is the root */
} plait_tangents_params;

#endif
