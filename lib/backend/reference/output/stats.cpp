// stats: the health of a strand: worst |l/l0 - 1|, non-finite vertices, largest displacement since
// the previous position, mean |l/l0 - 1|. What is not finite is counted and left out of the rest.
#include "backend/reference/base/stages.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

struct Stretch {
    double worst = 0;
    double sum = 0;
    double edges = 0;

    void add(double stretch) {
        worst = std::max(worst, stretch);
        sum += stretch;
        ++edges;
    }
    double mean() const { return edges > 0 ? sum / edges : 0; }
};

} // namespace

void stats(uint32_t item_count, const plait_layout_params& params, const stats_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        const size_t root = strand * params.vertex_stride;
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        Stretch stretch;
        double nonfinite = 0, displacement = 0;
        for (size_t item = root; item < root + count; ++item) {
            const Vec3 x = xyz(args.position[item]);
            const Vec3 moved = x - xyz(args.position_prev[item]);
            if (moved.allFinite())
                displacement = std::max(displacement, moved.norm());
            else
                ++nonfinite;
            const double rest_length = args.rest_length[item];
            if (item + 1 == root + count || !(rest_length > 0))
                continue;
            const Vec3 edge = xyz(args.position[item + 1]) - x;
            if (edge.allFinite())
                stretch.add(std::abs(edge.norm() / rest_length - 1));
        }
        args.strand_stats[strand] = {stretch.worst, nonfinite, displacement, stretch.mean()};
    }
}

} // namespace plait::reference
