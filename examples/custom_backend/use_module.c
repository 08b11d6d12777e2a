/* use_module MODULE: simulate on a backend that is loaded at run time, and see that it computes
 * what the backend it wraps computes. */
#include "strands.h"

#include <plait/plait_backend.h>

#include <string.h>

static void print(plait_log_level level, const char* text, void* user) {
    (void)level;
    if (strncmp(text, "trace: ", 7) != 0)
        return;
    ++*(int*)user;
    puts(text);
}

/* Where the hair is after two steps on `backend`; *traced counts the dispatches it logs. */
static void simulate(const char* backend, float (*positions)[VERTICES][4], int* traced) {
    plait_context_desc context_desc = plait_context_desc_defaults();
    context_desc.backend = backend;
    context_desc.log = print;
    context_desc.log_user = traced;
    plait_context* context = NULL;
    check(plait_context_create(&context_desc, &context));

    plait_groom* groom = make_groom();
    plait_sim_desc desc = plait_sim_desc_defaults();
    plait_sim* sim = NULL;
    check(plait_sim_create(context, groom, &desc, &sim));
    check(plait_sim_step(sim, 2.0 * desc.step));
    size_t size = STRANDS * sizeof *positions;
    check(plait_sim_read(sim, PLAIT_FIELD_POSITION, positions, &size));

    plait_sim_destroy(sim);
    plait_groom_destroy(groom);
    plait_context_destroy(context);
}

int main(int argc, char** argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s MODULE\n", argv[0]);
        return 2;
    }
    check(plait_backend_load(argv[1]));
    static float through_module[STRANDS][VERTICES][4], directly[STRANDS][VERTICES][4];
    int traced = 0, untraced = 0;
    simulate("trace", through_module, &traced);
    simulate("reference", directly, &untraced);
    const int same = memcmp(through_module, directly, sizeof directly) == 0;
    printf("%d dispatches traced; %s\n", traced,
           same ? "the hair is where it is without" : "the hair differs");
    return traced > 0 && untraced == 0 && same ? 0 : 1;
}
