// Interop with OpenCL: the caller's context and queue, plait's memory.
#include "api/context.hpp"
#include "api/objects.hpp"
#include "api/wall.hpp"

#include <plait/plait_opencl.h>

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
