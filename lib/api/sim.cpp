// Simulation: creating, steering and stepping.
#include "api/materials.hpp"
#include "api/roots.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "api/with_sim.hpp"
#include "core/params/params.hpp"

#include <utility>

namespace plait::api {
namespace {

// The parameters inside a descriptor cannot be longer than the room they have there.
Status read_desc(const plait_sim_desc* given, plait_sim_desc& desc) {
    desc = default_sim_desc();
    if (!given)
        return {};
    PLAIT_TRY(read_struct(given, desc, "desc"));
    const plait_sim_params inner = desc.params;
    if (inner.struct_size > sizeof inner)
        return invalid(format("desc->params.struct_size is %u, range is [4, %zu]",
                              inner.struct_size, sizeof inner));
    desc.params = default_sim_params();
    PLAIT_TRY(read_struct(&inner, desc.params, "desc->params"));
    return check_sim_desc(desc);
}

Status check_levels(const plait_sim_desc& desc, const Groom& groom) {
    if (!desc.levels && desc.level_top > 0)
        return invalid(format("desc->level_top is %u and levels is NULL", desc.level_top));
    if (!desc.levels)
        return {};
    if (desc.follow_map || desc.follows_per_guide > 0)
        return invalid(format("desc->levels is given with %s, give one",
                              desc.follow_map ? "follow_map" : "follows_per_guide"));
    if (desc.model == PLAIT_MODEL_TRESSFX)
        return invalid("desc->levels: strands of the model tressfx have no levels, those of "
                       "articulated do");
    const Levels& levels = desc.levels->levels;
    if (desc.level_top >= levels.guides().size())
        return invalid(format("desc->level_top is %u, range is [0, %zu]", desc.level_top,
                              levels.guides().size() - 1));
    if (levels.guides()[desc.level_top] == 0)
        return invalid(format("desc->level_top is %u, a level without guides: nothing would ever "
                              "be stepped",
                              desc.level_top));
    if (fingerprint(levels.groom()) != fingerprint(groom))
        return invalid("desc->levels are of another groom");
    return {};
}

// Those of guides, in their order, of values of each of a groom's strands; none stay none.
template <typename T>
void take_guides(const Levels& levels, uint32_t guides, std::pmr::vector<T>& values) {
    if (values.empty())
        return;
    std::pmr::vector<T> taken(values.get_allocator());
    for (const uint32_t strand : levels.order().first(guides))
        taken.push_back(values[strand]);
    values = std::move(taken);
}

// The sim's guides are those of its finest level, whose map it follows.
Result<SimParts> leveled_parts(Context& context, const plait_sim_desc& desc, const Levels& levels,
                               std::pmr::vector<float>& stiffness,
                               const StrandMaterialsPtr& materials) {
    std::pmr::memory_resource* const memory = &context.memory;
    Groom guides{StrandSet(memory), {}, {}};
    FollowMap map(memory);
    PLAIT_TRY(levels.take(desc.level_top, guides, map));
    const auto count = static_cast<uint32_t>(guides.shape.strands);
    take_guides(levels, count, stiffness);
    auto own = std::allocate_shared<StrandMaterials>(
        std::pmr::polymorphic_allocator<StrandMaterials>(memory), *materials);
    take_guides(levels, count, own->of);
    return make_sim_parts(context, guides, desc,
                          {stiffness, std::move(own), &map, &levels, desc.level_top});
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

void plait_sim_params_init(plait_sim_params* params, size_t size) {
    api::init_struct(params, size, default_sim_params());
}

void plait_sim_desc_init(plait_sim_desc* desc, size_t size) {
    api::init_struct(desc, size, default_sim_desc());
}

void plait_roots_init(plait_roots* roots, size_t size) {
    api::init_struct(roots, size, api::default_roots());
}

plait_result plait_sim_create(plait_context* context, const plait_groom* groom,
                              const plait_sim_desc* desc, plait_sim** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        PLAIT_TRY(api::need(groom, "groom"));
        PLAIT_TRY(api::need(out, "out"));
        plait_sim_desc given;
        PLAIT_TRY(api::read_desc(desc, given));
        PLAIT_TRY(api::check_levels(given, groom->groom));
        std::pmr::vector<float> stiffness(&context->context.memory);
        PLAIT_TRY(api::copy_view(given.strand_stiffness, 1, "desc->strand_stiffness", stiffness));
        PLAIT_TRY(check_strand_stiffness(stiffness, groom->groom.shape.strands));
        auto materials =
            api::read_materials(given.materials, given.material_count, given.strand_material,
                                groom->groom.shape.strands, &context->context.memory);
        if (!materials)
            return materials.error();
        const FollowMap* const follows = given.follow_map ? &given.follow_map->map : nullptr;
        given.strand_stiffness = given.strand_material = {}; // the caller's
        given.materials = nullptr;
        given.follow_map = nullptr;
        const plait_levels* const levels = std::exchange(given.levels, nullptr);
        auto parts = levels ? api::leveled_parts(context->context, given, levels->levels, stiffness,
                                                 *materials)
                            : make_sim_parts(context->context, groom->groom, given,
                                             {stiffness, *materials, follows});
        if (!parts)
            return parts.error();
        auto handle = make_in<plait_sim>(&context->context.memory, *context, std::move(*parts));
        PLAIT_TRY(handle->sim.start());
        *out = handle.release();
        return {};
    });
}

void plait_sim_destroy(plait_sim* sim) {
    plait_context* const owner = sim ? &sim->owner : nullptr;
    api::destroy(sim);
    api::destroy_unused(owner);
}

void plait_sim_info_init(plait_sim_info* info, size_t size) {
    plait_sim_info empty{};
    empty.worst_stiffening = empty.scale = 1;
    api::init_struct(info, size, empty);
}

plait_result plait_sim_describe(const plait_sim* sim, plait_sim_info* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::check_output(out, "out"));
        api::write_struct(out, sim->sim.describe());
        return {};
    });
}

plait_result plait_sim_reset(plait_sim* sim) {
    return api::with_sim(__func__, sim, [](Sim& s) { return s.reset(); });
}

plait_result plait_sim_set_params(plait_sim* sim, const plait_sim_params* params) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        Params next = s.params();
        plait_sim_params& given = next;
        given = default_sim_params();
        PLAIT_TRY(api::read_struct(params, given, "params"));
        PLAIT_TRY(check_params(next));
        return s.set_params(next);
    });
}

plait_result plait_sim_get_params(const plait_sim* sim, plait_sim_params* params) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::check_output(params, "params"));
        api::write_struct(params, static_cast<const plait_sim_params&>(sim->sim.params()));
        return {};
    });
}

plait_result plait_sim_bind_roots(plait_sim* sim, const plait_mesh* mesh, plait_root_place* dst,
                                  size_t count) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        const size_t guides = s.guides();
        if (mesh && dst && count < guides)
            return api::invalid(format("count is %zu, the sim has %zu guides", count, guides));
        return s.bind_roots(mesh ? &mesh->mesh : nullptr, {dst, mesh && dst ? guides : 0});
    });
}

plait_result plait_sim_set_roots(plait_sim* sim, const plait_roots* roots) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        api::RootsCopy copy(&s.context().memory);
        PLAIT_TRY(api::read_roots(roots, copy));
        return s.set_roots(copy.input());
    });
}

plait_result plait_sim_teleport(plait_sim* sim, const plait_roots* roots) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        api::RootsCopy copy(&s.context().memory);
        PLAIT_TRY(api::read_roots(roots, copy));
        return s.teleport(copy.input());
    });
}

plait_result plait_sim_step(plait_sim* sim, double dt) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        const auto time = api::checked_dt(dt);
        if (!time)
            return time.error();
        PLAIT_TRY(s.step(*time));
        return s.ask_for_probes();
    });
}

plait_result plait_sim_wait(plait_sim* sim) {
    return api::with_sim(__func__, sim, [](Sim& s) { return s.wait(); });
}
}
