/* Interop with OpenCL: adopt the caller's context and queue, borrow a field's cl_mem, take vertices of
 * meshes from a cl_mem of the caller's.
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

/* Places in a buffer of the caller's, float[3], m, each [-1e6, 1e6]: `count` of them, `stride` bytes
 * apart (0: 12, tightly packed; 16 of float4, whose w is not read; more where a vertex has other
 * things, too), the first at byte `offset`. Both are multiples of 4, the stride in [12, 4096]. */
typedef struct plait_opencl_positions {
    cl_mem buffer; /* of the cl_context of the context's queue */
    size_t count;
    size_t offset;
    size_t stride;
} plait_opencl_positions;

/* plait_collider_set_positions from the device, for vertices that a kernel of the caller's places:
 * with the same places, to the same bits. Enqueues a copy on the context's queue and does not wait: what
 * was enqueued there before is in it, and from the return on commands enqueued there may write the
 * buffer again, or it may be released. Who fills it on another queue enqueues a barrier on this one
 * that waits for it before (clEnqueueBarrierWithWaitList). Nothing comes to the host, so that values
 * are not checked there: a vertex with a component that is not finite or outside its range stays
 * where it is, and a mesh that is mirrored is not noticed.
 * @errors UNSUPPORTED (not an OpenCL context; the backend lacks a stage), NOT_FOUND, INVALID_STATE
 * (no mesh, or of form FIELD), INVALID_ARGUMENT (count, stride or offset; a buffer that is too small,
 * or of another cl_context). A call that fails changes nothing. */
PLAIT_API plait_result plait_opencl_collider_set_positions(plait_sim* sim,
                                                           plait_collider_id collider,
                                                           const plait_opencl_positions* positions);

/* plait_sim_set_roots with mesh_positions from the device, in the same way; `head` NULL: the
 * identity. The scale is that of the last call that gave one. @errors as above, but for colliders; INVALID_ARGUMENT (roots that are bound to no mesh) */
PLAIT_API plait_result plait_opencl_sim_set_roots(plait_sim* sim, const plait_pose* head,
                                                  const plait_opencl_positions* positions);

/* The queue plait enqueues on, borrowed. @errors UNSUPPORTED (not an OpenCL context) */
PLAIT_API plait_result plait_opencl_context_get_queue(plait_context* context,
                                                      cl_command_queue* out);

#ifdef __cplusplus
}
#endif

#endif
