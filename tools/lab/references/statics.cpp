#include "statics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lab {

namespace {

// U = sum_i joint(theta_i - theta_{i-1} - rest_i) + sum_i W_i l_i sin(theta_i), W_i the weight
// beyond segment i. What stretches does so without moment: in balance the force in segment i is
// W_i whatever the shape, so the angles are those of the rod that cannot stretch.
class Balance {
  public:
    explicit Balance(const PlaneRod& rod) : rod_(rod), n_(rod.lengths.size()) {
        double beyond = 0;
        weight_.resize(n_);
        for (size_t i = n_; i-- > 0;) {
            const double after = i + 1 < n_ ? rod.lengths[i + 1] : 0;
            beyond += 0.5 * rod.line_density * rod.gravity * (rod.lengths[i] + after);
            weight_[i] = beyond;
        }
    }

    double joint_length(size_t i) const {
        return 0.5 * (rod_.lengths[i] + (i > 0 ? rod_.lengths[i - 1] : 0));
    }
    // Rest shapes follow the chords: the clamp holds the first one.
    double rest_turn(size_t i) const { return i > 0 ? rod_.curvature * joint_length(i) : 0; }
    double weight(size_t i) const { return weight_[i]; }

    std::vector<double> rest() const {
        std::vector<double> angle(n_, rod_.clamp);
        for (size_t i = 1; i < n_; ++i)
            angle[i] = angle[i - 1] + rest_turn(i);
        return angle;
    }

    // One Newton step downhill; the largest change of an angle.
    double step(std::vector<double>& angle, double load) const {
        std::vector<double> gradient, diagonal, beside, change;
        moments(angle, load, gradient, diagonal, beside);
        const double stiffest = *std::max_element(diagonal.begin(), diagonal.end());
        for (double shift = 0; !solve(gradient, diagonal, beside, shift, change);)
            shift = std::max(2 * shift, 1e-4 * std::abs(stiffest) + 1e-300); // until convex
        const double before = potential(angle, load);
        const double rounding = 1e-14 * (std::abs(before) + load * weight_[0]);
        for (double share = 1; share > 1e-9; share *= 0.5) {
            std::vector<double> trial = angle;
            double largest = 0;
            for (size_t i = 0; i < n_; ++i) {
                trial[i] -= share * change[i];
                largest = std::max(largest, std::abs(share * change[i]));
            }
            if (potential(trial, load) <= before + rounding) {
                angle = trial;
                return largest;
            }
        }
        return 0;
    }

  private:
    double potential(const std::vector<double>& angle, double load) const {
        double sum = 0;
        for (size_t i = 0; i < n_; ++i) {
            const double before = i > 0 ? angle[i - 1] : rod_.clamp;
            const double turn = angle[i] - before - rest_turn(i);
            const double k = rod_.bend_stiffness / joint_length(i);
            sum += rod_.law == JointLaw::angle ? 0.5 * k * turn * turn
                                               : 4 * k * (1 - std::cos(0.5 * turn));
            sum += load * weight_[i] * rod_.lengths[i] * std::sin(angle[i]);
        }
        return sum;
    }

    // Moment and stiffness of a joint.
    std::pair<double, double> joint(size_t i, double turn) const {
        const double k = rod_.bend_stiffness / joint_length(i);
        if (rod_.law == JointLaw::angle)
            return {k * turn, k};
        return {2 * k * std::sin(0.5 * turn), k * std::cos(0.5 * turn)};
    }

    void moments(const std::vector<double>& angle, double load, std::vector<double>& gradient,
                 std::vector<double>& diagonal, std::vector<double>& beside) const {
        gradient.assign(n_, 0);
        diagonal.assign(n_, 0);
        beside.assign(n_, 0);
        for (size_t i = 0; i < n_; ++i) {
            const double before = i > 0 ? angle[i - 1] : rod_.clamp;
            const auto [moment, stiffness] = joint(i, angle[i] - before - rest_turn(i));
            const double lever = load * weight_[i] * rod_.lengths[i];
            gradient[i] += moment + lever * std::cos(angle[i]);
            diagonal[i] += stiffness - lever * std::sin(angle[i]);
            if (i > 0) {
                gradient[i - 1] -= moment;
                diagonal[i - 1] += stiffness;
                beside[i] = -stiffness; // between i - 1 and i
            }
        }
    }

    // Thomas; false where the shifted matrix is not positive definite.
    bool solve(const std::vector<double>& gradient, const std::vector<double>& diagonal,
               const std::vector<double>& beside, double shift, std::vector<double>& change) const {
        std::vector<double> pivot = diagonal;
        change = gradient;
        for (size_t i = 0; i < n_; ++i) {
            pivot[i] += shift;
            if (i > 0) {
                const double factor = beside[i] / pivot[i - 1];
                pivot[i] -= factor * beside[i];
                change[i] -= factor * change[i - 1];
            }
            if (!(pivot[i] > 0))
                return false;
        }
        for (size_t i = n_; i-- > 0;) {
            if (i + 1 < n_)
                change[i] -= beside[i + 1] * change[i + 1];
            change[i] /= pivot[i];
        }
        return true;
    }

    const PlaneRod& rod_;
    size_t n_;
    std::vector<double> weight_;
};

} // namespace

std::vector<Eigen::Vector2d> hanging_shape(const PlaneRod& rod) {
    const Balance balance(rod);
    std::vector<double> angle = balance.rest();
    constexpr int loads = 60;
    for (int k = 1; k <= loads; ++k) {
        const double load = std::pow(static_cast<double>(k) / loads, 3); // weak ones first
        double change = 1;
        for (int i = 0; i < 500 && change > 1e-13; ++i)
            change = balance.step(angle, load);
        if (!(change < 1e-9))
            return {};
    }
    std::vector<Eigen::Vector2d> points{Eigen::Vector2d::Zero()};
    for (size_t i = 0; i < angle.size(); ++i) {
        Eigen::Vector2d strain(std::cos(angle[i]), std::sin(angle[i]));
        if (rod.stretch_stiffness > 0)
            strain.y() -= balance.weight(i) / rod.stretch_stiffness;
        points.push_back(points.back() + rod.lengths[i] * strain);
    }
    return points;
}

Eigen::Vector2d elastica_tip(PlaneRod rod) {
    const double length = std::accumulate(rod.lengths.begin(), rod.lengths.end(), 0.0);
    const double first = rod.curvature * 0.5; // the clamp holds the tangent, not the first chord
    rod.law = JointLaw::angle;
    rod.stretch_stiffness = 0;
    const double clamp = rod.clamp;
    const auto tip = [&](size_t segments) -> Eigen::Vector2d {
        const double l = length / static_cast<double>(segments);
        rod.lengths.assign(segments, l);
        rod.clamp = clamp + first * l;
        const auto shape = hanging_shape(rod);
        return shape.empty() ? Eigen::Vector2d::Constant(std::nan("")) : shape.back();
    };
    // Second order, then fourth.
    const Eigen::Vector2d a = tip(200), b = tip(400), c = tip(800);
    const Eigen::Vector2d ab = (4 * b - a) / 3, bc = (4 * c - b) / 3;
    return (16 * bc - ab) / 15;
}

} // namespace lab
