#include "inputs.hpp"

namespace plait::cases {
namespace {

// ax ay az ra  bx by bz rb  at the substep's begin, the same at its end, its turn, friction.
struct Capsule {
    std::array<float, 8> from, to;
    std::array<float, 4> turn;
    float friction;
};

std::vector<float> pack(const std::vector<Capsule>& capsules) {
    std::vector<float> packed;
    for (const Capsule& capsule : capsules) {
        packed.insert(packed.end(), capsule.from.begin(), capsule.from.end());
        packed.insert(packed.end(), capsule.to.begin(), capsule.to.end());
        packed.insert(packed.end(), capsule.turn.begin(), capsule.turn.end());
        packed.insert(packed.end(), {capsule.friction, 0, 0, 0});
    }
    return packed;
}

const Capsule tapered = {{-.3f, -.1f, .1f, .25f, .4f, .3f, .2f, .08f},
                         {-.2f, 0, 0, .25f, .4f, .4f, .1f, .08f},
                         {.12f, -.24f, .16f, .9506840f},
                         .3f};
const Capsule straight = {{.1f, -.5f, -.4f, .15f, .1f, .1f, -.4f, .15f},
                          {.2f, -.4f, -.4f, .15f, .1f, .2f, -.3f, .15f},
                          {0, .6f, 0, .8f},
                          2};
const Capsule sphere = {{-.3f, .4f, -.2f, .2f, -.3f, .4f, -.2f, .2f},
                        {-.25f, .35f, -.2f, .2f, -.25f, .35f, -.2f, .2f},
                        {0, 0, 0, 1},
                        0};
// The sphere at b holds the one at a.
const Capsule swallowed = {{.3f, -.3f, .3f, .05f, .32f, -.33f, .3f, .2f},
                           {.3f, -.35f, .3f, .05f, .32f, -.38f, .3f, .2f},
                           {0, 0, .28f, .96f},
                           .5f};
// Holds all hair, and belongs to the substep before.
const Capsule past = {{0, 0, 0, 9, 0, 0, 0, 9}, {0, 0, 0, 9, 0, 0, 0, 9}, {0, 0, 0, 1}, 1};

Setup make(const Size& size, std::vector<Capsule> capsules) {
    const Hair hair = make_hair(size, 10);
    Setup setup;
    setup.name = name_of(size) + ", " + std::to_string(capsules.size()) + " capsules";
    setup.items = hair.vertices();
    const auto count = static_cast<uint32_t>(capsules.size());
    capsules.insert(capsules.begin(), past);
    setup.buffers = {uints(hair.vertex_count), float4s(pack(capsules)), float4s(hair.position_prev),
                     float4s(hair.position)};
    return setup.with(plait_collide_params{size.stride, count, 1});
}

} // namespace

// A normal is good to 1e-7 m over the distance from the axis; pushes are up to 0.25 m. Vertices
// nearer to an axis than 1 cm would need more than this.
Case collide_case() {
    Case result = {PLAIT_STAGE_collide, {}, {{"position", 1e-5}}, unread_of_capsules()};
    for (const Size& size : sizes()) {
        result.setups.push_back(make(size, {tapered, straight, sphere, swallowed}));
        result.setups.push_back(make(size, {tapered}));
    }
    return result;
}

} // namespace plait::cases
