#include "lane_inputs.hpp"

#include <algorithm>

namespace plait::cases {

// A length solve divides by w_i + w_(i+1) - ..., which folds make small: 1e-5 of a strand of up to
// 5 m, and h' = 1/45 s carries it to the velocity. Friction takes its bound from a depth, so that a
// round of contact returns the rounding of x contact_rate h'^2 mu times: hence softer contact and
// less friction than the rods' cases have.
Case chain_case() {
    Case result = {
        PLAIT_STAGE_chain,
        {},
        {{"lane_x", 2e-5}, {"lane_v", 1e-3}, {"lane_x_before", 2e-5}, {"lane_v_before", 1e-3}}};
    result.ratios = {"lane_material.mass"}; // there is no stiffness to hold it against
    result.unread = unread_of_colliders();
    for (const char* stiffness : {"stretch", "bend", "twist", "cross", "wetness"})
        result.unread.push_back(std::string("lane_material.") + stiffness);
    for (const Size& size : sizes())
        for (const uint32_t bdf2 : {0u, 1u})
            result.setups.push_back(
                lane_setup(size, make_lane_hair(size, 31), lane_params(size, 1, bdf2), false));
    for (const Size& size : sizes()) {
        plait_lane_params fine = lane_params(size, 2, 0);
        std::fill_n(fine.gravity, 3, 0.01f); // no strand is coarse
        result.setups.push_back(lane_setup(size, make_lane_hair(size, 33), fine, false));
    }
    for (const Size& size : contact_sizes())
        result.setups.push_back(
            lane_setup(size, make_lane_hair_spun(size, 31), lane_params_afloat(size, 1), false));
    for (const Size& size : contact_sizes())
        result.setups.push_back(
            reordered(lane_setup(size, make_lane_hair(size, 31), lane_params(size, 1, 0), false)));
    // In the second and the third a strand does not touch and has a neighbour in its work-item that
    // does. In the last the second sweep finds a vertex where the first put it, its plane just
    // touching the sphere around its leader: rounding must not move it.
    for (const uint32_t seed : {32u, 39u, 52u, 144u})
        for (const Size& size : contact_sizes())
            for (const uint32_t bdf2 : {0u, 1u}) {
                plait_lane_params params = lane_params(size, 1, bdf2);
                params.contact_rate = 3e4f;
                result.setups.push_back(
                    lane_setup(size, make_lane_hair_in_contact(size, seed, 0.05f), params, false));
                result.setups.back().name += ", seed " + std::to_string(seed);
            }
    for (const Size& size : contact_sizes())
        for (const uint32_t far : {0u, 70u}) {
            plait_lane_params params = lane_params(size, 1, far == 0);
            params.contact_rate = 3e4f;
            result.setups.push_back(
                lane_setup(size, make_lane_hair_on_surfaces(size, 60, 0.05f, far), params, false));
        }
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u}) {
            plait_lane_params params = lane_params(size, 1, bdf2);
            params.contact_rate = 3e4f;
            result.setups.push_back(
                lane_setup(size, make_lane_hair_on_hulls(size, 53, 0.05f), params, false));
        }
    for (const Size& size : contact_sizes())
        for (const float kind : room_kinds) {
            plait_lane_params params = lane_params(size, 1, kind == PLAIT_KIND_BOX);
            params.contact_rate = 3e4f;
            result.setups.push_back(
                lane_setup(size, make_lane_hair_in_room(size, 53, kind, 0.05f), params, false));
        }
    result.flags.push_back("collider.kind");
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u}) {
            plait_lane_params params = lane_params(size, 1, bdf2);
            params.contact_rate = 3e4f;
            const LaneHair lanes = make_lane_hair(size, 32);
            result.setups.push_back(
                on_planes(lane_setup(size, lanes, params, false), lanes, 0.05f, false));
        }
    add_pinned(result, false);
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
