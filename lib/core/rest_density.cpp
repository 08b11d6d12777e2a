#include "core/rest_density.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

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
    Nodes(const RestGrid& grid, std::pmr::memory_resource* memory)
        : grid_(grid), density_(size_t{grid.edge_count} * grid.edge_count * grid.edge_count, 0.0,
                                memory) {}

    // Calls visit(density at a node, weight there) for the nodes around a point, as the kernels
    // have it.
    template <typename Visit> void around(const float* point, const Visit& visit) {
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
            visit(density_[(cell[1] * n + cell[2]) * n + cell[0]], weight);
        }
    }

  private:
    RestGrid grid_;
    std::pmr::vector<double> density_;
};

} // namespace

RestDensity measure_rest_density(std::span<const float> positions, std::span<const uint32_t> counts,
                                 const RestGrid& grid, std::pmr::memory_resource* memory) {
    RestDensity rest(memory);
    share_hair(positions, counts, rest.hair);
    Nodes nodes(grid, memory);
    for (size_t i = 0; i < rest.hair.size(); ++i)
        nodes.around(&positions[3 * i], [&](double& density, double weight) {
            density += weight * double(rest.hair[i]);
        });
    for (size_t i = 0; i < rest.hair.size(); ++i) {
        double gathered = 0;
        nodes.around(&positions[3 * i],
                     [&](double& density, double weight) { gathered += weight * density; });
        rest.density.push_back(static_cast<float>(gathered));
    }
    return rest;
}

} // namespace plait
