#include "measures.hpp"

#include "generator/generator.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace lab::volume {

namespace {

constexpr double cell = 0.012;  // m, of the measured volume
constexpr double reach = 0.012; // m, of neighbours
constexpr size_t sampled = 500; // vertices whose neighbours are looked for

uint64_t cell_of(const Vec3& x, double edge) {
    uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double place = std::clamp(std::floor(x[axis] / edge), -1e5, 1e5) + 2e5;
        key = key << 20 | static_cast<uint64_t>(place);
    }
    return key;
}

Vec3 mean_velocity(const Cloud& cloud) {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (size_t i = 0; i < cloud.size(); ++i)
        if (cloud.moves[i]) {
            sum += cloud.mass[i] * cloud.v[i];
            mass += cloud.mass[i];
        }
    return sum / mass;
}

double energy_of(const Cloud& cloud) {
    const Vec3 mean = mean_velocity(cloud);
    double energy = 0;
    for (size_t i = 0; i < cloud.size(); ++i)
        if (cloud.moves[i])
            energy += 0.5 * cloud.mass[i] * (cloud.v[i] - mean).squaredNorm();
    return energy;
}

std::vector<std::pair<size_t, size_t>> pairs_of(const Cloud& cloud, uint32_t row) {
    std::vector<std::pair<size_t, size_t>> pairs;
    const size_t apart = cloud.size() / sampled + 1;
    for (size_t i = 0; i < cloud.size(); i += apart)
        for (size_t k = 0; k < cloud.size(); ++k)
            if (i / row != k / row && (cloud.x[i] - cloud.x[k]).norm() < reach)
                pairs.push_back({i, k});
    return pairs;
}

} // namespace

Room room_of(const Cloud& cloud) {
    std::unordered_map<uint64_t, double> cells;
    double all = 0, squares = 0, height = 0, above = 0;
    for (const Vec3& x : cloud.x) {
        cells[cell_of(x, cell)] += 1;
        all += 1;
        if (x.y() > 0) {
            height += x.norm() - plait_generator::ball_radius;
            above += 1;
        }
    }
    for (const auto& [key, count] : cells)
        squares += count * count;
    return {all * all / squares * std::pow(cell, 3), height / std::max(above, 1.0)};
}

double strand_length(const Cloud& rest, uint32_t row) {
    double sum = 0;
    for (size_t i = 0; i < rest.size(); ++i)
        sum += i % row == 0 ? 0 : (rest.x[i] - rest.x[i - 1]).norm();
    return sum * row / static_cast<double>(rest.size());
}

double way(const Cloud& before, const Cloud& now) {
    double squares = 0;
    for (size_t i = 0; i < now.size(); ++i)
        squares += (now.x[i] - before.x[i]).squaredNorm();
    return std::sqrt(squares / static_cast<double>(now.size()));
}

double momentum_change(const Cloud& cloud, const std::vector<Vec3>& changed) {
    Vec3 sum = Vec3::Zero();
    double sizes = 0;
    for (size_t i = 0; i < changed.size(); ++i) {
        sum += cloud.mass[i] * changed[i];
        sizes += cloud.mass[i] * changed[i].norm();
    }
    return sizes > 0 ? sum.norm() / sizes : 0;
}

double energy_change(const Cloud& cloud, const std::vector<Vec3>& changed) {
    Cloud after = cloud;
    for (size_t i = 0; i < changed.size(); ++i)
        after.v[i] += changed[i];
    const double before = energy_of(cloud);
    return (energy_of(after) - before) / before;
}

// Of some vertices, spread over all.
Neighbours::Neighbours(const Cloud& rest, uint32_t row) : row_(row), pairs_(pairs_of(rest, row)) {}

double Neighbours::kept(const Cloud& now) const {
    const auto near = [&](const std::pair<size_t, size_t>& pair) {
        return (now.x[pair.first] - now.x[pair.second]).norm() < reach;
    };
    return static_cast<double>(std::count_if(pairs_.begin(), pairs_.end(), near)) /
           static_cast<double>(std::max<size_t>(pairs_.size(), 1));
}

double Neighbours::crowd(const Cloud& now) const {
    return static_cast<double>(pairs_of(now, row_).size()) /
           static_cast<double>(std::max<size_t>(pairs_.size(), 1));
}

} // namespace lab::volume
