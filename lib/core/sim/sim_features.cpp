// What a sim is told of its hair and of its features: parameters, materials, settings, wind, wetness, detail.
#include "base/format.hpp"
#include "core/params/params.hpp"
#include "core/sim/sim.hpp"
#include "core/sim/trial.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace plait {
namespace {

// Whether the grid is where it was.
bool same_place(const Params& a, const Params& b) {
    return a.grid.edge == b.grid.edge && a.grid.in_world == b.grid.in_world &&
           std::ranges::equal(a.grid.origin, b.grid.origin);
}

} // namespace

// All or nothing: what is new is made aside, taken, and given back if its stages cannot run.
Status Sim::set_params(const Params& params) {
    stir();
    const Discard discard{*model_};
    PLAIT_TRY(check_model_takes(params, desc_.model));
    if (reduce_)
        PLAIT_TRY(check_reduces(params, wind_.is_sheltered()));
    PLAIT_TRY(model_->prepare(device(), params));
    StrandGrid grid;
    const bool same_grid = grid_.fits(params);
    if (!same_grid) {
        auto made = StrandGrid::create(device(), params);
        if (!made)
            return made.error();
        grid = std::move(*made);
    }
    Volume volume;
    const bool same_volume = volume_.fits(params);
    if (!same_volume) {
        auto made = Volume::create(device(), params);
        if (!made)
            return made.error();
        volume = std::move(*made);
        PLAIT_TRY(volume.keep_wetness(device(), bool(state_.wetness)));
    }
    Pairs pairs;
    const bool same_pairs = pairs_.fits(params);
    if (!same_pairs) {
        auto made = Pairs::create(device(), params, layout_, longest_segment_);
        if (!made)
            return made.error();
        pairs = std::move(*made);
    }
    Buffer acceleration;
    const bool same_acceleration = params.acceleration.on == bool(state_.acceleration);
    if (!same_acceleration && params.acceleration.on)
        PLAIT_TRY(make_rows(device(), layout_, acceleration, "acceleration", &context_.memory));
    PartNeeds needs = part_needs();
    needs.push = needs.push || params.acceleration.on;
    needs.plane = needs.plane || pairs.buffers();
    PLAIT_TRY(model_->open(device(), needs));
    Params next = params;
    const std::string warned = context_.log.callback ? warning() : "";
    const auto swap = [&] {
        model_->swap();
        std::swap(params_, next);
        if (!same_grid)
            std::swap(grid_, grid);
        if (!same_volume)
            std::swap(volume_, volume);
        if (!same_pairs)
            std::swap(pairs_, pairs);
        if (!same_acceleration)
            std::swap(state_.acceleration, acceleration);
    };
    const Status status = Trial(swap).keep_if(check_stages());
    if (status) {
        log_warning(warned);
        if (!same_place(next, params_))
            volume_.carries = false;
        if (!params_.wetness.on)
            close_wetness();
    }
    PLAIT_TRY(model_->open(device(), part_needs()));
    return status;
}

PartNeeds Sim::part_needs() const {
    return {state_.acceleration || wind_.blows(), state_.pin || wind_.blows(),
            meshes_.buffers() || bending_.buffers() || pairs_.buffers(), bending_.has_sheets(),
            bool(state_.wetness)};
}

Status Sim::set_materials(StrandMaterialsPtr materials) {
    stir();
    if (desc_.model == PLAIT_MODEL_TRESSFX)
        return Error{PLAIT_INVALID_STATE,
                     "the sim is of model 0 (tressfx), whose strands have no material; those of "
                     "articulated do"};
    const Discard discard{*model_};
    const std::string warned = context_.log.callback ? warning() : "";
    auto given = materials; // the model keeps one, the sim another
    Trial trial([&] {
        model_->exchange(given);
        std::swap(materials_, materials);
    });
    PLAIT_TRY(trial.keep_if(model_->prepare(device(), params_)));
    model_->swap();
    log_warning(warned);
    return {};
}

Status Sim::find_balance() {
    stir();
    if (desc_.sag_free == PLAIT_SAG_FREE_OFF)
        return Error{PLAIT_INVALID_STATE,
                     "sag_free is 0 (off): the sim's groom is not in balance with any gravity"};
    const Discard discard{*model_};
    const std::string warned = context_.log.callback ? warning() : "";
    auto gravity = std::to_array(params_.gravity);
    Trial trial([&] { model_->exchange(gravity); });
    PLAIT_TRY(trial.keep_if(model_->prepare(device(), params_)));
    model_->swap();
    log_warning(warned);
    return {};
}

Status Sim::set_wind(const plait_wind_desc* desc) {
    stir();
    if (!desc) {
        wind_ = {};
        return model_->open(device(), part_needs());
    }
    if (desc_.model == PLAIT_MODEL_TRESSFX)
        return Error{
            PLAIT_INVALID_STATE,
            "the sim is of model 0 (tressfx), whose wind is that of plait_sim_set_tressfx; strands "
            "of articulated take plait_sim_set_wind"};
    if (reduce_)
        PLAIT_TRY(check_reduces(params_, desc->shelter == 1));
    Wind next;
    PLAIT_TRY(next.begin(device(), wind_, *desc, hair_));
    PartNeeds needs = part_needs();
    needs.push = needs.spring = true;
    PLAIT_TRY(model_->open(device(), needs));
    const Status status = Trial([&] { std::swap(wind_, next); }).keep_if(check_stages());
    PLAIT_TRY(model_->open(device(), part_needs()));
    return status;
}

Status Sim::open_wetness() {
    struct Closer { // also where memory ends half-way
        Sim* sim;
        ~Closer() {
            if (sim)
                sim->close_wetness();
        }
    } closer{this};
    PLAIT_TRY(Wetness::open(device(), layout_, state_, &context_.memory));
    PLAIT_TRY(model_->open(device(), part_needs()));
    PLAIT_TRY(volume_.keep_wetness(device(), true));
    PLAIT_TRY(display_.keep_wetness(device(), layout_, state_, true, &context_.memory));
    PLAIT_TRY(check_stages());
    closer.sim = nullptr;
    return {};
}

// The material of dry strands is where it was.
void Sim::close_wetness() {
    (void)display_.keep_wetness(device(), layout_, state_, false, &context_.memory);
    (void)volume_.keep_wetness(device(), false);
    Wetness::close(state_);
    (void)model_->open(device(), part_needs()); // which makes nothing
}

Status Sim::set_detail(const plait_detail_desc* desc, std::span<const uint32_t> centres) {
    stir();
    Detail next;
    if (desc) {
        auto made =
            display_.make_detail(device(), layout_, state_, *desc, centres, &context_.memory);
        if (!made)
            return made.error();
        next = std::move(*made);
    }
    Trial trial([&] { display_.exchange(next); });
    schedule_.clear();
    append_shown();
    return trial.keep_if(check_schedule());
}

SettingsList Sim::settings() const {
    SettingsList list(layout_.guides, own_settings(), &context_.memory);
    model_->read_settings(list);
    return list;
}

Status Sim::check_settings(std::span<const Settings> settings) const {
    if (desc_.model == PLAIT_MODEL_TRESSFX)
        return Error{PLAIT_INVALID_STATE,
                     "the sim is of model 0 (tressfx), whose strands have no settings; those of "
                     "articulated do"};
    if (settings.size() != layout_.guides)
        return Error{PLAIT_INVALID_ARGUMENT, format("count is %zu, the sim has %u guides",
                                                    settings.size(), layout_.guides)};
    return {};
}

Status Sim::take_substeps(const std::pmr::vector<uint32_t>& substeps) {
    PLAIT_TRY(colliders_.set_substeps(device(), substeps));
    substeps_ = substeps;
    return {};
}

Status Sim::set_settings(std::span<const Settings> settings) {
    stir();
    PLAIT_TRY(check_settings(settings));
    if (std::ranges::equal(settings, this->settings()))
        return {};
    const Discard discard{*model_};
    schedule_.clear();
    PLAIT_TRY(model_->prepare_settings(device(), schedule_, present(), settings));
    const std::pmr::vector<uint32_t> before(substeps_, &context_.memory);
    const auto after = substeps_of(settings, &context_.memory);
    std::pmr::vector<Buffer> poses(&context_.memory);
    PLAIT_TRY(make_poses_before(poses, after.size()));
    PLAIT_TRY(take_substeps(after));
    const auto swap = [&] {
        model_->swap();
        std::swap(pose_before_, poses);
    };
    swap();
    Status status = check_stages();
    if (!status) {
        swap();
        (void)take_substeps(before); // there is room for them
        return status;
    }
    schedule_.clear();
    append_motion_of_substeps(poses[0], before);
    for (size_t g = 0; g < after.size(); ++g) // those that stay keep theirs, bit by bit
        if (const auto place = std::ranges::find(before, after[g]); place != before.end())
            std::swap(pose_before_[g], poses[static_cast<size_t>(place - before.begin())]);
    return submit();
}

} // namespace plait
