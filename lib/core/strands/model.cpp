#include "core/strands/model.hpp"

namespace plait {

Result<std::unique_ptr<Model>> make_model(plait_model model, const Settings& settings,
                                          const ModelInput& input) {
    if (model == PLAIT_MODEL_TRESSFX)
        return make_tressfx_model(input.layout);
    return make_lane_model(settings, input);
}

} // namespace plait
