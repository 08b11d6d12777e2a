#include "core/groom/rest_density.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr int rounds = 10;       // of the fit, each a splat and a gather on the host
constexpr double most_hair = 16; // of a vertex: sums of fixed point have an end

double distance(std::span<const float> positions, size_t a, size_t b) {
    double square = 0;
    for (size_t i = 0; i < 3; ++i) {
        const double d = double(positions[3 * b + i]) - double(positions[3 * a + i]);
        square += d * d;
    }
    return std::sqrt(square);
}

// Half of the segments before and behind every vertex, m; then over their mean.
void share_hair(std::span<const float> positions, std::span<const uint32_t> counts,
                std::pmr::vector<float>& hair) {
    hair.assign(positions.size() / 3, 0.0f);
    double total = 0;
    size_t first = 0;
    for (const uint32_t count : counts) {
        for (size_t i = first; i + 1 < first + count; ++i) {
            const double length = distance(positions, i, i + 1);
            hair[i] += static_cast<float>(length / 2);
            hair[i + 1] += static_cast<float>(length / 2);
            total += length;
        }
        first += count;
    }
    const double mean = total / double(std::max<size_t>(hair.size(), 1));
    for (float& share : hair)
        share = mean > 0 ? static_cast<float>(std::min(double(share) / mean, most_hair)) : 1.0f;
}

class Nodes {
  public:
    explicit Nodes(const RestGrid& grid) : grid_(grid) {}

    size_t count() const { return size_t{grid_.edge_count} * grid_.edge_count * grid_.edge_count; }
    // Calls visit(node, weight) for the nodes around a point, as the kernels have it.
    template <typename Visit> void around(const float* point, const Visit& visit) const {
        const size_t n = grid_.edge_count;
        const double voxel = double(grid_.edge) / double(n);
        size_t low[3];
        double high[3];
        for (size_t i = 0; i < 3; ++i) {
            const double g = (double(point[i]) - double(grid_.origin[i])) / voxel;
            if (!(g >= 0 && g < double(n)))
                return;
            const double at = std::clamp(g - 0.5, 0.0, double(n - 1));
            low[i] = std::min(static_cast<size_t>(at), std::max<size_t>(n, 2) - 2);
            high[i] = at - double(low[i]);
        }
        for (size_t corner = 0; corner < (n > 1 ? 8u : 1u); ++corner) {
            size_t cell[3];
            double weight = 1;
            for (size_t i = 0; i < 3; ++i) {
                const bool up = corner >> i & 1;
                cell[i] = low[i] + (up ? 1 : 0);
                weight *= up ? high[i] : 1 - high[i];
            }
            visit((cell[1] * n + cell[2]) * n + cell[0], weight);
        }
    }

  private:
    RestGrid grid_;
};

// What is gathered from nodes is smoother than what is at them: hair would find the groom itself too
// dense at its densest places and swell by a sixth. So densities of vertices are scaled until the
// mean of them at a node is the density there.
class Fit {
  public:
    Fit(std::span<const float> positions, const Nodes& nodes, RestDensity& rest,
        std::pmr::memory_resource* memory)
        : positions_(positions), nodes_(nodes), rest_(rest), at_nodes_(nodes.count(), 0.0, memory),
          ratio_(nodes.count(), 0.0, memory) {}

    void begin() {
        for (size_t i = 0; i < rest_.hair.size(); ++i)
            nodes_.around(&positions_[3 * i], [&](size_t node, double weight) {
                at_nodes_[node] += weight * double(rest_.hair[i]);
            });
        rest_.density.assign(rest_.hair.size(), 0.0f);
        for (size_t i = 0; i < rest_.hair.size(); ++i)
            rest_.density[i] = static_cast<float>(gathered(i, at_nodes_));
    }
    void improve() {
        std::ranges::fill(ratio_, 0.0);
        for (size_t i = 0; i < rest_.hair.size(); ++i)
            nodes_.around(&positions_[3 * i], [&](size_t node, double weight) {
                ratio_[node] += weight * double(rest_.hair[i]) * double(rest_.density[i]);
            });
        for (size_t node = 0; node < ratio_.size(); ++node)
            ratio_[node] =
                ratio_[node] > 0 ? at_nodes_[node] * at_nodes_[node] / ratio_[node] : 1.0;
        for (size_t i = 0; i < rest_.hair.size(); ++i)
            rest_.density[i] *= static_cast<float>(gathered(i, ratio_));
    }

  private:
    double gathered(size_t vertex, const std::pmr::vector<double>& values) const {
        double sum = 0;
        nodes_.around(&positions_[3 * vertex],
                      [&](size_t node, double weight) { sum += weight * values[node]; });
        return sum;
    }

    std::span<const float> positions_;
    const Nodes& nodes_;
    RestDensity& rest_;
    std::pmr::vector<double> at_nodes_, ratio_;
};

} // namespace

RestDensity measure_rest_density(std::span<const float> positions, std::span<const uint32_t> counts,
                                 const RestGrid& grid, std::pmr::memory_resource* memory) {
    RestDensity rest(memory);
    share_hair(positions, counts, rest.hair);
    const Nodes nodes(grid);
    Fit fit(positions, nodes, rest, memory);
    fit.begin();
    for (int round = 0; round < rounds; ++round)
        fit.improve();
    return rest;
}

} // namespace plait
