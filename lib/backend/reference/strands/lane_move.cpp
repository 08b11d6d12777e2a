// lane_move: a strand's rows, all components, from one lane of a buffer to a lane of another.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {

void lane_move(uint32_t item_count, const plait_lane_move_params& params,
               const lane_move_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const Lane from(args.lane_slot[2 * item], params.vertex_stride, params.tile);
        const Lane to(args.lane_slot[2 * item + 1], params.vertex_stride, params.tile);
        for (size_t row = 0; row < params.vertex_stride; ++row)
            for (size_t c = 0; c < params.components; ++c)
                args.lane_to[to.index(row, c, params.components)] =
                    args.lane_from[from.index(row, c, params.components)];
    }
}

} // namespace plait::reference
