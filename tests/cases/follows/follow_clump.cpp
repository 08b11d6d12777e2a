#include "follows/follow_detail.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

Setup make(const Size& size, const plait_follow_clump_params& params) {
    const FollowHair hair = follow_hair(make_hair(size, 61));
    Random random(size.stride);
    std::vector<float> place;
    for (uint32_t f = 0; f < hair.follows; ++f)
        for (uint32_t i = 0; i < size.stride; ++i)
            place.push_back(static_cast<float>(
                std::clamp(i + random.uniform(-0.7, 0.7), 0.0, size.stride - 1.0)));
    std::vector<uint32_t> guides; // that wet strands are drawn to
    for (uint32_t f = 0; f < hair.follows; ++f)
        guides.push_back(f % size.strands);
    std::vector<float> wetness;
    for (uint32_t guide = 0; guide < size.strands + hair.follows; ++guide) // and any centre
        wetness.push_back(guide % 4 == 3 ? 0 : static_cast<float>(random.uniform(0.4, 0.9)));
    Setup setup;
    setup.name = name_of(size);
    setup.items = hair.follows;
    setup.buffers = {uints(params.wet ? guides : clump_centres(size, hair.follows)), floats(place),
                     floats(wetness), floats(hair.arc), float4s(hair.position)};
    return setup.with(params);
}

} // namespace

// 255 segments of 2 cm, whose directions are good to the rounding of positions of up to 5 m over
// those of a path, which is shorter where hair and centre go different ways. w is kept.
Case follow_clump_case() {
    Case result = {PLAIT_STAGE_follow_clump, {}, {{"position", 2e-5}}, {"position.w"}};
    for (const Size& size : sizes())
        for (const uint32_t wet : {0u, 1u})
            result.setups.push_back(
                make(size, {size.stride, size.strands, {.1f, .4f, .7f, .9f}, wet}));
    return result;
}

} // namespace plait::cases
