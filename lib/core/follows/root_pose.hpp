// Poses of roots in double precision, on the host.
#pragma once

#include "core/base/pose.hpp"

#include <Eigen/Geometry>

namespace plait {

struct RootPose {
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();

    Eigen::Vector3d apply(const Eigen::Vector3d& p) const { return q * p + t; }
    Eigen::Vector3d undo(const Eigen::Vector3d& p) const { return q.conjugate() * (p - t); }
};

// Of a strand, in the groom's units.
inline RootPose pose_of(const RootPoses& roots, size_t strand) {
    const auto of = [&](const plait_pose& given) -> RootPose {
        const plait_pose pose = in_units(given, roots.scale);
        return {Eigen::Quaterniond(Eigen::Vector4f(pose.q).cast<double>()).normalized(),
                Eigen::Vector3f(pose.t).cast<double>()};
    };
    const RootPose head = of(roots.head);
    if (roots.own.empty())
        return head;
    const RootPose own = of(roots.own[strand]);
    return {head.q * own.q, head.apply(own.t)};
}

} // namespace plait
