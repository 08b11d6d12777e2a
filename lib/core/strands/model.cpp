#include "core/strands/model.hpp"

#include "core/strands/traits.hpp"

namespace plait {

Result<std::unique_ptr<Model>> make_model(const Settings& settings, const ModelInput& input) {
    if (traits_of(settings.model).switches)
        return make_lane_model(settings, input);
    return make_tressfx_model(input.layout);
}

} // namespace plait
