// From a snapshot back to a sim. Everything is checked before anything changes.
#include "core/snapshot/snapshot_format.hpp"

#include "base/format.hpp"
#include "core/params/params.hpp"

#include <algorithm>
#include <cmath>

namespace plait {

using namespace snapshots;

namespace {

constexpr float most_potential = 1e30f;

// Those of the sim, but for what decides whether strands had a history when they were saved.
Params params_then(const Params& now, const SavedSim& saved) {
    Params params = now;
    params.bdf2 = saved.bdf2;
    params.strand_contact.on = saved.strand_contact != 0;
    return params;
}

// The model has as many strands as a snapshot is of; after it, as many as the sim's level steps.
struct Stepped {
    Stepped(Model& of, const SimLevels* its, uint32_t level) : model(of), levels(its) {
        if (levels)
            model.step_first(levels->stepped_of(level));
    }
    Stepped(const Stepped&) = delete;
    Stepped& operator=(const Stepped&) = delete;
    ~Stepped() { take(); }
    void take() const {
        if (levels)
            model.step_first(levels->stepped());
    }
    Model& model;
    const SimLevels* levels;
};

} // namespace

// The runs of a snapshot whose strands may have other settings than the sim's have now, and a history
// where these have none or the other way round: those of the lanes come part by part; first those that
// every model has, x, v, q and q before, then BDF2's x and v where the part steps by it.
std::pmr::vector<Sim::Run> Sim::saved_runs(const Saved& now, std::span<const Settings> strands) {
    const auto list = list_runs(now);
    const auto is_lane = [](const Run& run) {
        return run.lanes.buffer != nullptr && run.of != Run::Of::pushes;
    };
    auto own = std::ranges::find_if(list, is_lane); // of the part, where there are such parts now
    const auto last = std::find_if_not(own, list.end(), is_lane);
    std::pmr::vector<Run> saved(list.begin(), own, &context_.memory);
    std::pmr::vector<PartShape> parts(&context_.memory);
    model_->list_parts(strands, parts);
    const bool same_parts = std::ranges::equal(strands, settings());
    const Params then = params_then(params_, now.sim);
    for (const PartShape& part : parts) {
        const std::ptrdiff_t had = part.settings.bdf2_of(then) ? 6 : 4;
        const std::ptrdiff_t has = part.settings.bdf2_of(params_) ? 6 : 4;
        for (std::ptrdiff_t i = 0; i < had; ++i) {
            saved.push_back(own[same_parts && has == had ? i : i % 4]);
            saved.back().floats = size_t{part.strands} * part.row * saved.back().lanes.components;
            saved.back().taken = same_parts && i < has;
        }
        own += same_parts ? has : 0;
    }
    saved.insert(saved.end(), last, list.end());
    return saved;
}

// The settings of every strand, as their block says; the sim's own where there is none.
Result<SettingsList> Sim::saved_settings(std::span<const unsigned char> from) const {
    SettingsList list(layout_.guides, own_settings(), &context_.memory);
    if (!from.data())
        return list;
    if (from.size() != list.size() * sizeof(SavedSettings))
        return malformed(format("the block settings has %zu bytes, %zu guides take %zu",
                                from.size(), list.size(), list.size() * sizeof(SavedSettings)));
    for (size_t i = 0; i < list.size(); ++i) {
        SavedSettings saved;
        std::memcpy(&saved, from.data() + i * sizeof saved, sizeof saved);
        plait_strand_settings settings = default_strand_settings();
        settings.substeps = saved.substeps;
        settings.iterations = saved.iterations;
        settings.bdf2 = saved.bdf2;
        if (const auto status = check_strand_settings(settings); !status)
            return malformed(format("strand %zu: %s", i, status.error().message.c_str()));
        list[i] = make_settings(settings, desc_.substeps);
    }
    return list;
}

// A snapshot is of the same groom, model and step; parameters and the rest may differ.
Status Sim::check_fits(const Saved& from) const {
    const SavedSim& sim = from.sim;
    if (sim.guides != layout_.guides || sim.row != layout_.row)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the snapshot is of %u guides of %u vertices, the sim has %u of %u",
                            sim.guides, sim.row, layout_.guides, layout_.row)};
    if (sim.groom != groom_)
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("the snapshot is of another groom: its fingerprint is 0x%016llx, that of "
                   "the sim's 0x%016llx",
                   static_cast<unsigned long long>(sim.groom),
                   static_cast<unsigned long long>(groom_))};
    if (sim.model != static_cast<uint32_t>(desc_.model))
        return Error{PLAIT_INVALID_ARGUMENT, format("the snapshot is of model %u, the sim's is %d",
                                                    sim.model, desc_.model)};
    if (from.is(BlockKind::settings) && desc_.model == PLAIT_MODEL_TRESSFX)
        return malformed("it has a block settings, strands of model 0 have none");
    if (sim.step != desc_.step || sim.substeps != desc_.substeps)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the snapshot has steps of %g s in %u substeps, the sim %g s in %u",
                            double(sim.step), sim.substeps, double(desc_.step), desc_.substeps)};
    return {};
}

Status Sim::check_levels(const Saved& from) const {
    if (from.is(BlockKind::levels) != bool(levels_))
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the snapshot is of a sim with%s levels, this one has %s",
                            levels_ ? "out" : "", levels_ ? "some" : "none")};
    return levels_ ? levels_->check(from.levels) : Status{};
}

// What a kernel can take: positions and velocities at hand, turns that are turns, masses as they
// are.
Status Sim::check_run(const Run& run, const unsigned char* from, float scale) const {
    const char* name = run.buffer->name();
    const bool poses = run.of == Run::Of::poses, turns = run.of == Run::Of::turns;
    if (run.of == Run::Of::pressures) {
        for (size_t i = 0; i < run.floats; ++i)
            if (const float value = float_at(from, i); !(std::abs(value) <= most_potential))
                return outside("volume_potential", i, double(value), "[-1e30, 1e30]");
        return {};
    }
    if (run.of == Run::Of::wetness) {
        for (size_t i = 0; i < run.floats; ++i)
            if (const float value = float_at(from, i); !(value >= 0 && value <= 1))
                return outside("wetness", i, double(value), "[0, 1]");
        return {};
    }
    for (size_t i = 0; i < run.floats; i += 4) {
        if (turns || (poses && i % 8 == 0)) {
            PLAIT_TRY(check_turn(from, i, name, run.lanes.blended));
            continue;
        }
        for (size_t k = i; k < std::min(i + 4, run.floats); ++k)
            PLAIT_TRY(check_range(from, k, name, scale));
        const auto vertex = static_cast<uint32_t>(i / 4 % layout_.row);
        const float mass = vertex < model_->pinned_vertices() ? 0.0f : 1.0f;
        if (run.of == Run::Of::vertices && float_at(from, i + 3) != mass)
            return outside(name, i + 3, double(float_at(from, i + 3)),
                           "the vertex' inverse mass, 0 at what the root holds, else 1");
    }
    return {};
}

// All runs of all blocks, and that nothing is left of any.
Status Sim::check_runs(std::span<const Run> list, const BlockBytes& from, float scale) const {
    BlockBytes left = from;
    for (const Run& run : list) {
        auto& bytes = left[static_cast<size_t>(run.kind)];
        if (bytes.size() / sizeof(float) < run.floats)
            return malformed(format("the block %s ends before its %zu numbers of %s",
                                    name_of(run.kind), run.floats, run.buffer->name()));
        PLAIT_TRY(check_run(run, bytes.data(), scale));
        bytes = bytes.subspan(run.floats * sizeof(float));
    }
    for (size_t i = 0; i < block_kinds; ++i)
        if (!left[i].empty())
            return malformed(format("the block %s has %zu bytes more than it needs",
                                    name_of(static_cast<BlockKind>(i)), left[i].size()));
    return {};
}

// Leaves the buffers of roots' own poses to be filled from the snapshot.
Status Sim::restore_roots(const SavedRoots& saved) {
    if (std::ranges::any_of(saved.own, [](uint32_t own) { return own != 0; }))
        PLAIT_TRY(roots_.make_buffers(device()));
    const auto all = roots_.all_poses();
    for (size_t i = 0; i < all.size(); ++i) {
        all[i]->head = saved.heads[i];
        all[i]->own = saved.own[i] != 0;
        all[i]->given = 0;
    }
    roots_.aimed = saved.aimed != 0;
    roots_.restore_samples(saved.bends);
    motion_.restore(saved.motion);
    return roots_.clear_buffers(device());
}

Status Sim::restore_run(const Run& run, const unsigned char* from) {
    if (!run.lanes.buffer)
        return device().write(*run.buffer, 0,
                              run.floats * sizeof(float) / run.buffer->element_size(), from);
    std::pmr::vector<float> tiled(run.buffer->count(), &context_.memory);
    PLAIT_TRY(device().read(*run.buffer, tiled.data()));
    for_each_lane_element(run.lanes.layout, run.lanes.components, [&](size_t lane, size_t plain) {
        std::memcpy(&tiled[lane], from + plain * sizeof(float), sizeof(float));
    });
    return device().write(*run.buffer, tiled.data());
}

Status Sim::restore_runs(std::span<const Run> list, BlockBytes from) {
    for (const Run& run : list) {
        auto& bytes = from[static_cast<size_t>(run.kind)];
        const bool fits = run.of != Run::Of::pressures || run.buffer->count() == run.floats;
        if (run.taken && *run.buffer && fits) // this sim may do without
            PLAIT_TRY(restore_run(run, bytes.data()));
        bytes = bytes.subspan(run.floats * sizeof(float));
    }
    return {};
}

Status Sim::restore(std::span<const unsigned char> src) {
    stir();
    auto blocks = split(src);
    if (!blocks)
        return blocks.error();
    const auto saved = take_saved(*blocks);
    if (!saved)
        return saved.error();
    PLAIT_TRY(check_fits(*saved));
    const float scale = saved->sim.scale;
    auto& bodies = (*blocks)[static_cast<size_t>(BlockKind::bodies)];
    const auto slots = saved_slots(bodies, scale, &context_.memory);
    if (!slots)
        return slots.error();
    auto faces = saved_faces(*slots, bodies, &context_.memory);
    if (!faces)
        return faces.error();
    auto meshes = saved_meshes(*slots, layout_.guide_vertices(), bodies, &context_.memory);
    if (!meshes)
        return meshes.error();
    auto bending = saved_bending(*slots, layout_.guide_vertices(), bodies, &context_.memory);
    if (!bending)
        return bending.error();
    if ((!meshes->empty() || !bending->empty()) && desc_.model == PLAIT_MODEL_TRESSFX)
        return malformed("colliders are meshes, which strands of model 0 do not meet");
    if (sharer_ != this && !are_bodies(*slots, *faces, *meshes, *bending))
        return Error{PLAIT_INVALID_STATE,
                     "the snapshot has other colliders than the sim, which shares its: "
                     "plait_sim_share_colliders with NULL ends that"};
    auto& own = (*blocks)[static_cast<size_t>(BlockKind::settings)];
    const auto strands = saved_settings(own);
    if (!strands)
        return strands.error();
    own = {};
    PLAIT_TRY(check_levels(*saved));
    const Stepped stepped{*model_, levels_.get(), saved->levels.level};
    PLAIT_TRY(check_runs(saved_runs(*saved, *strands), *blocks, scale));
    if (*strands != settings())
        PLAIT_TRY(set_settings(*strands));
    const bool wet = saved->is(BlockKind::wetness) && params_.wetness.on; // it may do without
    if (!wet)
        close_wetness();
    else if (!state_.wetness)
        PLAIT_TRY(open_wetness());
    if (saved->is(BlockKind::pins))
        PLAIT_TRY(open_pins());
    PLAIT_TRY(open_scale(scale));
    schedule_.clear();
    const bool kept = saved->is(BlockKind::output);
    if (kept && desc_.interpolate_output == 2 && !display_.interpolates()) {
        PLAIT_TRY(display_.interpolate(device(), schedule_, layout_, state_));
        PLAIT_TRY(submit());
    }
    if (levels_)
        levels_->restore(saved->levels);
    stepped.take();
    const auto list = saved_runs(*saved, *strands);
    PLAIT_TRY(take_meshes(std::move(*meshes), std::move(*bending)));
    PLAIT_TRY(colliders_.assign(device(), *slots, std::move(*faces), scale));
    scale_ = display_.scale = scale;
    bending_.rescale(scale);
    PLAIT_TRY(restore_roots(saved->roots));
    frame_.restore(saved->frame);
    if (!saved->is(BlockKind::pins))
        PLAIT_TRY(clear_pins(device(), layout_, state_, &context_.memory));
    if (!saved->is(BlockKind::contact))
        PLAIT_TRY(model_->clear_normal_force(device()));
    PLAIT_TRY(restore_runs(list, *blocks));
    PLAIT_TRY(model_->begin_history(device(), params_then(params_, saved->sim)));
    if (wet)
        PLAIT_TRY(wetness_.resume(device(), state_, saved->wetness.dried, &context_.memory));
    clock_.waiting = saved->sim.waiting;
    clock_.steps = saved->sim.steps;
    clock_.dropped = saved->sim.dropped;
    if (wind_.blows()) { // this sim may do without
        wind_.moving.time = saved->wind.time;
        std::ranges::copy(saved->wind.way, wind_.moving.way.begin());
        std::ranges::copy(saved->wind.jump, wind_.moving.jump.begin());
    }
    volume_.carries =
        volume_ && saved->is(BlockKind::volume) && saved->volume.nodes == params_.grid.edge_count;
    append_motion_of_substeps(pose_before_[0], {substeps_.data(), 1});
    if (!kept)
        display_.append_step_before(schedule_, layout_, state_);
    PLAIT_TRY(place_colliders());
    append_shown();
    return submit();
}

} // namespace plait
