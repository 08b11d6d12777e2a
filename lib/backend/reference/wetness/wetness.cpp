// wetness: w e^(-t/tau), 0 once it is less than can be felt; and the value that material has, which
// follows it in steps.
#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

#include <cmath>

namespace plait::reference {

void wetness(uint32_t item_count, const plait_wetness_params& params, const wetness_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        double w = args.wetness_given[strand] * double(params.left);
        if (w < PLAIT_WETNESS_DRY)
            w = 0;
        args.strand_wetness[strand] = w;
        double& held = args.wetness_held[strand];
        if (std::abs(w - held) > PLAIT_WETNESS_MOVE || w == 0)
            held = w;
    }
}

} // namespace plait::reference
