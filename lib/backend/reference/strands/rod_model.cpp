#include "backend/reference/strands/rod_model.hpp"

#include <plait/constants.h>

#include <algorithm>

namespace plait::reference {
namespace {

// Share of the last turn that an orientation starts with.
double repeated(const plait_lane_params& params) {
    return params.bdf2 ? PLAIT_ROD_EXTRAPOLATION_BDF2 : PLAIT_ROD_EXTRAPOLATION;
}

double dot(const Quat& a, const Quat& b) {
    return a.coeffs().dot(b.coeffs());
}

const Quat unit_x(0, 1, 0, 0), unit_z(0, 0, 0, 1);

// b such that -<q, b> is, but for a constant, the tangent at q of
//   k_x <q, along>^2/2 + k_z <q, across>^2/2 - m |q|^2/2,  m = max(k_x, k_z, 0),
// which is concave and on the unit sphere the section's energy but for a constant.
Vec4 section_pull(const Vec3& k, const Quat& q, const Quat& along, const Quat& across) {
    const double m = std::max({k.x(), k.z(), 0.0});
    return m * q.coeffs() - k.x() * dot(q, along) * along.coeffs() -
           k.z() * dot(q, across) * across.coeffs();
}

} // namespace

RodModel::RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot,
                   bool inextensible)
    : RodModel(buffers, params, slot, strand_of(buffers.lane_strand, slot), inextensible) {}

RodModel::RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot,
                   size_t strand, bool inextensible)
    : inextensible_(inextensible), params_(&params), lane_(slot, params.vertex_stride, params.tile),
      motion_(lane_, params, buffers.state,
              root_of(buffers.rest, pose_of(buffers.pose, strand), strand, params.row_stride)),
      root_frame_(pose_of(buffers.pose, strand).q) {
    const double repeat = repeated(params);
    for (uint32_t i = 0; i < params.vertex_stride; ++i) {
        const auto material = [&](size_t component) {
            return buffers.material[lane_.index(i, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
        };
        mass_.push_back(material(PLAIT_LANE_MASS));
        if (i + 1 == params.vertex_stride)
            break;
        length_.push_back(material(PLAIT_LANE_LENGTH));
        stretch_.push_back(material(PLAIT_LANE_STRETCH));
        bend_.push_back(material(PLAIT_LANE_BEND));
        section_.emplace_back(material(PLAIT_LANE_TWIST), 0, material(PLAIT_LANE_CROSS));
        rest_.push_back(lane_.rotation(buffers.rest_rotation, i));
        // Start from the present orientation turned on by most of the last step's turn.
        const Quat now = lane_.rotation(buffers.q, i), before = lane_.rotation(buffers.q_before, i);
        q.push_back(
            Quat(Vec4(now.coeffs() + repeat * (now.coeffs() - before.coeffs()))).normalized());
        q_start_.push_back(now.normalized()); // float32 rounds it
        q_before_.push_back(before.normalized());
    }
    for (size_t i = 0; i < mass_.size(); ++i)
        x.push_back(motion_.goal(i, mass_[i]));
    length_before_.assign(1, 0.0);
    length_before_.insert(length_before_.end(), length_.begin(), length_.end());
    std::vector<double> stretch_before(1, 0.0);
    stretch_before.insert(stretch_before.end(), stretch_.begin(), stretch_.end());
    if (inextensible)
        leave_out_stretch();
    if (params.collider_count == 0 && !params.planes)
        return;
    contacts_ = std::make_shared<Contacts>(params, buffers.colliders, motion_, length_before_,
                                           stretch_before, mass_,
                                           mesh_planes_of(lane_, params, buffers.state.plane));
}

// Vertices past the tip lie on it: nothing may pull there.
void RodModel::leave_out_stretch() {
    std::fill(stretch_.begin(), stretch_.end(), 0.0);
    for (size_t i = 1; i < mass_.size(); ++i)
        if (length_before_[i] == 0)
            mass_[i] = 0;
}

void RodModel::renew_contacts() {
    if (contacts_)
        contacts_->renew(x);
}

void RodModel::shorten(double share) {
    if (share == 1)
        return;
    const std::vector<Vec3> start = motion_.relative_start();
    for (size_t i = 1; i < x.size(); ++i)
        x[i] = start[i] + share * (x[i] - start[i]);
    for (size_t i = 0; i < segments(); ++i)
        q[i] = Quat(Vec4((1 - share) * q_start_[i].coeffs() + share * q[i].coeffs())).normalized();
    if (inextensible_)
        rebuild();
}

double RodModel::strain_limit() const {
    double mass = 0;
    for (size_t i = 1; i < mass_.size(); ++i)
        mass += length_before_[i] > 0 ? mass_[i] : 0; // none past the tip
    return std::max(PLAIT_ROD_MAX_ACCELERATION * mass / (stretch_[0] * length_[0]), least_limit_);
}

// Planes are stiffer than EA, and a solve that is cut short does not let what they push run to the
// root; so lengths go before depth. What is moved keeps its depth where the sphere around the
// vertex before it allows it. Orientations stay: the next solve turns them.
void RodModel::hold_lengths() {
    const double limit = strain_limit();
    for (size_t i = 0; i < segments(); ++i) {
        const Vec3 solved = x[i + 1], edge = solved - x[i];
        const double size = edge.norm();
        const double held = std::clamp(size, (1 - limit) * length_[i], (1 + limit) * length_[i]);
        if (length_[i] > 0 && held != size)
            x[i + 1] = contacts_->keep_off(i + 1, x[i], held, solved,
                                           x[i] + held * reference::direction(edge));
    }
}

void RodModel::store(const RodBuffers& buffers) {
    double given = 0;
    if (contacts_) {
        given = contacts_->work(x);
        if (inextensible_)
            contacts_->press(x); // where there is no room, depth gives way, not length
        else
            contacts_->clip(x);
        if (touched() && least_limit_ > 0)
            hold_lengths();
        given += contacts_->work_of_new(x);
    }
    std::vector<Vec3> v = motion_.velocities(x);
    const Substep substep{*params_, motion_, mass_, length_before_};
    given += counts_pairs(substep) ? released_of_pairs() : released();
    const Limit limit = limit_energy(substep, given, x, v);
    if (!touched())
        shorten(limit.way);
    if (contacts_)
        contacts_->store(lane_, buffers.state, x, v);
    else
        motion_.store(lane_, buffers.state, x, v);
    if (params_->bdf2)
        limit.apply_before(lane_, buffers.state, x.size());
    // The turn that the next substep repeats loses what the velocities lost; BDF2's remembers
    // strains.
    const double repeats = params_->bdf2 ? 1 : limit.share;
    for (size_t i = 0; i < segments(); ++i) {
        lane_.store(buffers.q, i, q[i]);
        const Vec4 turn = q[i].coeffs() - q_start_[i].coeffs();
        lane_.store(buffers.q_before, i, Quat(Vec4(q[i].coeffs() - repeats * turn)));
    }
}

Quat RodModel::expected(size_t segment) const {
    return (segment == 0 ? root_frame_ : q[segment - 1]) * rest_[segment];
}

Vec3 RodModel::strain(size_t segment) const {
    return x[segment + 1] - x[segment] - length_[segment] * director(segment);
}

double RodModel::elastic(const std::vector<Vec3>& at, const std::vector<Quat>& turned) const {
    double sum = 0;
    for (size_t i = 0; i < segments(); ++i) {
        const Quat from = (i == 0 ? root_frame_ : turned[i - 1]) * rest_[i];
        const Vec3 bent = (from.conjugate() * turned[i]).vec();
        const Vec3 strain = at[i + 1] - at[i] - length_[i] * (turned[i] * Vec3::UnitX());
        sum += stretch_[i] / 2 * strain.squaredNorm() +
               bend_[i] * (1 - std::abs(dot(turned[i], from))) +
               bent.dot(section_[i].cwiseProduct(bent)) / 2;
    }
    return sum;
}

// Before and after relative to the root of their time, both clamped as after.
double RodModel::released() const {
    const std::vector<Vec3> start = motion_.relative_start();
    return elastic(start, q_start_) - elastic(x, q);
}

RodModel::JointStrain RodModel::joint_strain(size_t segment, const std::vector<Vec3>& at,
                                             const std::vector<Quat>& turned, double side) const {
    const Quat from = (segment == 0 ? root_frame_ : turned[segment - 1]) * rest_[segment];
    const Quat& to = turned[segment];
    return {at[segment + 1] - at[segment] - length_[segment] * (to * Vec3::UnitX()),
            to.coeffs() - side * from.coeffs(), (from.conjugate() * to).vec(), dot(to, from)};
}

double RodModel::released_of_pairs() const {
    const std::vector<Vec3> start = motion_.relative_start();
    double sum = 0;
    for (size_t i = 0; i < segments(); ++i) {
        const double side = std::copysign(1.0, dot(q[i], expected(i)));
        const JointStrain now = joint_strain(i, x, q, side);
        const JointStrain then = joint_strain(i, start, q_start_, side);
        const JointStrain before = joint_strain(i, motion_.x_before, q_before_, side);
        const auto lost = [&](const auto& a, const auto& b, const auto& c) {
            return held(true, b, c) - held(true, a, b);
        };
        sum += stretch_[i] * lost(now.stretch, then.stretch, before.stretch);
        // What turned past half a turn has another energy altogether.
        const bool flipped = side * then.cosine < 0 || side * before.cosine < 0;
        sum += bend_[i] * (flipped ? std::abs(now.cosine) - std::abs(then.cosine)
                                   : lost(now.bend, then.bend, before.bend));
        const Vec3 k = section_[i];
        for (const int axis : {0, 2}) {
            using Scalar = Eigen::Matrix<double, 1, 1>;
            sum += k[axis] * lost(Scalar(now.section[axis]), Scalar(then.section[axis]),
                                  Scalar(before.section[axis]));
        }
    }
    return sum;
}

Vec3 RodModel::vertex_force(size_t vertex) const {
    const double mu = mass_[vertex] * motion_.inertia;
    return mu * (motion_.y[vertex] - x[vertex]) + motion_.pin[vertex].force(x[vertex]);
}

double RodModel::vertex_stiffness(size_t vertex) const {
    return mass_[vertex] * motion_.inertia + motion_.pin[vertex].stiffness;
}

// Less what the two pull at each other, which no solve changes.
double RodModel::vertex_energy(size_t vertex) const {
    const Vec3 lag = x[vertex] - motion_.goal(vertex, mass_[vertex]);
    return vertex_stiffness(vertex) / 2 * lag.squaredNorm();
}

double RodModel::energy() const {
    double sum = elastic(x, q);
    for (size_t i = 0; i < segments(); ++i)
        sum += vertex_energy(i + 1);
    for (size_t i = 1; contacts_ && i < x.size(); ++i)
        sum += inextensible_ ? contacts_->model(i, x[i]) : contacts_->energy(i, x[i]);
    return sum;
}

// The energy is quadratic in x, also in contact: with the terms of the last renewal. Only contact
// couples the coordinates; without, there is one linear system with three right-hand sides.
void RodModel::solve_positions() {
    const bool touches = contacts_ && contacts_->touching();
    const auto n = static_cast<Eigen::Index>(segments());
    const Eigen::Index d = touches ? 3 : 1; // unknowns per vertex
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(d * n, d * n);
    Eigen::MatrixXd force = Eigen::MatrixXd::Zero(n, 3); // minus the gradient at x
    const auto block = [&](Eigen::Index i, Eigen::Index k) {
        return hessian.block(d * i, d * k, d, d);
    };
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(d, d);
    for (Eigen::Index i = 0; i < n; ++i) { // unknown i is vertex i + 1
        const Vec3 pull = stretch_[i] * strain(i);
        block(i, i) += (vertex_stiffness(i + 1) + stretch_[i]) * one;
        force.row(i) += vertex_force(i + 1) - pull;
        if (touches) {
            block(i, i) += contacts_->hessian(i + 1, x[i + 1]);
            force.row(i) += contacts_->force(i + 1, x[i + 1]);
        }
        if (i == 0)
            continue;
        block(i - 1, i - 1) += stretch_[i] * one;
        block(i, i - 1) -= stretch_[i] * one;
        block(i - 1, i) -= stretch_[i] * one;
        force.row(i - 1) += pull;
    }
    // Rows of vertices one after the other where the coordinates are coupled.
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Rows correction = force;
    Eigen::Map<Rows> unknowns(correction.data(), d * n, touches ? 1 : 3);
    unknowns = hessian.ldlt().solve(Eigen::MatrixXd(unknowns));
    for (Eigen::Index i = 0; i < n; ++i)
        x[i + 1] += correction.row(i);
}

// q minimises -EA <edge, t> - <q, b>: q ~ v b e + lambda b, with v = -2 EA edge, b the neighbours'
// pull and what their sections add, and lambda the root of lambda^2 = |v|^2 + |v b e + lambda b|: a
// fixed point that draws from |v| + |b| by half a step at least.
void RodModel::sweep_orientations() {
    for (size_t i = 0; i < segments(); ++i) {
        const Quat from_root = expected(i);
        Vec4 pull = bend_[i] * std::copysign(1.0, dot(q[i], from_root)) * from_root.coeffs();
        if (i + 1 < segments()) {
            const Quat from_tip = q[i + 1] * rest_[i + 1].conjugate();
            pull += bend_[i + 1] * std::copysign(1.0, dot(q[i], from_tip)) * from_tip.coeffs();
            const Quat back = rest_[i + 1].conjugate();
            if (sweeps_sections_)
                pull += section_pull(section_[i + 1], q[i], q[i + 1] * unit_x * back,
                                     q[i + 1] * unit_z * back);
        }
        if (sweeps_sections_)
            pull += section_pull(section_[i], q[i], from_root * unit_x, from_root * unit_z);
        Quat v, b(pull);
        v.w() = 0;
        v.vec() = -2 * stretch_[i] * length_[i] * (x[i + 1] - x[i]);
        const Vec4 turned = (v * b * Quat(0, 1, 0, 0)).coeffs();
        double lambda = v.norm() + b.norm();
        for (int k = 0; k < 60; ++k)
            lambda = std::sqrt((turned + lambda * pull).norm() + v.squaredNorm());
        const Vec4 best = turned + lambda * pull;
        if (best.squaredNorm() > 1e-30 * b.squaredNorm())
            q[i] = Quat(best).normalized();
    }
}

} // namespace plait::reference
