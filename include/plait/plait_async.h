/* Reading without waiting. plait_sim_step hands work to the device and returns; plait_sim_read waits for
 * all of it. Here the copy is put behind the work, and a fence says when it is there: a game draws the
 * hair of the frame before while the device works on this one. The conventions are those of plait.h.
 *
 * A fence is a number behind the work that its context has been given so far. Later ones are larger
 * and are reached later. Where a backend has no such functions (reference, whose steps are done when
 * the call returns), reads are done at once and every fence is reached.
 */
#ifndef PLAIT_ASYNC_H
#define PLAIT_ASYNC_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

/* As plait_sim_read, but dst is filled once `fence` is reached: till then it must stay there, and is
 * neither read nor written. `size`: bytes, as plait_sim_read gives them. Any field but VELOCITY and
 * POSITION_PREV, which the host computes. Destroying the sim waits for reads under way.
 * @errors INVALID_STATE (as plait_sim_read), INVALID_ARGUMENT (VELOCITY, POSITION_PREV) */
PLAIT_API plait_result plait_sim_read_later(plait_sim* sim, plait_field field, void* dst,
                                            size_t size, uint64_t* fence);

/* Behind all work so far, of this sim and of others of its context. */
PLAIT_API plait_result plait_sim_fence(plait_sim* sim, uint64_t* fence);

/* `reached` is 1, or 0 while work before the fence is not done. Never waits.
 * @errors as plait_sim_wait, of work before it */
PLAIT_API plait_result plait_sim_fence_reached(plait_sim* sim, uint64_t fence, uint32_t* reached);

/* Waits for the work before the fence, not for what came after. */
PLAIT_API plait_result plait_sim_fence_wait(plait_sim* sim, uint64_t fence);

#ifdef __cplusplus
}
#endif

#endif
