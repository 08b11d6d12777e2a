/* Interop with OpenCL: adopt the caller's context and queue, borrow a field's cl_mem.
 *
 * What includes this file needs OpenCL's headers and, for the caller's own calls, links OpenCL
 * (CMake: OpenCL::OpenCL; pkg-config: OpenCL) beside plait. What includes plait.h alone does not.
 */
#ifndef PLAIT_OPENCL_H
#define PLAIT_OPENCL_H

#include <plait/plait.h>

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#ifdef __APPLE__
#include <OpenCL/cl.h>
#else
#include <CL/cl.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What plait_open_info.native points to for the backend `opencl`. */
typedef struct plait_opencl_handles {
    cl_context context;
    cl_device_id device;
    cl_command_queue queue; /* in-order */
} plait_opencl_handles;

/* A plait context on the caller's queue. The handles are retained until the context is destroyed.
 * Work is enqueued on `queue` in order, so commands the caller enqueues there see it finished.
 * `desc` as in plait_context_create; its backend and device are ignored.
 * @errors INVALID_ARGUMENT (an out-of-order queue, handles that do not belong together), COMPILE */
PLAIT_API plait_result plait_opencl_context_create(const plait_opencl_handles* handles,
                                                   const plait_context_desc* desc,
                                                   plait_context** out);

/* The buffer behind POSITION, TANGENT, REST, VERTEX_COUNT, GRID_DENSITY, GRID_VELOCITY,
 * FOLLOW_GUIDE, POSITION_LAST_FRAME or ACCELERATION, borrowed: valid until the sim is destroyed or
 * its grid is resized; read it on the context's queue, where ACCELERATION may also be written.
 * @errors UNSUPPORTED (not an OpenCL context), INVALID_STATE (the field is off) */
PLAIT_API plait_result plait_opencl_sim_get_field(plait_sim* sim, plait_field field, cl_mem* out);

/* Copies one of these fields, or BOUNDS, into the caller's buffer (of the queue's cl_context, with
 * room for the bytes that plait_sim_read tells) from byte `offset` on; enqueued on the context's
 * queue, so that it does not wait and later commands there find it done.
 * @errors UNSUPPORTED (not an OpenCL context), INVALID_STATE (the field is off) */
PLAIT_API plait_result plait_opencl_sim_copy_field(plait_sim* sim, plait_field field, cl_mem to,
                                                   size_t offset);

/* The queue plait enqueues on, borrowed. @errors UNSUPPORTED (not an OpenCL context) */
PLAIT_API plait_result plait_opencl_context_get_queue(plait_context* context,
                                                      cl_command_queue* out);

#ifdef __cplusplus
}
#endif

#endif
