// tressfx_carry: one rigid motion of all positions and both histories.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void tressfx_carry(uint32_t item_count, const plait_carry_params& params,
                   const tressfx_carry_args& args) {
    const Pose motion{quat(params.q), vec3(params.t)};
    for (size_t item = 0; item < item_count; ++item)
        for (const auto* state : {&args.position, &args.position_prev, &args.position_prev2}) {
            Vec4& x = (*state)[item];
            set_xyz(x, motion.apply(xyz(x)));
        }
}

} // namespace plait::reference
