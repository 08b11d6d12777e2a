// accelerate: nothing pulls.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void accelerate(uint32_t item_count, const plait_accelerate_params&, const accelerate_args& args) {
    for (size_t item = 0; item < item_count; ++item)
        args.acceleration[item] = Vec4::Zero();
}

} // namespace plait::reference
