/* Hair on a character with bones: a body that its skin bends, and hair that goes with the head bone.
 * 06_body BODY.gltf HAIR.tfx, as assets/character.gltf assets/long.tfx. Metres, y up. */
#include <math.h>
#include <plait/plait.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SETTLE = 60, FRAMES = SETTLE + 120 };

/* c = a b, 3x4 row-major; c may be b. */
static void multiply(const float* a, const float* b, float* c) {
    float product[12];
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            float sum = column == 3 ? a[4 * row + 3] : 0;
            for (int k = 0; k < 3; ++k)
                sum += a[4 * row + k] * b[4 * k + column];
            product[4 * row + column] = sum;
        }
    memcpy(c, product, sizeof product);
}

/* A turn about the vertical through the joint of a bone, which inverse_bind takes to the origin. */
static void turn(const plait_mesh_bone_info* bone, float half, float* to) {
    const float s = sinf(2 * half), c = cosf(2 * half), *b = bone->inverse_bind;
    const float x = -(b[0] * b[3] + b[4] * b[7] + b[8] * b[11]);
    const float z = -(b[2] * b[3] + b[6] * b[7] + b[10] * b[11]);
    const float m[12] = {c, 0, s, x - c * x - s * z, 0, 1, 0, 0, -s, 0, c, z + s * x - c * z};
    memcpy(to, m, sizeof m);
}

/* Skinning matrices of a head that looks to both sides. In an engine: the pose of each bone now, times
 * its inverse_bind. */
static plait_result pose_bones(const plait_mesh* body, size_t bones, float half, float (*skin)[12],
                               size_t* head) {
    plait_result result = PLAIT_OK;
    for (size_t i = 0; i < bones && result == PLAIT_OK; ++i) {
        plait_mesh_bone_info bone = plait_mesh_bone_info_defaults();
        result = plait_mesh_read_bone(body, (uint32_t)i, &bone);
        const int is_neck = strcmp(bone.name, "neck") == 0,
                  is_head = strcmp(bone.name, "head") == 0;
        turn(&bone, is_neck ? 0.4f * half : is_head ? 0.6f * half : 0, skin[i]);
        if (is_head && i > 0) /* whose parent is the bone before it, the neck */
            multiply(skin[i - 1], skin[i], skin[i]);
        *head = is_head ? i : *head;
    }
    return result;
}

/* Body and roots at the end of the coming frame. */
static plait_result move(plait_sim* sim, plait_collider_id id, const plait_mesh* body,
                         const plait_view* skin, const float* head, float half, float* posed,
                         size_t vertices) {
    const plait_view positions = {posed, vertices, 0};
    plait_roots roots = plait_roots_defaults();
    roots.head = (plait_pose){{0, sinf(half), 0, cosf(half)}, {head[3], head[7], head[11]}};
    plait_result result = plait_mesh_pose(body, skin, posed);
    result = result ? result : plait_collider_set_positions(sim, id, &positions);
    return result ? result : plait_sim_set_roots(sim, &roots);
}

int main(int argc, char** argv) {
    plait_context* context = NULL;
    plait_groom* hair = NULL;
    plait_mesh* body = NULL;
    plait_sim* sim = NULL;
    plait_collider_id id = {0};
    plait_mesh_info info = plait_mesh_info_defaults();
    plait_collider_mesh_desc collider = plait_collider_mesh_desc_defaults();
    collider.form = PLAIT_MESH_FORM_NEAREST; /* the form that bends */
    int bad = argc != 3 || plait_context_create(NULL, &context) ||
              plait_mesh_load(argv[1], NULL, &body) || plait_mesh_describe(body, &info) ||
              plait_groom_load(argv[2], NULL, &hair) ||
              plait_sim_create(context, hair, NULL, &sim) ||
              plait_collider_create_mesh(sim, body, &collider, &id); /* body and hair at rest */
    float(*skin)[12] = calloc(info.bones + 1, sizeof *skin), *posed = calloc(info.vertices + 1, 12);
    const plait_view bones = {skin, info.bones, 0};
    size_t head = 0;
    plait_sim_measures stats = plait_sim_measures_defaults();
    bad = bad || !skin || !posed;
    for (int frame = 1; !bad && frame <= FRAMES; ++frame) {
        const float turning = fmaxf((float)(frame - SETTLE), 0) / 60; /* s; first the hair falls */
        const float half = 0.35f * sinf(3.1415927f * turning);        /* 40 degrees to each side */
        bad = pose_bones(body, info.bones, half, skin, &head) ||
              move(sim, id, body, &bones, skin[head], half, posed, (size_t)info.vertices) ||
              plait_sim_step(sim, 1.0 / 60);
    }
    float box[2][4] = {{0}};
    size_t size = sizeof box;
    bad = bad || plait_sim_measure(sim, &stats) ||
          plait_sim_read(sim, PLAIT_FIELD_BOUNDS, box, &size);
    if (bad)
        fprintf(stderr, "%s\n", argc == 3 ? plait_last_error() : "06_body BODY.gltf HAIR.tfx");
    else
        printf("%u bones bend %u vertices; the hair goes with bone %u\nworst stretch: %.4f %%\n"
               "the hair hangs from %.3f m down to %.3f m\n",
               (unsigned)info.bones, (unsigned)info.vertices, (unsigned)head,
               1e2 * (double)stats.max_stretch, (double)box[1][1], (double)box[0][1]);
    free(skin);
    free(posed);
    plait_sim_destroy(sim);
    plait_mesh_destroy(body);
    plait_groom_destroy(hair);
    plait_context_destroy(context);
    return bad;
}
