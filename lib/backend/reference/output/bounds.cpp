// bounds: least and greatest coordinates of a run of points or boxes.
#include "backend/reference/base/stages.hpp"

#include <algorithm>
#include <cfloat>

namespace plait::reference {

void bounds(uint32_t item_count, const plait_bounds_params& params, const bounds_args& args) {
    const size_t stride = params.boxes ? 2 : 1;
    for (size_t item = 0; item < item_count; ++item) {
        Vec3 least = Vec3::Constant(FLT_MAX), greatest = -least;
        const size_t begin = item * params.share;
        for (size_t i = begin; i < std::min<size_t>(params.count, begin + params.share); ++i) {
            const Vec3 low = xyz(args.points[stride * i]);
            const Vec3 high = xyz(args.points[stride * i + stride - 1]);
            if (!low.allFinite() || !high.allFinite())
                continue;
            least = least.cwiseMin(low);
            greatest = greatest.cwiseMax(high);
        }
        args.box[2 * item] = with_w(least, 0);
        args.box[2 * item + 1] = with_w(greatest, 0);
    }
}

} // namespace plait::reference
