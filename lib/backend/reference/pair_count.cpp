// pair_count: how many segments have their middle in each cell.
#include "backend/reference/pair.hpp"

namespace plait::reference {

void pair_count(uint32_t item_count, const plait_pair_params& params, const pair_count_args& args) {
    for (uint32_t item = 0; item < item_count; ++item)
        if (has_segment(args.vertex_count, item, params.vertex_stride)) {
            const Vec3 middle = segment_at(args.position, item).middle();
            ++args.cell_count[number_of(params, cell_of(params, middle))];
        }
}

} // namespace plait::reference
