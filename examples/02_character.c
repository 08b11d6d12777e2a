/* Hair on a character: a head that turns, and a skull, a neck and shoulders that the hair lies on.
 * Metres; y is up, the face looks along +z. */
#include <math.h>
#include <plait/plait.h>
#include <stdio.h>

enum { STRANDS = 200, PER_STRAND = 20, VERTICES = STRANDS * PER_STRAND };
enum { PARTS = 3, SETTLE = 120, FRAMES = SETTLE + 120 };

/* Tapered capsules, each the hull of two spheres. The first turns with the head, about y. */
static const plait_capsule body[PARTS] = {
    {.a = {0, 0, 0}, .radius_a = 0.09f, .b = {0, -0.07f, 0.04f}, .radius_b = 0.05f},
    {.a = {0, -0.06f, -0.03f}, .radius_a = 0.05f, .b = {0, -0.18f, -0.03f}, .radius_b = 0.05f},
    {.a = {-0.17f, -0.23f, -0.03f},
     .radius_a = 0.06f,
     .b = {0.17f, -0.23f, -0.03f},
     .radius_b = 0.06f},
};

/* 35 cm of hair, straight out of the upper half of the skull, roots 1 mm above it. plait copies
 * what it is given; the groom is the caller's to destroy. */
static plait_result make_hair(plait_groom** groom) {
    static float rest[VERTICES][3];
    for (int i = 0; i < VERTICES; ++i) {
        const int strand = i / PER_STRAND, vertex = i % PER_STRAND;
        const float up = 1 - (float)strand / (float)STRANDS, across = sqrtf(1 - up * up);
        const float turn = 2.399963f * (float)strand; /* the golden angle: as a sunflower's seeds */
        const float r = 0.091f + 0.35f * (float)vertex / (PER_STRAND - 1);
        rest[i][0] = r * across * sinf(turn);
        rest[i][1] = r * up;
        rest[i][2] = r * across * cosf(turn);
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = (plait_view){rest, VERTICES, 0};
    desc.vertices_per_strand = PER_STRAND;
    return plait_groom_create(&desc, NULL, groom);
}

/* A collider belongs to its sim and goes with it; its id is what moves it. */
static plait_result make_body(plait_sim* sim, plait_collider_id* parts) {
    plait_result result = PLAIT_OK;
    for (int i = 0; i < PARTS && result == PLAIT_OK; ++i) {
        plait_collider_desc desc = plait_collider_desc_defaults();
        desc.capsule = body[i];
        result = plait_collider_create(sim, &desc, &parts[i]);
    }
    return result;
}

/* Where head and skull are at the end of the coming frame; until then plait interpolates. */
static plait_result turn_head(plait_sim* sim, plait_collider_id skull, float half) {
    plait_roots roots = plait_roots_defaults();
    roots.head = (plait_pose){.q = {0, sinf(half), 0, cosf(half)}};
    const plait_result result = plait_sim_set_roots(sim, &roots);
    return result ? result : plait_collider_set_pose(sim, skull, &roots.head);
}

/* How far inside a capsule turned by 2 * half about y the point is, m; negative: outside. */
static float depth(const plait_capsule* part, float half, const float* point) {
    const float s = sinf(2 * half), c = cosf(2 * half);
    const float p[3] = {c * point[0] - s * point[2], point[1], s * point[0] + c * point[2]};
    float pp = 0, pd = 0, dd = 0; /* of p and d = b - a, both from a */
    for (int i = 0; i < 3; ++i) {
        const float d = part->b[i] - part->a[i], from = p[i] - part->a[i];
        pp += from * from, pd += from * d, dd += d * d;
    }
    const float length = sqrtf(dd), along = pd / length,
                taper = (part->radius_b - part->radius_a) / length;
    const float across = sqrtf(fmaxf(pp - along * along, 0));
    const float at = fminf(fmaxf(along + across * taper / sqrtf(1 - taper * taper), 0), length);
    return part->radius_a + at * taper - hypotf(along - at, across);
}

/* The deepest of all vertices, m. To measure: what draws leaves the positions on the device
 * (05_interop.c). */
static plait_result read_depth(plait_sim* sim, float half, float* deepest) {
    static float now[VERTICES][4]; /* x, y, z, inverse mass */
    size_t size = sizeof now;
    const plait_result result = plait_sim_read(sim, PLAIT_FIELD_POSITION, now, &size);
    for (int i = 0; i < VERTICES && result == PLAIT_OK; ++i)
        for (int part = 0; part < PARTS; ++part)
            *deepest = fmaxf(*deepest, depth(&body[part], part ? 0 : half, now[i]));
    return result;
}

int main(void) {
    plait_context* context = NULL;
    plait_groom* groom = NULL;
    plait_sim* sim = NULL;
    plait_collider_id parts[PARTS];
    int bad = plait_context_create(NULL, &context) || make_hair(&groom) ||
              plait_sim_create(context, groom, NULL, &sim) || make_body(sim, parts);
    float deepest = -1, stretch = 0, box[2][4];
    for (int frame = 1; !bad && frame <= FRAMES; ++frame) {
        const float turning = fmaxf((float)(frame - SETTLE), 0) / 60; /* s; first the hair falls */
        const float half = 0.4f * sinf(3.1415927f * turning);         /* 46 degrees to each side */
        plait_sim_measures stats = plait_sim_measures_defaults();
        bad = turn_head(sim, parts[0], half) || plait_sim_step(sim, 1.0 / 60);
        if (frame > SETTLE)
            bad = bad || read_depth(sim, half, &deepest) || plait_sim_measure(sim, &stats);
        stretch = fmaxf(stretch, stats.max_stretch);
    }
    size_t size = sizeof box;
    bad = bad || plait_sim_read(sim, PLAIT_FIELD_BOUNDS, box, &size);
    if (bad)
        fprintf(stderr, "%s\n", plait_last_error());
    else
        printf("deepest vertex in a capsule: %.2f mm\nworst stretch: %.4f %%\n"
               "the hair lies between (%.2f, %.2f, %.2f) and (%.2f, %.2f, %.2f) m\n",
               1e3 * (double)deepest, 1e2 * (double)stretch, (double)box[0][0], (double)box[0][1],
               (double)box[0][2], (double)box[1][0], (double)box[1][1], (double)box[1][2]);
    plait_sim_destroy(sim);
    plait_groom_destroy(groom);
    plait_context_destroy(context);
    return bad;
}
