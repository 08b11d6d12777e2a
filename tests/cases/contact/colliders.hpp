// Colliders of every kind, within a metre of the origin.
#pragma once

#include <plait/params.h>

#include <array>
#include <cstddef>
#include <vector>

namespace plait::cases {

// As in params.h. A capsule: ax ay az ra  bx by bz rb  at the substep's begin, the same at its end.
struct Collider {
    std::array<float, 8> from, to;
    std::array<float, 4> turn;
    float friction;
    float kind = PLAIT_KIND_CAPSULE;
    std::vector<std::array<float, 4>> faces = {}; // of a hull: at most 5
};

// Faces lie behind the rows, those of a hull after a float4 of nothing: none lies where a row would have
// what is not read.
inline std::vector<float> pack(const std::vector<Collider>& colliders) {
    std::vector<float> packed, faces;
    const std::size_t end = PLAIT_COLLIDER_STRIDE * colliders.size();
    for (const Collider& collider : colliders) {
        const std::size_t here = packed.size() / 4;
        packed.insert(packed.end(), collider.from.begin(), collider.from.end());
        packed.insert(packed.end(), collider.to.begin(), collider.to.end());
        packed.insert(packed.end(), collider.turn.begin(), collider.turn.end());
        packed.insert(packed.end(), {collider.friction, collider.kind, 0, 0});
        if (collider.faces.empty())
            continue;
        faces.insert(faces.end(), 4, 0.5f);
        packed[packed.size() - 2] = static_cast<float>(end - here + faces.size() / 4);
        packed[packed.size() - 1] = static_cast<float>(collider.faces.size());
        for (const auto& face : collider.faces)
            faces.insert(faces.end(), face.begin(), face.end());
    }
    packed.insert(packed.end(), faces.begin(), faces.end());
    return packed;
}

inline const Collider tapered = {{-.3f, -.1f, .1f, .25f, .4f, .3f, .2f, .08f},
                                 {-.2f, 0, 0, .25f, .4f, .4f, .1f, .08f},
                                 {.12f, -.24f, .16f, .9506840f},
                                 .3f};
inline const Collider straight = {{.1f, -.5f, -.4f, .15f, .1f, .1f, -.4f, .15f},
                                  {.2f, -.4f, -.4f, .15f, .1f, .2f, -.3f, .15f},
                                  {0, .6f, 0, .8f},
                                  2};
inline const Collider sphere = {{-.3f, .4f, -.2f, .2f, -.3f, .4f, -.2f, .2f},
                                {-.25f, .35f, -.2f, .2f, -.25f, .35f, -.2f, .2f},
                                {0, 0, 0, 1},
                                0};
// The sphere at b holds the one at a.
inline const Collider swallowed = {{.3f, -.3f, .3f, .05f, .32f, -.33f, .3f, .2f},
                                   {.3f, -.35f, .3f, .05f, .32f, -.38f, .3f, .2f},
                                   {0, 0, .28f, .96f},
                                   .5f};
// A third of the hair lies under it.
inline const Collider plane = {{.1f, -.2f, .1f, 0, 0, 1, 0, 0},
                               {.1f, -.15f, .1f, 0, .48f, .64f, -.6f, 0},
                               {.3f, 0, .24f, .9233634f},
                               .4f,
                               PLAIT_KIND_PLANE};
inline const Collider box = {{.1f, .1f, 0, .06f, .36f, -.48f, .64f, .48f},
                             {.15f, .1f, .05f, .06f, .3f, .12f, .2f, 0},
                             {.12f, -.24f, .16f, .9506840f},
                             .6f,
                             PLAIT_KIND_BOX};
inline const Collider sharp_box = {{-.3f, -.2f, .1f, 0, 0, .6f, 0, .8f},
                                   {-.25f, -.2f, .2f, 0, .25f, .1f, .3f, 0},
                                   {0, 0, .28f, .96f},
                                   .2f,
                                   PLAIT_KIND_BOX};
// A prism on a triangle, with a margin.
inline const Collider hull = {{-.05f, .1f, 0, .03f, .36f, -.48f, .64f, .48f},
                              {0, .1f, .05f, .03f, .43f, .5f, .2f, 0},
                              {.12f, -.24f, .16f, .9506840f},
                              .6f,
                              PLAIT_KIND_HULL,
                              {{0, 1, 0, .22f},
                               {.8660254f, -.5f, 0, .24f},
                               {-.8660254f, -.5f, 0, .25f},
                               {0, 0, 1, .18f},
                               {0, 0, -1, .15f}}};

// The same, turned inside out: hair stays in it.
inline Collider inward(Collider collider) {
    collider.kind += PLAIT_KIND_INWARD;
    return collider;
}

} // namespace plait::cases
