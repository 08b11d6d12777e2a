// pair_fill: the segments of every cell; here in the order of their numbers.
#include "backend/reference/pair.hpp"

namespace plait::reference {

void pair_fill(uint32_t item_count, const plait_pair_params& params, const pair_fill_args& args) {
    for (uint32_t item = 0; item < item_count; ++item)
        if (has_segment(args.vertex_count, item, params.vertex_stride)) {
            const Vec3 middle = segment_at(args.position, item).middle();
            args.cell_segment[args.cell_end[number_of(params, cell_of(params, middle))]++] = item;
        }
}

} // namespace plait::reference
