// Devices and contexts.
#include "api/context.hpp"

#include "api/objects.hpp"
#include "api/structs.hpp"
#include "core/params.hpp"
#include "core/prepare.hpp"

#include <plait/params.h>

namespace plait::api {
namespace {

plait_context_desc default_desc() {
    plait_context_desc desc{};
    desc.struct_size = sizeof desc;
    return desc;
}

Status check_sources(const plait_context_desc& desc) {
    if (desc.stage_source_count > 0 && !desc.stage_sources)
        return invalid(format("desc->stage_sources is NULL, stage_source_count is %zu",
                              desc.stage_source_count));
    for (size_t i = 0; i < desc.stage_source_count; ++i)
        if (!desc.stage_sources[i].stage || !desc.stage_sources[i].source)
            return invalid(format("desc->stage_sources[%zu].%s is NULL", i,
                                  desc.stage_sources[i].stage ? "source" : "stage"));
    return {};
}

} // namespace

Result<ContextRules> context_rules(const plait_context_desc* given) {
    plait_context_desc desc = default_desc();
    if (given)
        PLAIT_TRY(read_struct(given, desc, "desc"));
    PLAIT_TRY(check_allocator(desc.allocator, "desc->allocator"));
    if (desc.profile > 1)
        return invalid(format("desc->profile is %u, range is [0, 1]", desc.profile));
    if (desc.lanes != 0 && desc.lanes != 1 && desc.lanes != 4 && desc.lanes != 8 &&
        desc.lanes != 16) // else the best device would be passed over for it
        return invalid(
            format("desc->lanes is %u; it is 1, 4, 8, 16 or 0, the device's", desc.lanes));
    PLAIT_TRY(check_sources(desc));
    ContextRules rules;
    rules.backend = desc.backend;
    rules.device = desc.device;
    rules.log = {desc.log, desc.log_user};
    rules.allocator = desc.allocator;
    rules.profile = desc.profile != 0;
    rules.stage_sources = desc.stage_sources;
    rules.stage_source_count = desc.stage_source_count;
    rules.lanes = desc.lanes;
    rules.program_folder = desc.program_folder;
    return rules;
}

Result<plait_context*> make_context(const ContextRules& rules) {
    auto device = open_device(rules);
    if (!device)
        return device.error();
    const auto info = device->describe();
    if (!info)
        return info.error();
    Memory memory(rules.allocator);
    return make_in<plait_context>(&memory, rules, std::move(*device), *info).release();
}

} // namespace plait::api

using namespace plait;

extern "C" {

void plait_device_info_init(plait_device_info* info, size_t size) {
    api::init_struct(info, size, plait_device_info{});
}

plait_result plait_devices_list(plait_device_info* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(count, "count"));
        const auto candidates = list_candidates({});
        if (!dst) {
            *count = candidates.size();
            return {};
        }
        const size_t number = std::min(*count, candidates.size());
        PLAIT_TRY(
            api::write_structs(dst, number, "dst", [&](size_t i) { return candidates[i].info; }));
        *count = number;
        return {};
    });
}

void plait_context_desc_init(plait_context_desc* desc, size_t size) {
    api::init_struct(desc, size, api::default_desc());
}

plait_result plait_context_create(const plait_context_desc* desc, plait_context** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(out, "out"));
        const auto rules = api::context_rules(desc);
        if (!rules)
            return rules.error();
        const auto context = api::make_context(*rules);
        if (!context)
            return context.error();
        *out = *context;
        return {};
    });
}

void plait_context_destroy(plait_context* context) {
    if (context)
        --context->users;
    api::destroy_unused(context);
}

plait_result plait_context_prepare(plait_context* context, const plait_model* models, size_t count,
                                   uint32_t vertices_per_strand) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        PLAIT_TRY(api::need(models, "models"));
        for (size_t i = 0; i < count; ++i)
            PLAIT_TRY(check_model(models[i], i));
        if (vertices_per_strand < PLAIT_MIN_VERTICES || vertices_per_strand > PLAIT_MAX_VERTICES)
            return api::invalid(format("vertices_per_strand is %u, range is [%d, %d]",
                                       vertices_per_strand, PLAIT_MIN_VERTICES,
                                       PLAIT_MAX_VERTICES));
        return prepare_models(context->context, {models, count}, vertices_per_strand);
    });
}

plait_result plait_context_describe(const plait_context* context, plait_device_info* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        PLAIT_TRY(api::check_output(out, "out"));
        api::write_struct(out, context->context.info);
        return {};
    });
}
}
