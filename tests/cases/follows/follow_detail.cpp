#include "follows/follow_detail.hpp"

#include <algorithm>

namespace plait::cases {

FollowHair follow_hair(const Hair& guides) {
    const uint32_t stride = guides.size.stride;
    FollowHair hair{2 * guides.size.strands + 1, {}, guides.position};
    Random random(stride + 7);
    for (uint32_t f = 0; f < hair.follows; ++f) {
        const uint32_t guide = f % guides.size.strands, count = f % 3 == 1 ? 2 : stride;
        const float* at = &guides.position[size_t{4} * guide * stride];
        Point x{at[0] + random.uniform(-.02, .02), at[1] + random.uniform(-.02, .02),
                at[2] + random.uniform(-.02, .02)};
        const Point main = random.direction();
        double arc = 0;
        for (uint32_t i = 0; i < stride; ++i) {
            const Point aside = random.direction();
            if (i > 0 && i < count)
                for (size_t c = 0; c < 3; ++c)
                    x[c] += double(segment_length) * (main[c] + 0.3 * aside[c]);
            arc += i > 0 && i < count ? double(segment_length) : 0;
            hair.arc.push_back(static_cast<float>(arc));
            for (const double c : x)
                hair.position.push_back(static_cast<float>(c));
            hair.position.push_back(static_cast<float>(random.uniform(0.5, 2)));
        }
    }
    return hair;
}

std::vector<uint32_t> clump_centres(const Size& size, uint32_t follows) {
    std::vector<uint32_t> centres;
    for (uint32_t f = 0; f < follows; ++f) {
        const uint32_t first = f - f % 4;
        centres.push_back(first % 8 == 0 ? size.strands + first : first / 4 % size.strands);
    }
    return centres;
}

} // namespace plait::cases
