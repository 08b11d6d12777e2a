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

Status check_lent(plait_field field) {
    if (field != PLAIT_FIELD_VELOCITY && field != PLAIT_FIELD_POSITION_PREV)
        return {};
    return invalid(format("field is %d; lent are POSITION, TANGENT, REST, VERTEX_COUNT, "
                          "GRID_DENSITY, GRID_VELOCITY and FOLLOW_GUIDE",
                          field));
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
        PLAIT_TRY(api::check_lent(field));
        const auto buffer = sim->sim.field_buffer(field);
        if (!buffer)
            return buffer.error();
        *out = static_cast<cl_mem>(sim->sim.context().device.native_buffer(**buffer));
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
