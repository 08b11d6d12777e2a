/* Meshes: bodies that hair collides with, and scalps that its roots are bound to; bodies that sims
 * share. C99; plait.h includes it.
 */
#ifndef PLAIT_MESH_H
#define PLAIT_MESH_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Repairs of a mesh; by the plait_repair_policy, as of grooms. */
typedef enum plait_mesh_repair {
    /* within 1e-6 of the mesh's size of one before that the same bones move: a seam */
    PLAIT_MESH_REPAIR_WELDED_VERTEX = 0,
    PLAIT_MESH_REPAIR_DEGENERATE_TRIANGLE = 1, /* without area: dropped */
    PLAIT_MESH_REPAIR_DUPLICATE_TRIANGLE = 2,  /* the corners of one before: dropped */
    PLAIT_MESH_REPAIR_FLIPPED_TRIANGLE = 3,    /* faces another way than its surface: turned */
    /* of files: of more than four bones the heaviest four, scaled to sum 1; of none the first */
    PLAIT_MESH_REPAIR_REDUCED_SKIN = 4,
    PLAIT_MESH_REPAIR_COUNT = 5,
    PLAIT_MESH_REPAIR_FORCE_32 = 0x7fffffff
} plait_mesh_repair;

/* Triangles that hair may collide with: a head, a body, a collar. See docs/meshes.md. */
typedef struct plait_mesh_desc {
    uint32_t struct_size;
    plait_view positions; /* float[3], m, each [-1e6, 1e6] [vertices]; of no triangle: not read */
    plait_view triangles; /* uint32_t[3], each below positions.count, counter-clockwise from outside
                             [triangles] */
    plait_view bone_indices; /* uint32_t[4], each below 65536 [vertices]; or empty */
    plait_view bone_weights; /* float[4], each [0, 1], sum 1 within 1e-3 [vertices]; or empty */
} plait_mesh_desc;
PLAIT_STRUCT(plait_mesh_desc)

/* `options` NULL: defaults; of them policy, scale, axes, pose and allocator are read.
 * @errors BAD_DATA (triangle or vertex, value and range; nothing left; policy REFUSE) */
PLAIT_API plait_result plait_mesh_create(const plait_mesh_desc* desc,
                                         const plait_import_options* options, plait_mesh** out);

/* By extension: .obj, .gltf (with the .bin it names), .glb: all faces of all objects, where their
 * nodes put them, polygons as triangles, of glTF with the skin; .tfxmesh (TressFX 4.1), with it,
 * too.
 * @errors NOT_FOUND, IO, BAD_DATA (file, triangle or line, value, range), UNSUPPORTED (unknown
 *         extension, or built without assimp) */
PLAIT_API plait_result plait_mesh_load(const char* path, const plait_import_options* options,
                                       plait_mesh** out);
PLAIT_API void plait_mesh_destroy(plait_mesh* mesh);

typedef struct plait_mesh_info {
    uint32_t struct_size;
    uint64_t vertices;
    uint64_t triangles;
    uint64_t open_edges;    /* of one triangle; 0: closed, if unsided_edges is 0, too */
    uint64_t unsided_edges; /* of three or more, or where no turning makes neighbours agree */
    uint32_t components;    /* that hang together by edges */
    float bounds_min[3];    /* m */
    float bounds_max[3];
    double volume;                             /* m^3, of the closed components */
    double area;                               /* m^2 */
    uint64_t repairs[PLAIT_MESH_REPAIR_COUNT]; /* vertices or triangles, by kind */
    uint64_t repairs_total;
    char first_repair[192]; /* "triangle 17: has no area, dropped" or "" */
    uint32_t bones;         /* of its skin; 0: none */
} plait_mesh_info;
PLAIT_STRUCT(plait_mesh_info)
PLAIT_API plait_result plait_mesh_describe(const plait_mesh* mesh, plait_mesh_info* out);

typedef enum plait_mesh_field {
    PLAIT_MESH_FIELD_POSITIONS = 0, /* float[3] [vertices] */
    PLAIT_MESH_FIELD_TRIANGLES = 1, /* uint32_t[3] [triangles] */
    /* uint32_t [vertices]: the number each had when it came in, of welded ones the first, so that
       positions[i] = came[sources[i]] also when the mesh that came in moves */
    PLAIT_MESH_FIELD_SOURCES = 2,
    PLAIT_MESH_FIELD_BONE_INDICES = 3, /* uint32_t[4] [vertices] */
    PLAIT_MESH_FIELD_BONE_WEIGHTS = 4, /* float[4] [vertices], sum 1 */
    PLAIT_MESH_FIELD_FORCE_32 = 0x7fffffff
} plait_mesh_field;

/* After repairs: bytes. */
PLAIT_API plait_result plait_mesh_read(const plait_mesh* mesh, plait_mesh_field field, void* dst,
                                       size_t* size);

/* A bone as the mesh's file has it. Its skinning matrix is its present pose in the space of the
 * mesh, 3x4, times inverse_bind. */
typedef struct plait_mesh_bone_info {
    uint32_t struct_size;
    char name[64];          /* UTF-8, cut if longer; of meshes from arrays "" */
    float inverse_bind[12]; /* 3x4 row-major, m: from the mesh at rest to the bone. The identity
                               where the mesh is from arrays or .tfxmesh, which have none */
} plait_mesh_bone_info;
PLAIT_STRUCT(plait_mesh_bone_info)

/* @errors NOT_FOUND (`index` is not below plait_mesh_info.bones) */
PLAIT_API plait_result plait_mesh_read_bone(const plait_mesh* mesh, uint32_t index,
                                            plait_mesh_bone_info* out);

/* Where bones put the vertices, for plait_collider_set_positions: a linear blend on the host, on
 * any thread. `bones`: float[12], 3x4 row-major skinning matrices as in plait_roots.bones, at least
 * as many as the mesh has, each finite and neither singular nor reflecting. `positions`: float[3],
 * m [vertices]; identities give PLAIT_MESH_FIELD_POSITIONS. @errors INVALID_STATE (no skin) */
PLAIT_API plait_result plait_mesh_pose(const plait_mesh* mesh, const plait_view* bones,
                                       float* positions);

/* ---- colliders ---------------------------------------------------------------------------------- */

/* How hair finds a mesh. */
typedef enum plait_mesh_form {
    /* rigid, by distances on a grid, made once: loses what is thinner than two cells, or sharper */
    PLAIT_MESH_FORM_FIELD = 0,
    /* by its nearest triangle: exact, for meshes that bend, are thin or open; dearer where hair is
       near */
    PLAIT_MESH_FORM_NEAREST = 1,
    PLAIT_MESH_FORM_FORCE_32 = 0x7fffffff
} plait_mesh_form;

typedef struct plait_collider_mesh_desc {
    uint32_t struct_size;
    uint32_t cells; /* of FIELD, along the grid's longest side, [8, 256], default 48 */
    float margin;   /* m, hair stays so far outside, less within twice of it from its root, [0,
                       0.05], default 5e-4 */
    float friction; /* Coulomb coefficient, [0, 10], default 0.3 */
    /* 1, the default: no vertex is pushed farther out than it is where the groom has it, the roots
       and the mesh being where they are now; 0: all are */
    uint32_t clearance;
    /* 0: the mesh is closed, and hair stays outside. 1: it is a sheet, closed or not: hair stays,
       by FIELD a cell's edge, by NEAREST the margin from it on the side where it is. By NEAREST a
       vertex belongs to the side where it was first, until it goes round a rim */
    uint32_t two_sided;
    plait_pose pose; /* at creation */

    plait_mesh_form form; /* default FIELD */
} plait_collider_mesh_desc;
PLAIT_STRUCT(plait_collider_mesh_desc)

/* As large as the roots' scale makes it. Model articulated; a vertex meets one mesh in a substep,
 * the deepest, beside all other colliders. Waits.
 * @errors INVALID_STATE (model tressfx), INVALID_ARGUMENT (also open edges, and others that leave
 *         it without sides, where two_sided is 0) */
PLAIT_API plait_result plait_collider_create_mesh(plait_sim* sim, const plait_mesh* mesh,
                                                  const plait_collider_mesh_desc* desc,
                                                  plait_collider_id* out);

/* Faces of a hull, at most. */
#define PLAIT_HULL_FACES_MAX 256

/* A convex body with flat faces, where box and capsule are too plain. Rigid, for both models, at
 * the cost of a box and a dot product per face. See docs/meshes.md. */
typedef struct plait_collider_hull_desc {
    uint32_t struct_size;
    float margin;    /* m: every face lies so far outside, [0, 1e3], default 0; edges stay sharp */
    float friction;  /* Coulomb coefficient, [0, 10], default 0.3 */
    float tolerance; /* of the mesh's size: how far it may be from convex, and triangles of one face
                        from its plane, [1e-6, 0.1], default 1e-4. The hull holds all of it */
    plait_pose pose; /* at creation */
    uint32_t inward; /* as plait_collider_desc.inward; the margin is then on the inside */
    float scale;     /* as plait_collider_desc.scale, of its faces and its margin */
} plait_collider_hull_desc;
PLAIT_STRUCT(plait_collider_hull_desc)

/* Of a closed convex mesh: its faces are the planes of its triangles, those that lie in one plane
 * together.
 * @errors INVALID_ARGUMENT (also open edges, and others that leave it without an inside; flat; not
 *         convex, with the edge and by how much; more than PLAIT_HULL_FACES_MAX faces) */
PLAIT_API plait_result plait_collider_create_hull(plait_sim* sim, const plait_mesh* mesh,
                                                  const plait_collider_hull_desc* desc,
                                                  plait_collider_id* out);

/* Where the vertices of a mesh of form NEAREST, PLAIT_MESH_FIELD_POSITIONS, will be at the end of
 * the next plait_sim_step, in the collider's own frame: float[3], m, each [-1e6, 1e6], as many as
 * there are; interpolated from where they are. They have the roots' scale in them, that of the next
 * step's end, stay until the next call, and are meanwhile as large as roots are. Hair on it goes
 * along with what moves and stretches under it.
 * @errors INVALID_STATE (no mesh, or of form FIELD) */
PLAIT_API plait_result plait_collider_set_positions(plait_sim* sim, plait_collider_id collider,
                                                    const plait_view* positions);

/* ---- bodies that sims share --------------------------------------------------------------------- */

/* From now on `sim` has the colliders of `with`, under the same ids, and a plait_collider_ call on
 * any of the sims that share is a call on all of them: a character's hair, brows, lashes and beard
 * meet one head, which is made once and moved once per frame. What meshes have on the device is
 * held once. No sim owns them: one that is destroyed leaves, and the others keep them.
 *
 * Each sim moves as with colliders of its own, to the bit, whenever and however often it steps: a
 * body comes from where it was at the end of the sim's own last step to where it was last sent.
 * plait_collider_place puts it elsewhere in all of them, without a way; plait_sim_teleport and
 * plait_sim_reset end ways in their sim alone. A sim's own are the sides of sheets,
 * friction_scale, the clearance, measured with its roots where they are when it joins or the mesh
 * is made, and the scale of its roots: give all of them the same. Bodies are made and destroyed in
 * all or in none; if another call fails on the device, some of the sims may have had it.
 *
 * A sim without colliders gets those of `with` where they were last sent, without a way: set its
 * roots first. A sim that has the same already, by ids, shapes and meshes, as after
 * plait_sim_restore, keeps where they are for it. If it shares with `with` already, nothing
 * changes. `with` NULL: `sim` shares no longer, and keeps the colliders as its own.
 *
 * A snapshot holds the colliders as its sim sees them, as if they were its own. plait_sim_restore
 * puts them back for that sim alone; if the snapshot has other colliders than the sim shares, it
 * is INVALID_STATE.
 *
 * Waits. @errors INVALID_ARGUMENT (`with` is `sim`, or of another context), INVALID_STATE (`sim`
 *         has other colliders, or shares those of others; model tressfx, and one is a mesh) */
PLAIT_API plait_result plait_sim_share_colliders(plait_sim* sim, plait_sim* with);

/* ---- roots -------------------------------------------------------------------------------------- */

/* Where on a mesh a root is bound. */
typedef struct plait_root_place {
    uint32_t triangle; /* of PLAIT_MESH_FIELD_TRIANGLES */
    float weights[3];  /* of its corners, where it is nearest to the root; their sum is 1 */
    float height;      /* m, of the root above the triangle's plane */
    float distance;    /* m, from the root to that place */
} plait_root_place;

/* Binds the root of every guide to the triangle of `mesh` that is nearest to it, the groom and the
 * mesh lying as they were made, in one frame; NULL: roots are free again. From the next
 * plait_sim_set_roots on, with plait_roots.mesh_positions, a root keeps its place over the triangle
 * and its height above it, and turns as the triangle does (the closest rotation). The log warns of
 * roots that are farther than 1 cm from the mesh. `dst`: NULL, or `count` places, one per guide,
 * which a call that fails may write. Waits. Not part of a snapshot. See docs/meshes.md. */
PLAIT_API plait_result plait_sim_bind_roots(plait_sim* sim, const plait_mesh* mesh,
                                            plait_root_place* dst, size_t count);

#ifdef __cplusplus
}
#endif

#endif
