#include "core/model.hpp"

#include "base/format.hpp"

namespace plait {

Result<std::unique_ptr<Model>> make_model(plait_model model, const ModelInput& input) {
    switch (model) {
    case PLAIT_MODEL_TRESSFX:
        return make_tressfx_model(input.layout);
    case PLAIT_MODEL_CHAIN:
    case PLAIT_MODEL_COSSERAT:
    case PLAIT_MODEL_ROD:
        return make_lane_model(model, input);
    }
    return Error{PLAIT_INVALID_ARGUMENT,
                 format("model is %d, range is [0, %d]", model, PLAIT_MODEL_ROD)};
}

} // namespace plait
