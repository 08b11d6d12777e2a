#include "backend/reference/strands/rod_model.hpp"

#include <plait/constants.h>

#include <algorithm>

namespace plait::reference {
namespace {

double dot(const Quat& a, const Quat& b) {
    return a.coeffs().dot(b.coeffs());
}

} // namespace

RodModel::RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot)
    : RodModel(buffers, params, slot, strand_of(buffers.lane_strand, slot)) {}

RodModel::RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot,
                   size_t strand)
    : params_(&params), lane_(slot, params.vertex_stride, params.tile),
      motion_(lane_, params, buffers.state,
              root_of(buffers.rest, pose_of(buffers.pose, strand), strand, params.row_stride)),
      root_frame_(pose_of(buffers.pose, strand).q) {
    std::vector<double> stretch_before(1, 0.0);
    for (uint32_t i = 0; i < params.vertex_stride; ++i) {
        const auto material = [&](size_t component) {
            return buffers.material[lane_.index(i, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
        };
        mass_.push_back(material(PLAIT_LANE_MASS));
        if (i + 1 == params.vertex_stride)
            break;
        length_.push_back(material(PLAIT_LANE_LENGTH));
        stretch_before.push_back(material(PLAIT_LANE_STRETCH));
        bend_.push_back(material(PLAIT_LANE_BEND));
        section_.emplace_back(material(PLAIT_LANE_TWIST), 0, material(PLAIT_LANE_CROSS));
        rest_.push_back(lane_.rotation(buffers.rest_rotation, i));
        const Quat now = lane_.rotation(buffers.q, i), before = lane_.rotation(buffers.q_before, i);
        q_start_.push_back(now.normalized()); // float32 rounds it
        q_before_.push_back(before.normalized());
    }
    for (size_t i = 0; i < mass_.size(); ++i)
        x.push_back(motion_.goal(i, mass_[i]));
    q = q_start_;
    length_before_.assign(1, 0.0);
    length_before_.insert(length_before_.end(), length_.begin(), length_.end());
    for (size_t i = 1; i < mass_.size(); ++i)
        if (length_before_[i] == 0)
            mass_[i] = 0; // vertices past the tip lie on it: nothing may pull there
    if (params.collider_count == 0 && !params.planes)
        return;
    contacts_ = std::make_shared<Contacts>(params, buffers.colliders, motion_, length_before_,
                                           stretch_before, mass_,
                                           mesh_planes_of(lane_, params, buffers.state.plane),
                                           hollows_of(lane_, params, buffers.hollow));
}

void RodModel::shorten(double share) {
    if (share == 1)
        return;
    const std::vector<Vec3> start = motion_.relative_start();
    for (size_t i = 1; i < x.size(); ++i)
        x[i] = start[i] + share * (x[i] - start[i]);
    for (size_t i = 0; i < segments(); ++i)
        q[i] = Quat(Vec4((1 - share) * q_start_[i].coeffs() + share * q[i].coeffs())).normalized();
    rebuild();
}

void RodModel::store(const RodBuffers& buffers) {
    double given = 0;
    if (contacts_) {
        given = contacts_->work(x);
        contacts_->press(x); // where there is no room, depth gives way, not length
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
    for (size_t i = 1; contacts_ && i < x.size(); ++i)
        buffers.normal_force[lane_.index(i, 0, 1)] = contacts_->push(i);
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

double RodModel::elastic(const std::vector<Quat>& turned) const {
    double sum = 0;
    for (size_t i = 0; i < segments(); ++i) {
        const Quat from = (i == 0 ? root_frame_ : turned[i - 1]) * rest_[i];
        const Vec3 bent = (from.conjugate() * turned[i]).vec();
        sum += bend_[i] * (1 - std::abs(dot(turned[i], from))) +
               bent.dot(section_[i].cwiseProduct(bent)) / 2;
    }
    return sum;
}

// Before and after, both clamped as after.
double RodModel::released() const {
    return elastic(q_start_) - elastic(q);
}

RodModel::JointStrain RodModel::joint_strain(size_t segment, const std::vector<Quat>& turned,
                                             double side) const {
    const Quat from = (segment == 0 ? root_frame_ : turned[segment - 1]) * rest_[segment];
    const Quat& to = turned[segment];
    return {to.coeffs() - side * from.coeffs(), (from.conjugate() * to).vec(), dot(to, from)};
}

double RodModel::released_of_pairs() const {
    double sum = 0;
    for (size_t i = 0; i < segments(); ++i) {
        const double side = std::copysign(1.0, dot(q[i], expected(i)));
        const JointStrain now = joint_strain(i, q, side);
        const JointStrain then = joint_strain(i, q_start_, side);
        const JointStrain before = joint_strain(i, q_before_, side);
        const auto lost = [&](const auto& a, const auto& b, const auto& c) {
            return held(true, b, c) - held(true, a, b);
        };
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
    double sum = elastic(q);
    for (size_t i = 0; i < segments(); ++i)
        sum += vertex_energy(i + 1);
    for (size_t i = 1; contacts_ && i < x.size(); ++i)
        sum += contacts_->model(i, x[i]);
    return sum;
}

bool RodModel::off_pin() const {
    for (size_t i = 1; i < x.size(); ++i) {
        const Pin& pin = motion_.pin[i];
        if (pin.stiffness > PLAIT_ARTICULATED_PIN_STIFFNESS * mass_[i] * motion_.inertia &&
            (pin.target - x[i]).norm() > PLAIT_ARTICULATED_PIN_DISTANCE * length_before_[i])
            return true;
    }
    return false;
}

} // namespace plait::reference
