#include "core/roots.hpp"

#include <algorithm>
#include <vector>

namespace plait {
namespace {

using PackedPose = std::array<float, 8>; // PLAIT_POSE_STRIDE float4

PackedPose pack(const plait_pose& p) {
    return {p.q[0], p.q[1], p.q[2], p.q[3], p.t[0], p.t[1], p.t[2], 0};
}

void copy_head(const plait_pose& head, float q[4], float t[4]) {
    std::copy_n(head.q, 4, q);
    std::copy_n(head.t, 3, t);
    t[3] = 0;
}

plait_roots_params roots_params(const plait_pose& from, const plait_pose& to, float alpha,
                                bool own) {
    plait_roots_params params{};
    copy_head(from, params.head_from_q, params.head_from_t);
    copy_head(to, params.head_to_q, params.head_to_t);
    params.alpha = alpha;
    params.per_root = own;
    return params;
}

} // namespace

Status Roots::make_buffers(Device& device) {
    if (at_.poses)
        return {};
    const std::pmr::vector<PackedPose> identities(layout_.guides, pack(identity_pose), memory_);
    std::array<Buffer, 4> made;
    for (Buffer& buffer : made) {
        PLAIT_TRY(
            device.create(buffer, PLAIT_ELEMENT_FLOAT4, size_t{2} * layout_.guides, "root_poses"));
        PLAIT_TRY(device.upload(buffer, identities.data()));
    }
    for (size_t i = 0; i < made.size(); ++i)
        all_poses()[i]->poses = std::move(made[i]);
    return {};
}

Status Roots::clear_buffers(Device& device) {
    const std::pmr::vector<PackedPose> identities(layout_.guides, pack(identity_pose), memory_);
    for (const Poses* each : all_poses())
        if (each->poses)
            PLAIT_TRY(device.write(each->poses, identities.data()));
    return {};
}

Status Roots::aim(Device& device, const plait_pose& head, std::span<const plait_pose> own) {
    if (!own.empty())
        PLAIT_TRY(make_buffers(device));
    if (at_.poses) {
        std::pmr::vector<PackedPose> packed(layout_.guides, pack(identity_pose), memory_);
        std::transform(own.begin(), own.end(), packed.begin(), pack);
        PLAIT_TRY(device.upload(target_.poses, packed.data()));
    }
    target_.head = head;
    target_.own = !own.empty();
    aimed = true;
    return {};
}

Result<const Buffer*> Roots::target_poses(Device& device) {
    PLAIT_TRY(make_buffers(device));
    return &target_.poses;
}

void Roots::aim_at_target_poses(const plait_pose& head) {
    target_.head = head;
    target_.own = true;
    aimed = true;
}

void Roots::add(Schedule& schedule, const Poses& from, const Poses& to, float alpha,
                const Buffer& pose) const {
    const bool own = from.own || to.own;
    schedule.add(PLAIT_STAGE_roots, layout_.guides, roots_params(from.head, to.head, alpha, own),
                 {own ? &from.poses : nullptr, own ? &to.poses : nullptr, &pose});
}

void Roots::advance(double end) {
    std::swap(from_, to_);
    to_.head = interpolate(at_.head, goal().head, end);
    const bool was_own = to_.own;
    to_.own = at_.own || goal().own;
    fill_ = to_.own || was_own; // else the buffer, if there is one, holds identities already
    end_ = static_cast<float>(end);
}

void Roots::append_path(Schedule& schedule) const {
    if (fill_)
        schedule.add(PLAIT_STAGE_roots, layout_.guides,
                     roots_params(identity_pose, identity_pose, end_, true),
                     {&at_.poses, &goal().poses, &to_.poses});
}

void Roots::append_poses(Schedule& schedule, float alpha, const Buffer& pose) const {
    add(schedule, from_, to_, alpha, pose);
}

void Roots::arrive() {
    if (aimed)
        std::swap(at_, target_);
    aimed = false;
}

void Roots::append_poses_now(Schedule& schedule, const Buffer& pose) const {
    add(schedule, at_, at_, 1, pose);
}

std::array<float, 3> Roots::head_moves(const float p[3]) const {
    std::array<float, 3> from{}, to{};
    transform(from_.head, p, from.data());
    transform(to_.head, p, to.data());
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

void Roots::stop(Schedule& schedule) {
    for (int end = 0; end < 2; ++end) { // of the path: its begin is the end of the one before
        advance(0);
        append_path(schedule);
    }
}

} // namespace plait
