// tangents: the direction to the next vertex; the last vertex and the padding repeat the last one.
// A segment of no length takes the direction of the nearest one towards the root that has some,
// else of the nearest towards the tip, else +y: a tangent is always a unit vector. Padding takes
// the tip's position too, so that a row can be drawn without its count.
#include "backend/reference/stages.hpp"

#include <algorithm>

namespace plait::reference {
namespace {

Vec3 segment_direction(const tangents_args& args, size_t item) {
    return direction(xyz(args.position[item + 1]) - xyz(args.position[item]));
}

Vec3 tangent(const tangents_args& args, size_t root, uint32_t segment, uint32_t segments) {
    for (uint32_t back = 0; back <= segment; ++back)
        if (Vec3 d = segment_direction(args, root + segment - back); !d.isZero(0))
            return d;
    for (uint32_t next = segment + 1; next < segments; ++next)
        if (Vec3 d = segment_direction(args, root + next); !d.isZero(0))
            return d;
    return Vec3::UnitY();
}

} // namespace

void tangents(uint32_t item_count, const plait_layout_params& params, const tangents_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [strand, i] = strand_vertex(item, params.vertex_stride);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const size_t root = strand * params.vertex_stride;
        const uint32_t segment = std::min(i, count - 2);
        args.tangent[item] = with_w(tangent(args, root, segment, count - 1), 0);
        if (i >= count)
            args.position[item] = args.position[root + count - 1];
    }
}

} // namespace plait::reference
