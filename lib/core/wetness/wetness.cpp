#include "core/wetness/wetness.hpp"

#include "base/format.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plait {

Status check_wetness(std::span<const float> wetness) {
    for (size_t i = 0; i < wetness.size(); ++i)
        if (!(wetness[i] >= 0 && wetness[i] <= 1))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("wetness[%zu] is %g, range is [0, 1]", i, double(wetness[i]))};
    return {};
}

Status Wetness::open(Device& device, const Layout& layout, State& state,
                     std::pmr::memory_resource* memory) {
    const std::pmr::vector<float> dry(layout.guides, 0.0f, memory);
    const auto make = [&](Buffer& to, const char* name) -> Status {
        PLAIT_TRY(device.create(to, PLAIT_ELEMENT_FLOAT, layout.guides, name));
        return device.write(to, dry.data());
    };
    Buffer now, given, held;
    PLAIT_TRY(make(now, "strand_wetness"));
    PLAIT_TRY(make(given, "wetness_given"));
    PLAIT_TRY(make(held, "wetness_held"));
    state.wetness = std::move(now);
    state.wetness_given = std::move(given);
    state.wetness_held = std::move(held);
    return {};
}

void Wetness::close(State& state) {
    for (Buffer* buffer : {&state.wetness, &state.wetness_given, &state.wetness_held})
        *buffer = {};
}

Status Wetness::give(Device& device, const State& state, std::span<const float> wetness) {
    PLAIT_TRY(device.write(state.wetness_given, wetness.data()));
    PLAIT_TRY(device.write(state.wetness, wetness.data()));
    dried_ = 0;
    most_ = std::ranges::max(wetness);
    return {};
}

Status Wetness::resume(Device& device, const State& state, double dried,
                       std::pmr::memory_resource* memory) {
    std::pmr::vector<float> wetness(state.wetness_given.count(), memory);
    PLAIT_TRY(device.read(state.wetness_given, wetness.data()));
    dried_ = dried;
    most_ = std::ranges::max(wetness);
    for (float& w : wetness)
        w = dried > 0 ? now(w) : w; // what no step has been taken with is as it was given
    return device.write(state.wetness, wetness.data());
}

void Wetness::pass(double time, double drying_time) {
    if (drying_time > 0)
        dried_ += time / drying_time;
}

// One number for all strands and all the time since then: factors of single steps, a rounding off
// each, would be off by more with every step, and with a drying time of days not dry at all.
float Wetness::left() const {
    return static_cast<float>(std::exp(-dried_));
}

float Wetness::now(float given) const {
    const float w = left() * given;
    return w < static_cast<float>(PLAIT_WETNESS_DRY) ? 0 : w;
}

bool Wetness::is_dry() const {
    return now(most_) == 0;
}

void Wetness::append(Schedule& schedule, const Layout& layout, const State& state) const {
    schedule.add(PLAIT_STAGE_wetness, layout.guides, plait_wetness_params{left()},
                 {&state.wetness_given, &state.wetness, &state.wetness_held});
}

void Wetness::append_material(Schedule& schedule, const Part& part, const State& state) {
    schedule.add(PLAIT_STAGE_lane_wetness, part.lanes.strands,
                 plait_lane_wetness_params{part.lanes.row, part.lanes.tile},
                 {&part.strand, &state.wetness_held, &part.dry_material, &part.material},
                 part.lanes.row);
}

} // namespace plait
