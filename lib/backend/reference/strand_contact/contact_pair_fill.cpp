// contact_pair_fill: the segments of every cell, and where they are and move to; here in the order of their
// numbers.
#include "backend/reference/strand_contact/pair.hpp"

namespace plait::reference {

void contact_pair_fill(uint32_t item_count, const plait_pair_params& params,
                       const contact_pair_fill_args& args) {
    for (uint32_t item = 0; item < item_count; ++item)
        if (has_segment(args.vertex_count, item, params.vertex_stride)) {
            const Segment segment = segment_at(args.position, item);
            const Segment moves = moves_of(args.position, args.position_prev, item);
            const Cell cell = cell_of(params, segment.middle());
            const size_t at = args.cell_end[number_of(cell, params.edge_count)]++;
            args.cell_segment[at] = item;
            const auto put = [&](size_t component, double value) {
                args.cell_line[component * line_stride(item_count) + at] = value;
            };
            const Vec3 way = segment.to - segment.from, change = moves.to - moves.from;
            for (const Eigen::Index k : {0, 1, 2}) {
                const auto axis = static_cast<size_t>(k);
                put(PLAIT_PAIR_MIDDLE + axis, segment.middle()[k]);
                put(PLAIT_PAIR_HALF + axis, std::abs(way[k]) / 2);
                put(PLAIT_PAIR_FROM + axis, segment.from[k]);
                put(PLAIT_PAIR_WAY + axis, way[k]);
                put(PLAIT_PAIR_MOVES + axis, moves.middle()[k]);
                put(PLAIT_PAIR_CHANGE + axis, change[k]);
            }
            put(PLAIT_PAIR_SPREAD, change.norm() / 2);
        }
}

} // namespace plait::reference
