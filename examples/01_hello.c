/* A fringe of hair on a head that shakes "no": make it, move it, read it. See docs/hello.md. */
#include <math.h>
#include <plait/plait.h>
#include <stdio.h>

enum { STRANDS = 64, PER_STRAND = 16, VERTICES = STRANDS * PER_STRAND };

int main(void) {
    static float rest[VERTICES][3], now[VERTICES][4]; /* strand after strand, root first; m */
    for (int i = 0; i < VERTICES; ++i) {
        rest[i][0] = 0.003f * (float)(i / PER_STRAND) - 0.0945f; /* 19 cm wide */
        rest[i][1] = -0.02f * (float)(i % PER_STRAND);           /* and 30 cm long */
    }
    plait_groom_desc hair = plait_groom_desc_defaults();
    hair.positions = (plait_view){rest, VERTICES, 0};
    hair.vertices_per_strand = PER_STRAND;
    const double stiffness = 4.7e-8; /* EI, N m^2: of a lock, ten times a single hair's */
    plait_context* context = NULL;
    plait_groom* groom = NULL;
    plait_sim* sim = NULL;
    int bad = plait_context_create(NULL, &context) || plait_groom_create(&hair, NULL, &groom) ||
              plait_sim_create(context, groom, NULL, &sim) ||
              plait_sim_set_param(sim, "bend_stiffness", &stiffness, 1);
    plait_roots roots = plait_roots_defaults();
    for (int frame = 1; !bad && frame <= 120; ++frame) {
        const float half = 0.3f * sinf(6.2831853f * (float)frame / 60); /* of the angle about y */
        roots.head = (plait_pose){.q = {0, sinf(half), 0, cosf(half)}};
        bad = plait_sim_set_roots(sim, &roots) || plait_sim_step(sim, 1.0 / 60);
    }
    size_t size = sizeof now;
    bad = bad || plait_sim_read(sim, PLAIT_FIELD_POSITION, now, &size);
    if (bad)
        fprintf(stderr, "%s\n", plait_last_error());
    else
        printf("strand 0 ends %.3f m below its root\n", (double)-now[PER_STRAND - 1][1]);
    plait_sim_destroy(sim);
    plait_groom_destroy(groom);
    plait_context_destroy(context);
    return bad;
}
