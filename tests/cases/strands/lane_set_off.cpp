#include "lane_inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

// `pose` a little later: poses of a substep apart.
std::vector<float> moved_on(const std::vector<float>& pose, Random& random, double way) {
    std::vector<float> moved = pose;
    for (size_t i = 0; i < moved.size(); i += 8) {
        double square = 0;
        for (size_t k = 0; k < 4; ++k) {
            moved[i + k] += static_cast<float>(random.uniform(-way, way));
            square += double(moved[i + k]) * moved[i + k];
        }
        for (size_t k = 0; k < 4; ++k)
            moved[i + k] = static_cast<float>(moved[i + k] / std::sqrt(square));
        for (size_t k = 4; k < 7; ++k)
            moved[i + k] += static_cast<float>(random.uniform(-way, way));
    }
    return moved;
}

} // namespace

// Differences of three places within 5 m of the root, over h = 1/60 s: velocities are off by 60 times
// what float32 makes of one. Of the last case all strands move on as before but for 1 m/s, and are left.
Case lane_set_off_case() {
    Case result = {PLAIT_STAGE_lane_set_off,
                   {},
                   {{"lane_v", 4e-4},
                    {"lane_q_before", 2e-6},
                    {"lane_x_before", 1e-5},
                    {"lane_v_before", 4e-4}},
                   {},
                   {},
                   {},
                   {},
                   {"jump"}}; // 0: all strands
    for (const Size& size : sizes())
        for (const uint32_t history : {1u, 0u}) {
            const LaneHair lanes = make_lane_hair(size, 45);
            Random random(size.strands + history);
            const std::vector<float>& was = lanes.hair.pose_other;
            const std::vector<float> before = moved_on(was, random, 0.05);
            const std::vector<float> next = moved_on(lanes.hair.pose, random, 0.05);
            Setup setup;
            setup.name = name_of(size) + (history ? ", BDF2" : "");
            setup.items = size.strands;
            setup.width = size.stride;
            setup.buffers = {null_array(),
                             float4s(lanes.hair.rest),
                             float4s(before),
                             float4s(was),
                             float4s(lanes.hair.pose),
                             float4s(next),
                             lane_floats(lanes.x, 3),
                             lane_floats(lanes.v, 3),
                             lane_floats(lanes.q_before, 4),
                             lane_floats(lanes.x_before, 3),
                             lane_floats(lanes.v_before, 3)};
            const plait_set_off_params params = {size.stride, 1,         size.stride,
                                                 history,     1.0f / 60, 0};
            result.setups.push_back(setup.with(params));
            result.setups.push_back(reordered(setup).with(params));
        }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
