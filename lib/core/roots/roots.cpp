#include "core/roots/roots.hpp"

#include "base/hash.hpp"

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

plait_roots_params roots_params(const plait_pose* before, const plait_pose& from,
                                const plait_pose& to, float alpha, bool own) {
    plait_roots_params params{};
    copy_head(before ? *before : from, params.head_before_q, params.head_before_t);
    params.bends = before ? 1 : 0;
    copy_head(from, params.head_from_q, params.head_from_t);
    copy_head(to, params.head_to_q, params.head_to_t);
    params.alpha = alpha;
    params.per_root = own;
    return params;
}

std::array<float, 3> way_of(const plait_pose& from, const plait_pose& to, const float p[3]) {
    std::array<float, 3> begin{}, end{};
    transform(from, p, begin.data());
    transform(to, p, end.data());
    return {end[0] - begin[0], end[1] - begin[1], end[2] - begin[2]};
}

} // namespace

Status Roots::make_buffers(Device& device) {
    if (at_.poses)
        return {};
    const std::pmr::vector<PackedPose> identities(layout_.guides, pack(identity_pose), memory_);
    std::array<Buffer, 5> made;
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

Status Roots::aim(Device& device, const plait_pose& head, std::span<const plait_pose> own,
                  float scale) {
    if (!own.empty())
        PLAIT_TRY(make_buffers(device));
    if (at_.poses) {
        std::pmr::vector<PackedPose> packed(layout_.guides, pack(identity_pose), memory_);
        std::transform(own.begin(), own.end(), packed.begin(),
                       [&](const plait_pose& pose) { return pack(in_units(pose, scale)); });
        PLAIT_TRY(device.upload(target_.poses, packed.data()));
        Hash hash;
        hash.add(packed.data(), packed.size() * sizeof packed[0]);
        target_.given = hash.value();
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

void Roots::aim_at_target_poses(const plait_pose& head, uint64_t given) {
    target_.given = given;
    target_.head = head;
    target_.own = true;
    aimed = true;
}

void Roots::add(Schedule& schedule, const Poses* before, const Poses& from, const Poses& to,
                float alpha, const Buffer& pose) const {
    const bool own = from.own || to.own || (before && before->own);
    schedule.add(PLAIT_STAGE_roots, layout_.guides,
                 roots_params(before ? &before->head : nullptr, from.head, to.head, alpha, own),
                 {own && before ? &before->poses : nullptr, own ? &from.poses : nullptr,
                  own ? &to.poses : nullptr, &pose});
}

void Roots::advance(double end) {
    std::swap(before_, from_);
    std::swap(from_, to_);
    samples_ = std::min(samples_ + 1, 2u);
    to_.head = interpolate(at_.head, goal().head, end);
    const bool was_own = to_.own;
    to_.own = at_.own || goal().own;
    to_.given = at_.given == goal().given ? at_.given : 0;
    fill_ = to_.own || was_own; // else the buffer, if there is one, holds identities already
    end_ = static_cast<float>(end);
}

void Roots::append_path(Schedule& schedule) const {
    if (fill_)
        schedule.add(PLAIT_STAGE_roots, layout_.guides,
                     roots_params(nullptr, identity_pose, identity_pose, end_, true),
                     {nullptr, &at_.poses, &goal().poses, &to_.poses});
}

void Roots::append_poses(Schedule& schedule, float alpha, const Buffer& pose) const {
    const bool bend = bends() && alpha < 1; // it ends where the straight one does
    add(schedule, bend ? &before_ : nullptr, from_, to_, alpha, pose);
}

void Roots::append_poses_of(Schedule& schedule, const plait_pose& head, const Buffer& pose) const {
    const Buffer* own = from_.own ? &from_.poses : nullptr;
    schedule.add(PLAIT_STAGE_roots, layout_.guides, roots_params(nullptr, head, head, 1, from_.own),
                 {nullptr, own, own, &pose});
}

void Roots::append_between(Schedule& schedule, const Buffer& from, const Buffer& to, float share,
                           const Buffer& pose) const {
    schedule.add(PLAIT_STAGE_roots, layout_.guides,
                 roots_params(nullptr, identity_pose, identity_pose, share, true),
                 {nullptr, &from, &to, &pose});
}

void Roots::arrive() {
    if (aimed)
        std::swap(at_, target_);
    aimed = false;
}

void Roots::append_poses_now(Schedule& schedule, const Buffer& pose) const {
    add(schedule, nullptr, at_, at_, 1, pose);
}

std::array<float, 3> Roots::head_moves(const float p[3]) const {
    return way_of(from_.head, to_.head, p);
}

std::array<float, 3> Roots::call_moves(const float p[3]) const {
    return way_of(at_.head, goal().head, p);
}

void Roots::jump(Schedule& schedule, double end) {
    const plait_pose from = from_.head, to = to_.head;
    for (int k = 0; k < 2; ++k) { // the path's begin is the end of the one before
        advance(end);
        append_path(schedule);
    }
    from_.head = carried(from, to, to_.head);
    samples_ = 0;
}

Result<Roots::OwnPoses> Roots::read_own(Device& device, const Poses& poses) const {
    OwnPoses own(memory_);
    if (!poses.own)
        return own;
    std::pmr::vector<PackedPose> packed(layout_.guides, PackedPose{}, memory_);
    PLAIT_TRY(device.read(poses.poses, packed.data()));
    own.resize(packed.size());
    std::transform(packed.begin(), packed.end(), own.begin(), [](const PackedPose& p) {
        return plait_pose{{p[0], p[1], p[2], p[3]}, {p[4], p[5], p[6]}};
    });
    return own;
}

Result<HeadWays> Roots::rescale(Device& device, double ratio) {
    HeadWays ways;
    for (const auto& [poses, way] : {std::pair{&at_, &ways.at}, std::pair{&before_, &ways.before},
                                     std::pair{&from_, &ways.from}, std::pair{&to_, &ways.to}}) {
        auto own = read_own(device, *poses);
        if (!own)
            return own.error();
        std::array<double, 3> sum{};
        for (const plait_pose& pose : *own)
            for (size_t i = 0; i < 3; ++i)
                sum[i] += double(pose.t[i]);
        HeadWays::Way middle{}; // by how much it is elsewhere
        for (size_t i = 0; i < 3 && !own->empty(); ++i)
            middle[i] = static_cast<float>((ratio - 1) * sum[i] / double(own->size()));
        for (plait_pose& pose : *own)
            for (size_t i = 0; i < 3; ++i)
                pose.t[i] += middle[i];
        if (!own->empty()) {
            std::pmr::vector<PackedPose> packed(layout_.guides, PackedPose{}, memory_);
            std::transform(own->begin(), own->end(), packed.begin(), pack);
            PLAIT_TRY(device.upload(poses->poses, packed.data()));
            poses->given = 0;
        }
        const plait_pose was = poses->head;
        plait::rescale(poses->head, ratio);
        transform(poses->head, middle.data(), way->data());
        for (size_t i = 0; i < 3; ++i)
            (*way)[i] -= was.t[i];
    }
    return ways;
}

Status Roots::fill_next(Device& device, double share, const Buffer& pose) const {
    const auto before = read_own(device, before_), from = read_own(device, from_),
               to = read_own(device, to_);
    for (const auto* own : {&before, &from, &to})
        PLAIT_TRY(*own);
    const auto of = [](const OwnPoses& own, size_t root) {
        return own.empty() ? identity_pose : own[root];
    };
    const auto on_path = [&](const plait_pose& b, const plait_pose& f, const plait_pose& t) {
        return bends() ? on_parabola(b, f, t, share) : interpolate(f, t, share);
    };
    const auto after = [](const plait_pose& head, const plait_pose& own) {
        plait_pose root{};
        rotation_product(head, own, root.q);
        transform(head, own.t, root.t);
        return root;
    };
    const plait_pose head = on_path(before_.head, from_.head, to_.head);
    std::pmr::vector<PackedPose> packed(layout_.guides, PackedPose{}, memory_);
    for (size_t root = 0; root < packed.size(); ++root) {
        const plait_pose own = of(*to, root);
        const plait_pose was = after(head, on_path(of(*before, root), of(*from, root), own));
        const plait_pose now = after(to_.head, own);
        packed[root] = pack(carried(now, was, now));
    }
    return device.upload(pose, packed.data());
}

void Roots::carry(const plait_pose& motion) {
    for (Poses* poses : {&before_, &from_, &to_})
        poses->head = carried(poses->head, identity_pose, motion);
}

} // namespace plait
