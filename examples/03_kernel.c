/* 03_kernel 03_kernel.cl: your own kernel for one stage, here a gravity well for hair. Any stage is
 * replaced like this (docs/backends.md); `accelerate` is the one that plait leaves to you. */
#include <math.h>
#include <plait/plait.h>
#include <stdio.h>

enum { STRANDS = 64, PER_STRAND = 16, VERTICES = STRANDS * PER_STRAND };

static const float well[3] = {0, -0.15f, 0.2f}; /* m: before the fringe, at half its height */

/* The fringe of 01_hello.c. */
static plait_result make_hair(plait_groom** groom) {
    static float rest[VERTICES][3];
    for (int i = 0; i < VERTICES; ++i) {
        rest[i][0] = 0.003f * (float)(i / PER_STRAND) - 0.0945f;
        rest[i][1] = -0.02f * (float)(i % PER_STRAND);
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = (plait_view){rest, VERTICES, 0};
    desc.vertices_per_strand = PER_STRAND;
    return plait_groom_create(&desc, NULL, groom);
}

/* The text is compiled here, and its arguments are compared with those of the stage: a mistake is
 * PLAIT_COMPILE, with the compiler's log. Only OpenCL runs OpenCL C, so the backend is named. plait
 * copies the text. */
static plait_result make_context(const char* source, const char* name, plait_context** context) {
    const plait_stage_source own = {"accelerate", source, name};
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = "opencl";
    desc.stage_sources = &own;
    desc.stage_source_count = 1;
    return plait_context_create(&desc, context);
}

static plait_result make_sim(plait_context* context, const plait_groom* groom, plait_sim** sim) {
    return plait_sim_create(context, groom, NULL, sim);
}

/* Two seconds of a well of this strength, m^3/s^2; then the mean distance of the tips to it, m. */
static plait_result pull(plait_sim* sim, float strength, double* distance) {
    plait_acceleration_desc desc = plait_acceleration_desc_defaults();
    const float values[] = {well[0], well[1], well[2], strength, 0.1f};
    for (int i = 0; i < 5; ++i)
        desc.values[i] = values[i];
    plait_result result = plait_sim_set_acceleration(sim, &desc); /* the kernel runs from now on */
    for (int frame = 0; !result && frame < 120; ++frame)
        result = plait_sim_step(sim, 1.0 / 60);

    static float now[VERTICES][4];
    size_t size = sizeof now;
    result = result ? result : plait_sim_read(sim, PLAIT_FIELD_POSITION, now, &size);
    *distance = 0;
    for (int strand = 0; strand < STRANDS; ++strand) {
        const float* tip = now[strand * PER_STRAND + PER_STRAND - 1];
        *distance += sqrt(pow((double)(tip[0] - well[0]), 2) + pow((double)(tip[1] - well[1]), 2) +
                          pow((double)(tip[2] - well[2]), 2)) /
                     (double)STRANDS;
    }
    return result;
}

int main(int argc, char** argv) {
    static char source[1 << 14];
    FILE* file = argc == 2 ? fopen(argv[1], "rb") : NULL;
    if (!file || !fread(source, 1, sizeof source - 1, file)) {
        fprintf(stderr, "usage: 03_kernel 03_kernel.cl\n");
        return 1;
    }
    fclose(file);
    plait_context* context = NULL;
    plait_groom* groom = NULL;
    plait_sim* sim = NULL;
    double without = 0, with = 0;
    const int bad = make_context(source, argv[1], &context) || make_hair(&groom) ||
                    make_sim(context, groom, &sim) || pull(sim, 0, &without) || pull(sim, 1, &with);
    if (bad)
        fprintf(stderr, "%s\n", plait_last_error());
    else
        printf("tips hang %.3f m from the well while it does not pull, %.3f m when it does\n"
               "drawn by %.3f m\n",
               without, with, without - with);
    plait_sim_destroy(sim);
    plait_groom_destroy(groom);
    plait_context_destroy(context);
    return bad;
}
