/* Tuned constants of the stages: as much of their specification as the formulae. Kernels and the
 * float64 reference take them from here; docs/constants.md lists them, and a test compares the two.
 *
 * Compiled as C99, C++20 and OpenCL C 1.2: float in OpenCL C, double elsewhere. Lengths in segment
 * lengths are those of the segment before the vertex. h' is the step of the integrator: the
 * substep, 2/3 of it for BDF2. What only one backend needs (list sizes, rounding of float32)
 * stands beside its use.
 */
#ifndef PLAIT_CONSTANTS_H
#define PLAIT_CONSTANTS_H

#ifdef __OPENCL_C_VERSION__
#define PLAIT_NUMBER(digits) digits##f
#else
#define PLAIT_NUMBER(digits) digits
#endif

/* ---- tressfx: integrate, local_shape, length ---------------------------------------------------
 */

/* 1/s: rate of exp(-rate d h), so that the damping d means at any step what it does at 60 Hz.
 * TressFX 4.1. */
#define PLAIT_DAMPING_RATE PLAIT_NUMBER(60.0)
/* Largest stiffness of the local shape constraint; a joint moves by half of it. TressFX 4.1. */
#define PLAIT_LOCAL_SHAPE_MAX_STIFFNESS PLAIT_NUMBER(0.95)
/* m: shortest distance that the length constraint divides by. Ours. */
#define PLAIT_LENGTH_MIN_DISTANCE PLAIT_NUMBER(1e-7)

/* ---- contact in the solve ----------------------------------------------------------------------
 */

/* Segment lengths: penetration tolerance. No contact spring pushes with more than it does at this depth. Ours. */
#define PLAIT_CONTACT_TOLERANCE PLAIT_NUMBER(0.005)
/* Segment lengths: what a step leaves deeper takes another one. Ours. */
#define PLAIT_CONTACT_MAX_PENETRATION PLAIT_NUMBER(0.02)
/* EA: largest friction on a vertex. A strand that a collider caught is released before it stretches
 * without end and snaps back. Ours. */
#define PLAIT_CONTACT_MAX_FRICTION PLAIT_NUMBER(0.1)
/* Arc length from the root: how far out of a surface that holds the root a vertex has to come. All
 * of it would have the strand stand on end; the surface itself would stretch it. Ours. */
#define PLAIT_CONTACT_ROOT_CLEARANCE PLAIT_NUMBER(0.5)
/* Segment lengths of room around the way from where a vertex was to where inertia takes it: bodies are looked for in
 * it. Ours. */
#define PLAIT_CONTACT_ROOM PLAIT_NUMBER(0.3)
/* Penetration tolerances: a vertex farther off a surface is no longer pressed to it. Ours. */
#define PLAIT_CONTACT_REACH PLAIT_NUMBER(4.0)
/* Share of its way to the surface that a pressed vertex goes back by in a step. Ours. */
#define PLAIT_CONTACT_BACK PLAIT_NUMBER(0.1)
/* Share of the slip of friction's spring: a vertex that slips by less has all but stopped, and the spring holds
 * it on. Ours. */
#define PLAIT_CONTACT_STOPS PLAIT_NUMBER(0.3)
/* Segment lengths: a vertex that was lifted by more takes another step. Ours. */
#define PLAIT_CONTACT_DEEP PLAIT_NUMBER(0.1)
/* Radians: a step turns no segment of a strand in contact by more, which no potential could tell from wrong. Ours. */
#define PLAIT_CONTACT_MAX_TURN PLAIT_NUMBER(0.5)
/* Most steps of a strand that is left too deep. Ours. */
#define PLAIT_CONTACT_MAX_STEPS 12
/* Steps in which Newton's method itself may move a vertex out that is too deep; later steps put it on the surface,
 * against the forces in the strand. Ours. */
#define PLAIT_CONTACT_NEWTON_STEPS 2
/* Squared sine of 30 degrees: surfaces at a greater angle meet in an edge, in which a vertex is put on both. Ours. */
#define PLAIT_CONTACT_EDGE PLAIT_NUMBER(0.25)
/* Most surfaces on which such a vertex is put, one after the other: a corner has three. Ours. */
#define PLAIT_CONTACT_EDGE_ROUNDS 4
/* Newton steps to the first crossing; exact to 1e-3 r at half a radius off the axis. Ours. */
#define PLAIT_SWEEP_STEPS 4
/* Cosine of 60 degrees: normals farther apart belong to different sides of a capsule. Ours. */
#define PLAIT_SWEEP_SAME_SIDE PLAIT_NUMBER(0.5)

/* ---- meshes ------------------------------------------------------------------------------------
 */

/* Steps along the way of a vertex, each as long as the distance to the mesh. Ours. */
#define PLAIT_MESH_MARCH_STEPS 12
/* m: nearer, the way has come to the mesh. Ours. */
#define PLAIT_MESH_MARCH_LEAST PLAIT_NUMBER(2e-4)
/* Cells: no step along the way is shorter. What is thinner is lost in a grid, so that a step passes
 * no crossing but by less than this. Ours. */
#define PLAIT_MESH_MARCH_STEP PLAIT_NUMBER(0.25)
/* Slope of a distance below which it has no normal: between two surfaces that are equally near it
 * falls from 1 to 0. Ours. */
#define PLAIT_MESH_MIN_SLOPE PLAIT_NUMBER(0.5)
/* m: a place farther from the nearest triangle, or deeper under it, gives no plane (mesh_nearest).
 * Ours. */
#define PLAIT_MESH_ROOM PLAIT_NUMBER(1e-2)
/* Share of a triangle by which it is larger for what passes through it: no way slips through an edge.
 * Ours. */
#define PLAIT_MESH_EDGE PLAIT_NUMBER(1e-4)
/* m: roots that are deeper under a mesh that bends count as if they lay on it. Ours. */
#define PLAIT_MESH_ROOT_DEPTH PLAIT_NUMBER(5e-2)
/* m: nearer to an edge or a corner the way from there has no direction in float32; the normal is then
 * the mean of the triangles' around it. Ours. */
#define PLAIT_MESH_TOUCH PLAIT_NUMBER(5e-5)

/* m: what rises no more than this lies in a plane. Ours. */
#define PLAIT_MESH_FLAT PLAIT_NUMBER(1e-4)
/* m: what goes less far along a plane has no direction there in float32. Ours. */
#define PLAIT_MESH_SLIDE PLAIT_NUMBER(1e-3)
/* m: a tip that begins no deeper than this under its second plane has that. Ours. */
#define PLAIT_MESH_CREASE PLAIT_NUMBER(1e-3)
/* Of the way of a vertex in a substep: how far around it the planes of a hollow are found. Ours. */
#define PLAIT_MESH_HOLLOW PLAIT_NUMBER(0.5)

/* ---- strand against strand ---------------------------------------------------------------------
 */

/* Diameters: so near a pair is kept however slow it is. Ours. */
#define PLAIT_PAIR_NEAR PLAIT_NUMBER(1.5)
/* Diameters of arc: segments of one strand that are nearer along it are no pair. A strand that
 * bends back on itself as closely as it may is half a circle of pi/2. Ours. */
#define PLAIT_PAIR_ARC PLAIT_NUMBER(2.0)
/* m: nearer to each other, points of two segments have no direction apart. Ours. */
#define PLAIT_PAIR_LEAST PLAIT_NUMBER(1e-7)
/* Of a point of a segment: a vertex with a smaller share of it does not answer for it, so that a
 * strand can turn about what it lies on. Ours. */
#define PLAIT_PAIR_SHARE PLAIT_NUMBER(0.25)

/* ---- energy budget -----------------------------------------------------------------------------
 */

/* J: smallest budget; a strand with less does not move. Ours. */
#define PLAIT_ENERGY_MIN PLAIT_NUMBER(1e-30)
/* Squared share of its distance from the root by which a vertex may move in a substep beyond the
 * budget: positions are float32, and slower creep would wait for their rounding. Ours. */
#define PLAIT_ENERGY_ROUNDING PLAIT_NUMBER(1e-10)
/* m g L: what BDF2 leaves to all that moves; truncated solves give creeping hair more than it has.
 * Ours. */
#define PLAIT_ENERGY_BDF2_ALLOWANCE PLAIT_NUMBER(1e-5)
/* Squared relative change of velocities in a substep, beside twice gravity's, up to which BDF2 is
 * counted by G. Ours. */
#define PLAIT_ENERGY_BDF2_CHANGE PLAIT_NUMBER(0.2)

/* ---- articulated -------------------------------------------------------------------------------
 */

/* J: smallest difference of two potentials. Ours. */
#define PLAIT_ARTICULATED_POTENTIAL_MIN PLAIT_NUMBER(1e-20)
/* mu l^2: stiffness of the rotation about a segment's own axis, beside its joint's: that of limp
 * hair alone would be singular. Ours. */
#define PLAIT_ARTICULATED_TWIST PLAIT_NUMBER(1e-3)
/* A potential has risen if by more than this share: below it float32 picks at random. Ours. */
#define PLAIT_ARTICULATED_POTENTIAL_RISE PLAIT_NUMBER(1e-5)
/* Line search: factor of each shorter step, and how many there are. Ours. */
#define PLAIT_ARTICULATED_SHORTEN PLAIT_NUMBER(0.4)
#define PLAIT_ARTICULATED_SHORTER_STEPS 3
/* Squared chord between a segment's direction and its director above which somebody moved the
 * vertices and it is no rounding. Ours. */
#define PLAIT_ARTICULATED_MISALIGNED PLAIT_NUMBER(1e-9)
/* Segment lengths: what is less deep in a surface that it did not touch is left, since that is rounding. Ours. */
#define PLAIT_ARTICULATED_STOP PLAIT_NUMBER(1e-5)
/* Most Newton steps of a strand with a vertex farther from its pin than so many segment lengths,
 * whose stiffness is above so many times its inertia m/h'^2. A held vertex is off by a hundredth
 * under 10 g. Ours. */
#define PLAIT_ARTICULATED_PIN_STEPS 4
#define PLAIT_ARTICULATED_PIN_DISTANCE PLAIT_NUMBER(0.03)
#define PLAIT_ARTICULATED_PIN_STIFFNESS PLAIT_NUMBER(10.0)

/* ---- air ---------------------------------------------------------------------------------------
 */

/* 1/h': greatest rate of the air's drag. What is dragged harder has the air's velocity to a
 * thousandth, and springs far stiffer than inertia cost float32 digits. Ours. */
#define PLAIT_AIR_MOST_DRAG PLAIT_NUMBER(1000.0)

/* 1/m: extinction of wind in a collider: e^-10 is left behind a centimetre. Ours. */
#define PLAIT_AIR_SOLID PLAIT_NUMBER(1000.0)

/* ---- volume ------------------------------------------------------------------------------------
 */

/* Share of the density to keep below which hair is air to the pressure, and the least density at
 * all, in mean vertices per voxel. Ours. */
#define PLAIT_VOLUME_AIR PLAIT_NUMBER(0.05)
#define PLAIT_VOLUME_LEAST_DENSITY PLAIT_NUMBER(1e-3)
/* Share of it above which hair coheres. Ours. */
#define PLAIT_VOLUME_COHESIVE PLAIT_NUMBER(0.3)
/* Overrelaxation of the sweeps: layers of hair are a few voxels deep. Ours. */
#define PLAIT_VOLUME_RELAXATION PLAIT_NUMBER(1.5)
/* By how much more viscous than loose hair is hair that its weight presses, and what weight is,
 * m/s^2: friction of hair on hair. Ours. */
#define PLAIT_VOLUME_FRICTION PLAIT_NUMBER(4.0)
#define PLAIT_VOLUME_WEIGHT PLAIT_NUMBER(10.0)

/* ---- wetness -----------------------------------------------------------------------------------
 */

/* What wetness w does, as 1 + factor w or 1 - factor w: to line density (hair takes up a third of its
 * mass, and a film), bend and twist stiffness, the density that volume keeps, and the distance of a
 * follow from its guide. Starting values, of which none was measured. Ours. */
#define PLAIT_WET_DENSITY PLAIT_NUMBER(0.6)
#define PLAIT_WET_BEND PLAIT_NUMBER(0.5)
#define PLAIT_WET_CLOSENESS PLAIT_NUMBER(2.0)
#define PLAIT_WET_FOLLOW PLAIT_NUMBER(0.8)
/* Move of w for which rows of material are scaled anew: 1.2 % of a mass. Ours. */
#define PLAIT_WETNESS_MOVE PLAIT_NUMBER(0.02)
/* w below which hair is dry: e^(-t/tau) alone never gets there. Ours. */
#define PLAIT_WETNESS_DRY PLAIT_NUMBER(1e-3)
/* EA l: least 4 EI/l of a joint. Orientations are found from what joints and stretch pull at them; of
 * joints alone without stiffness they would find nothing and stay. Far below what can be seen:
 * Gamma 4e5 at 16 segments. Ours. */
#define PLAIT_LANE_LEAST_BEND PLAIT_NUMBER(1e-5)

/* ---- follow_clump and follow_curl --------------------------------------------------------------
 */

/* Way along which a strand comes to the centre of its clump, of its length and in segments: any
 * shorter way turns hair by more at once, and in one segment it would pass the centre. Ours. */
#define PLAIT_CLUMP_REACH PLAIT_NUMBER(0.08)
#define PLAIT_CLUMP_REACH_SEGMENTS PLAIT_NUMBER(2.0)
/* rms of gradient noise in one dimension whose gradients are even in [-1, 1]: the root of 2/3 of the
 * integral of (1 - f)^2 t^2, f the fade. */
#define PLAIT_FRIZZ_NOISE_RMS PLAIT_NUMBER(0.14069)

/* ---- follow_collide, follow_field and follow_nearest --------------------------------------------
 */

/* Sine of the steepest way out of a body: what is deeper comes out over several segments. Ours. */
#define PLAIT_FOLLOW_STEEPEST PLAIT_NUMBER(0.9)
/* Turns of a segment towards one surface: the second is for its curvature. Ours. */
#define PLAIT_FOLLOW_TURNS 2

/* ---- tressfx_set_off and lane_set_off ----------------------------------------------------------
 */

/* m: a turn counts as the speed it has so far from its axis, about a head's radius. Ours. */
#define PLAIT_SET_OFF_REACH PLAIT_NUMBER(0.1)

#endif
