// Source: Li et al. 2020 (friction lagged in a potential).
#include "backend/reference/contact/contact.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plait::reference {

Contacts::Contacts(const plait_lane_params& params, const View<const Vec4>& colliders,
                   const Motion& motion, std::vector<double> length, std::vector<double> stretch,
                   std::vector<double> mass, std::vector<std::optional<MeshPlane>> planes,
                   std::vector<Hollow> hollows)
    : params_(params), colliders_(colliders), motion_(motion), length_(std::move(length)),
      stretch_(std::move(stretch)), mass_(std::move(mass)), arc_(length_.size()),
      planes_(std::move(planes)), hollows_(std::move(hollows)), at_(params.vertex_stride) {
    std::partial_sum(length_.begin(), length_.end(), arc_.begin());
}

Vec3 Contacts::slip_of(const Contact& at, const Vec3& x) const {
    return (Mat3::Identity() - at.normal * at.normal.transpose()) * (x - at.anchor);
}

void Contacts::press(const std::vector<Vec3>& x) {
    for (size_t i = 1; i < x.size(); ++i)
        at_[i].push = at_[i].stiffness * std::max(at_[i].offset - at_[i].normal.dot(x[i]), 0.0);
}

bool Contacts::touching() const {
    return std::any_of(at_.begin(), at_.end(), [](const Contact& at) { return at.stiffness > 0; });
}

// Across the direction of slip friction turns as mu N/|u|; along it, it stays as it is.
Mat3 Contacts::hessian(size_t vertex, const Vec3& x) const {
    const Contact& at = at_[vertex];
    const Mat3 n = at.normal * at.normal.transpose(), d = at.slide * at.slide.transpose();
    const double length =
        at.sticks() ? at.grip : std::max(slip_of(at, x).norm(), double(params_.contact_slip));
    return at.stiffness * n + at.friction * at.push / length * (Mat3::Identity() - n - d);
}

Vec3 Contacts::force(size_t vertex, const Vec3& x) const {
    const Contact& at = at_[vertex];
    const Vec3 direction = at.sticks() ? Vec3(slip_of(at, x) / at.grip) : at.slide;
    return -at.stiffness * (at.normal.dot(x) - at.offset) * at.normal -
           at.friction * at.push * direction;
}

double Contacts::model(size_t vertex, const Vec3& x) const {
    const Contact& at = at_[vertex];
    const double depth = std::max(at.offset - at.normal.dot(x), 0.0), e = params_.contact_slip;
    const Vec3 u = slip_of(at, x);
    const double along = at.slide.dot(u), across = (u - along * at.slide).squaredNorm();
    const double reach = at.sticks() ? at.grip : std::max(u.norm(), e);
    return at.stiffness / 2 * depth * depth +
           at.friction * at.push * (along + across / (2 * reach));
}

void Contacts::aim(std::vector<Vec3> y) {
    y_ = std::move(y);
    for (size_t i = 1; i < planes_.size(); ++i)
        if (planes_[i]) {
            const Vec3 way = planes_[i]->anchor - (motion_.start[i] - motion_.start[0]);
            along_ = along_ && way.norm() <= PLAIT_MESH_ROOM;
        }
}

// From the nearest place on its way from `begin` to its inertial target.
Vec3 Contacts::off_way(size_t vertex, const Vec3& begin, const Vec3& p) const {
    const Vec3 way = y_[vertex] - begin;
    const double share = way.dot(p - begin) / std::max(way.squaredNorm(), 1e-30);
    return p - begin - std::clamp(share, 0.0, 1.0) * way;
}

Vec3 Contacts::astray(size_t vertex, const Vec3& p) const {
    return off_way(vertex, motion_.start[vertex] - motion_.start[0], p);
}

namespace {

// No farther off than `most`.
Vec3 kept(const Vec3& to, const Vec3& off, double most) {
    return off.norm() > most ? Vec3(to - (1 - most / off.norm()) * off) : to;
}

} // namespace

// A mesh that goes along with the root and gave the vertex no plane is farther than PLAIT_MESH_ROOM from all of its
// way; a sheet is as far as it says.
Vec3 Contacts::within(size_t vertex, const Vec3& to) const {
    if (y_.empty() || of_strands())
        return to;
    Vec3 p = to;
    if (along_ && !planes_.empty() && !planes_[vertex]) {
        const auto next = planes_.begin() + static_cast<std::ptrdiff_t>(vertex) + 1;
        if (std::any_of(next, planes_.end(), [](const auto& plane) { return plane.has_value(); }))
            p = kept(p, astray(vertex, p), PLAIT_MESH_ROOM);
    }
    if (!hollows_.empty() && hollows_[vertex].room)
        p = kept(p, off_way(vertex, hollows_[vertex].begin, p), *hollows_[vertex].room);
    return p;
}

Vec3 Contacts::lifted(size_t vertex, const Vec3& to) const {
    const Contact& at = at_[vertex];
    return at.stiffness > 0 ? Vec3(to + std::max(at.offset - at.normal.dot(to), 0.0) * at.normal)
                            : to;
}

// From the depth `begin` on, of the spring that is stiff all along, but holds no more than at the
// depth from which on a vertex counts as started inside.
double Contacts::released(size_t vertex, const Vec3& x, double begin) const {
    const Contact& at = at_[vertex];
    const double most = PLAIT_CONTACT_TOLERANCE * length_[vertex];
    const double before = std::clamp(begin, 0.0, most);
    const double after = std::clamp(at.offset - at.normal.dot(x), 0.0, most);
    return mass_[vertex] * params_.contact_rate / 2 * (before * before - after * after);
}

double Contacts::work(const std::vector<Vec3>& x) const {
    double sum = 0;
    for (size_t i = 1; i < x.size(); ++i) {
        const Contact& at = at_[i];
        if (at.stiffness == 0)
            continue;
        const Vec3 way = params_.h / motion_.h * (at.anchor - motion_.from[i]);
        const double push = at.stiffness * std::max(at.offset - at.normal.dot(x[i]), 0.0);
        const double rise = at.normal.dot(way);
        const double pushed = push * rise + released(i, x[i], at.begin);
        const double own = mass_[i] / 2 * rise * rise / (motion_.h * motion_.h);
        sum += of_strands() ? std::min(pushed, own) // another strand's own speed
                            : pushed + at.friction * at.push * (way - rise * at.normal).norm();
    }
    return sum;
}

double Contacts::work_of_new(const std::vector<Vec3>& x) const {
    double sum = 0;
    for (size_t i = 1; i < x.size(); ++i)
        if (at_[i].stiffness > 0 && at_[i].push == 0)
            sum += released(i, x[i], 0);
    return sum;
}

void Contacts::store(const Lane& lane, const LaneState& state, const std::vector<Vec3>& x,
                     const std::vector<Vec3>& solved) const {
    motion_.store(lane, state, x, solved);
    const Vec3 root_start = motion_.root + motion_.start[0];
    for (size_t i = 1; i < x.size(); ++i) {
        const Contact& at = at_[i];
        const Vec3 surface = (at.anchor - motion_.start[i]) / params_.h;
        Vec3 v = lane.vector(state.v, i);
        if (!(at.stiffness > 0 && (at.push > 0 || at.normal.dot(v - surface) < 0)))
            continue;
        v += at.normal.dot(surface - v) * at.normal;
        lane.store(state.v, i, v);
        if (!params_.bdf2)
            continue;
        // The step before becomes one that leads to this one: all of it where the vertex sticks,
        // else what is normal to the surface.
        const Mat3 part =
            at.sticks() ? Mat3(Mat3::Identity()) : Mat3(at.normal * at.normal.transpose());
        const Vec3 v_before = lane.vector(state.v_before, i);
        const Vec3 x_before = lane.vector(state.x_before, i);
        const Vec3 x_led = motion_.root + x[i] - params_.h * v - root_start;
        lane.store(state.v_before, i,
                   Vec3(v_before + part * ((at.sticks() ? v : surface) - v_before)));
        lane.store(state.x_before, i, Vec3(x_before + part * (x_led - x_before)));
    }
}

} // namespace plait::reference
