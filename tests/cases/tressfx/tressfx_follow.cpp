#include "inputs.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size, uint32_t form) {
    const Hair hair = make_hair(size, 14);
    const uint32_t followers = 2 * size.strands + 1;
    Random random(size.stride);
    std::vector<uint32_t> guide;
    std::vector<float> offset;
    for (uint32_t f = 0; f < followers; ++f) {
        guide.push_back(random.below(size.strands));
        for (int lane = 0; lane < 3; ++lane)
            offset.push_back(static_cast<float>(random.uniform(-.01, .01)));
        offset.push_back(0);
    }
    std::vector<float> position = hair.position; // the guides, then room for the followers
    const Array room = unwritten_float4s(size_t{followers} * size.stride);
    position.insert(position.end(), room.floats.begin(), room.floats.end());
    Setup setup;
    setup.name = name_of(size) + (form == PLAIT_FOLLOW_ROTATING ? ", rotating" : ", published");
    setup.items = followers * size.stride;
    setup.buffers = {float4s(hair.rest), float4s(hair.pose), uints(hair.vertex_count),
                     uints(guide),       float4s(offset),    float4s(position)};
    return setup.with(plait_tressfx_follow_params{size.stride, size.strands, 2.0f, form});
}

} // namespace

// An offset of 1 cm to 3 cm turned by a rotation good to 1e-7 / 0.02, added to a position below 2
// m.
Case tressfx_follow_case() {
    Case result = {
        PLAIT_STAGE_tressfx_follow, {}, {{"position", 2e-6}}, {"pose.t"}}; // an offset turns only
    for (const Size& size : sizes())
        for (uint32_t form : {PLAIT_FOLLOW_ROTATING, PLAIT_FOLLOW_PUBLISHED})
            result.setups.push_back(make(size, form));
    return result;
}

} // namespace plait::cases
