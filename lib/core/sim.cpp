#include "core/sim.hpp"

#include "base/format.hpp"
#include "core/models/traits.hpp"
#include "core/params.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plait {
namespace {

// Drops what was prepared and not taken, however the call ends.
struct Discard {
    Model& model;
    ~Discard() { model.discard(); }
};

Status check_follows(const Groom& groom, const plait_sim_desc& desc, const FollowMap* follows) {
    if (!follows)
        return {};
    if (desc.follows_per_guide > 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("follows_per_guide is %u and follow_map is given, give one",
                            desc.follows_per_guide)};
    if (follows->guide_count != groom.shape.strands)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("follow_map is of %u guides, the groom has %llu strands",
                            follows->guide_count,
                            static_cast<unsigned long long>(groom.shape.strands))};
    return {};
}

uint32_t row_of(const Groom& groom, const FollowMap* follows) {
    return std::max(groom.shape.max_vertices, follows ? follows->max_vertices : 0);
}

Status check_size(const Context& context, const Groom& groom, const plait_sim_desc& desc,
                  const FollowMap* follows) {
    const double strands = double(groom.shape.strands) * (1 + desc.follows_per_guide) +
                           (follows ? double(follows->count()) : 0);
    const uint32_t row = row_of(groom, follows);
    if (strands * row > std::numeric_limits<uint32_t>::max())
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("%g strands of %u vertices are more than 2^32 - 1 vertices", strands, row)};
    if (desc.model == PLAIT_MODEL_TRESSFX && row > context.info.max_group_size)
        return Error{PLAIT_UNSUPPORTED,
                     format("strands have up to %u vertices, device %s takes %u work-items in a "
                            "work-group",
                            row, context.info.name, context.info.max_group_size)};
    return {};
}

Layout make_layout(const Groom& groom, const plait_sim_desc& desc, const FollowMap* follows) {
    const auto guides = static_cast<uint32_t>(groom.shape.strands);
    const auto count =
        follows ? static_cast<uint32_t>(follows->count()) : guides * desc.follows_per_guide;
    return {guides, count, row_of(groom, follows)};
}

// m, of the groom's strands, or a hair's.
float mean_diameter(const Groom& groom) {
    double sum = 0, count = 0;
    for (const float d : groom.strands.thickness) {
        sum += double(d);
        count += d > 0;
    }
    return count > 0 ? static_cast<float>(sum / count) : 70e-6f;
}

// Whether the grid is where it was.
bool same_place(const plait_sim_params& a, const plait_sim_params& b) {
    return a.grid_edge == b.grid_edge && a.grid_in_world == b.grid_in_world &&
           std::ranges::equal(a.grid_origin, b.grid_origin);
}

} // namespace

Result<SimParts> make_sim_parts(Context& context, const Groom& groom, const plait_sim_desc& desc,
                                const StrandInput& strands) {
    PLAIT_TRY(check_follows(groom, desc, strands.follows));
    PLAIT_TRY(check_size(context, groom, desc, strands.follows));
    const Layout layout = make_layout(groom, desc, strands.follows);
    Device& device = context.device;
    auto model =
        make_model({desc.model, desc.substeps},
                   {layout, groom, strands.stiffness, strands.materials, context.info.tile,
                    desc.sag_free, desc.accelerations != 0, desc.pins != 0, &context.memory});
    if (!model)
        return model.error();
    PLAIT_TRY((*model)->prepare(device, desc.params));
    (*model)->swap();
    (*model)->discard();
    const bool interpolate = desc.interpolate_output != 0;
    const StateNeeds needs{interpolate ? layout.guides : layout.strands(),
                           (*model)->pinned_vertices(),
                           (*model)->keeps_two_steps(),
                           desc.accelerations != 0,
                           desc.pins != 0,
                           strands.follows};
    auto state = create_state(device, groom, layout, needs, &context.memory);
    if (!state)
        return state.error();
    auto grid = InterHair::create(device, desc.params);
    if (!grid)
        return grid.error();
    auto skin = Skin::create(device, groom);
    if (!skin)
        return skin.error();
    auto display = Display::create(device, groom, layout,
                                   {desc.follows_per_guide, desc.follow_radius, desc.seed,
                                    strands.follows, (*model)->pinned_vertices()},
                                   {interpolate, desc.keep_last_frame != 0}, &context.memory);
    if (!display)
        return display.error();
    return SimParts{layout,
                    desc,
                    groom.shape.mean_length,
                    mean_diameter(groom),
                    fingerprint(groom),
                    cube_around(groom),
                    std::move(*skin),
                    std::move(*model),
                    std::move(*state),
                    std::move(*grid),
                    std::move(*display)};
}

Sim::Sim(Context& context, SimParts parts)
    : context_(context), layout_(parts.layout), desc_(parts.desc), mean_length_(parts.mean_length),
      diameter_(parts.diameter), groom_(parts.fingerprint), cube_(parts.cube),
      skin_(std::move(parts.skin)), model_(std::move(parts.model)), state_(std::move(parts.state)),
      grid_(std::move(parts.grid)), display_(std::move(parts.display)),
      roots_(layout_, &context.memory), colliders_(desc_.substeps, &context.memory),
      meshes_(&context.memory), substeps_(1, desc_.substeps, &context.memory),
      clock_(desc_.step, desc_.max_steps_per_call), schedule_(&context.memory),
      pin_table_(&context.memory) {}

Sim::~Sim() {
    if (context_.measured == this)
        context_.measured = nullptr;
}

Status Sim::start() {
    PLAIT_TRY(check_stages());
    PLAIT_TRY(prepare_calls());
    model_->reset(schedule_, present());
    display_.keep(schedule_, layout_, state_);
    PLAIT_TRY(show_at_once());
    PLAIT_TRY(wait());
    log_warnings(default_params(), "");
    return {};
}

Status Sim::check_stages() {
    schedule_.clear();
    add_pins(schedule_, layout_, state_, 1);
    begin_substeps();
    (void)for_each_group([&](const Group& group) {
        add_substep(group, 0);
        return Status{};
    });
    end_substeps();
    Status status = check_supported(device(), schedule_.list());
    if (status)
        status = device().prepare(schedule_.list());
    schedule_.clear();
    return status;
}

// What steps do not take, but the calls around them.
Status Sim::prepare_calls() {
    model_->reset(schedule_, present());
    display_.keep(schedule_, layout_, state_);
    display_.keep_frame(schedule_, layout_, state_);
    display_.update(schedule_, layout_, state_, roots_, desc_.params, 0);
    model_->teleport(schedule_, present(), state_.pose);
    skin_.append(schedule_, layout_, state_, state_.pose);
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

// Ends what the caller has begun in schedule_.
Status Sim::refresh() {
    display_.update(schedule_, layout_, state_, roots_, desc_.params,
                    static_cast<float>(clock_.remainder()));
    return submit();
}

// What jumped has moved on no way: the frame before is where it is now.
Status Sim::show_at_once() {
    PLAIT_TRY(refresh());
    display_.keep_frame(schedule_, layout_, state_);
    return submit();
}

Status Sim::step(double dt) {
    schedule_.clear(); // what a failed call may have left
    display_.keep_frame(schedule_, layout_, state_);
    const Tick tick = clock_.advance(dt);
    for (uint32_t k = 0; k < tick.steps; ++k)
        PLAIT_TRY(fixed_step(tick.end_of(k), k + 1 == tick.steps));
    roots_.end_call();
    colliders_.end_call();
    end_pins_call(schedule_, layout_, state_);
    const bool changed = tick.steps > 0 || display_.interpolates();
    return changed ? refresh() : submit();
}

Status Sim::fixed_step(double end, bool keep) {
    if (keep)
        display_.keep(schedule_, layout_, state_);
    roots_.begin_step(schedule_, end);
    begin_pins_step(schedule_, layout_, state_, static_cast<float>(end));
    PLAIT_TRY(colliders_.begin_step(device(), end));
    begin_substeps();
    const auto substeps = [&](const Group& group) -> Status {
        for (uint32_t i = 0; i < group.substeps; ++i) {
            add_substep(group, i);
            PLAIT_TRY(submit());
        }
        return {};
    };
    PLAIT_TRY(for_each_group(substeps));
    end_substeps();
    PLAIT_TRY(submit());
    if (grid_.volume())
        grid_.volume().carry();
    if (wind_.blows())
        wind_.end_step(clock_.step());
    ++clock_.steps;
    return {};
}

Substep Sim::at(const Group& group, uint32_t substep) const {
    return {layout_,
            state_,
            desc_.params,
            colliders_.capsules(),
            colliders_.count() - colliders_.meshes(),
            (group.first + substep) * colliders_.count(),
            meshes_.buffers() ? colliders_.meshes() : 0,
            meshes_.buffers(),
            clock_.step(),
            group.substeps,
            length_of(group.substeps),
            air(),
            static_cast<float>(substep + 1) / static_cast<float>(group.substeps),
            wind_.blows() ? std::optional(wind_.at(air(), substep == 0, clock_.step()))
                          : std::nullopt};
}

std::array<float, 3> Sim::air() const {
    const plait_sim_params& p = desc_.params;
    std::array<float, 3> air{p.wind[0], p.wind[1], p.wind[2]};
    if (p.air_with_head == 0)
        return air;
    float middle[3];
    for (size_t i = 0; i < 3; ++i)
        middle[i] = cube_.origin[i] + 0.5f * cube_.edge;
    const auto moved = roots_.head_moves(middle);
    for (size_t i = 0; i < 3; ++i)
        air[i] += p.air_with_head * moved[i] / static_cast<float>(clock_.step());
    return air;
}

// What pulls at single vertices in all substeps of a fixed step, where they are at its begin.
void Sim::begin_substeps() {
    if (wind_.blows()) // around where the hair is
        wind_.begin_step(schedule_, roots_.step_begin(), cube_, clock_.step());
    if (grid_.volume() && !grid_.volume().carries)
        grid_.append_volume_start(schedule_, grid_step(roots_.step_begin()), *model_,
                                  first_group());
    if (!state_.acceleration)
        return;
    if (context_.replaced[PLAIT_STAGE_accelerate]) {
        plait_accelerate_params params{};
        params.vertex_stride = layout_.row;
        params.h = substep_length();
        params.time = static_cast<float>(clock_.time());
        std::ranges::copy(desc_.params.accelerate_values, params.value);
        schedule_.add(
            PLAIT_STAGE_accelerate, layout_.guide_vertices(), params,
            {&state_.vertex_count, &state_.position, &state_.position_prev, &state_.acceleration});
    }
    model_->accelerate(schedule_, present());
}

void Sim::add_substep(const Group& group, uint32_t index) {
    const Substep substep = at(group, index);
    roots_.pose_in_step(schedule_, substep.share, state_.pose);
    model_->substep(schedule_, substep);
}

// Positions from what the model keeps, and the inter-hair step: on the lanes where these fill a
// CPU's registers, else, and where the caller has kernels of his own for it, on positions.
void Sim::end_substeps() {
    const InterHair::Step step = grid_step(roots_.step_head());
    if (grid_.volume()) {
        grid_.append_volume(schedule_, step, *model_, first_group());
        model_->publish(schedule_, present());
        return;
    }
    if (grid_.is_exact() && brakes_lanes()) {
        grid_.append_over_lanes(schedule_, step, *model_, present());
        model_->publish(schedule_, present());
        return;
    }
    model_->publish(schedule_, present());
    grid_.append(schedule_, step);
    if (desc_.params.interhair != PLAIT_INTERHAIR_OFF)
        model_->adopt(schedule_, present());
}

InterHair::Step Sim::grid_step(const plait_pose& head) const {
    return {layout_,          state_,       desc_.params, cube_,        head,
            substep_length(), clock_.steps, desc_.seed,   context_.info};
}

bool Sim::brakes_lanes() const {
    const Device& device = context_.device;
    const auto& replaced = context_.replaced;
    return model_->has_lanes() && context_.info.lanes > 1 && !replaced[PLAIT_STAGE_grid_splat] &&
           !replaced[PLAIT_STAGE_grid_diffuse] && device.supports(PLAIT_STAGE_lane_splat) &&
           device.supports(PLAIT_STAGE_lane_diffuse);
}

// All or nothing: what is new is made aside, taken, and given back if its stages cannot run.
Status Sim::set_params(const plait_sim_params& params) {
    const Discard discard{*model_};
    PLAIT_TRY(check_volume(params, desc_.model));
    PLAIT_TRY(model_->prepare(device(), params));
    InterHair grid;
    const bool same_grid = grid_.fits(params);
    if (!same_grid) {
        auto made = InterHair::create(device(), params);
        if (!made)
            return made.error();
        grid = std::move(*made);
    }
    plait_sim_params next = params;
    const std::string warned = context_.log.callback ? warning() : "";
    const auto exchange = [&] {
        model_->swap();
        std::swap(desc_.params, next);
        if (!same_grid)
            std::swap(grid_, grid);
    };
    exchange();
    Status status = check_stages();
    if (!status)
        exchange();
    else
        log_warnings(next, warned);
    if (status && !same_place(next, desc_.params))
        grid_.volume().carries = false;
    return status;
}

Status Sim::set_materials(StrandMaterialsPtr materials) {
    if (!traits_of(desc_.model).switches)
        return Error{PLAIT_INVALID_STATE,
                     format("the sim is of model 0 (tressfx), whose stiffness is no material's; "
                            "strands of the models %s have one",
                            list_models(&ModelTraits::switches).c_str())};
    const Discard discard{*model_};
    const std::string warned = context_.log.callback ? warning() : "";
    model_->exchange(materials);
    Status status = model_->prepare(device(), desc_.params);
    if (!status) {
        model_->exchange(materials);
        return status;
    }
    model_->swap();
    log_warnings(desc_.params, warned);
    return {};
}

Status Sim::set_wind(const plait_wind_desc* desc) {
    if (!desc) {
        wind_ = {};
        model_->close_wind();
        return {};
    }
    if (!traits_of(desc_.model).switches)
        return Error{PLAIT_INVALID_STATE,
                     format("the sim is of model 0 (tressfx), whose wind is that of the params; "
                            "strands of the models %s take plait_sim_set_wind",
                            list_models(&ModelTraits::switches).c_str())};
    Wind next;
    PLAIT_TRY(next.begin(device(), wind_, *desc, diameter_));
    if (!wind_.blows())
        PLAIT_TRY(model_->open_wind(device()));
    std::swap(wind_, next);
    Status status = check_stages();
    if (!status) {
        std::swap(wind_, next);
        if (!wind_.blows())
            model_->close_wind();
    }
    return status;
}

SettingsList Sim::settings() const {
    SettingsList list(layout_.guides, own_settings(desc_.model), &context_.memory);
    model_->read_settings(list);
    return list;
}

Status Sim::check_settings(std::span<const Settings> settings) const {
    if (desc_.model == PLAIT_MODEL_TRESSFX)
        return Error{PLAIT_INVALID_STATE,
                     format("the sim is of model 0 (tressfx); strands of the models %s can be "
                            "switched",
                            list_models(&ModelTraits::switches).c_str())};
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
    PLAIT_TRY(take_substeps(substeps_of(settings, &context_.memory)));
    model_->swap();
    Status status = check_stages();
    if (!status) {
        model_->swap();
        (void)take_substeps(before); // there is room for them
    }
    return status;
}

Status Sim::set_roots(const RootsInput& input) {
    if (!input.own.empty() && input.own.size() != layout_.guides)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("root_poses.count is %zu, the sim has %u guides", input.own.size(),
                            layout_.guides)};
    if (input.bones.empty())
        return roots_.aim(device(), input.head, input.own);
    PLAIT_TRY(skin_.check(input.bones));
    const auto poses = roots_.target_poses(device());
    if (!poses)
        return poses.error();
    schedule_.clear();
    PLAIT_TRY(skin_.append(device(), schedule_, layout_, state_, input.bones, **poses));
    PLAIT_TRY(submit());
    roots_.aim_at_target_poses(input.head);
    return {};
}

Status Sim::prepare_teleport() {
    if (pose_spare_)
        return {};
    return device().create(pose_spare_, PLAIT_ELEMENT_FLOAT4, size_t{2} * layout_.guides,
                           "pose_spare");
}

Status Sim::teleport(const RootsInput& input) {
    schedule_.clear();
    PLAIT_TRY(prepare_teleport());
    PLAIT_TRY(set_roots(input));
    roots_.end_call();
    roots_.stop(schedule_);
    roots_.pose_now(schedule_, pose_spare_);
    stop_pins(schedule_, layout_, state_);
    grid_.volume().carries = false;
    model_->teleport(schedule_, present(), pose_spare_);
    std::swap(state_.pose, pose_spare_);
    return show_at_once();
}

Status Sim::reset() {
    schedule_.clear();
    clock_.reset();
    wind_.reset();
    grid_.volume().carries = false;
    roots_.stop(schedule_);
    colliders_.stop();
    stop_pins(schedule_, layout_, state_);
    roots_.pose_now(schedule_, state_.pose);
    model_->reset(schedule_, present());
    display_.keep(schedule_, layout_, state_);
    return show_at_once();
}

} // namespace plait
