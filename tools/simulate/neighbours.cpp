#include "neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simulate {

namespace {

constexpr size_t most_pairs = 500;

double squared_distance(const float* a, const float* b) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        sum += double(a[axis] - b[axis]) * double(a[axis] - b[axis]);
    return sum;
}

} // namespace

Neighbours::Neighbours(std::span<const float> rest, std::span<const uint32_t> vertex_count,
                       uint32_t row)
    : row_(row) {
    const size_t strands = vertex_count.size(), step = strands / most_pairs + 1;
    const auto root = [&](size_t strand) { return &rest[4 * row * strand]; };
    for (size_t strand = 0; strand < strands && strands > 1; strand += step) {
        double least = std::numeric_limits<double>::infinity();
        size_t nearest = 0;
        for (size_t other = 0; other < strands; ++other)
            if (const double gap = squared_distance(root(strand), root(other));
                other != strand && gap < least) {
                least = gap;
                nearest = other;
            }
        pairs_.push_back({static_cast<uint32_t>(strand), static_cast<uint32_t>(nearest),
                          std::min(vertex_count[strand], vertex_count[nearest])});
    }
    keep(rest);
}

std::array<float, 3> Neighbours::apart(std::span<const float> positions, Pair pair,
                                       uint32_t vertex) const {
    const float* const a = &positions[4 * (size_t{row_} * pair.strand + vertex)];
    const float* const b = &positions[4 * (size_t{row_} * pair.other + vertex)];
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

void Neighbours::keep(std::span<const float> positions) {
    before_.clear();
    for (const Pair& pair : pairs_)
        for (uint32_t vertex = 1; vertex < pair.vertices; ++vertex)
            before_.push_back(apart(positions, pair, vertex));
}

void Neighbours::add(std::span<const float> positions, float step) {
    size_t at = 0;
    for (const Pair& pair : pairs_)
        for (uint32_t vertex = 1; vertex < pair.vertices; ++vertex, ++at) {
            const std::array<float, 3> now = apart(positions, pair, vertex);
            sum_.squares +=
                squared_distance(now.data(), before_[at].data()) / double(step) / double(step);
        }
    sum_.count += before_.size();
    keep(positions);
}

double Neighbours::rms_speed() const {
    return sum_.count ? std::sqrt(sum_.squares / static_cast<double>(sum_.count)) : 0.0;
}

} // namespace simulate
