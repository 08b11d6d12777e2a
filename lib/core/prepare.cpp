#include "core/prepare.hpp"

#include "core/models/traits.hpp"
#include "core/schedule.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace plait {
namespace {

// Stages that no strand over lanes takes, whatever its parameters.
constexpr plait_stage of_tressfx[] = {
    PLAIT_STAGE_integrate, PLAIT_STAGE_strand_data,    PLAIT_STAGE_wind,
    PLAIT_STAGE_length,    PLAIT_STAGE_collide,        PLAIT_STAGE_clamp,
    PLAIT_STAGE_reset,     PLAIT_STAGE_velocity_shock, PLAIT_STAGE_teleport};

bool runs(const plait_stage_info& stage, std::span<const plait_model> models) {
    const auto is_among = [&](plait_model model) {
        return std::find(models.begin(), models.end(), model) != models.end();
    };
    for (const ModelTraits& traits : all_models())
        if (traits.stage == stage.stage)
            return is_among(traits.model);
    if (std::find(std::begin(of_tressfx), std::end(of_tressfx), stage.stage) !=
        std::end(of_tressfx))
        return is_among(PLAIT_MODEL_TRESSFX);
    if (std::string_view(stage.name).starts_with("lane_"))
        return std::any_of(models.begin(), models.end(),
                           [](plait_model model) { return traits_of(model).switches; });
    return true;
}

uint32_t width_of(const plait_stage_info& stage, uint32_t row) {
    const bool by_strand =
        stage.space == PLAIT_SPACE_LANES || stage.space == PLAIT_SPACE_STRAND_GROUP;
    return by_strand ? row : 1;
}

} // namespace

Status prepare_models(Context& context, std::span<const plait_model> models, uint32_t row) {
    std::vector<plait_dispatch> list;
    for (int i = 0; i < PLAIT_STAGE_COUNT; ++i) {
        const plait_stage_info& stage = *plait_stage_describe(static_cast<plait_stage>(i));
        if (!runs(stage, models))
            continue;
        // groups of voxels are as wide as their slots, which nobody knows yet
        const bool known = stage.space != PLAIT_SPACE_VOXEL_GROUP;
        for (const uint32_t items : {1u, 1u << 20}) // few and many: compilers may tell them apart
            list.push_back({stage.stage, known ? items : 0, width_of(stage, row), nullptr,
                            stage.params_size, stage.buffer_count, nullptr, 0});
    }
    PLAIT_TRY(check_supported(context.device, list));
    return context.device.prepare(list);
}

} // namespace plait
