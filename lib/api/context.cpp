// Devices and contexts.
#include "api/context.hpp"

#include "api/objects.hpp"
#include "api/structs.hpp"
#include "core/sim/prepare.hpp"
#include "core/strands/length_classes.hpp"
#include "core/strands/traits.hpp"

#include <plait/params.h>

namespace plait::api {
namespace {

plait_context_desc default_desc() {
    plait_context_desc desc{};
    desc.struct_size = sizeof desc;
    return desc;
}

plait_prepare_desc default_prepare_desc() {
    plait_prepare_desc desc{};
    desc.struct_size = sizeof desc;
    desc.models = 1u << PLAIT_MODEL_ARTICULATED;
    return desc;
}

Status check_prepare(const plait_prepare_desc& desc) {
    const uint32_t models = (2u << last_model()) - 1, features = PLAIT_FEATURE_ALL;
    if (desc.models == 0 || desc.models & ~models)
        return invalid(format("desc->models is 0x%x, range is [1, 0x%x]", desc.models, models));
    if (desc.features & ~features)
        return invalid(
            format("desc->features is 0x%x, range is [0, 0x%x]", desc.features, features));
    if (desc.vertices_per_strand != 0 && (desc.vertices_per_strand < PLAIT_MIN_VERTICES ||
                                          desc.vertices_per_strand > PLAIT_MAX_VERTICES))
        return invalid(format("desc->vertices_per_strand is %u, range is [%d, %d], or 0",
                              desc.vertices_per_strand, PLAIT_MIN_VERTICES, PLAIT_MAX_VERTICES));
    return {};
}

Status prepare_for(Context& context, const plait_prepare_desc& desc) {
    constexpr uint32_t usual_row = 16;
    std::pmr::vector<uint32_t> counts(&context.memory);
    Preparation preparation{desc.models, desc.features, {}, desc.vertices_per_strand, 0, {}};
    if (desc.groom) {
        const Groom& groom = desc.groom->groom;
        counts = groom.strands.vertex_counts;
        preparation.strands = static_cast<uint32_t>(counts.size());
        preparation.row = std::max(preparation.row, groom.shape.max_vertices);
        if (groom.shape.bones > 0)
            preparation.features |= PLAIT_FEATURE_SKIN;
    } else {
        preparation.row = preparation.row > 0 ? preparation.row : usual_row;
        counts.push_back(preparation.row);
    }
    const LengthClasses classes(counts, &context.memory);
    preparation.rows = classes.rows();
    preparation.progress = [&](uint32_t done, uint32_t total, const char* stage) {
        return !desc.progress || desc.progress(done, total, stage, desc.progress_user) == 0;
    };
    return prepare(context, preparation);
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

void plait_prepare_desc_init(plait_prepare_desc* desc, size_t size) {
    api::init_struct(desc, size, api::default_prepare_desc());
}

plait_result plait_context_prepare(plait_context* context, const plait_prepare_desc* given) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        plait_prepare_desc desc = api::default_prepare_desc();
        if (given)
            PLAIT_TRY(api::read_struct(given, desc, "desc"));
        PLAIT_TRY(api::check_prepare(desc));
        return api::prepare_for(context->context, desc);
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
