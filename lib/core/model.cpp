#include "core/model.hpp"

#include "core/models/traits.hpp"

namespace plait {

Result<std::unique_ptr<Model>> make_model(plait_model model, const ModelInput& input) {
    if (traits_of(model).switches)
        return make_lane_model(model, input);
    return make_tressfx_model(input.layout);
}

} // namespace plait
