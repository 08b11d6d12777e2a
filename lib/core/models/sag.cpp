// For fixed orientations the energy of cl/common/rod.clh is quadratic in the vertices, and in
// equilibrium the tension T_i of segment i is the weight below it, whatever the orientations. So
//   x_{i+1} - x_i = l_i (t_i + T_i/EA), |t_i| = 1      gives l_i and t_i,
//   M_i = M_{i+1} - l_i t_i x T_i                      the moments, from the tip on,
//   M_i = (kb_i/2) v_i                                 the rest rotations: m = (v, sqrt(1 - v^2))
//   is
//                                                      that from q_i to q_{i-1} r_i, in the world.
// What remains is E(q) = sum kb_i (1 - |w_i|) - l_i T_i.t_i(q_i), exactly: the equilibrium is
// stable where its Hessian in rotation vectors is positive definite,
//   segment:  l (T.t I - (t T' + T t')/2)
//   joint:    kb w/4 I on both segments, -kb/4 (w I + [v]x) between that before and that after it.
// Eliminated from the tip on, the pivot of segment i tells whether joint i holds what follows.
// Sag-free rods: Hadap 2006, Twigg & Kacic-Alesic 2011, Hsu et al. 2022; the closed form for this
// energy, and the stability: ours.
#include "core/models/sag.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <numbers>

namespace plait {
namespace {

using Mat3 = Eigen::Matrix3d;

// What STIFFEN sees to, for every joint. None depends on the number of segments, but the first:
// v stays below this (60 degrees). The moment ceases to grow at 1.
constexpr double most_bent = 0.5;
// With the load of its joint all along, the strand would rest coiled by this turn at most:
// springier hair finds other shapes when it is shaken.
constexpr double most_coiled = 2 * std::numbers::pi;
// EI is at least so much of (what tips over the rest of the strand, N m) x (the strand's length).
// Each such joint adds to the load of those before it, all together less than a factor e^2. An
// upright strand is stiffened where Gamma > 2; it buckles at 7.84.
constexpr double safety = 0.5;

Mat3 cross_matrix(const Vec3& v) {
    Mat3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

// Length of a segment that tension T stretches to `edge`; that as it is where there is none.
double unstretched(const Vec3& edge, const Vec3& T, double EA) {
    const double along = edge.dot(T) / EA, square = edge.squaredNorm();
    const double root = along * along + (1 - T.squaredNorm() / (EA * EA)) * square;
    const double length = square / (along + std::sqrt(std::max(root, 0.0)));
    return root >= 0 && length > 0 ? length : edge.norm();
}

// Of every segment: the weight below it.
std::pmr::vector<Vec3> tensions(const RestStrand& s, const Vec3& gravity) {
    std::pmr::vector<Vec3> T(s.segments(), s.length.get_allocator());
    Vec3 weight = Vec3::Zero();
    for (size_t i = s.segments(); i-- > 0;)
        T[i] = weight += s.mass[i + 1] * gravity;
    return T;
}

// Lengths and directions under tension, and frames along them.
void unstretch(RestStrand& s, const std::pmr::vector<Vec3>& T) {
    for (size_t i = 0; i < s.segments(); ++i) {
        const double EA = s.stretch[i] * s.length[i];
        s.length[i] = unstretched(s.edge(i), T[i], EA);
        s.stretch[i] = EA / s.length[i];
        s.frame_along(i, s.edge(i) / s.length[i] - T[i] / EA);
    }
}

// From the tip to the root: what a joint has to hold, and how it does.
class Joints {
  public:
    Joints(RestStrand& strand, bool stiffen) : s_(strand), stiffen_(stiffen) {}

    void hold(size_t joint, const Vec3& T);

    SagReport report;

  private:
    double enough(size_t joint, double moment, double tipping) const;
    void stiffen(size_t joint, double bend);
    void turn_rest(size_t joint, const Vec3& v);

    RestStrand& s_;
    bool stiffen_;
    Vec3 moment_ = Vec3::Zero();  // of the joint after
    Mat3 carried_ = Mat3::Zero(); // what the segments after add to the Hessian
};

// Stiffness kb for a joint that holds `moment`, and against `tipping`, both N m.
double Joints::enough(size_t i, double moment, double tipping) const {
    const double joint = (i == 0 ? 0 : s_.length[i - 1] / 2) + s_.length[i] / 2;
    const double share = s_.whole / joint;
    const double upright = 4 * safety * share * tipping; // against it stands kb w/4, and kb w is
    return std::max({2 * moment / most_bent, 4 * moment * share / most_coiled,
                     std::hypot(upright, 2 * moment)}); // sqrt(kb^2 - 4 M^2)
}

void Joints::stiffen(size_t joint, double bend) {
    if (bend <= s_.bend[joint])
        return;
    report.stiffening = std::max(report.stiffening, bend / s_.bend[joint]);
    ++report.stiffened;
    s_.bend[joint] = bend;
}

void Joints::hold(size_t i, const Vec3& T) {
    const Vec3 t = s_.frame[i] * Vec3::UnitX();
    moment_ -= s_.length[i] * t.cross(T);
    const Mat3 load =
        s_.length[i] * (t.dot(T) * Mat3::Identity() - (t * T.transpose() + T * t.transpose()) / 2) +
        carried_;
    const double weakest = Eigen::SelfAdjointEigenSolver<Mat3>()
                               .computeDirect(load, Eigen::EigenvaluesOnly)
                               .eigenvalues()[0];
    if (stiffen_ && s_.bend[i] > 0)
        stiffen(i, enough(i, moment_.norm(), std::max(0.0, -weakest)));
    const double kb = s_.bend[i];
    Vec3 v = kb > 0 ? Vec3(2 / kb * moment_) : Vec3(Vec3::Zero());
    if (v.norm() > most_bent)
        v *= most_bent / v.norm();
    moment_ = kb / 2 * v;
    turn_rest(i, v);
    // Elimination of this segment from the Hessian.
    const double w = std::sqrt(1 - v.squaredNorm());
    const Mat3 pivot = load + kb / 4 * w * Mat3::Identity();
    const Mat3 before = -kb / 4 * (w * Mat3::Identity() + cross_matrix(v));
    if (!(kb / 4 * w + weakest > 0))
        report.unstable = 1;
    carried_ = kb / 4 * w * Mat3::Identity() - before * pivot.ldlt().solve(before.transpose());
}

void Joints::turn_rest(size_t i, const Vec3& v) {
    Quat m;
    m.w() = std::sqrt(1 - v.squaredNorm());
    m.vec() = v;
    const Quat before = i == 0 ? Quat::Identity() : s_.frame[i - 1];
    s_.rest[i] = (before.conjugate() * m * s_.frame[i]).normalized();
}

// Force on the far end of a segment.
Vec3 stretch_force(const RestStrand& s, size_t i) {
    return s.stretch[i] * (s.length[i] * (s.frame[i] * Vec3::UnitX()) - s.edge(i));
}

// Of joint i on segment i.
Vec3 bend_moment(const RestStrand& s, size_t i) {
    const Quat before = i == 0 ? Quat::Identity() : s.frame[i - 1];
    const Quat m = before * s.rest[i] * s.frame[i].conjugate();
    return s.bend[i] / 2 * std::copysign(1.0, m.w()) * m.vec();
}

// What is missing of a tension or a joint's moment, from the energy's gradient and nothing else.
double residual(const RestStrand& s, const Vec3& gravity) {
    double force = 0, torque = 0, mass = 0;
    Vec3 tension = Vec3::Zero(), moment = Vec3::Zero(); // of all that follows
    Vec3 stretch_after = Vec3::Zero(), bend_after = Vec3::Zero();
    for (size_t i = s.segments(); i-- > 0;) {
        const Vec3 stretch = stretch_force(s, i), bend = bend_moment(s, i);
        mass += s.mass[i + 1];
        tension += s.mass[i + 1] * gravity + stretch - stretch_after;
        moment += bend - bend_after - s.length[i] * (s.frame[i] * Vec3::UnitX()).cross(stretch);
        force = std::max(force, tension.norm());
        torque = std::max(torque, moment.norm());
        stretch_after = stretch;
        bend_after = bend;
    }
    const double weight = mass * gravity.norm();
    return weight > 0 ? std::max(force / weight, torque / (weight * s.whole)) : 0;
}

} // namespace

void SagReport::add(const SagReport& strand) {
    residual = std::max(residual, strand.residual);
    unstable += strand.unstable;
    stiffened += strand.stiffened;
    stiffening = std::max(stiffening, strand.stiffening);
}

SagReport remove_sag(RestStrand& strand, const Vec3& gravity, plait_sag_free mode) {
    const std::pmr::vector<Vec3> T = tensions(strand, gravity);
    unstretch(strand, T);
    Joints joints(strand, mode == PLAIT_SAG_FREE_STIFFEN);
    for (size_t i = strand.segments(); i-- > 0;)
        joints.hold(i, T[i]);
    joints.report.residual = residual(strand, gravity);
    return joints.report;
}

} // namespace plait
