/* Where a sim's time goes on the device: sums stage by stage, and every launch. Times are measured
 * where plait_context_desc.profile is 1. The conventions are those of plait.h.
 */
#ifndef PLAIT_PROFILE_H
#define PLAIT_PROFILE_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct plait_stage_time {
    char stage[32];
    uint64_t calls;
    double seconds; /* device time, all calls; 0 without profile */
} plait_stage_time;

/* Times since creation or the last call with `reset`: a list. Waits. */
PLAIT_API plait_result plait_sim_get_stage_times(plait_sim* sim, plait_stage_time* dst,
                                                 size_t* count, uint32_t reset);

/* Per sim; of more launches between two calls the newest are kept. */
#define PLAIT_LAUNCHES_KEPT 65536

/* One run of one stage on the device. Times in ns of the device's clock, whose origin is arbitrary;
 * all three are 0 where its driver reports none. */
typedef struct plait_launch {
    uint32_t struct_size;
    char stage[32];
    uint64_t items;
    uint64_t bytes;     /* that the stage has to move through memory at least */
    uint64_t queued_ns; /* the call that caused it enqueued it */
    uint64_t begin_ns;
    uint64_t end_ns;
} plait_launch;
PLAIT_STRUCT(plait_launch)

/* What has run for the sim since its creation or the last call, the oldest first: a list. What is
 * written to dst is removed. Waits. @errors INVALID_STATE (without profile) */
PLAIT_API plait_result plait_sim_take_launches(plait_sim* sim, plait_launch* dst, size_t* count);

#ifdef __cplusplus
}
#endif

#endif
