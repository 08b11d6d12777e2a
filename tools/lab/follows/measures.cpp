#include "measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lab::follows {

namespace {

constexpr size_t most_pairs = 500;    // of neighbours
constexpr double slow = 1e-3;         // m a frame: steps of guides below it compare nothing
constexpr double lowest_share = 0.01; // of the neighbours' distances

size_t nearest_root(const Hair& rest, size_t strand) {
    size_t nearest = strand;
    float least = std::numeric_limits<float>::infinity();
    for (size_t other = 0; other < rest.strands(); ++other) {
        const float square = (rest.strand(other)[0] - rest.strand(strand)[0]).squaredNorm();
        if (other != strand && square < least) {
            least = square;
            nearest = other;
        }
    }
    return nearest;
}

double angle_at(const Point* x) {
    const Vec3 a = (x[1] - x[0]).cast<double>(), b = (x[2] - x[1]).cast<double>();
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace

Measures::Measures(const Hair& rest, std::vector<bool> simulated)
    : rest_(rest), before_(rest), simulated_(std::move(simulated)) {
    const size_t apart = rest.strands() / most_pairs + 1;
    for (size_t s = 0; s < rest.strands(); s += apart)
        pairs_.push_back({s, nearest_root(rest, s)});
}

void Measures::add_segments(const Hair& now) {
    for (size_t s = 0; s < now.strands(); ++s) {
        const Point *x = now.strand(s), *r = rest_.strand(s);
        for (uint32_t i = 0; i + 1 < now.counts[s]; ++i) {
            const double length = double((r[i + 1] - r[i]).norm());
            length_ = std::max(length_, std::abs(double((x[i + 1] - x[i]).norm()) / length - 1));
            if (i + 2 < now.counts[s])
                kink_ = std::max(kink_, std::abs(angle_at(x + i) - angle_at(r + i)));
        }
    }
}

void Measures::add_steps(const Hair& now) {
    double follows = 0, guides = 0;
    for (size_t s = 0; s < now.strands(); ++s) {
        double& most = simulated_[s] ? guides : follows;
        most = std::max(most, double((now.tip(s) - before_.tip(s)).norm()));
    }
    if (guides > slow)
        step_ = std::max(step_, follows / guides);
}

// Where they were less than a tenth of a millimetre apart at rest there is nothing to keep.
void Measures::add_neighbours(const Hair& now) {
    for (const Pair& pair : pairs_) {
        const uint32_t count = std::min(now.counts[pair.strand], now.counts[pair.other]);
        for (uint32_t i = 1; i < count; ++i) {
            const auto apart = [&](const Hair& hair) {
                return double((hair.strand(pair.strand)[i] - hair.strand(pair.other)[i]).norm());
            };
            if (apart(rest_) > 1e-4)
                beside_.push_back(apart(now) / apart(rest_));
        }
    }
}

void Measures::add(const Hair& now, const Hair& truth) {
    add_segments(now);
    add_steps(now);
    add_neighbours(now);
    double squares = 0;
    for (size_t s = 0; s < now.strands(); ++s)
        for (uint32_t i = 0; i < now.counts[s]; ++i) {
            const double square = double((now.strand(s)[i] - truth.strand(s)[i]).squaredNorm());
            squares += square;
            farthest_ = std::max(farthest_, square);
        }
    const uint64_t points = std::accumulate(now.counts.begin(), now.counts.end(), uint64_t{0});
    curve_.push_back(std::sqrt(squares / static_cast<double>(points)));
    before_ = now;
}

void Measures::finish(FollowRow& row) {
    row.length = length_;
    row.kink = kink_ * 180 / pi;
    row.step = step_;
    double squares = 0; // every frame has as many vertices
    for (const double away : curve_)
        squares += away * away;
    row.away = std::sqrt(squares / static_cast<double>(std::max<size_t>(curve_.size(), 1)));
    row.away_most = std::sqrt(farthest_);
    row.curve = curve_;
    if (beside_.empty())
        return;
    const auto low =
        static_cast<std::ptrdiff_t>(lowest_share * static_cast<double>(beside_.size()));
    std::nth_element(beside_.begin(), beside_.begin() + low, beside_.end());
    row.beside = beside_[static_cast<size_t>(low)];
}

} // namespace lab::follows
