#include "lane_inputs.hpp"

#include <algorithm>
#include <cmath>

namespace plait::cases {
namespace {

// Weights of one to four guides, the largest first, 0 where there is no more.
std::vector<float> weights(Random& random, uint32_t used) {
    std::vector<double> of(4, 0.0);
    double sum = 0;
    for (uint32_t k = 0; k < used; ++k)
        sum += of[k] = random.uniform(0.5, 1);
    std::vector<float> shares;
    for (const double weight : of)
        shares.push_back(static_cast<float>(weight / sum));
    std::sort(shares.rbegin(), shares.rend());
    return shares;
}

// Turns along a guide that differ from one segment to the next as those of bent hair do, about its
// root's pose: so those of different guides differ by more.
std::vector<float> turns(const Size& size, const Hair& hair, Random& random) {
    std::vector<float> values;
    for (uint32_t guide = 0; guide < size.strands; ++guide)
        for (uint32_t i = 0; i < size.stride; ++i) {
            std::array<double, 4> q{};
            double squares = 0;
            for (size_t c = 0; c < 4; ++c) {
                q[c] = double(hair.pose[8 * size_t{guide} + c]) + random.uniform(-0.2, 0.2);
                squares += q[c] * q[c];
            }
            for (const double c : q)
                values.push_back(static_cast<float>(c / std::sqrt(squares)));
        }
    return values;
}

// Every other guide's root has the other quaternion of the same rotation.
void turn_signs(const Size& size, std::vector<float>& pose, std::vector<float>& turn) {
    for (size_t guide = 1; guide < size.strands; guide += 2) {
        for (size_t c = 0; c < 4; ++c)
            pose[8 * guide + c] *= -1;
        for (size_t c = 0; c < size_t{4} * size.stride; ++c)
            turn[4 * guide * size.stride + c] *= -1;
    }
}

Setup make(const Size& size, bool signs) {
    Hair hair = make_hair(size, 52);
    Random random(size.stride);
    const uint32_t follows = 2 * size.strands + 1;
    std::vector<float> turn = turns(size, hair, random);
    if (signs)
        turn_signs(size, hair.pose, turn);
    std::vector<uint32_t> guide;
    std::vector<float> weight, place, rest;
    for (uint32_t f = 0; f < follows; ++f) {
        const uint32_t used = 1 + f % 4, count = f % 3 == 1 ? 2 : size.stride;
        for (const float share : weights(random, used)) {
            weight.push_back(share);
            guide.push_back(random.below(size.strands));
        }
        for (uint32_t i = 0; i < size.stride; ++i) {
            const Point way = random.direction();
            const double length = i == 0 ? 0.3 : i < count ? double(segment_length) : 0;
            for (const double x : way)
                rest.push_back(static_cast<float>(length * x));
            rest.push_back(static_cast<float>(random.uniform(0.5, 2)));
            for (int k = 0; k < 4; ++k)
                place.push_back(static_cast<float>(random.uniform(0, size.stride - 1.5)));
        }
    }
    Setup setup;
    setup.name = name_of(size) + (signs ? ", of either sign" : "");
    setup.items = follows;
    setup.width = size.stride;
    setup.buffers = {uints(other_order(follows, follows)),
                     float4s(hair.pose),
                     float4s(turn),
                     uints(guide),
                     float4s(weight),
                     lane_floats(place, 4),
                     lane_floats(rest, 4),
                     unwritten_float4s(size_t{size.strands + follows} * size.stride)};
    return setup.with(plait_follow_turns_params{size.stride, 1, size.strands});
}

} // namespace

// A place below 1 m, and 255 segments of 2 cm turned by rotations good to 1e-6: the mean of four
// whose sum may be a third as long as they are, places rounded to 1e-5 between turns that differ by
// less than half a turn.
Case follow_turns_case() {
    Case result = {PLAIT_STAGE_follow_turns, {}, {{"position", 1e-5}}};
    for (const Size& size : sizes())
        for (const bool signs : {false, true})
            result.setups.push_back(make(size, signs));
    return result;
}

} // namespace plait::cases
