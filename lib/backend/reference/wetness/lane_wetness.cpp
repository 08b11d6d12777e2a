// lane_wetness: rho A (1 + 0.6 w), EI and GJ (1 - 0.5 w), and EA (1 + 0.6 w) where it holds the weight.
#include "backend/reference/base/lanes.hpp"

#include <plait/constants.h>

#include <algorithm>

namespace plait::reference {

void lane_wetness(uint32_t item_count, const plait_lane_wetness_params& params,
                  const lane_wetness_args& args) {
    const size_t last = params.vertex_stride - size_t{1};
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const auto at = [&](size_t row, size_t component) {
            return lane.index(row, component, PLAIT_LANE_MATERIAL_COMPONENTS);
        };
        const double w = args.wetness_held[strand_of(args.lane_strand, slot)];
        if (args.lane_material[at(last, PLAIT_LANE_WETNESS)] == w)
            continue;
        const double mass = 1 + PLAIT_WET_DENSITY * w, joint = 1 - PLAIT_WET_BEND * w;
        const double stretch = args.lane_dry[at(last, PLAIT_LANE_WEIGHED)] != 0 ? mass : 1;
        const auto set = [&](size_t row, size_t component, double factor) {
            args.lane_material[at(row, component)] = factor * args.lane_dry[at(row, component)];
        };
        for (size_t i = 0; i <= last; ++i) {
            const double length = args.lane_dry[at(i, PLAIT_LANE_LENGTH)];
            const bool hair = i == 0 || args.lane_dry[at(i - 1, PLAIT_LANE_LENGTH)] > 0;
            set(i, PLAIT_LANE_LENGTH, 1);
            set(i, PLAIT_LANE_MASS, hair ? mass : 1);
            if (i == last)
                break;
            set(i, PLAIT_LANE_STRETCH, stretch);
            for (const size_t component : {PLAIT_LANE_BEND, PLAIT_LANE_TWIST, PLAIT_LANE_CROSS})
                set(i, component, joint);
            double& bend = args.lane_material[at(i, PLAIT_LANE_BEND)];
            const double least = PLAIT_LANE_LEAST_BEND *
                                 args.lane_material[at(i, PLAIT_LANE_STRETCH)] * length * length;
            bend = std::max(bend, least);
        }
        for (const size_t scale : {PLAIT_LANE_DRAG, PLAIT_LANE_FRICTION, PLAIT_LANE_WEIGHED})
            set(last, scale, 1);
        args.lane_material[at(last, PLAIT_LANE_WETNESS)] = w;
    }
}

} // namespace plait::reference
