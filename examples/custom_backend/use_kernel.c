/* use_kernel FILE: the smallest plug, one's own kernel in place of one stage. The same hair in the
 * same wind, with plait's `wind` and with ours, which leaves hair that hangs below its root alone.
 */
#include "strands.h"

static char* read_file(const char* path) {
    FILE* file = fopen(path, "rb");
    char* text = calloc(1, 1 << 16);
    if (!file || !text || fread(text, 1, (1 << 16) - 1, file) == 0) {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(1);
    }
    fclose(file);
    return text;
}

/* How far a wind of 5 m/s along z has carried the tips after half a second, on average, in metres.
 */
static float drift(const plait_stage_source* stage, float gravity) {
    plait_context_desc context_desc = plait_context_desc_defaults();
    context_desc.backend = "opencl";
    context_desc.stage_sources = stage;
    context_desc.stage_source_count = stage ? 1 : 0;
    plait_context* context = NULL;
    check(plait_context_create(&context_desc, &context));

    plait_groom* groom = make_groom();
    plait_sim_desc desc = plait_sim_desc_defaults();
    desc.model = PLAIT_MODEL_TRESSFX;   /* of which wind is a stage */
    desc.params.local_stiffness = 0.0f; /* limp */
    desc.params.gravity[1] = gravity;
    desc.params.wind[2] = 5.0f;
    desc.params.air_drag = 2.0f;
    plait_sim* sim = NULL;
    check(plait_sim_create(context, groom, &desc, &sim));
    for (int frame = 0; frame < 30; ++frame)
        check(plait_sim_step(sim, 1.0 / 60.0));
    static float positions[STRANDS][VERTICES][4];
    size_t size = sizeof positions;
    check(plait_sim_read(sim, PLAIT_FIELD_POSITION, positions, &size));

    float sum = 0.0f;
    for (int strand = 0; strand < STRANDS; ++strand)
        sum += positions[strand][VERTICES - 1][2] - 0.01f * (float)strand;
    plait_sim_destroy(sim);
    plait_groom_destroy(groom);
    plait_context_destroy(context);
    return sum / STRANDS;
}

int main(int argc, char** argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s FILE\n", argv[0]);
        return 2;
    }
    char* source = read_file(argv[1]);
    const plait_stage_source ours = {"wind", source, argv[1]};
    const float hanging = drift(&ours, -9.81f), rising = drift(&ours, 9.81f);
    const float hanging_built_in = drift(NULL, -9.81f);
    free(source);
    printf("tips drift %.3f m in our wind where they hang, %.3f m where they rise; %.3f m in "
           "plait's\n",
           hanging, rising, hanging_built_in);
    const int still = hanging < 0.001f && hanging > -0.001f;
    return still && rising > 0.01f && hanging_built_in > 0.01f ? 0 : 1;
}
