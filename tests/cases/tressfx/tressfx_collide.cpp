#include "contact/colliders.hpp"
#include "inputs.hpp"

namespace plait::cases {
namespace {

// Holds all hair, and belongs to the substep before.
const Collider past = {{0, 0, 0, 9, 0, 0, 0, 9}, {0, 0, 0, 9, 0, 0, 0, 9}, {0, 0, 0, 1}, 1};

// More than the solve over lanes lists, of every kind.
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
    return setup.with(plait_tressfx_collide_params{size.stride, count, 1});
}

} // namespace

// A normal is good to 1e-7 m over the distance from the axis; pushes are up to 0.25 m. Vertices
// nearer to an axis than 1 cm would need more than this; none of these lies there, nor so near the
// middle between two faces of a box or a hull that rounding chooses.
Case tressfx_collide_case() {
    Case result = {PLAIT_STAGE_tressfx_collide, {}, {{"position", 1e-5}}, unread_of_colliders()};
    result.flags.push_back("collider.kind");
    for (const Size& size : sizes()) {
        result.setups.push_back(make(size, {tapered, straight, sphere, swallowed}));
        result.setups.push_back(make(size, {tapered}));
        result.setups.push_back(make(size, {plane}));
        result.setups.push_back(make(size, {box}));
        result.setups.push_back(make(size, {hull}));
        result.setups.push_back(make(size, {sharp_box, tapered, plane, box}));
        result.setups.push_back(make(size, {tapered, hull, sharp_box}));
        result.setups.push_back(make(size, many()));
        result.setups.push_back(make(size, {inward(tapered)}));
        result.setups.push_back(make(size, {inward(box), sphere}));
        result.setups.push_back(make(size, {sharp_box, inward(hull)}));
    }
    return result;
}

} // namespace plait::cases
