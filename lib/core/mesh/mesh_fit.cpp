// Fits cones to points of the surface by least squares of min_k d_k(x), d_k the signed distance to cone
// k: a point is the business of the cone that holds it deepest, so one that sticks out of the mesh
// costs as much as one that does not reach it.
//
// Sources: damped Gauss-Newton (Levenberg 1944, Marquardt 1963), alternating with the choice of cones as
// in Lloyd 1982; cones start from the largest balls inside (mesh_balls.hpp). Where that has come to rest, the cone that is missed least is tried
// in the worst place: ours.
#include "core/mesh/mesh_fit.hpp"

#include "core/mesh/mesh_balls.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plait {
namespace {

using Vec8 = Eigen::Matrix<double, 8, 1>;
using Mat8 = Eigen::Matrix<double, 8, 8>;

constexpr double infinite = std::numeric_limits<double>::infinity();

struct RoundedCone {
    Vec3 a, b;                 // m
    double radius_a, radius_b; // m, > 0

    // Signed: negative inside. That of the ball along the axis whose surface is nearest: at the foot of
    // `x`, moved towards the thicker end by the slope of the cone.
    double distance(const Vec3& x) const {
        const Vec3 axis = b - a;
        const double length = axis.norm(), narrows = radius_a - radius_b;
        if (length <= std::abs(narrows)) // one ball holds the other
            return narrows >= 0 ? (x - a).norm() - radius_a : (x - b).norm() - radius_b;
        const double along = (x - a).dot(axis) / length;
        const double away = std::sqrt(std::max((x - a).squaredNorm() - along * along, 0.0));
        const double slope = narrows / std::sqrt(length * length - narrows * narrows);
        const double share = std::clamp((along - away * slope) / length, 0.0, 1.0);
        return (x - a - share * axis).norm() - (radius_a - share * narrows);
    }
};

Vec8 values_of(const RoundedCone& cone) {
    Vec8 values;
    values << cone.a, cone.b, cone.radius_a, cone.radius_b;
    return values;
}

class Fit {
  public:
    Fit(const Samples& samples, std::span<RoundedCone> cones, double size)
        : samples_(samples), cones_(cones), size_(size),
          owner_(samples.size(), samples.get_allocator().resource()),
          next_(samples.size(), owner_.get_allocator()),
          leasts_(samples.size(), owner_.get_allocator()),
          damping_(cones.size(), first_damping, owner_.get_allocator()) {}

    void run() {
        start();
        double loss = refine(40);
        std::pmr::vector<RoundedCone> best(owner_.get_allocator());
        for (int i = 0; cones_.size() > 1 && i < tries; ++i) {
            best.assign(cones_.begin(), cones_.end());
            move_least_missed();
            if (const double now = refine(12); now < loss) {
                loss = now;
            } else {
                std::ranges::copy(best, cones_.begin());
                choose();
            }
        }
        refine(20);
    }

  private:
    static constexpr double first_damping = 1e-3;
    static constexpr int tries = 16;

    // Centres of balls in clusters, each farthest from those before, then in their middles; a cone
    // along the longest axis of each.
    void start() {
        std::pmr::vector<Vec3> centres({samples_.front().middle}, owner_.get_allocator());
        const auto apart = [&](const Sample& sample) {
            double least = infinite;
            for (const Vec3& centre : centres)
                least = std::min(least, (sample.middle - centre).squaredNorm());
            return least * sample.radius; // rather in what is thick
        };
        while (centres.size() < cones_.size())
            centres.push_back(std::ranges::max_element(samples_, {}, apart)->middle);
        for (int i = 0; i < 20; ++i)
            gather(centres);
        for (size_t k = 0; k < cones_.size(); ++k)
            cones_[k] = along_cluster(static_cast<uint32_t>(k), centres[k]);
    }

    void gather(std::pmr::vector<Vec3>& centres) {
        std::pmr::vector<std::pair<Vec3, double>> sums(centres.size(), {Vec3::Zero(), 0},
                                                       owner_.get_allocator());
        for (size_t i = 0; i < samples_.size(); ++i) {
            const Vec3& x = samples_[i].middle;
            const auto nearest = std::ranges::min_element(
                centres, {}, [&](const Vec3& centre) { return (x - centre).squaredNorm(); });
            owner_[i] = static_cast<uint32_t>(nearest - centres.begin());
            sums[owner_[i]].first += x;
            sums[owner_[i]].second += 1;
        }
        for (size_t k = 0; k < centres.size(); ++k)
            if (sums[k].second > 0)
                centres[k] = sums[k].first / sums[k].second;
    }

    RoundedCone along_cluster(uint32_t k, const Vec3& centre) const {
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        double radius = 0, number = 0;
        for (size_t i = 0; i < samples_.size(); ++i) {
            if (owner_[i] != k)
                continue;
            const Vec3 from = samples_[i].middle - centre;
            spread += from * from.transpose();
            radius += samples_[i].radius;
            number += 1;
        }
        if (number == 0)
            return ball({centre, Vec3::UnitX(), centre, 0.01 * size_});
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread / number);
        const Vec3 half = (1.2 * std::sqrt(std::max(axes.eigenvalues()[2], 0.0)) + 1e-3 * size_) *
                          axes.eigenvectors().col(2);
        return {centre - half, centre + half, radius / number, radius / number};
    }

    // A short one in the place of a ball.
    RoundedCone ball(const Sample& sample) const {
        const Vec3 half = 1e-3 * size_ * sample.outward.unitOrthogonal();
        return {sample.middle - half, sample.middle + half, sample.radius, sample.radius};
    }

    // Which cone each point is the business of, and how far the next one is; the sum of squares.
    double choose() {
        double loss = 0;
        for (size_t i = 0; i < samples_.size(); ++i) {
            double least = infinite;
            next_[i] = infinite;
            for (size_t k = 0; k < cones_.size(); ++k) {
                const double d = cones_[k].distance(samples_[i].x);
                next_[i] = std::min(next_[i], std::max(least, d));
                if (d < least) {
                    least = d;
                    owner_[i] = static_cast<uint32_t>(k);
                }
            }
            leasts_[i] = least;
            loss += least * least;
        }
        return loss;
    }

    // All cones at once, each as if the others stayed; the best of all rounds is what is left.
    double refine(int rounds) {
        std::pmr::vector<RoundedCone> best(cones_.begin(), cones_.end(), owner_.get_allocator());
        double loss = choose();
        for (int round = 0; round < rounds; ++round) {
            for (size_t k = 0; k < cones_.size(); ++k)
                improve(static_cast<uint32_t>(k));
            if (const double now = choose(); now < loss) {
                loss = now;
                best.assign(cones_.begin(), cones_.end());
            }
        }
        std::ranges::copy(best, cones_.begin());
        return choose();
    }

    // With `cone` in the place of cone k: of all points, since it may grow over those of others.
    double loss_of(uint32_t k, const RoundedCone& cone) const {
        double loss = 0;
        for (size_t i = 0; i < samples_.size(); ++i) {
            const double others = owner_[i] == k ? next_[i] : leasts_[i];
            loss += std::pow(std::min(others, cone.distance(samples_[i].x)), 2);
        }
        return loss;
    }

    RoundedCone cone_of(const Vec8& values) const {
        const double least = 1e-4 * size_;
        return {values.head<3>(), values.segment<3>(3), std::max(values[6], least),
                std::max(values[7], least)};
    }

    // A step of its eight numbers.
    void improve(uint32_t k) {
        const Vec8 values = values_of(cones_[k]);
        const double h = 1e-6 * size_;
        Mat8 squares = Mat8::Zero();
        Vec8 slope = Vec8::Zero();
        double number = 0;
        for (size_t i = 0; i < samples_.size(); ++i) {
            if (owner_[i] != k)
                continue;
            const double d = cones_[k].distance(samples_[i].x);
            Vec8 derivative;
            for (Eigen::Index j = 0; j < 8; ++j)
                derivative[j] =
                    (cone_of(values + h * Vec8::Unit(j)).distance(samples_[i].x) - d) / h;
            squares += derivative * derivative.transpose();
            slope += d * derivative;
            number += 1;
        }
        if (number == 0)
            return;
        const double before = loss_of(k, cones_[k]);
        for (int i = 0; i < 4; ++i) {
            Mat8 damped = squares;
            damped.diagonal().array() += damping_[k] * number + 1e-12;
            const RoundedCone next = cone_of(values - damped.ldlt().solve(slope));
            if (loss_of(k, next) < before) {
                cones_[k] = next;
                damping_[k] = std::max(1e-6, 0.3 * damping_[k]);
                return;
            }
            damping_[k] = std::min(1e6, 5 * damping_[k]);
        }
    }

    // After choose().
    void move_least_missed() {
        std::pmr::vector<double> missed(cones_.size(), 0, owner_.get_allocator());
        double worst = -infinite;
        const Sample* uncovered = &samples_.front();
        for (size_t i = 0; i < samples_.size(); ++i) {
            missed[owner_[i]] += next_[i] * next_[i] - leasts_[i] * leasts_[i];
            if (leasts_[i] > worst) {
                worst = leasts_[i];
                uncovered = &samples_[i];
            }
        }
        const auto least = std::ranges::min_element(missed) - missed.begin();
        cones_[static_cast<size_t>(least)] = ball(*uncovered);
        damping_[static_cast<size_t>(least)] = first_damping;
    }

    const Samples& samples_;
    std::span<RoundedCone> cones_;
    double size_;                      // m, of the mesh
    std::pmr::vector<uint32_t> owner_; // of each sample, a cone
    std::pmr::vector<double> next_;    // m, of each sample, from the nearest of all other cones
    std::pmr::vector<double> leasts_;  // m, from its own
    std::pmr::vector<double> damping_; // of each cone
};

FitError error_of(const Samples& samples, std::span<const RoundedCone> cones) {
    std::pmr::vector<double> apart(samples.get_allocator());
    double squares = 0;
    for (const Sample& sample : samples) {
        double least = infinite;
        for (const RoundedCone& cone : cones)
            least = std::min(least, cone.distance(sample.x));
        apart.push_back(std::abs(least));
        squares += least * least;
    }
    std::ranges::sort(apart);
    return {std::sqrt(squares / double(apart.size())), apart[apart.size() * 99 / 100],
            apart.back()};
}

MeshPoint point_of(const Vec3& x) {
    return {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
}

double size_of(const MeshShape& shape) {
    double squares = 0;
    for (size_t i = 0; i < 3; ++i)
        squares += std::pow(double(shape.bounds_max[i]) - double(shape.bounds_min[i]), 2);
    return std::sqrt(squares);
}

} // namespace

FitError fit_cones(const Mesh& mesh, std::span<FittedCone> fitted) {
    std::pmr::memory_resource* const memory = mesh.surface.positions.get_allocator().resource();
    const size_t number = 2000 + 50 * fitted.size();
    const double size = size_of(mesh.shape);
    Samples samples = spread(mesh.surface, number, memory);
    measure_balls(samples, size);
    std::pmr::vector<RoundedCone> cones(fitted.size(), memory);
    Fit(samples, cones, size).run();
    for (size_t k = 0; k < cones.size(); ++k)
        fitted[k] = {point_of(cones[k].a), point_of(cones[k].b),
                     static_cast<float>(cones[k].radius_a), static_cast<float>(cones[k].radius_b)};
    return error_of(spread(mesh.surface, 4 * number + 1, memory), cones);
}

} // namespace plait
