#include "core/sim/sim.hpp"

#include "base/format.hpp"
#include "base/hash.hpp"
#include "core/params/params.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace plait {
namespace {

// Drops what was prepared and not taken, however the call ends.
struct Discard {
    Model& model;
    ~Discard() { model.discard(); }
};

// Swaps in what is new, and out again however the call ends, also by an exception, unless it is kept:
// Trial(swap).keep_if(check()) checks with the new in place.
template <typename Swap> class Trial {
  public:
    explicit Trial(Swap swap) : swap_(swap) { swap_(); }
    ~Trial() {
        if (!kept_)
            swap_();
    }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
    Status keep_if(Status status) {
        kept_ = static_cast<bool>(status);
        return status;
    }

  private:
    Swap swap_;
    bool kept_ = false;
};

// Whether the grid is where it was.
bool same_place(const Params& a, const Params& b) {
    return a.grid.edge == b.grid.edge && a.grid.in_world == b.grid.in_world &&
           std::ranges::equal(a.grid.origin, b.grid.origin);
}

} // namespace

Sim::Sim(Context& context, SimParts parts)
    : context_(context), layout_(parts.layout), desc_(parts.desc), params_(parts.params),
      materials_(std::move(parts.materials)), size_warning_(std::move(parts.size_warning)),
      hair_(parts.hair), said_{default_params(), default_material()},
      groom_warning_(std::move(parts.groom_warning)), groom_(parts.fingerprint), cube_(parts.cube),
      longest_segment_(parts.longest_segment), skin_(std::move(parts.skin)),
      model_(std::move(parts.model)), state_(std::move(parts.state)),
      display_(std::move(parts.display)), roots_(layout_, &context.memory),
      colliders_(desc_.substeps, &context.memory), meshes_(&context.memory),
      bending_(&context.memory), substeps_(1, desc_.substeps, &context.memory),
      clock_(desc_.step, desc_.max_steps_per_call), schedule_(&context.memory),
      pin_table_(&context.memory), pose_before_(&context.memory) {}

Sim::~Sim() {
    leave();
    if (context_.measured == this)
        context_.measured = nullptr;
    if (read_fence_ != 0) // the caller's memory may go with the sim
        (void)fence_reached(read_fence_, true);
}

Status Sim::start() {
    PLAIT_TRY(make_poses(pose_spare_, "pose_spare"));
    PLAIT_TRY(make_poses(pose_was_, "pose_was"));
    PLAIT_TRY(make_poses(pose_next_, "pose_next"));
    PLAIT_TRY(make_poses_before(pose_before_, substeps_.size()));
    PLAIT_TRY(check_stages());
    PLAIT_TRY(prepare_calls());
    model_->reset(schedule_, present());
    append_no_motion();
    display_.append_step_before(schedule_, layout_, state_);
    PLAIT_TRY(show_at_once());
    PLAIT_TRY(wait());
    log_warning("");
    return {};
}

Status Sim::check_stages() {
    schedule_.clear();
    append_dry_step();
    return check_schedule();
}

// That what was appended can run; it is not run.
Status Sim::check_schedule() {
    Status status = check_supported(device(), schedule_.list());
    if (status)
        status = device().prepare(schedule_.list());
    schedule_.clear();
    return status;
}

// What steps do not take, but the calls around them.
Status Sim::prepare_calls() {
    model_->reset(schedule_, present());
    display_.append_step_before(schedule_, layout_, state_);
    display_.append_frame_before(schedule_, layout_, state_);
    append_shown();
    if (desc_.interpolate_output == 2)
        display_.append_interpolation(schedule_, layout_, state_);
    model_->teleport(schedule_, present(), state_.pose);
    model_->adopt(schedule_, present(), Changed::places);
    model_->set_off(schedule_, present(), pose_before_.front(), pose_was_, pose_next_, 0);
    skin_.append(schedule_, layout_, state_, state_.pose);
    binding_.append(schedule_, layout_, state_, state_.pose);
    add_stats();
    add_bounds();
    std::pmr::vector<plait_dispatch> list(&context_.memory);
    for (const plait_dispatch& dispatch : schedule_.list())
        if (device().supports(dispatch.stage)) // else the call that wants it says so
            list.push_back(dispatch);
    Status status = device().prepare(list);
    schedule_.clear();
    return status;
}

// All work passes here, so that device time is counted for the sim that caused it.
Status Sim::submit() {
    if (context_.profile) {
        PLAIT_TRY(begin_measuring());
        schedule_.reckon_traffic(layout_.row);
    }
    for (const plait_dispatch& dispatch : schedule_.list())
        ++costs_[dispatch.stage].calls;
    return schedule_.submit(device());
}

// What jumped has moved on no way: the frame before is where it is now.
Status Sim::show_at_once() {
    append_shown();
    PLAIT_TRY(submit());
    display_.append_frame_before(schedule_, layout_, state_);
    return submit();
}

// All or nothing: what is new is made aside, taken, and given back if its stages cannot run.
Status Sim::set_params(const Params& params) {
    const Discard discard{*model_};
    PLAIT_TRY(check_model_takes(params, desc_.model));
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
            meshes_.buffers() || bending_.buffers() || pairs_.buffers(), bool(state_.wetness)};
}

Status Sim::set_materials(StrandMaterialsPtr materials) {
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
    if (!desc) {
        wind_ = {};
        return model_->open(device(), part_needs());
    }
    if (desc_.model == PLAIT_MODEL_TRESSFX)
        return Error{
            PLAIT_INVALID_STATE,
            "the sim is of model 0 (tressfx), whose wind is that of plait_sim_set_tressfx; strands "
            "of articulated take plait_sim_set_wind"};
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

Status Sim::bind_roots(const Mesh* mesh, std::span<plait_root_place> places) {
    RootBinding next;
    if (mesh) {
        std::pmr::vector<float> rest(4 * size_t{layout_.guide_vertices()}, &context_.memory);
        PLAIT_TRY(device().read(state_.rest, 0, layout_.guide_vertices(), rest.data()));
        auto made = RootBinding::create(device(), *mesh, layout_, rest, places, &context_.memory);
        if (!made)
            return made.error();
        next = std::move(*made);
    }
    PLAIT_TRY(Trial([&] { std::swap(binding_, next); }).keep_if(check_stages()));
    const std::string turned =
        binding_.turned() == 0
            ? ""
            : format("; of %u the tip is nearer to it than the root: are they stored from tip to "
                     "root (plait_import_options.root_end)?",
                     binding_.turned());
    if (binding_.far() > 0 && context_.log.callback)
        context_.log(PLAIT_LOG_LEVEL_WARNING,
                     format("sim: %u of %u roots are more than 1 cm from the mesh that they are "
                            "bound to, that of guide %u %.3g m%s",
                            binding_.far(), layout_.guides, binding_.farthest_root(),
                            double(binding_.farthest()), turned.c_str()));
    return {};
}

Status Sim::aim(const RootsInput& input) {
    if (!input.own.empty() && input.own.size() != layout_.guides)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("root_poses.count is %zu, the sim has %u guides", input.own.size(),
                            layout_.guides)};
    const auto scale = scale_of(input);
    if (!scale)
        return scale.error();
    if (!input.mesh.empty())
        PLAIT_TRY(binding_.check(input.mesh));
    PLAIT_TRY(open_scale(*scale));
    const plait_pose head = plait::in_units(input.head, *scale);
    if (input.bones.empty() && input.mesh.empty()) {
        PLAIT_TRY(roots_.aim(device(), head, input.own, *scale));
        return rescale(*scale);
    }
    const auto poses = roots_.target_poses(device());
    if (!poses)
        return poses.error();
    schedule_.clear();
    PLAIT_TRY(input.mesh.empty() ? skin_.append(device(), schedule_, layout_, state_, input.bones,
                                                *scale / input.scale, *scale, **poses)
                                 : binding_.append(device(), schedule_, layout_, state_, input.mesh,
                                                   *scale, **poses));
    PLAIT_TRY(submit());
    Hash given;
    given.add(input.bones.data(), input.bones.size_bytes());
    given.add(*scale);
    // positions on the device, which nobody reads here, do what the same from the host do
    roots_.aim_at_target_poses(head, input.mesh.empty() ? given.value() : 0);
    return rescale(*scale);
}

// The first aim is where the hair is. An aim at the present place says nothing of the head's motion: a
// game aims in every frame, in that of a teleport, too.
Status Sim::aimed() {
    told_ = begun_ && roots_.moves();
    if (std::exchange(begun_, true))
        return {};
    first_aim_ = true;
    return place_head();
}

Status Sim::set_roots(const RootsInput& input) {
    PLAIT_TRY(aim(input));
    return aimed();
}

Status Sim::set_frame(const plait_frame_desc* desc) {
    if (desc && !frame_.is_on()) {
        schedule_.clear();
        model_->carry(schedule_, present(), identity_pose);
        PLAIT_TRY(check_schedule());
    }
    plait_frame_desc own{};
    if (desc) {
        own = *desc;
        own.pose = in_units(desc->pose);
    }
    if (frame_.aim(desc ? &own : nullptr) && motion_ == Motion::known)
        motion_ = Motion::framed;
    return {};
}

// One for each number of substeps that strands take.
Status Sim::make_poses_before(std::pmr::vector<Buffer>& to, size_t count) {
    to.resize(count);
    for (Buffer& before : to)
        PLAIT_TRY(make_poses(before, "pose_before"));
    return {};
}

// Of a head that has not moved, as far as anybody knows.
void Sim::append_no_motion() {
    roots_.append_poses_now(schedule_, pose_was_);
    for (const Buffer& before : pose_before_)
        roots_.append_poses_now(schedule_, before);
}

// A head that was placed and has not set off since has moved in the last of other substeps as it did in
// that of the `known` ones; `first`: where it was before the first of these.
void Sim::append_motion_of_substeps(const Buffer& first, std::span<const uint32_t> known) {
    if (motion_ == Motion::known || motion_ == Motion::framed)
        return; // the next step says it
    for (size_t g = 0; g < substeps_.size(); ++g) {
        if (std::ranges::find(known, substeps_[g]) != known.end())
            continue;
        const float ways = static_cast<float>(known[0]) / static_cast<float>(substeps_[g]);
        roots_.append_between(schedule_, first, pose_was_, 1 - ways, pose_before_[g]);
    }
}

// How the head has moved in the last substep; where it was placed before and has not set off since, that
// is known already.
void Sim::append_last_motion() {
    if (motion_ != Motion::known && motion_ != Motion::framed)
        return;
    roots_.append_poses(schedule_, 1, pose_was_);
    for (size_t g = 0; g < substeps_.size(); ++g)
        roots_.append_poses(schedule_, 1 - 1 / static_cast<float>(substeps_[g]), pose_before_[g]);
}

Status Sim::make_poses(Buffer& to, const char* name) {
    return device().create(to, PLAIT_ELEMENT_FLOAT4, size_t{2} * layout_.guides, name);
}

// Where the last step left them, for strands that follow and are shown before the next one. Nothing moves
// on: the next step's path begins where that one ended, however many calls lie between.
Status Sim::place_colliders() {
    if (!display_.meets_colliders(params_))
        return {};
    bending_.fit_new(schedule_);
    return colliders_.upload(device());
}

// Of sheets that do not come along with the head.
Status Sim::forget_sides_of_left(const plait_pose& before, const plait_pose& after) {
    for (const BendingMeshes::Entry& mesh : bending_.entries()) {
        const Colliders::Slot& slot = colliders_.slots()[mesh.slot];
        if (mesh.two_sided() && !goes_along(before, slot.to, after, colliders_.goal(slot)))
            PLAIT_TRY(bending_.forget_sides(device(), mesh.slot));
    }
    return {};
}

// The roots are where they were aimed at, and hair is carried along.
Status Sim::place_head() {
    schedule_.clear();
    append_last_motion();
    roots_.arrive();
    roots_.stop(schedule_);
    roots_.append_poses_now(schedule_, pose_spare_);
    append_placed();
    return show_at_once();
}

void Sim::append_placed() {
    volume_.carries = false;
    model_->teleport(schedule_, present(), pose_spare_);
    std::swap(state_.pose, pose_spare_);
    motion_ = Motion::as_before;
    placed_from_ = roots_.step_begin();
    placed_to_ = roots_.step_head();
    told_ = waited_ = knows_velocity_ = false;
}

// The same with all that goes along with the head, which has come no way either.
Status Sim::place() {
    append_last_motion();
    const plait_pose before = roots_.step_head();
    roots_.arrive();
    roots_.stop(schedule_);
    PLAIT_TRY(forget_sides_of_left(before, roots_.step_head()));
    frame_.arrive();
    frame_.stop();
    colliders_.place();
    bending_.arrive();
    bending_.stop(schedule_);
    roots_.append_poses_now(schedule_, pose_spare_);
    PLAIT_TRY(place_colliders());
    append_stopped_pins(schedule_, layout_, state_, scale_);
    append_placed();
    return {};
}

Status Sim::teleport(const RootsInput& input) {
    PLAIT_TRY(aim(input));
    schedule_.clear();
    begun_ = true;
    PLAIT_TRY(place());
    return show_at_once();
}

Status Sim::reset() {
    schedule_.clear();
    clock_.reset();
    wind_.reset();
    volume_.carries = false;
    motion_ = roots_.stands() ? Motion::as_before : Motion::unknown;
    told_ = waited_ = false;
    roots_.stop(schedule_);
    roots_.forget();
    placed_from_ = placed_to_ = roots_.step_head();
    frame_.stop();
    colliders_.stop();
    bending_.stop(schedule_);
    PLAIT_TRY(bending_.forget_sides(device()));
    PLAIT_TRY(place_colliders());
    append_stopped_pins(schedule_, layout_, state_, scale_);
    roots_.append_poses_now(schedule_, state_.pose);
    append_no_motion();
    model_->reset(schedule_, present());
    display_.append_step_before(schedule_, layout_, state_);
    return show_at_once();
}

} // namespace plait
