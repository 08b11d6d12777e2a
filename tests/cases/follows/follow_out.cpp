#include "follows/follow_out.hpp"

#include <algorithm>

namespace plait::cases {

FollowHair hair_through_bodies(const Size& size, uint32_t seed) {
    return follow_hair(make_hair(size, seed));
}

Array lanes_of(const FollowHair& hair) {
    return uints(other_order(hair.follows, hair.follows));
}

void add_body_row(std::vector<float>& rows, Random& random, const FollowHair& hair,
                  const Size& size, uint32_t follow, bool around_root, float share) {
    const size_t first = (size_t{size.strands} + follow) * size.stride;
    const uint32_t middle = std::clamp(size.stride / 2, 1u, 8u);
    const float* at = &hair.position[4 * (first + (around_root ? 0 : middle))];
    const Point aside = random.direction();
    const double off = around_root ? 0.03 : 0.033;
    append_floats(rows, {1, 2, 3, 0});
    const auto orientation = random.rotation();
    append_floats(rows, {orientation[0], orientation[1], orientation[2], orientation[3]});
    append_floats(rows, {at[0] + off * aside[0], at[1] + off * aside[1], at[2] + off * aside[2],
                         double(share)});
    append_floats(rows, {0, 0, 0, 0});
    append_floats(rows, {0, 0, 0, 1});
    append_floats(rows, {0.5, double{PLAIT_KIND_MESH}, 0, 0});
}

std::vector<std::string> out_unread() {
    return {
        "collider.begin.a", "collider.begin.a.radius", "collider.end.b", "collider.end.b.radius",
        "collider.turn",    "collider.friction",       "collider.kind",  "position.w"};
}

plait_follow_collide_params out_params(const Size& size, uint32_t count) {
    return {size.stride, size.strands, count, count};
}

} // namespace plait::cases
