#include "follows/follow_detail.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size, const plait_follow_curl_params& params) {
    const Hair guides = make_hair(size, 62);
    const FollowHair hair = follow_hair(guides);
    Random random(size.stride);
    std::vector<uint32_t> guide;
    std::vector<float> way;
    for (uint32_t f = 0; f < hair.follows; ++f) {
        guide.push_back(random.below(size.strands));
        for (const double x : random.direction())
            way.push_back(static_cast<float>(x));
        way.push_back(0);
    }
    Setup setup;
    setup.name = name_of(size);
    setup.items = hair.follows;
    setup.buffers = {
        float4s(guides.pose), uints(guide),     uints(clump_centres(size, hair.follows)),
        float4s(way),         floats(hair.arc), float4s(hair.position)};
    return setup.with(params);
}

} // namespace

// Offsets of 3 cm in a frame that 255 turns have carried, each good to the rounding of positions of
// up to 5 m over segments of 2 cm, at an angle whose turns, below 100, are good to 1e-5. Of poses
// directions are read, and w is kept.
Case follow_curl_case() {
    Case result = {PLAIT_STAGE_follow_curl, {}, {{"position", 2e-5}}, {"pose.t", "position.w"}};
    for (const Size& size : sizes())
        result.setups.push_back(make(size, {size.stride,
                                            size.strands,
                                            {.01f, .02f, .03f, .02f},
                                            .07f,
                                            .4f,
                                            {.005f, .01f, .015f, .01f},
                                            .05f,
                                            4711}));
    return result;
}

} // namespace plait::cases
