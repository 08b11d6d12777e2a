// For fixed orientations the energy of cl/strands/rod.clh is quadratic in the vertices, and in
// equilibrium the tension T_i of segment i is the weight below it, whatever the orientations. So
//   x_{i+1} - x_i = l_i (t_i + T_i/EA), |t_i| = 1      gives l_i and t_i,
//   M_i = M_{i+1} - l_i t_i x T_i                      the moments, from the tip on,
//   M_i = -g(u_i)/2 in the joint's axes               the rest rotations: (u, w) is the turn from
//                                                      q_{i-1} r_i to q_i and
//   g(u) = kb (u + w d u + u x d u), d = diag(GJ/EI - 1, 0, EI2/EI - 1).
// An inextensible strand is EA without bound: l_i and t_i stay as they are.
// What remains is E(q) = sum of the joints' energies - l_i T_i.t_i(q_i), exactly: the equilibrium
// is stable where its Hessian in rotation vectors is positive definite,
//   segment:  l (T.t I - (t T' + T t')/2)
//   joint:    S = (kb/4) (w I + J'd J - (u.d u) I), J = w I - [u]x, on both segments, and
//             -S + [g]x/4 between that before and that after it.
// Eliminated from the tip on, the pivot of segment i tells whether joint i holds what follows.
// Sag-free rods: Hadap 2006, Twigg & Kacic-Alesic 2011, Hsu et al. 2022; the closed form for this
// energy, and the stability: ours.
#include "core/strands/sag.hpp"

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

// How a joint that is turned by (u, w) pushes back.
struct Joint {
    Joint(double bend, const RestStrand& s) : kb(bend), d(s.twist - 1, 0, s.cross - 1) {}

    double w() const { return std::sqrt(1 - u.squaredNorm()); }
    Quat turn() const { return {w(), u.x(), u.y(), u.z()}; }
    // g in the axes before the turn; after it, the last term changes sign.
    Vec3 g(double side = 1) const {
        const Vec3 du = d.cwiseProduct(u);
        return kb * (u + w() * du + side * u.cross(du));
    }
    Mat3 hessian() const {
        const Mat3 J = w() * Mat3::Identity() - cross_matrix(u);
        return kb / 4 *
               (J.transpose() * d.asDiagonal() * J +
                (w() - u.dot(d.cwiseProduct(u))) * Mat3::Identity());
    }
    // The turn at which it holds `moment`, in the axes after the turn; at most most_bent.
    void hold(const Vec3& moment);

    double kb; // N m
    Vec3 d;
    Vec3 u = Vec3::Zero();
};

void Joint::hold(const Vec3& moment) {
    if (kb <= 0)
        return;
    constexpr int most = 60; // round joints take two
    for (int k = 0; k < most; ++k) {
        Mat3 secant = -cross_matrix(u) * d.asDiagonal();
        secant.diagonal() += Vec3::Ones() + w() * d;
        const Vec3 before = u;
        u = secant.inverse() * (-2 / kb * moment);
        if (!(u.norm() <= most_bent))
            u *= most_bent / u.norm();
        if ((u - before).norm() < 1e-15)
            return;
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

    RestStrand& s_;
    bool stiffen_;
    Vec3 moment_ = Vec3::Zero();  // of the joint after
    Mat3 carried_ = Mat3::Zero(); // what the segments after add to the Hessian
};

// Stiffness kb for a joint that holds `moment`, and against `tipping`, both N m, about its weakest
// axis.
double Joints::enough(size_t i, double moment, double tipping) const {
    const double joint = (i == 0 ? 0 : s_.length[i - 1] / 2) + s_.length[i] / 2;
    const double share = s_.whole / joint;
    const double upright = 4 * safety * share * tipping; // against it stands kb w/4, and kb w is
    const double round = std::max({2 * moment / most_bent, 4 * moment * share / most_coiled,
                                   std::hypot(upright, 2 * moment)}); // sqrt(kb^2 - 4 M^2)
    return round / std::min({1.0, s_.twist, s_.cross});
}

void Joints::stiffen(size_t joint, double bend) {
    if (bend <= s_.bend[joint])
        return;
    report.stiffening = std::max(report.stiffening, bend / s_.bend[joint]);
    ++report.stiffened;
    s_.bend[joint] = bend;
}

double smallest_eigenvalue(const Mat3& symmetric) {
    return Eigen::SelfAdjointEigenSolver<Mat3>()
        .computeDirect(symmetric, Eigen::EigenvaluesOnly)
        .eigenvalues()[0];
}

void Joints::hold(size_t i, const Vec3& T) {
    const Vec3 t = s_.frame[i] * Vec3::UnitX();
    moment_ -= s_.length[i] * t.cross(T);
    const Mat3 load =
        s_.length[i] * (t.dot(T) * Mat3::Identity() - (t * T.transpose() + T * t.transpose()) / 2) +
        carried_;
    if (stiffen_ && s_.bend[i] > 0)
        stiffen(i, enough(i, moment_.norm(), std::max(0.0, -smallest_eigenvalue(load))));
    Joint joint(s_.bend[i], s_);
    joint.hold(s_.frame[i].conjugate() * moment_);
    moment_ = s_.frame[i] * Vec3(joint.g(-1) / -2);
    const Quat from = s_.frame[i] * joint.turn().conjugate();
    s_.rest[i] = (s_.frame_before(i).conjugate() * from).normalized();
    // Elimination of this segment from the Hessian.
    const Mat3 axes = from.toRotationMatrix();
    const Mat3 S = axes * joint.hessian() * axes.transpose();
    const Mat3 before = cross_matrix(axes * joint.g()) / 4 - S;
    const Mat3 pivot = load + S;
    if (!(smallest_eigenvalue(pivot) > 0))
        report.unstable = 1;
    carried_ = S - before * pivot.ldlt().solve(before.transpose());
}

// Force on the far end of a segment.
Vec3 stretch_force(const RestStrand& s, size_t i) {
    return s.stretch[i] * (s.length[i] * (s.frame[i] * Vec3::UnitX()) - s.edge(i));
}

// Of joint i on segment i.
Vec3 bend_moment(const RestStrand& s, size_t i) {
    const Quat from = s.frame_before(i) * s.rest[i];
    Joint joint(s.bend[i], s);
    const Quat turn = from.conjugate() * s.frame[i];
    joint.u = std::copysign(1.0, turn.w()) * turn.vec();
    return from * Vec3(joint.g() / -2);
}

// What is missing of a tension or a joint's moment, from the energy's gradient and nothing else.
double residual(const RestStrand& s, const Vec3& gravity) {
    double force = 0, torque = 0, mass = 0;
    Vec3 tension = Vec3::Zero(), moment = Vec3::Zero(); // of all that follows
    Vec3 stretch_after = Vec3::Zero(), bend_after = Vec3::Zero();
    for (size_t i = s.segments(); i-- > 0;) {
        mass += s.mass[i + 1];
        const Vec3 stretch = s.inextensible ? Vec3(-mass * gravity) : stretch_force(s, i);
        const Vec3 bend = bend_moment(s, i);
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

void SagReport::add(const SagReport& other) {
    // what is not a number is the worst
    if (other.residual > residual || std::isnan(other.residual)) {
        residual = other.residual;
        residual_strand = other.residual_strand;
    }
    if (other.stiffening > stiffening) {
        stiffening = other.stiffening;
        stiffening_strand = other.stiffening_strand;
    }
    unreached += other.unreached;
    unstable += other.unstable;
    joints += other.joints;
    stiffened += other.stiffened;
}

void SagReport::add(SagReport of_one, uint64_t strand) {
    of_one.residual_strand = of_one.stiffening_strand = strand;
    of_one.unreached = !(of_one.residual <= reached);
    add(of_one);
}

SagReport remove_sag(RestStrand& strand, const Vec3& gravity, plait_sag_free mode) {
    const std::pmr::vector<Vec3> T = tensions(strand, gravity);
    if (!strand.inextensible)
        unstretch(strand, T);
    Joints joints(strand, mode == PLAIT_SAG_FREE_STIFFEN);
    for (size_t i = strand.segments(); i-- > 0;)
        joints.hold(i, T[i]);
    joints.report.residual = residual(strand, gravity);
    joints.report.joints = strand.segments();
    return joints.report;
}

} // namespace plait
