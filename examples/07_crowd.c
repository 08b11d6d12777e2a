/* A crowd within a budget: each frame the director says which of a groom's strands each head steps, and
 * how many are shown. One groom, one set of levels, a sim for each head.
 *
 *     07_crowd assets/long.tfx [budget in ms]
 */
#define _POSIX_C_SOURCE 199309L /* clock_gettime */
#include <math.h>
#include <plait/plait.h>
#include <plait/plait_levels.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { HEADS = 12, FRAMES = 120 };

typedef struct {
    plait_context* context;
    plait_levels* levels;
    plait_sim* sims[HEADS];
    plait_character heads[HEADS];
} crowd;

static double now_ms(void) {
#ifdef _WIN32 /* whose clock() is that on the wall */
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;
#else
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
#endif
}

static plait_result make_head(crowd* c, const plait_groom* groom, int i) {
    plait_sim_desc desc = plait_sim_desc_defaults();
    desc.levels = c->levels;
    plait_result result = plait_sim_create(c->context, groom, &desc, &c->sims[i]);
    plait_collider_desc skull = plait_collider_desc_defaults();
    skull.capsule = (plait_capsule){
        .a = {0, 0, 0}, .radius_a = 0.09f, .b = {0, -0.07f, 0.04f}, .radius_b = 0.05f};
    plait_collider_id id;
    if (result == PLAIT_OK)
        result = plait_collider_create(c->sims[i], &skull, &id);
    c->heads[i] = plait_character_defaults();
    c->heads[i].sim = c->sims[i];
    return result;
}

static plait_result make_crowd(crowd* c, const char* path) {
    plait_groom* groom = NULL;
    plait_result result = plait_groom_load(path, NULL, &groom);
    plait_levels_desc desc = plait_levels_desc_defaults();
    desc.groom = groom;
    if (result == PLAIT_OK)
        result = plait_levels_create(&desc, &c->levels);
    for (int i = 0; i < HEADS && result == PLAIT_OK; ++i)
        result = make_head(c, groom, i);
    plait_groom_destroy(groom);
    return result;
}

/* Heads turn about y, each in its own time, and stand in a row from 0.7 m to 30 m away. */
static plait_result move(crowd* c, int frame) {
    plait_result result = PLAIT_OK;
    for (int i = 0; i < HEADS && result == PLAIT_OK; ++i) {
        const float half = 0.3f * sinf(0.1f * (float)frame + (float)i);
        plait_roots roots = plait_roots_defaults();
        roots.head = (plait_pose){.q = {0, sinf(half), 0, cosf(half)}};
        result = plait_sim_set_roots(c->sims[i], &roots);
        /* 1080 lines, a view of 40 degrees */
        const float away = 0.7f * powf(30 / 0.7f, (float)i / (HEADS - 1));
        c->heads[i].pixels_per_metre = 1080 / (2 * tanf(0.349f) * away);
    }
    return result;
}

/* Without a budget and with a tolerance of nothing all strands of all heads are stepped. Writes the ms of the
 * last half of the frames. */
static plait_result run(crowd* c, float budget_ms, double* ms) {
    plait_director_desc director = plait_director_desc_defaults();
    director.budget_ms = budget_ms;
    director.tolerance_px = 0.05f;
    plait_result result = PLAIT_OK;
    *ms = 0;
    for (int frame = 0; frame < FRAMES && result == PLAIT_OK; ++frame) {
        result = move(c, frame);
        if (result == PLAIT_OK)
            result = plait_context_direct(c->context, c->heads, HEADS, &director, 1.0 / 60, NULL);
        const double begin = now_ms();
        if (result == PLAIT_OK)
            result = plait_context_step(c->context, c->sims, HEADS, 1.0 / 60);
        for (int i = 0; i < HEADS && result == PLAIT_OK; ++i)
            result = plait_sim_wait(c->sims[i]);
        director.last_ms = (float)(now_ms() - begin);
        if (frame >= FRAMES / 2)
            *ms += (double)director.last_ms / (FRAMES - FRAMES / 2);
    }
    return result;
}

int main(int argc, char** argv) {
    if (argc < 2) {
        fprintf(stderr, "07_crowd HAIR [budget in ms]\n");
        return 1;
    }
    const float budget = argc > 2 ? (float)atof(argv[2]) : 4;
    static crowd c;
    double full = 0, directed = 0;
    plait_level_state near = plait_level_state_defaults(), far = near;
    const int bad = plait_context_create(NULL, &c.context) || make_crowd(&c, argv[1]) ||
                    run(&c, 0, &full) || run(&c, budget, &directed) ||
                    plait_sim_get_level(c.sims[0], &near) ||
                    plait_sim_get_level(c.sims[HEADS - 1], &far);
    if (bad)
        fprintf(stderr, "%s\n", plait_last_error());
    else
        printf("%d heads: %.1f ms a frame, %.1f in a budget of %.1f\n"
               "the nearest is at level %u and shows %u strands\n"
               "the farthest is at level %u and shows %u strands\n",
               HEADS, full, directed, (double)budget, near.level, near.shown, far.level, far.shown);
    for (int i = 0; i < HEADS; ++i)
        plait_sim_destroy(c.sims[i]);
    plait_levels_destroy(c.levels);
    plait_context_destroy(c.context);
    return bad;
}
