#include "plane_fall.hpp"
#include "modes.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lab {

namespace {

// With S_j the mass beyond segment j: kinetic energy is theta' M theta' / 2,
// M_jk = l_j l_k S_max(j,k) cos(theta_j - theta_k), and the drag's force -c M theta'.
class Equations {
  public:
    explicit Equations(const PlaneFall& strand)
        : strand_(strand), n_(static_cast<Eigen::Index>(strand.lengths.size())), weight_(n_),
          arm_(n_, n_), mass_(n_, n_) {
        double beyond = 0;
        for (Eigen::Index j = n_; j-- > 0;) {
            beyond += strand.masses[at(j) + 1];
            weight_[j] = beyond * length(j);
            for (Eigen::Index k = 0; k <= j; ++k)
                arm_(j, k) = arm_(k, j) = beyond * length(j) * length(k);
        }
    }

    Eigen::VectorXd acceleration(const Eigen::VectorXd& angle, const Eigen::VectorXd& rate) {
        cos_ = angle.array().cos();
        sin_ = angle.array().sin();
        force_ = -strand_.gravity * weight_.cwiseProduct(cos_);
        for (Eigen::Index j = 0; j < n_; ++j)
            for (Eigen::Index k = 0; k < n_; ++k) {
                mass_(k, j) = arm_(k, j) * (cos_[j] * cos_[k] + sin_[j] * sin_[k]);
                const double sine = sin_[k] * cos_[j] - cos_[k] * sin_[j]; // of k less j
                force_[k] -= arm_(k, j) * sine * rate[j] * rate[j];
            }
        for (Eigen::Index j = 0; j < n_; ++j) {
            const double moment = moment_of(j, angle);
            force_[j] -= moment;
            if (j > 0)
                force_[j - 1] += moment;
        }
        return mass_.llt().solve(force_) - strand_.drag * rate;
    }

    // The stiffest motion there is, rad/s, of joints alone, about the shape at rest.
    double fastest(const Eigen::VectorXd& angle) {
        acceleration(angle, Eigen::VectorXd::Zero(n_)); // fills mass_
        Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n_, n_);
        for (Eigen::Index j = 0; j < n_; ++j) {
            const double k = strand_.bend_stiffness / joint_length(j);
            stiffness(j, j) += k;
            if (j > 0) {
                stiffness(j - 1, j - 1) += k;
                stiffness(j, j - 1) -= k;
                stiffness(j - 1, j) -= k;
            }
        }
        return std::sqrt(std::max(0.0, modes_of(stiffness, mass_).squares.maxCoeff()));
    }

  private:
    static size_t at(Eigen::Index j) { return static_cast<size_t>(j); }
    double length(Eigen::Index j) const { return strand_.lengths[at(j)]; }
    double joint_length(Eigen::Index j) const {
        return 0.5 * (length(j) + (j > 0 ? length(j - 1) : 0));
    }

    // Of the joint before segment j, on that segment, against its turn from rest.
    double moment_of(Eigen::Index j, const Eigen::VectorXd& angle) const {
        const double rest = strand_.angles[at(j)];
        const double turn =
            angle[j] - rest - (j > 0 ? angle[j - 1] - strand_.angles[at(j) - 1] : 0);
        const double k = strand_.bend_stiffness / joint_length(j);
        return strand_.law == JointLaw::angle ? k * turn : 2 * k * std::sin(0.5 * turn);
    }

    const PlaneFall& strand_;
    Eigen::Index n_;
    Eigen::VectorXd weight_;     // l_j S_j
    Eigen::MatrixXd arm_, mass_; // l_j l_k S_max(j,k), and M
    Eigen::VectorXd cos_, sin_, force_;
};

void runge_kutta(Equations& equations, double h, Eigen::VectorXd& angle, Eigen::VectorXd& rate) {
    const Eigen::VectorXd a1 = equations.acceleration(angle, rate);
    const Eigen::VectorXd r2 = rate + 0.5 * h * a1;
    const Eigen::VectorXd a2 = equations.acceleration(angle + 0.5 * h * rate, r2);
    const Eigen::VectorXd r3 = rate + 0.5 * h * a2;
    const Eigen::VectorXd a3 = equations.acceleration(angle + 0.5 * h * r2, r3);
    const Eigen::VectorXd r4 = rate + h * a3;
    const Eigen::VectorXd a4 = equations.acceleration(angle + h * r3, r4);
    angle += h / 6 * (rate + 2 * r2 + 2 * r3 + r4);
    rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

std::vector<Eigen::Vector2d> points_of(const PlaneFall& strand, const Eigen::VectorXd& angle) {
    std::vector<Eigen::Vector2d> points{Eigen::Vector2d::Zero()};
    for (Eigen::Index j = 0; j < angle.size(); ++j)
        points.push_back(points.back() +
                         strand.lengths[static_cast<size_t>(j)] *
                             Eigen::Vector2d(std::cos(angle[j]), std::sin(angle[j])));
    return points;
}

} // namespace

std::vector<std::vector<Eigen::Vector2d>> fall_in_plane(const PlaneFall& strand, uint32_t frames,
                                                        double interval, uint32_t steps) {
    Equations equations(strand);
    Eigen::VectorXd angle = Eigen::Map<const Eigen::VectorXd>(
        strand.angles.data(), static_cast<Eigen::Index>(strand.angles.size()));
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(angle.size());
    if (steps == 0) {
        const double length = std::accumulate(strand.lengths.begin(), strand.lengths.end(), 0.0);
        const double h = std::min(2e-3 * std::sqrt(length / strand.gravity),
                                  1.5 / std::max(equations.fastest(angle), 1e-9)); // it bears 2.8
        steps = static_cast<uint32_t>(std::ceil(interval / h));
    }
    std::vector<std::vector<Eigen::Vector2d>> all{points_of(strand, angle)};
    for (uint32_t k = 0; k < frames; ++k) {
        for (uint32_t i = 0; i < steps; ++i)
            runge_kutta(equations, interval / steps, angle, rate);
        all.push_back(points_of(strand, angle));
    }
    return all;
}

} // namespace lab
