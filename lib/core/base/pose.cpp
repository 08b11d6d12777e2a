#include "core/base/pose.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plait {

plait_pose in_units(const plait_pose& pose, float scale) {
    plait_pose own = pose;
    for (float& t : own.t)
        t /= scale;
    return own;
}

void rescale(plait_pose& pose, double ratio) {
    for (float& t : pose.t)
        t = static_cast<float>(ratio * t);
}

bool same_pose(const plait_pose& a, const plait_pose& b) {
    return std::equal(a.q, a.q + 4, b.q) && std::equal(a.t, a.t + 3, b.t);
}

Result<plait_pose> checked_pose(const plait_pose& pose, const char* name) {
    for (const float t : pose.t)
        if (!std::isfinite(t) || std::abs(t) > 1e6f)
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("%s: translation %g is outside [-1e6, 1e6] m", name, double(t))};
    const double norm = std::sqrt(double(pose.q[0]) * pose.q[0] + double(pose.q[1]) * pose.q[1] +
                                  double(pose.q[2]) * pose.q[2] + double(pose.q[3]) * pose.q[3]);
    if (!(std::abs(norm - 1) <= 1e-3))
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("%s: quaternion norm is %g, range is 1 +- 0.001", name, norm)};
    plait_pose unit = pose;
    for (float& q : unit.q)
        q = static_cast<float>(q / norm);
    return unit;
}

plait_pose interpolate(const plait_pose& from, const plait_pose& to, double share) {
    if (share <= 0 || share >= 1)
        return share <= 0 ? from : to;
    plait_pose pose = from;
    for (size_t i = 0; i < 3; ++i)
        pose.t[i] = static_cast<float>((1 - share) * from.t[i] + share * to.t[i]);
    if (std::equal(from.q, from.q + 4, to.q))
        return pose; // normalised again it would turn by a rounding
    double dot = 0;
    for (size_t i = 0; i < 4; ++i)
        dot += double(from.q[i]) * to.q[i];
    // At one angular velocity: a call may be long, and steps that end in it would go unevenly on a chord.
    const double angle = std::acos(std::min(std::abs(dot), 1.0));
    const bool turns = angle > 1e-3;
    const double before = turns ? std::sin((1 - share) * angle) : 1 - share;
    const double after = std::copysign(turns ? std::sin(share * angle) : share, dot);
    double q[4];
    double square = 0;
    for (size_t i = 0; i < 4; ++i) {
        q[i] = before * from.q[i] + after * to.q[i];
        square += q[i] * q[i];
    }
    const double norm = std::sqrt(square);
    for (size_t i = 0; i < 4; ++i)
        pose.q[i] = static_cast<float>(q[i] / norm);
    return pose;
}

plait_pose on_parabola(const plait_pose& before, const plait_pose& from, const plait_pose& to,
                       double share) {
    if (share <= 0 || share >= 1)
        return share <= 0 ? from : to;
    const plait_pose* const poses[] = {&before, &from, &to};
    const double weights[] = {0.5 * share * (share - 1), 1 - share * share,
                              0.5 * share * (share + 1)};
    double q[4] = {}, t[3] = {};
    for (size_t k = 0; k < 3; ++k) {
        double dot = 0;
        for (size_t i = 0; i < 4; ++i)
            dot += double(from.q[i]) * poses[k]->q[i];
        for (size_t i = 0; i < 4; ++i)
            q[i] += (dot < 0 ? -weights[k] : weights[k]) * poses[k]->q[i];
        for (size_t i = 0; i < 3; ++i)
            t[i] += weights[k] * poses[k]->t[i];
    }
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    plait_pose pose = from;
    for (size_t i = 0; i < 3; ++i)
        pose.t[i] = static_cast<float>(t[i]);
    if (std::equal(from.q, from.q + 4, to.q) && std::equal(from.q, from.q + 4, before.q))
        return pose; // normalised again it would turn by a rounding
    for (size_t i = 0; i < 4; ++i)
        pose.q[i] = static_cast<float>(q[i] / norm);
    return pose;
}

plait_pose carried(const plait_pose& pose, const plait_pose& from, const plait_pose& to) {
    plait_pose moved = pose;
    float turned[4], offset[3];
    turn(from, to, turned);
    const plait_pose by = {{turned[0], turned[1], turned[2], turned[3]}, {}};
    rotation_product(by, pose, moved.q);
    const float way[3] = {pose.t[0] - from.t[0], pose.t[1] - from.t[1], pose.t[2] - from.t[2]};
    transform(by, way, offset);
    for (size_t i = 0; i < 3; ++i)
        moved.t[i] = to.t[i] + offset[i];
    return moved;
}

plait_carry_params carry_params(const plait_pose& motion, uint32_t row, uint32_t tile,
                                bool history) {
    plait_carry_params params{row, tile, history ? 1u : 0u, 0, {}, {}};
    params.turns = std::equal(motion.q, motion.q + 4, identity_pose.q) ? 0 : 1;
    std::copy_n(motion.q, 4, params.q);
    std::copy_n(motion.t, 3, params.t);
    return params;
}

void rotation_product(const plait_pose& after, const plait_pose& first, float out[4]) {
    const double a[4] = {after.q[0], after.q[1], after.q[2], after.q[3]};
    const double b[4] = {first.q[0], first.q[1], first.q[2], first.q[3]};
    const double q[4] = {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
                         a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
                         a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0],
                         a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (size_t i = 0; i < 4; ++i)
        out[i] = static_cast<float>(q[i] / norm);
}

void turn(const plait_pose& from, const plait_pose& to, float out[4]) {
    const plait_pose back = {{-from.q[0], -from.q[1], -from.q[2], from.q[3]}, {}};
    rotation_product(to, back, out);
    if (std::equal(from.q, from.q + 4, to.q))
        std::copy_n(identity_pose.q, 4, out);
}

void transform(const plait_pose& pose, const float p[3], float out[3]) {
    const float* q = pose.q;
    const float u[3] = {2 * (q[1] * p[2] - q[2] * p[1]), 2 * (q[2] * p[0] - q[0] * p[2]),
                        2 * (q[0] * p[1] - q[1] * p[0])};
    const float v[3] = {p[0] + q[3] * u[0] + q[1] * u[2] - q[2] * u[1],
                        p[1] + q[3] * u[1] + q[2] * u[0] - q[0] * u[2],
                        p[2] + q[3] * u[2] + q[0] * u[1] - q[1] * u[0]};
    for (size_t i = 0; i < 3; ++i)
        out[i] = v[i] + pose.t[i];
}

bool goes_along(const plait_pose& head_before, const plait_pose& body_before,
                const plait_pose& head_after, const plait_pose& body_after) {
    constexpr float least = 1e-4f, rounding = 1e-6f; // m; of a coordinate
    const plait_pose back = {
        {-head_before.q[0], -head_before.q[1], -head_before.q[2], head_before.q[3]}, {}};
    constexpr float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto& point : points) {
        float was[3], own[3], carried[3], is[3];
        transform(body_before, point, was);
        for (size_t i = 0; i < 3; ++i)
            was[i] -= head_before.t[i];
        transform(back, was, own);
        transform(head_after, own, carried);
        transform(body_after, point, is);
        for (size_t i = 0; i < 3; ++i) {
            const float size = std::max(std::abs(head_before.t[i]), std::abs(is[i]));
            if (!(std::abs(carried[i] - is[i]) <= least + rounding * size))
                return false;
        }
    }
    return true;
}

} // namespace plait
