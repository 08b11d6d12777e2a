// last_frame: a copy.
#include "backend/reference/stages.hpp"

namespace plait::reference {

void last_frame(uint32_t item_count, const plait_layout_params&, const last_frame_args& args) {
    for (size_t item = 0; item < item_count; ++item)
        args.position_last_frame[item] = args.position[item];
}

} // namespace plait::reference
