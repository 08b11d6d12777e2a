// float64 vectors, poses and two conventions of docs/backends.md: n(x) and the shortest-arc turn.
#pragma once

#include "backend/reference/base/view.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <plait/params.h>

#include <cmath>

namespace plait::reference {

using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Quat = Eigen::Quaterniond;

inline Vec3 xyz(const Vec4& v) {
    return v.head<3>();
}
inline void set_xyz(Vec4& v, const Vec3& p) {
    v.head<3>() = p;
}
// What pulls at a vertex, m/s^2: none of it where a component is not finite or out of range.
inline Vec3 checked_acceleration(const Vec4& a) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(a[c]) <= double(PLAIT_MOST_ACCELERATION)))
            return Vec3::Zero();
    return xyz(a);
}
inline Vec4 with_w(const Vec3& p, double w) {
    return {p.x(), p.y(), p.z(), w};
}
inline Vec3 vec3(const float* v) {
    return {v[0], v[1], v[2]};
}
inline Quat quat(const float* q) {
    return {q[3], q[0], q[1], q[2]};
}
inline Quat quat(const Vec4& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

inline bool pinned(const Vec4& position) {
    return position.w() == 0;
}

// n(x): the direction of x, and 0 for 0.
inline Vec3 direction(const Vec3& x) {
    const double length = x.norm();
    return length > 0 ? Vec3(x / length) : Vec3::Zero();
}

// The shortest arc that takes the direction of `from` to that of `to`; the identity if either is 0.
// Opposite directions leave the axis open: a half turn about the normal to n(from) and to the
// coordinate axis of n(from)'s smallest component.
inline Quat turn(const Vec3& from, const Vec3& to) {
    if (from.isZero(0) || to.isZero(0))
        return Quat::Identity();
    const Vec3 a = direction(from), b = direction(to);
    Quat q;
    q.w() = 1 + a.dot(b);
    q.vec() = a.cross(b);
    if (q.w() > 1e-12) // half the squared length of a + b
        return q.normalized();
    Eigen::Index smallest;
    a.cwiseAbs().minCoeff(&smallest);
    q.w() = 0;
    q.vec() = direction(a.cross(Vec3::Unit(smallest)));
    return q;
}

// Maps rest space to the world.
struct Pose {
    Quat q = Quat::Identity();
    Vec3 t = Vec3::Zero();

    Vec3 apply(const Vec3& p) const { return q * p + t; }
    Vec3 invert(const Vec3& x) const { return q.conjugate() * (x - t); }
};

inline Pose pose_of(const View<const Vec4>& poses, size_t strand) {
    return {quat(poses[2 * strand]), xyz(poses[2 * strand + 1])};
}

inline void store_pose(const View<Vec4>& poses, size_t strand, const Pose& pose) {
    poses[2 * strand] = pose.q.coeffs(); // (x, y, z, w)
    poses[2 * strand + 1] = with_w(pose.t, 0);
}

} // namespace plait::reference
