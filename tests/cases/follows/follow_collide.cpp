#include "contact/colliders.hpp"
#include "follows/follow_out.hpp"

namespace plait::cases {
namespace {

// So wide that most hair begins in it: a segment that is turned until it points straight at a surface knows no
// direction in float32.
Collider wide(Collider body) {
    body.to[3] += 0.4f;
    if (body.kind == PLAIT_KIND_CAPSULE)
        body.to[7] += 0.4f;
    return inward(body);
}

// Its three faces leave free where a row has what is not read.
Collider three_sided() {
    Collider prism = hull;
    prism.faces.resize(3);
    return prism;
}

Setup make(const Size& size, std::vector<Collider> colliders) {
    const FollowHair hair = hair_through_bodies(size, 81);
    Setup setup;
    setup.name = name_of(size) + ", " + std::to_string(colliders.size()) + " colliders";
    setup.items = hair.follows;
    const auto count = static_cast<uint32_t>(colliders.size());
    const std::vector<Collider> before(count, sphere); // of the substep before
    colliders.insert(colliders.begin(), before.begin(), before.end());
    setup.width = size.stride;
    setup.buffers = {lanes_of(hair), float4s(pack(colliders)), float4s(hair.position)};
    return setup.with(out_params(size, count));
}

} // namespace

// What a turn is off by moves all that comes after it.
Case follow_collide_case() {
    Case result = {PLAIT_STAGE_follow_collide, {}, {{"position", 1e-5}}};
    result.unread = {"collider.begin.a", "collider.begin.a.radius", "collider.turn",
                     "collider.friction", "position.w"};
    for (const Size& size : sizes()) {
        result.setups.push_back(make(size, {tapered}));
        result.setups.push_back(make(size, {sphere, straight}));
        result.setups.push_back(make(size, {plane}));
        result.setups.push_back(make(size, {box}));
        if (size.stride > 31) // metres that turn over and over in a room half a metre wide
            continue;
        result.setups.push_back(make(size, {wide(tapered)}));
        result.setups.push_back(make(size, {sphere, wide(box)}));
        result.setups.push_back(make(size, {wide(three_sided())}));
    }
    return result;
}

} // namespace plait::cases
