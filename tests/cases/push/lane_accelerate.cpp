#include "lane_inputs.hpp"

#include <plait/params.h>

#include <array>

namespace plait::cases {
namespace {

// Some that are as strong as may be, some that are stronger in one component: those are none.
std::vector<float> some_too_strong(const Size& size) {
    std::vector<float> values = accelerations(size, 10);
    const float most = PLAIT_MOST_ACCELERATION;
    for (size_t i = 0; i < values.size(); i += 12)
        values[i + i % 3] = std::array{most, -most, 1.5f * most, -1e30f}[i / 12 % 4];
    return values;
}

} // namespace

// A copy, and with pressure a sum with what is as great as PLAIT_MOST_ACCELERATION.
Case lane_accelerate_case() {
    Case result = {PLAIT_STAGE_lane_accelerate, {}, {{"lane_acceleration", 0}}, {"acceleration.w"}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 41);
        std::vector<float> pressure;
        for (size_t i = 0; i < size_t{3} * size.strands * size.stride; ++i)
            pressure.push_back(0.1f * static_cast<float>(i % 17) - 0.7f);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {
            null_array(), uints(hair.vertex_count), float4s(some_too_strong(size)),
            lane_floats(pressure, 3),
            lane_floats(std::vector<float>(size_t{3} * size.strands * size.stride, 9), 3)};
        result.setups.push_back(setup.with(plait_lane_tile_params{size.stride, 1, size.stride, 0}));
        setup.name += ", pressure";
        result.setups.push_back(setup.with(plait_lane_tile_params{size.stride, 1, size.stride, 1}));
        setup.name += ", reordered";
        setup.buffers[0] = uints(other_order(size.strands, size.strands));
        result.setups.push_back(setup);
    }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
