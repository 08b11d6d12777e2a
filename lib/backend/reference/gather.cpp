// gather: row i of the result is row lane_strand[i].
#include "backend/reference/stages.hpp"

namespace plait::reference {

void gather(uint32_t item_count, const plait_layout_params& params, const gather_args& args) {
    const size_t width = params.vertex_stride;
    for (size_t item = 0; item < item_count; ++item)
        for (size_t i = 0; i < width; ++i)
            args.gathered[item * width + i] = args.rows[args.lane_strand[item] * width + i];
}

} // namespace plait::reference
