// Strands that follow, shown between steps or before the first one: bodies are where they are drawn.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <optional>

namespace {

class FollowShown : public OnBackend {};
ON_EVERY_BACKEND(FollowShown);

constexpr float radius = 0.1f; // m, of a skull
constexpr size_t vertices = 12;

// Back from in front of the skull, over its upper half.
Strand lock(float z) {
    Strand strand;
    for (size_t i = 0; i < vertices; ++i)
        strand.push_back({0.12f - 0.02f * static_cast<float>(i), 0.06f, z});
    return strand;
}

// Guides to both sides of the skull; follows between them, which they alone would lead through it.
struct Hair {
    static constexpr uint32_t guide_count = 2, follow_count = 8;
    plait::Groom guides = make_groom({lock(-0.12f), lock(0.12f)});
    plait::Groom follows = make_groom(between());
    std::optional<plait::FollowMap> map;

    Hair() {
        std::vector<uint32_t> of;
        std::vector<float> weights;
        for (uint32_t f = 0; f < follow_count; ++f) {
            of.insert(of.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {1 - share(f), share(f), 0, 0});
        }
        auto desc = plait_follow_map_desc_defaults();
        desc.follows = follows;
        desc.guide_count = guide_count;
        desc.guides = plait::view(of, 4);
        desc.weights = plait::view(weights, 4);
        map.emplace(desc);
    }
    static float share(uint32_t follow) {
        return (static_cast<float>(follow) + 0.5f) / follow_count;
    }
    static Strands between() {
        Strands strands;
        for (uint32_t f = 0; f < follow_count; ++f)
            strands.push_back(lock(0.18f * (share(f) - 0.5f)));
        return strands;
    }
    plait::SimDesc sim() const {
        plait::SimDesc desc;
        desc.follow_map = *map;
        return desc;
    }
};

enum class Body { ball, hull, field, nearest };
constexpr Body bodies[] = {Body::ball, Body::hull, Body::field, Body::nearest};

plait_collider_id add_skull(plait::Sim& sim, Body body = Body::ball) {
    if (body == Body::ball) {
        auto skull = smooth_collider();
        skull.capsule.radius_a = skull.capsule.radius_b = radius;
        return sim.create_collider(skull);
    }
    const auto r = double(radius);
    const uint32_t around = body == Body::hull ? 14 : 64;
    const ShapeMesh shape = ellipsoid_mesh(r, r, r, around, around);
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    const plait::Mesh mesh(desc);
    if (body == Body::hull)
        return sim.create_hull(mesh, plait_collider_hull_desc_defaults());
    auto form = plait_collider_mesh_desc_defaults();
    form.form = body == Body::field ? PLAIT_MESH_FORM_FIELD : PLAIT_MESH_FORM_NEAREST;
    return sim.create_collider(mesh, form);
}

struct Seen {
    float jump = 0, deepest = 0; // m: of a follow in a frame, seen from the head; in the skull
};

// The head and its skull at 6 m/s along x once it has sped up.
Seen ride(plait::Sim sim, Body body, int rate) {
    const plait_collider_id skull = add_skull(sim, body);
    std::vector<float> before;
    Seen seen;
    for (int f = 1; f <= 2 * rate; ++f) {
        const float time = static_cast<float>(f) / static_cast<float>(rate);
        const float x = 6 * (time < 1 ? 0.5f * time * time : time - 0.5f);
        sim.set_roots(head_at({x, 0, 0}));
        sim.set_collider_pose(skull, head_at({x, 0, 0}).head);
        sim.step(1.0 / rate);
        auto now = sim.read(PLAIT_FIELD_POSITION);
        now.erase(now.begin(), now.begin() + ptrdiff_t{4} * Hair::guide_count * vertices);
        for (size_t i = 0; i < now.size(); i += 4) {
            now[i] -= x;
            if (time < 1.5f)
                continue;
            seen.jump =
                std::max(seen.jump, std::hypot(now[i] - before[i], now[i + 1] - before[i + 1],
                                               now[i + 2] - before[i + 2]));
            seen.deepest =
                std::max(seen.deepest, radius - std::hypot(now[i], now[i + 1], now[i + 2]));
        }
        before = now;
    }
    return seen;
}

TEST_P(FollowShown, BodiesAreWhereTheHeadIs) {
    const Hair hair;
    for (const Body body : bodies) {
        const auto at = [&](int rate, uint32_t contact) {
            auto desc = hair.sim();
            desc.params.follow_contact = contact;
            return ride(plait::Sim(context, hair.guides, desc), body, rate);
        };
        const Seen in_steps = at(60, 1); // jumps: hair still settles on a body, and turns its faces
        const int which = static_cast<int>(body);
        EXPECT_GT(at(72, 0).deepest, 0.02f) << which;
        for (const int rate : body == Body::ball ? std::vector{72, 144} : std::vector{72}) {
            const Seen between = at(rate, 1);
            EXPECT_LT(between.deepest, in_steps.deepest + 3e-4f) << which << ", " << rate;
            EXPECT_LT(between.jump, in_steps.jump + 1e-3f) << which << ", " << rate;
        }
    }
}

// Of the call that shows a collider first, before any step.
TEST_P(FollowShown, ACollidersFirstCallShowsIt) {
    const Hair hair;
    const auto shown = [&](bool again, uint32_t interpolates) {
        auto desc = hair.sim();
        desc.interpolate_output = interpolates;
        plait::Sim sim(context, hair.guides, desc);
        add_skull(sim);
        const auto roots = head_at({0.03f, 0, 0});
        if (again)
            sim.reset();
        sim.set_roots(roots); // the first, which shows at once
        sim.step(0);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    for (const uint32_t interpolates : {0u, 1u, 2u}) {
        const auto expected = shown(true, interpolates);
        for (int k = 0; k < 50; ++k)
            ASSERT_EQ(shown(false, interpolates), expected) << interpolates << ", sim " << k;
    }
}

// Into sims that have shown nothing of the colliders yet.
TEST_P(FollowShown, RestoreShowsWhatWasSaved) {
    const Hair hair;
    for (const int rate : {60, 72}) {
        plait::Sim saved(context, hair.guides, hair.sim());
        const plait_collider_id skull = add_skull(saved);
        for (int f = 1; f <= rate / 2 + 1; ++f) {
            const auto roots =
                head_at({6.0f * static_cast<float>(f) / static_cast<float>(rate), 0, 0});
            saved.set_roots(roots);
            saved.set_collider_pose(skull, roots.head);
            saved.step(1.0 / rate);
        }
        const auto bytes = saved.save();
        const auto before = saved.read(PLAIT_FIELD_POSITION);
        saved.restore(bytes); // the reference's doubles are floats from here on
        const auto expected = saved.read(PLAIT_FIELD_POSITION);
        EXPECT_LE(largest_difference(expected, before), GetParam() == "reference" ? 1e-6f : 0.0f);
        for (int k = 0; k < 50; ++k) {
            plait::Sim fresh(context, hair.guides, hair.sim());
            fresh.restore(bytes);
            ASSERT_EQ(fresh.read(PLAIT_FIELD_POSITION), expected) << rate << " Hz, sim " << k;
        }
    }
}

} // namespace
