#include "core/pins/lane_springs.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// Under 10 g of the whole strand a held vertex is off by a hundredth of a segment, and by less in short
// substeps, where that is a soft spring, and the rest of what bounces is gone in a few.
constexpr float hold = 1e4f;            // m/s^2
constexpr float steps_of_hold = 100.0f; // least rate, 1/h^2
constexpr float pull = 300.0f;          // m/s^2: with 30 times its strand's weight at most

// The slider `groom` in times of the spring that leaves half of a droop. Two springs side by side would
// ask for g/(1 - g); of limp hair, which swings out of the way, the power of .6 of it: between them. At
// 1 a ten-thousandth is left.
float groom_slider(float groom) {
    constexpr float power = 0.8f, least = 1e-5f;
    return std::pow(groom / std::max(1 - groom, least), power);
}

float least_rate(const Part& part) {
    const float step = part.bdf2 ? part.h * 2.0f / 3.0f : part.h; // the integrator's own, s
    return steps_of_hold / (step * step);
}

void fill_pins(Schedule& schedule, const Part& part, const State& state) {
    schedule.add(PLAIT_STAGE_lane_pin, part.lanes.strands,
                 plait_lane_pin_params{part.lanes.row, part.lanes.tile, part.row_stride, part.share,
                                       hold, least_rate(part), part.h, pull},
                 {&part.strand, &part.vertex_count, &part.rest, &part.pose, &part.material,
                  &state.pin_from, &state.pin_to, &part.x, &part.v, &part.spring},
                 part.lanes.row);
}

// `pins`: the springs are beside those.
void fill_groom(Schedule& schedule, const Part& part, float groom, bool pins) {
    schedule.add(PLAIT_STAGE_lane_groom, part.lanes.strands,
                 plait_lane_groom_params{part.lanes.row, part.lanes.tile, part.row_stride,
                                         pins ? 1u : 0u, groom_slider(groom), part.h,
                                         least_rate(part), pull},
                 {&part.strand, &part.vertex_count, &part.rest, &part.pose, &part.material,
                  &part.groom, &part.x, &part.v, &part.spring},
                 part.lanes.row);
}

} // namespace

void fill_springs(Schedule& schedule, const Part& part, const State& state, float groom,
                  Doors& doors) {
    if (state.pin_to) {
        fill_pins(schedule, part, state);
        doors.spring = true;
    }
    if (part.groom && (groom > 0 || part.grooms)) {
        fill_groom(schedule, part, groom, doors.spring);
        doors.spring = true;
    }
}

} // namespace plait
