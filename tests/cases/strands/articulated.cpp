#include "lane_inputs.hpp"

namespace plait::cases {

// Elimination along 256 segments in float32 leaves 1e-4 rad at the tip.
Case articulated_case() {
    Case result = {PLAIT_STAGE_articulated,
                   {},
                   {{"lane_x", 2e-5},
                    {"lane_v", 1e-3},
                    {"lane_q", 4e-4},
                    {"lane_q_before", 4e-4},
                    {"lane_x_before", 2e-5},
                    {"lane_v_before", 1e-3},
                    {"lane_normal_force", 1e-7}},
                   unread_of_colliders()};
    result.unread.push_back("lane_material.wetness");
    for (const Size& size : sizes())
        for (const uint32_t bdf2 : {0u, 1u})
            result.setups.push_back(
                lane_setup(size, make_lane_hair(size, 32), lane_params(size, 1, bdf2), true));
    for (const Size& size : sizes())
        result.setups.push_back(
            lane_setup(size, make_lane_hair_spun(size, 32), lane_params(size, 0, 0), true));
    for (const Size& size : contact_sizes())
        result.setups.push_back(
            lane_setup(size, make_lane_hair_spun(size, 32), lane_params_afloat(size, 0), true));
    for (const Size& size : contact_sizes())
        result.setups.push_back(
            lane_setup(size, make_lane_hair_wrung(size, 32), lane_params(size, 1, 1), true));
    for (const Size& size : contact_sizes())
        result.setups.push_back(
            reordered(lane_setup(size, make_lane_hair(size, 32), lane_params(size, 1, 0), true)));
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u})
            result.setups.push_back(lane_setup(size, make_lane_hair_in_contact(size, 877, 100.0f),
                                               lane_params(size, 1, bdf2), true));
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u})
            result.setups.push_back(lane_setup(size, make_lane_hair_pressed(size, 32, 1.0f),
                                               lane_params(size, 1, bdf2), true));
    add_rods_on_surfaces(result, 319); // with others a vertex is about to break loose
    add_rods_on_hulls(result);
    add_rods_in_rooms(result);
    add_rods_on_planes(result);
    add_rods_among_strands(result);
    add_pinned(result, true);
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
