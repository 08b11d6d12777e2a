// clamp: limit what a free vertex moves in a substep to C, by scaling with C/|dx|. (The published
// code scales with C^2/|dx|^2, which limits it to C only where |dx| is C.)
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void clamp(uint32_t item_count, const plait_clamp_params& params, const clamp_args& args) {
    const double limit = params.max_displacement;
    for (size_t item = 0; item < item_count; ++item) {
        Vec4& position = args.position[item];
        const Vec3 previous = xyz(args.position_prev[item]);
        const Vec3 moved = xyz(position) - previous;
        if (!pinned(position) && moved.norm() > limit)
            set_xyz(position, previous + moved * (limit / moved.norm()));
    }
}

} // namespace plait::reference
