// last_frame: positions times a scale.
#include "backend/reference/base/math.hpp"
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void last_frame(uint32_t item_count, const plait_last_frame_params& params,
                const last_frame_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const Vec4 x = args.position[item];
        args.position_last_frame[item] = with_w(double(params.scale) * xyz(x), x.w());
    }
}

} // namespace plait::reference
