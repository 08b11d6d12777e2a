#include "core/follows/follow_places.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// Of a segment. Strands with as many segments have their middles at the same shares of length but for
// the rounding of positions, some 1e-5 of a segment; a turn that lies on a middle takes half the time.
constexpr double beside = 1e-4;

double segment_length(const float* p) {
    return std::hypot(double(p[3]) - p[0], double(p[4]) - p[1], double(p[5]) - p[2]);
}

// Appends where the middle of each of a strand's segments is, as a share of its length.
void append_middles(const float* strand, uint32_t count, std::pmr::vector<double>& to) {
    const size_t first = to.size();
    double length = 0;
    for (uint32_t i = 0; i + 1 < count; ++i) {
        const double segment = segment_length(strand + size_t{3} * i);
        to.push_back(length + segment / 2);
        length += segment;
    }
    for (size_t i = first; i < to.size(); ++i)
        to[i] /= length;
}

} // namespace

Middles middles_of(std::span<const float> positions, std::span<const uint32_t> vertex_counts,
                   std::pmr::memory_resource* memory) {
    Middles middles{std::pmr::vector<double>(memory), std::pmr::vector<size_t>(memory)};
    const float* strand = positions.data();
    for (const uint32_t count : vertex_counts) {
        middles.first.push_back(middles.at.size());
        append_middles(strand, count, middles.at);
        strand += size_t{3} * count;
    }
    middles.first.push_back(middles.at.size());
    return middles;
}

float place_in(std::span<const double> middles, double share) {
    const auto after = std::upper_bound(middles.begin(), middles.end(), share);
    if (after == middles.begin())
        return 0;
    const auto a = static_cast<size_t>(after - middles.begin()) - 1;
    if (after == middles.end())
        return static_cast<float>(a);
    const double t = (share - middles[a]) / (middles[a + 1] - middles[a]);
    return static_cast<float>(double(a) + (t < beside ? 0 : t > 1 - beside ? 1 : t));
}

} // namespace plait
