// tangents: the direction to the next vertex; the last vertex and the padding repeat the last one.
// Padding takes the tip's position too, so that a row can be drawn without its count.
#include "backend/reference/base/tangent.hpp"

#include <algorithm>

namespace plait::reference {

void tangents(uint32_t item_count, const plait_tangents_params& params, const tangents_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [of, i] = strand_vertex(item, params.vertex_stride);
        const size_t strand = params.strand_first + of;
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const size_t root = strand * params.vertex_stride;
        args.tangent[root + i] = with_w(tangent(args.position, root, i, count), 0);
        if (i >= count)
            args.position[root + i] = args.position[root + count - 1];
    }
}

} // namespace plait::reference
