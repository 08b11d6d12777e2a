/* A ring of hair on a head that shakes "no": make it, move it, read it. See docs/hello.md. */
#include <plait/plait.h>

#include <math.h>
#include <stdio.h>

enum { STRANDS = 64, VERTICES = 16, FRAMES = 120 };

static int ok(plait_result result) {
    if (result != PLAIT_OK)
        fprintf(stderr, "%s: %s\n", plait_result_string(result), plait_last_error());
    return result == PLAIT_OK;
}

int main(void) {
    static float rest[STRANDS][VERTICES][3], now[STRANDS][VERTICES][4];
    for (int s = 0; s < STRANDS; ++s)
        for (int v = 0; v < VERTICES; ++v) { /* 30 cm of hair, hanging from 9 cm off the axis */
            rest[s][v][0] = 0.09f * cosf(6.2831853f * (float)s / STRANDS);
            rest[s][v][1] = -0.02f * (float)v;
            rest[s][v][2] = 0.09f * sinf(6.2831853f * (float)s / STRANDS);
        }
    plait_groom_desc hair = plait_groom_desc_defaults();
    hair.positions = (plait_view){rest, STRANDS * VERTICES, 0};
    hair.vertices_per_strand = VERTICES;

    plait_context* context = NULL;
    plait_groom* groom = NULL;
    plait_sim* sim = NULL;
    plait_sim_desc desc = plait_sim_desc_defaults();
    desc.params.length_iterations = 32; /* with the default 2, TressFX's, hair is soft as rubber */
    int fine = ok(plait_context_create(NULL, &context)) &&
               ok(plait_groom_create(&hair, NULL, &groom)) &&
               ok(plait_sim_create(context, groom, &desc, &sim));

    plait_roots roots = plait_roots_defaults();
    for (int frame = 1; fine && frame <= FRAMES; ++frame) {
        const float angle = 0.6f * sinf(6.2831853f * (float)frame / 60); /* once a second */
        roots.head.q[1] = sinf(angle / 2);
        roots.head.q[3] = cosf(angle / 2);
        fine = ok(plait_sim_set_roots(sim, &roots)) && ok(plait_sim_step(sim, 1.0 / 60));
    }

    size_t size = sizeof now;
    fine = fine && ok(plait_sim_read(sim, PLAIT_FIELD_POSITION, now, &size));
    const float* tip = now[0][VERTICES - 1];
    if (fine)
        printf("tip of strand 0: %.3f %.3f %.3f m\n", tip[0], tip[1], tip[2]);

    plait_sim_destroy(sim);
    plait_groom_destroy(groom);
    plait_context_destroy(context);
    return fine ? 0 : 1;
}
