// Interop with OpenCL: the caller's context and queue, plait's memory.
#include "api/context.hpp"
#include "api/objects.hpp"
#include "api/wall.hpp"

#include <plait/plait_opencl.h>

#include <cstdint>
#include <cstring>

namespace plait::api {
namespace {

constexpr char backend_name[] = "opencl";

Status check_opencl(const Context& context) {
    if (std::strcmp(context.info.backend, backend_name) == 0)
        return {};
    return Error{PLAIT_UNSUPPORTED,
                 format("the context runs on backend \"%s\", which has no OpenCL "
                        "objects",
                        context.info.backend)};
}

// `bounds`: in a buffer only when they are asked for.
Status check_lent(plait_field field, bool bounds) {
    if (field != PLAIT_FIELD_VELOCITY && field != PLAIT_FIELD_POSITION_PREV &&
        field != PLAIT_FIELD_WETNESS && (bounds || field != PLAIT_FIELD_BOUNDS))
        return {};
    return invalid(format(
        "field is %d; there are POSITION, TANGENT, REST, VERTEX_COUNT, "
        "GRID_DENSITY, GRID_VELOCITY, FOLLOW_GUIDE, POSITION_LAST_FRAME, ACCELERATION%s PIN%s",
        field, bounds ? "," : " and", bounds ? " and BOUNDS" : ""));
}

constexpr size_t least_stride = 12, most_stride = 4096;

// What of the caller's buffer is read: bytes from `offset` on.
struct Placed {
    size_t bytes, words; // words: from one place to the next
};

template <typename T> Result<T> info_of(cl_mem buffer, cl_mem_info what) {
    T value{};
    if (const cl_int code = clGetMemObjectInfo(buffer, what, sizeof value, &value, nullptr))
        return invalid(format("positions->buffer is no buffer (OpenCL error %d)", code));
    return value;
}

Status check_context(Context& context, cl_mem buffer) {
    const auto of = info_of<cl_context>(buffer, CL_MEM_CONTEXT);
    if (!of)
        return of.error();
    cl_context own = nullptr;
    const auto queue = static_cast<cl_command_queue>(context.device.native_queue());
    if (const cl_int code =
            clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof own, &own, nullptr))
        return Error{PLAIT_BACKEND, format("the queue has no context: OpenCL error %d", code)};
    if (*of != own)
        return invalid("positions->buffer is of another cl_context than plait's queue");
    return {};
}

Result<Placed> check_placed(Context& context, const plait_opencl_positions& p) {
    const size_t stride = p.stride == 0 ? least_stride : p.stride;
    if (stride < least_stride || stride > most_stride || stride % 4 != 0)
        return invalid(format("positions->stride is %zu bytes, allowed are 0 and the multiples of "
                              "4 in [%zu, %zu]",
                              p.stride, least_stride, most_stride));
    if (p.offset % 4 != 0)
        return invalid(format("positions->offset is %zu bytes, no multiple of 4", p.offset));
    if (p.count == 0 || p.count > UINT32_MAX)
        return invalid(format("positions->count is %zu, range is [1, %u]", p.count, UINT32_MAX));
    PLAIT_TRY(need(p.buffer, "positions->buffer"));
    const auto size = info_of<size_t>(p.buffer, CL_MEM_SIZE);
    if (!size)
        return size.error();
    PLAIT_TRY(check_context(context, p.buffer));
    const size_t bytes = (p.count - 1) * stride + least_stride;
    if (p.offset > *size || bytes > *size - p.offset)
        return invalid(format("positions->buffer has %zu bytes; %zu places, %zu bytes apart, take "
                              "%zu from byte %zu on",
                              *size, p.count, stride, bytes, p.offset));
    return Placed{bytes, stride / 4};
}

// Into `to`, which is plait's.
Status copy_placed(Context& context, const plait_opencl_positions& p, const Placed& placed,
                   const Buffer& to) {
    const auto queue = static_cast<cl_command_queue>(context.device.native_queue());
    const auto into = static_cast<cl_mem>(context.device.native_buffer(to));
    if (const cl_int code = clEnqueueCopyBuffer(queue, p.buffer, into, p.offset, 0, placed.bytes, 0,
                                                nullptr, nullptr))
        return invalid(format("positions->buffer takes no copy: OpenCL error %d", code));
    return {};
}

Status check_room(cl_mem to, size_t offset, size_t bytes) {
    size_t size = 0;
    if (const cl_int code = clGetMemObjectInfo(to, CL_MEM_SIZE, sizeof size, &size, nullptr))
        return invalid(format("to is no buffer (OpenCL error %d)", code));
    if (offset <= size && bytes <= size - offset)
        return {};
    return invalid(format("to has %zu bytes; the field's %zu from byte %zu on do not fit", size,
                          bytes, offset));
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

plait_result plait_opencl_context_create(const plait_opencl_handles* handles,
                                         const plait_context_desc* desc, plait_context** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(handles, "handles"));
        PLAIT_TRY(api::need(out, "out"));
        auto rules = api::context_rules(desc);
        if (!rules)
            return rules.error();
        rules->backend = api::backend_name;
        rules->device = nullptr;
        rules->native = handles;
        const auto context = api::make_context(*rules);
        if (!context)
            return context.error();
        *out = *context;
        return {};
    });
}

plait_result plait_opencl_sim_get_field(plait_sim* sim, plait_field field, cl_mem* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(out, "out"));
        PLAIT_TRY(api::check_opencl(sim->sim.context()));
        PLAIT_TRY(api::check_lent(field, false));
        const auto buffer = sim->sim.field_buffer(field);
        if (!buffer)
            return buffer.error();
        *out = static_cast<cl_mem>(sim->sim.context().device.native_buffer(**buffer));
        return {};
    });
}

plait_result plait_opencl_sim_copy_field(plait_sim* sim, plait_field field, cl_mem to,
                                         size_t offset) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(to, "to"));
        Context& context = sim->sim.context();
        PLAIT_TRY(api::check_opencl(context));
        PLAIT_TRY(api::check_lent(field, true));
        const auto bytes = sim->sim.field_bytes(field);
        if (!bytes)
            return bytes.error();
        PLAIT_TRY(api::check_room(to, offset, *bytes));
        const auto buffer = sim->sim.filled_field(field);
        if (!buffer)
            return buffer.error();
        const auto queue = static_cast<cl_command_queue>(context.device.native_queue());
        const auto from = static_cast<cl_mem>(context.device.native_buffer(**buffer));
        if (const cl_int code =
                clEnqueueCopyBuffer(queue, from, to, 0, offset, *bytes, 0, nullptr, nullptr))
            return api::invalid(
                format("to takes no copy: OpenCL error %d; it has to be of the context "
                       "of plait's queue, and written by the device",
                       code));
        clFlush(queue);
        return {};
    });
}

plait_result plait_opencl_collider_set_positions(plait_sim* sim, plait_collider_id collider,
                                                 const plait_opencl_positions* positions) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(positions, "positions"));
        Context& context = sim->sim.context();
        PLAIT_TRY(api::check_opencl(context));
        const auto placed = api::check_placed(context, *positions);
        if (!placed)
            return placed.error();
        const auto room = sim->sim.room_for_positions(collider, positions->count, placed->words);
        if (!room)
            return room.error();
        PLAIT_TRY(api::copy_placed(context, *positions, *placed, **room));
        return sim->sim.take_positions(collider, static_cast<uint32_t>(placed->words));
    });
}

plait_result plait_opencl_sim_set_roots(plait_sim* sim, const plait_pose* head,
                                        const plait_opencl_positions* positions) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(positions, "positions"));
        const auto pose = checked_pose(head ? *head : identity_pose, "head");
        if (!pose)
            return pose.error();
        Context& context = sim->sim.context();
        PLAIT_TRY(api::check_opencl(context));
        const auto placed = api::check_placed(context, *positions);
        if (!placed)
            return placed.error();
        const auto room = sim->sim.room_for_root_positions(positions->count, placed->words);
        if (!room)
            return room.error();
        PLAIT_TRY(api::copy_placed(context, *positions, *placed, **room));
        return sim->sim.take_root_positions(*pose, static_cast<uint32_t>(placed->words));
    });
}

plait_result plait_opencl_context_get_queue(plait_context* context, cl_command_queue* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        PLAIT_TRY(api::need(out, "out"));
        PLAIT_TRY(api::check_opencl(context->context));
        *out = static_cast<cl_command_queue>(context->context.device.native_queue());
        return {};
    });
}
}
