// Where a sim's head and roots are aimed at or put, and how hair has their motion.
#include "base/format.hpp"
#include "base/hash.hpp"
#include "core/sim/sim.hpp"
#include "core/sim/trial.hpp"

#include <algorithm>
#include <utility>

namespace plait {

Status Sim::bind_roots(const Mesh* mesh, std::span<plait_root_place> places) {
    stir();
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

// The first aim is where the hair is.
Status Sim::aimed() {
    return motion_.aim(roots_.moves()) ? place_head() : Status{};
}

Status Sim::set_roots(const RootsInput& input) {
    PLAIT_TRY(aim(input));
    if (levels_) {
        Hash told;
        told.add(input.head);
        told.add(input.scale);
        told.add(input.own.data(), input.own.size_bytes());
        told.add(input.bones.data(), input.bones.size_bytes());
        told.add(input.mesh.data(), input.mesh.size_bytes());
        if (told.value() != told_)
            stir();
        told_ = told.value();
    }
    return aimed();
}

Status Sim::set_frame(const plait_frame_desc* desc) {
    stir();
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
    if (frame_.aim(desc ? &own : nullptr))
        motion_.reframe();
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
    if (motion_.is_on_its_way())
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
    if (!motion_.is_on_its_way())
        return;
    roots_.append_poses(schedule_, 1, pose_was_);
    for (size_t g = 0; g < substeps_.size(); ++g)
        roots_.append_poses(schedule_, 1 - 1 / static_cast<float>(substeps_[g]), pose_before_[g]);
}

Status Sim::make_poses(Buffer& to, const char* name) {
    return device().create(to, PLAIT_ELEMENT_FLOAT4, size_t{2} * layout_.guides, name);
}

// Where the last step left them and, if hair is shown between steps, where they are now, for strands that
// follow. Nothing moves on: the next step's path begins where that one ended, however many calls lie
// between.
Status Sim::place_colliders() {
    if (!display_.meets_colliders(params_))
        return {};
    bending_.fit_new(schedule_);
    PLAIT_TRY(colliders_.upload(device()));
    return display_.interpolates() ? colliders_.show(device()) : Status{};
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
    motion_.put(roots_.step_begin(), roots_.step_head());
}

// The same with all that goes along with the head, which has come no way either.
Status Sim::place() {
    append_last_motion();
    if (roots_.left_step()) // it would go less than a step's way in the step that is under way
        clock_.begin_step();
    const plait_pose left = roots_.call_head(), before = roots_.step_head();
    roots_.arrive();
    roots_.stop(schedule_);
    PLAIT_TRY(forget_sides_of_left(before, roots_.step_head()));
    frame_.arrive();
    frame_.stop();
    frame_.leave(left, roots_.step_head());
    colliders_.place();
    bending_.arrive();
    bending_.stop(schedule_);
    roots_.append_poses_now(schedule_, pose_spare_);
    append_stopped_pins(schedule_, layout_, state_, scale_);
    append_placed();
    return {};
}

Status Sim::teleport(const RootsInput& input) {
    stir();
    PLAIT_TRY(aim(input));
    schedule_.clear();
    motion_.begin(HeadMotion::Begun::roots);
    PLAIT_TRY(place());
    return show_at_once();
}

} // namespace plait
