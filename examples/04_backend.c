/* 04_backend MODULE: simulate on a backend that is loaded at run time (04_module.c), and see that
 * the hair goes where the backend that it wraps takes it. */
#include <plait/plait_backend.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STRANDS = 16, PER_STRAND = 16, VERTICES = STRANDS * PER_STRAND };

/* Strands of 20 cm, grown sideways. */
static plait_result make_hair(plait_groom** groom) {
    static float rest[VERTICES][3];
    for (int i = 0; i < VERTICES; ++i) {
        rest[i][0] = 0.2f * (float)(i % PER_STRAND) / (PER_STRAND - 1);
        rest[i][2] = 0.01f * (float)(i / PER_STRAND);
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = (plait_view){rest, VERTICES, 0};
    desc.vertices_per_strand = PER_STRAND;
    return plait_groom_create(&desc, NULL, groom);
}

/* Where they are after two steps. */
static int simulate(const char* backend, float (*positions)[4]) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = backend;
    plait_context* context = NULL;
    plait_groom* groom = NULL;
    plait_sim* sim = NULL;
    size_t size = VERTICES * sizeof *positions;
    const int bad = plait_context_create(&desc, &context) || make_hair(&groom) ||
                    plait_sim_create(context, groom, NULL, &sim) || plait_sim_step(sim, 2.0 / 60) ||
                    plait_sim_read(sim, PLAIT_FIELD_POSITION, positions, &size);
    plait_sim_destroy(sim);
    plait_groom_destroy(groom);
    plait_context_destroy(context);
    return bad;
}

int main(int argc, char** argv) {
    static float traced[VERTICES][4], directly[VERTICES][4];
    if (argc != 2) {
        fprintf(stderr, "usage: 04_backend MODULE\n");
        return 1;
    }
    const char* wrapped = getenv("PLAIT_TRACE") ? getenv("PLAIT_TRACE") : "reference";
    /* For the whole process, and never unloaded: a driver in it may have started threads. */
    if (plait_backend_load(argv[1]) || simulate("trace", traced) || simulate(wrapped, directly)) {
        fprintf(stderr, "%s\n", plait_last_error());
        return 1;
    }
    const int same = memcmp(traced, directly, sizeof directly) == 0;
    printf("%d backends; the tip of strand 0 fell %.4f m, %s\n", (int)plait_backend_count(),
           (double)-traced[PER_STRAND - 1][1],
           same ? "as without the trace" : "not as without the trace");
    return !same;
}
