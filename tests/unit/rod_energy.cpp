// The energy of a rod's joints: it knows neither where a free strand is nor
// which way it is turned, and a clamped one buckles under twist where rods do.
#include "backend/reference/strands/rod_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>
#include <random>

namespace plait::reference {
namespace {

constexpr double pi = std::numbers::pi;

struct Rod {
    uint32_t segments;
    double length, bend, twist; // m, EI and GJ in N m^2
};

// A straight one along x, no mass, joints a segment apart but for the root's, half a segment from
// its clamp; `free`: the root's is none.
class Strand {
  public:
    Strand(const Rod& rod, bool free) {
        const size_t vertices = rod.segments + 1;
        const double l = rod.length / rod.segments;
        material_.assign(vertices * PLAIT_LANE_MATERIAL_COMPONENTS, 0);
        for (size_t i = 0; i < rod.segments; ++i) {
            double* m = &material_[i * PLAIT_LANE_MATERIAL_COMPONENTS];
            const double between = i == 0 ? l / 2 : l;
            m[PLAIT_LANE_LENGTH] = l;
            m[PLAIT_LANE_BEND] = i == 0 && free ? 0 : 4 * rod.bend / between;
            m[PLAIT_LANE_TWIST] = i == 0 && free ? 0 : 4 * (rod.twist - rod.bend) / between;
        }
        rest_position_.assign(vertices, Vec4::Zero());
        pose_ = {Vec4(0, 0, 0, 1), Vec4::Zero()};
        for (size_t i = 0; i < vertices; ++i)
            for (const double component : {0, 0, 0, 1})
                rotation_.push_back(component);
        rest_rotation_ = before_ = rotation_;
        x_.assign(3 * vertices, 0);
        v_ = x_;
    }

    RodModel model() {
        plait_lane_params params{};
        params.vertex_stride = static_cast<plait_u32>(rest_position_.size());
        params.tile = 1;
        params.row_stride = params.vertex_stride;
        params.h = 1;
        const View<const Vec4> rest(rest_position_.data(), rest_position_.size(), "rest");
        const View<const Vec4> pose(pose_.data(), pose_.size(), "pose");
        const View<const double> material(material_.data(), material_.size(), "material");
        const View<const double> turns(rest_rotation_.data(), rest_rotation_.size(), "turns");
        const View<const uint32_t> in_order;
        const View<const Vec4> capsules;
        const View<const double> acceleration, pin, plane;
        const View<double> q(rotation_.data(), rotation_.size(), "q");
        const View<double> q_before(before_.data(), before_.size(), "q_before");
        const View<double> x(x_.data(), x_.size(), "x"), v(v_.data(), v_.size(), "v"), none;
        return RodModel({in_order,
                         rest,
                         pose,
                         material,
                         turns,
                         capsules,
                         q,
                         q_before,
                         {x, v, none, none, material, acceleration, pin, plane},
                         none,
                         plane},
                        params, 0);
    }
    double* joint(size_t i) { return &material_[i * PLAIT_LANE_MATERIAL_COMPONENTS]; }

  private:
    std::vector<double> material_, rotation_, rest_rotation_, before_, x_, v_;
    std::vector<Vec4> rest_position_, pose_;
};

Quat about(const Vec3& axis, double angle) {
    return Quat(Eigen::AngleAxisd(angle, axis));
}

// ---- a free strand: no force and no torque on the whole

TEST(FreeRod, energy_is_of_its_shape_alone) {
    Strand strand({16, 0.3, 4.7e-9, 3.2e-9}, true);
    RodModel rod = strand.model();
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto any = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    for (Quat& q : rod.q)
        q = about(any().normalized(), 0.5 * normal(random));
    const double energy = rod.energy();
    EXPECT_GT(energy, 1e-7); // J: bent and twisted
    for (int trial = 0; trial < 20; ++trial) {
        RodModel moved = rod;
        const Quat turn = about(any().normalized(), 3 * normal(random));
        for (Quat& q : moved.q)
            q = turn * q;
        EXPECT_NEAR(moved.energy() / energy, 1, 1e-12);
    }
    RodModel bent = rod; // and is no constant
    bent.q[7] = about(Vec3::UnitZ(), 0.01) * bent.q[7];
    EXPECT_GT(std::abs(bent.energy() / energy - 1), 1e-4);
}

// ---- both ends clamped

// The last segment is the clamp of the far end: it stays, half a joint beyond its neighbour.
// Unknowns: displacements of the vertices between, over l, and turns of the segments between.
class Clamped {
  public:
    Clamped(uint32_t segments, double bend, double twist)
        : strand_(with_clamp(segments, bend, twist)), rod_(strand_.model()), n_(segments),
          l_(1.0 / segments) {}

    // Laid out by `frame` of the arc length from the root, and then moved into balance.
    template <typename Frame> double least_eigenvalue(const Frame& frame) {
        rod_.x[0] = Vec3::Zero();
        for (uint32_t i = 0; i < n_; ++i) {
            rod_.q[i] = frame((i + 0.5) * l_);
            rod_.x[i + 1] = rod_.x[i] + l_ * (rod_.q[i] * Vec3::UnitX());
        }
        rod_.q[n_] = frame(1);
        rod_.x[n_ + 1] = rod_.x[n_] + l_ * (rod_.q[n_] * Vec3::UnitX());
        Eigen::VectorXd g = gradient();
        for (int tries = 0; tries < 4 && g.cwiseAbs().maxCoeff() > balance; ++tries) {
            rod_ = moved(-hessian().ldlt().solve(g));
            g = gradient();
        }
        EXPECT_LT(g.cwiseAbs().maxCoeff(), balance);
        Eigen::MatrixXd h = hessian();
        const Eigen::VectorXd z = rolling();
        if (z.norm() > 0.1) {
            EXPECT_LT((h * z).norm(), 1e-6 * h.norm() * z.norm()) << "is not free";
            h += h.norm() * z * z.transpose() / z.squaredNorm();
        }
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(h, Eigen::EigenvaluesOnly)
            .eigenvalues()[0];
    }

  private:
    static Strand with_clamp(uint32_t segments, double bend, double twist) {
        Strand strand({segments + 1, 1 + 1.0 / segments, bend, twist}, false);
        strand.joint(segments)[PLAIT_LANE_BEND] *= 2; // half as long
        strand.joint(segments)[PLAIT_LANE_TWIST] *= 2;
        return strand;
    }
    // A closed round rod turns as a whole about the direction it is clamped in, and rolls back
    // about its own: that costs nothing and is no buckling. Nothing moves where it is straight.
    Eigen::VectorXd rolling() const {
        Eigen::VectorXd z(unknowns());
        for (uint32_t i = 0; i < n_; ++i) {
            z.segment<3>(6 * i) = Vec3::UnitX() - rod_.q[i] * Vec3::UnitX();
            if (i + 1 < n_)
                z.segment<3>(6 * i + 3) = Vec3::UnitX().cross(rod_.x[i + 1]) / l_;
        }
        return z;
    }
    // Node k: vertex k + 1 (but the last has none that moves), then segment k.
    Eigen::Index unknowns() const { return 6 * static_cast<Eigen::Index>(n_) - 3; }
    static Eigen::Index place(Eigen::Index unknown) { return unknown / 6; }

    RodModel moved(const Eigen::VectorXd& by) const {
        RodModel rod = rod_;
        for (Eigen::Index k = 0; 6 * k < by.size(); ++k) {
            const Vec3 turn = by.segment<3>(6 * k);
            const auto i = static_cast<size_t>(k);
            if (turn.norm() > 0)
                rod.q[i] = about(turn.normalized(), turn.norm()) * rod.q[i];
            if (6 * k + 6 <= by.size())
                rod.x[i + 1] += l_ * by.segment<3>(6 * k + 3);
        }
        return rod;
    }
    double energy(Eigen::Index a, double by_a, Eigen::Index b, double by_b) const {
        Eigen::VectorXd by = Eigen::VectorXd::Zero(unknowns());
        by[a] += by_a;
        by[b] += by_b;
        const RodModel rod = moved(by);
        return rod.energy() + penalty(rod);
    }
    // Segments that leave their director: with EA 10^5 EI/L^2 they do next to nothing.
    double penalty(const RodModel& rod) const {
        double sum = 0;
        for (size_t i = 0; i <= n_; ++i)
            sum += (rod.x[i + 1] - rod.x[i] - l_ * (rod.q[i] * Vec3::UnitX())).squaredNorm();
        return 1e5 / l_ / 2 * sum;
    }
    Eigen::VectorXd gradient() const {
        Eigen::VectorXd g(unknowns());
        for (Eigen::Index a = 0; a < g.size(); ++a)
            g[a] = (energy(a, step, a, 0) - energy(a, -step, a, 0)) / (2 * step);
        return g;
    }
    // Only neighbours know of each other.
    Eigen::MatrixXd hessian() const {
        Eigen::MatrixXd h = Eigen::MatrixXd::Zero(unknowns(), unknowns());
        for (Eigen::Index a = 0; a < h.rows(); ++a)
            for (Eigen::Index b = a; b < h.rows() && place(b) <= place(a) + 1; ++b)
                h(a, b) = h(b, a) = (energy(a, step, b, step) - energy(a, step, b, -step) -
                                     energy(a, -step, b, step) + energy(a, -step, b, -step)) /
                                    (4 * step * step);
        return h;
    }

    static constexpr double step = 1e-4, balance = 1e-4; // in l and radians; in EI/L
    Strand strand_;
    RodModel rod_;
    uint32_t n_;
    double l_;
};

// Twist of the far clamp at which the least eigenvalue changes sign, of two 2 % on either side of
// the closed form.
template <typename Frame>
void expect_buckling_at(double theta, double bend, double twist, const char* name,
                        const Frame& frame) {
    double eigenvalue[2];
    for (int side = 0; side < 2; ++side) {
        const double by = theta * (side == 0 ? 0.98 : 1.02);
        Clamped rod(48, bend, twist);
        eigenvalue[side] = rod.least_eigenvalue(
            [&](double s) { return Quat(frame(s) * about(Vec3::UnitX(), by * s)); });
    }
    EXPECT_GT(eigenvalue[0], 0) << name << " buckles too early";
    EXPECT_LT(eigenvalue[1], 0) << name << " buckles too late";
    const double share = eigenvalue[0] / (eigenvalue[0] - eigenvalue[1]);
    std::printf("%s: buckles %+.2f %% from the closed form\n", name, -2 + 4 * share);
}

// Greenhill's problem with clamped ends, no tension: Theta = 8.98682 EI/GJ.
TEST(ClampedRod, straight_one_buckles_under_twist) {
    for (const double twist : {1.0, 0.6896551724}) // GJ/EI
        expect_buckling_at(8.98682 / twist, 1, twist, "straight rod",
                           [](double) { return Quat::Identity(); });
}

// Michell 1889, Zajac 1962: a straight rod closed to a ring, Theta = 2 pi sqrt(3) EI/GJ.
TEST(ClampedRod, ring_buckles_under_twist) {
    constexpr double twist = 0.6896551724;
    expect_buckling_at(2 * pi * std::sqrt(3.0) / twist, 1, twist, "ring",
                       [](double s) { return about(Vec3::UnitZ(), 2 * pi * s); });
}

} // namespace
} // namespace plait::reference
