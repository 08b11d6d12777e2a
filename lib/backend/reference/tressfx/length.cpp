// length: bring every edge back to its rest length, even edges first, then odd ones, so that the
// edges of one colour share no vertex and may be corrected in any order.
//   d = x_{i+1} - x_i,  delta = (1 - l / max(|d|, 1e-7)) d,  shared by movability: half each, or
//   all to the free end of an edge whose other end is pinned.
// Source: Mueller et al. 2007, "Position based dynamics", section 3.3; red/black as in TressFX.
#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

#include <algorithm>

namespace plait::reference {
namespace {

void correct_edge(Vec4& a, Vec4& b, double rest_length) {
    if (pinned(a) && pinned(b))
        return;
    const Vec3 d = xyz(b) - xyz(a);
    const Vec3 delta = (1 - rest_length / std::max(d.norm(), PLAIT_LENGTH_MIN_DISTANCE)) * d;
    const double share_of_a = pinned(a) ? 0 : pinned(b) ? 1 : 0.5;
    set_xyz(a, xyz(a) + share_of_a * delta);
    set_xyz(b, xyz(b) - (1 - share_of_a) * delta);
}

} // namespace

void length(uint32_t item_count, const plait_length_params& params, const length_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        const size_t root = strand * params.vertex_stride;
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        for (uint32_t iteration = 0; iteration < params.iterations; ++iteration)
            for (const uint32_t colour : {0u, 1u})
                for (uint32_t i = colour; i + 1 < count; i += 2)
                    correct_edge(args.position[root + i], args.position[root + i + 1],
                                 args.rest_length[root + i]);
    }
}

} // namespace plait::reference
