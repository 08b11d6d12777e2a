/* One groom over several processes: each steps a tile of its strands, and MPI adds up the grid between
 * them. The sum that is printed, of all strands, is the same for any number of ranks. See docs/cluster.md.
 *
 *     mpirun -n 4 09_cluster [strands] [frames] [rank that dies halfway]
 */
#include <math.h>
#include <mpi.h>
#include <plait/plait.h>
#include <plait/plait_cluster.h>
#include <stdio.h>
#include <stdlib.h>

enum { PER_STRAND = 16, WARM = 10 }; /* frames that are not timed */

typedef struct {
    int rank, ranks;
    uint32_t first, last; /* strands first to last - 1 are this rank's */
    double waited;        /* s, in MPI */
    plait_context* context;
    plait_sim* sim;
} tile;

static int reduce(int64_t* sums, size_t count, void* user) {
    const double begin = MPI_Wtime();
    const int code =
        MPI_Allreduce(MPI_IN_PLACE, sums, (int)count, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    ((tile*)user)->waited += MPI_Wtime() - begin;
    return code != MPI_SUCCESS;
}

/* Hair of 30 cm on a cap; neighbours in the list lie at one height. */
static void grow(uint32_t strand, uint32_t strands, float vertex[PER_STRAND][3]) {
    const float high = 1 - 0.8f * ((float)strand + 0.5f) / (float)strands;
    const float wide = sqrtf(1 - high * high), round = 2.4f * (float)strand;
    for (int i = 0; i < PER_STRAND; ++i) {
        const float s = 0.02f * (float)i, r = 0.09f + 0.2f * s; /* m */
        vertex[i][0] = r * wide * cosf(round);
        vertex[i][1] = r * high - s;
        vertex[i][2] = r * wide * sinf(round);
    }
}

static plait_result make_groom(const tile* t, uint32_t strands, plait_groom** groom) {
    const uint32_t own = t->last - t->first;
    float(*vertices)[PER_STRAND][3] = malloc(own * sizeof *vertices);
    if (!vertices)
        return PLAIT_OUT_OF_MEMORY;
    for (uint32_t i = 0; i < own; ++i)
        grow(t->first + i, strands, vertices[i]);
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = (plait_view){vertices, (size_t)own * PER_STRAND, 0};
    desc.vertices_per_strand = PER_STRAND;
    const plait_result result = plait_groom_create(&desc, NULL, groom);
    free(vertices);
    return result;
}

/* Every rank has all bodies, and the same cube around all of the hair. */
static int make_sim(tile* t, uint32_t strands) {
    plait_collider_desc skull = plait_collider_desc_defaults();
    skull.capsule = (plait_capsule){.radius_a = 0.088f, .b = {0, -0.04f, 0}, .radius_b = 0.088f};
    plait_collider_id id;
    plait_grid_desc grid = plait_grid_desc_defaults();
    grid.edge_count = 32;
    grid.edge = 1;
    grid.origin[0] = grid.origin[1] = grid.origin[2] = -0.5f;
    plait_groom* groom = NULL;
    const int bad = make_groom(t, strands, &groom) ||
                    plait_sim_create(t->context, groom, NULL, &t->sim) ||
                    plait_collider_create(t->sim, &skull, &id) ||
                    plait_sim_set_grid(t->sim, &grid) || plait_sim_set_reduce(t->sim, reduce, t);
    plait_groom_destroy(groom);
    return bad;
}

/* Of the bits of every coordinate of every strand, each times an odd number of its own. */
static int sum_strands(const tile* t, uint64_t* sum) {
    const uint64_t words = (uint64_t)(t->last - t->first) * PER_STRAND * 4;
    size_t size = words * sizeof(uint32_t);
    uint32_t* word = malloc(size);
    const int bad = !word || plait_sim_read(t->sim, PLAIT_FIELD_POSITION, word, &size);
    uint64_t own = 0;
    for (uint64_t i = 0; !bad && i < words; ++i)
        own += word[i] * (2 * ((uint64_t)t->first * PER_STRAND * 4 + i) + 1);
    free(word);
    MPI_Reduce(&own, sum, 1, MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
    return bad;
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    static tile t;
    MPI_Comm_rank(MPI_COMM_WORLD, &t.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &t.ranks);
    const uint32_t strands = argc > 1 ? (uint32_t)atoi(argv[1]) : 2000;
    const int frames = argc > 2 ? atoi(argv[2]) : 100, dies = argc > 3 ? atoi(argv[3]) : -1;
    t.first = (uint32_t)((uint64_t)strands * (uint64_t)t.rank / (uint64_t)t.ranks);
    t.last = (uint32_t)((uint64_t)strands * (uint64_t)(t.rank + 1) / (uint64_t)t.ranks);
    int bad = plait_context_create(NULL, &t.context) || make_sim(&t, strands);
    plait_roots roots = plait_roots_defaults();
    double begin = 0;
    for (int frame = 0; !bad && frame < frames; ++frame) {
        if (frame == frames / 2 && t.rank == dies)
            abort(); /* as a machine that fails */
        if (frame == WARM)
            begin = MPI_Wtime(), t.waited = 0;
        const float half = 0.3f * sinf(0.1f * (float)frame);
        roots.head = (plait_pose){.q = {0, sinf(half), 0, cosf(half)}};
        bad = plait_sim_set_roots(t.sim, &roots) || plait_sim_step(t.sim, 1.0 / 60);
    }
    bad = bad || plait_sim_wait(t.sim);
    const double ms = 1e3 / (frames - WARM), step = ms * (MPI_Wtime() - begin);
    uint64_t sum = 0;
    if (bad || sum_strands(&t, &sum)) { /* the others would wait for this rank for ever */
        fprintf(stderr, "rank %d of %d: %s\n", t.rank, t.ranks, plait_last_error());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    if (t.rank == 0)
        printf("%d ranks, %.2f ms a step, %.2f of it in MPI, sum %016llx\n", t.ranks, step,
               ms * t.waited, (unsigned long long)sum);
    plait_sim_destroy(t.sim);
    plait_context_destroy(t.context);
    return MPI_Finalize();
}
