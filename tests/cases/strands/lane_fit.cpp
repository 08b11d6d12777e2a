#include "lane_inputs.hpp"

namespace plait::cases {

// A difference of two rounded positions of up to 5 m; velocities are copied.
Case lane_fit_case() {
    Case result = {PLAIT_STAGE_lane_fit,
                   {},
                   {{"lane_x_before", 1e-5}, {"lane_v_before", 0}},
                   {"lane_x_before", "lane_v_before"}}; // of the other strands kept
    for (const Size& size : sizes()) {
        LaneHair lanes = make_lane_hair(size, 43);
        for (float& v : lanes.v)
            v *= 10;
        Setup setup;
        setup.name = name_of(size);
        setup.items = (size.strands + 1) / 2;
        std::vector<uint32_t> slots;
        for (const uint32_t lane : other_order(size.strands, setup.items))
            slots.insert(slots.end(), {0, lane});
        setup.buffers = {uints(slots), lane_floats(lanes.v, 3), lane_floats(lanes.x, 3),
                         lane_floats(lanes.x_before, 3), lane_floats(lanes.v_before, 3)};
        result.setups.push_back(setup.with(plait_lane_fit_params{size.stride, 1, 1.0f / 60}));
    }
    return result;
}

} // namespace plait::cases
