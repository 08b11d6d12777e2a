/* One groom over several processes: each steps a part of its strands, and the grid between strands sees
 * all of them. plait knows no network: the caller adds up the sums, by MPI_Allreduce for example. The
 * conventions are those of plait.h. docs/cluster.md, examples/09_cluster.c. */
#ifndef PLAIT_CLUSTER_H
#define PLAIT_CLUSTER_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Puts into `sums[i]`, for each of `count`, the sum of what all parts have there. Called on the thread
 * that makes the call: by plait_sim_set_reduce with the lengths of the part's strands and their number
 * (count 2), and by steps once in each fixed step, when the device has arrived there, with five sums a
 * voxel (5 edge_count^3): weight, momentum in three components and energy of its hair, in fixed point.
 * Sums of integers have the same bits in any order and for any number of parts. It calls nothing of
 * plait on the same context, and throws nothing. 0: go on; any other value ends the call. `sums` is
 * valid until it returns. */
typedef int (*plait_reduce_fn)(int64_t* sums, size_t count, void* user);

/* The sim has a part of a groom whose parts meet in the grid alone, from the next step on; NULL: all of
 * it, as at first. All parts have the same grid, bodies, step, params and calls. The grid has an `edge`
 * of its own, since a part does not know where the others are: wind and air_with_head go by that
 * cube, too. Guides then have the bits that they have in one sim of all strands with a `reduce` that
 * adds nothing; that sim differs in rounding from one without `reduce`. With follows' scatter, or a wind
 * whose `diameter` is the groom's mean, a part still goes by its own strands. Not part of a snapshot.
 * Waits.
 *
 * Where `reduce` ends a step, that fixed step is done but for its grid, those that the call had left
 * are not, and the others wait for this part: plait_sim_restore and plait_sim_reset go on from whole
 * steps. Sims of one plait_context_step are stepped one after another.
 * @errors CANCELLED (by `reduce`, here and in steps), INVALID_ARGUMENT (a grid of form SLOTS, in_world
 * or without `edge`), INVALID_STATE (volume, strand contact or a wind's shelter, which act between
 * strands, too, or levels); the calls that set these have the same errors meanwhile */
PLAIT_API plait_result plait_sim_set_reduce(plait_sim* sim, plait_reduce_fn reduce, void* user);

#ifdef __cplusplus
}
#endif

#endif
