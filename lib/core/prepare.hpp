// Programs made before anything runs them.
#pragma once

#include "core/context.hpp"

#include <span>

namespace plait {

// What sims of these models run, for strands of `row` vertices: the stages that every sim may take,
// those of strands over lanes or of tressfx as the models ask, and each model's own.
// @errors UNSUPPORTED, COMPILE
Status prepare_models(Context& context, std::span<const plait_model> models, uint32_t row);

} // namespace plait
