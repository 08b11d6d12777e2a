#include "inputs.hpp"

namespace plait::cases {
namespace {

// As in params.h. A capsule: ax ay az ra  bx by bz rb  at the substep's begin, the same at its end.
struct Collider {
    std::array<float, 8> from, to;
    std::array<float, 4> turn;
    float friction;
    float kind = PLAIT_KIND_CAPSULE;
};

std::vector<float> pack(const std::vector<Collider>& colliders) {
    std::vector<float> packed;
    for (const Collider& collider : colliders) {
        packed.insert(packed.end(), collider.from.begin(), collider.from.end());
        packed.insert(packed.end(), collider.to.begin(), collider.to.end());
        packed.insert(packed.end(), collider.turn.begin(), collider.turn.end());
        packed.insert(packed.end(), {collider.friction, collider.kind, 0, 0});
    }
    return packed;
}

const Collider tapered = {{-.3f, -.1f, .1f, .25f, .4f, .3f, .2f, .08f},
                          {-.2f, 0, 0, .25f, .4f, .4f, .1f, .08f},
                          {.12f, -.24f, .16f, .9506840f},
                          .3f};
const Collider straight = {{.1f, -.5f, -.4f, .15f, .1f, .1f, -.4f, .15f},
                           {.2f, -.4f, -.4f, .15f, .1f, .2f, -.3f, .15f},
                           {0, .6f, 0, .8f},
                           2};
const Collider sphere = {{-.3f, .4f, -.2f, .2f, -.3f, .4f, -.2f, .2f},
                         {-.25f, .35f, -.2f, .2f, -.25f, .35f, -.2f, .2f},
                         {0, 0, 0, 1},
                         0};
// The sphere at b holds the one at a.
const Collider swallowed = {{.3f, -.3f, .3f, .05f, .32f, -.33f, .3f, .2f},
                            {.3f, -.35f, .3f, .05f, .32f, -.38f, .3f, .2f},
                            {0, 0, .28f, .96f},
                            .5f};
// A third of the hair lies under it.
const Collider plane = {{.1f, -.2f, .1f, 0, 0, 1, 0, 0},
                        {.1f, -.15f, .1f, 0, .48f, .64f, -.6f, 0},
                        {.3f, 0, .24f, .9233634f},
                        .4f,
                        PLAIT_KIND_PLANE};
const Collider box = {{.1f, .1f, 0, .06f, .36f, -.48f, .64f, .48f},
                      {.15f, .1f, .05f, .06f, .3f, .12f, .2f, 0},
                      {.12f, -.24f, .16f, .9506840f},
                      .6f,
                      PLAIT_KIND_BOX};
const Collider sharp_box = {{-.3f, -.2f, .1f, 0, 0, .6f, 0, .8f},
                            {-.25f, -.2f, .2f, 0, .25f, .1f, .3f, 0},
                            {0, 0, .28f, .96f},
                            .2f,
                            PLAIT_KIND_BOX};
// Holds all hair, and belongs to the substep before.
const Collider past = {{0, 0, 0, 9, 0, 0, 0, 9}, {0, 0, 0, 9, 0, 0, 0, 9}, {0, 0, 0, 1}, 1};

// More than a strand model lists, of every kind.
std::vector<Collider> many() {
    std::vector<Collider> colliders;
    for (int i = 0; i < 22; ++i)
        for (Collider collider : {tapered, box, sharp_box, plane}) {
            for (auto* at : {&collider.from, &collider.to})
                (*at)[1] -= 0.3f - 0.02f * static_cast<float>(i); // rises: all come to bear
            if (collider.kind == PLAIT_KIND_CAPSULE)
                for (auto* at : {&collider.from, &collider.to})
                    (*at)[5] -= 0.3f - 0.02f * static_cast<float>(i);
            colliders.push_back(collider);
        }
    return colliders;
}

Setup make(const Size& size, std::vector<Collider> colliders) {
    const Hair hair = make_hair(size, 10);
    Setup setup;
    setup.name = name_of(size) + ", " + std::to_string(colliders.size()) + " colliders";
    setup.items = hair.vertices();
    const auto count = static_cast<uint32_t>(colliders.size());
    colliders.insert(colliders.begin(), past);
    setup.buffers = {uints(hair.vertex_count), float4s(pack(colliders)),
                     float4s(hair.position_prev), float4s(hair.position)};
    return setup.with(plait_collide_params{size.stride, count, 1});
}

} // namespace

// A normal is good to 1e-7 m over the distance from the axis; pushes are up to 0.25 m. Vertices
// nearer to an axis than 1 cm would need more than this; none of these lies there, nor so near the
// middle between two faces of a box that rounding chooses.
Case collide_case() {
    Case result = {PLAIT_STAGE_collide, {}, {{"position", 1e-5}}, unread_of_colliders()};
    result.flags.push_back("collider.kind");
    for (const Size& size : sizes()) {
        result.setups.push_back(make(size, {tapered, straight, sphere, swallowed}));
        result.setups.push_back(make(size, {tapered}));
        result.setups.push_back(make(size, {plane}));
        result.setups.push_back(make(size, {box}));
        result.setups.push_back(make(size, {sharp_box, tapered, plane, box}));
        result.setups.push_back(make(size, many()));
    }
    return result;
}

} // namespace plait::cases
