// Strands that follow and bodies between their guides: they stay outside, and keep their lengths.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <optional>

namespace {

class FollowContact : public OnBackend {};
ON_EVERY_BACKEND(FollowContact);

constexpr float radius = 0.05f; // m, of a ball
constexpr Point middle{0.1f, -0.12f, 0};
constexpr size_t guide_count = 2, follow_count = 7, vertices = 17;

Strand straight(float z) {
    Strand strand;
    for (size_t i = 0; i < vertices; ++i)
        strand.push_back({0.0125f * static_cast<float>(i), 0, z});
    return strand;
}

// Guides to both sides of a ball, past which they fall; between them are hairs that follow both.
struct Hair {
    plait::Groom guides = make_groom({straight(-0.07f), straight(0.07f)});
    plait::Groom follows;
    std::vector<uint32_t> guides_of;
    std::vector<float> weights;
    std::optional<plait::FollowMap> map;

    Hair() : follows(make_groom(between())) {
        for (size_t f = 0; f < follow_count; ++f) {
            const float share = (static_cast<float>(f) + 0.5f) / follow_count;
            guides_of.insert(guides_of.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {1 - share, share, 0, 0});
        }
        auto desc = plait_follow_map_desc_defaults();
        desc.follows = follows;
        desc.guide_count = guide_count;
        desc.guides = plait::view(guides_of, 4);
        desc.weights = plait::view(weights, 4);
        map.emplace(desc);
    }
    static Strands between() {
        Strands strands;
        for (size_t f = 0; f < follow_count; ++f)
            strands.push_back(
                straight(-0.06f + 0.12f * (static_cast<float>(f) + 0.5f) / follow_count));
        return strands;
    }
};

enum class Body { none, ball, box, hull, field, nearest };
constexpr Body bodies[] = {Body::ball, Body::box, Body::hull, Body::field, Body::nearest};

plait_pose pose_at(const Point& at) {
    return {{0, 0, 0, 1}, {at[0], at[1], at[2]}};
}

// m: how deep in the ball hair lies on it, whose flat faces have their corners on the ball.
float depth_of_faces(Body body) {
    return body == Body::hull ? 3e-3f : 3e-4f;
}

plait::Mesh ball_mesh(uint32_t around) {
    const auto r = double(radius);
    const ShapeMesh shape = ellipsoid_mesh(r, r, r, around, around);
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

plait_collider_id add_body(plait::Sim& sim, Body body) {
    if (body == Body::hull) {
        auto hull = plait_collider_hull_desc_defaults();
        hull.pose = pose_at(middle);
        return sim.create_hull(ball_mesh(14), hull);
    }
    if (body == Body::field || body == Body::nearest) {
        auto mesh = plait_collider_mesh_desc_defaults();
        mesh.form = body == Body::field ? PLAIT_MESH_FORM_FIELD : PLAIT_MESH_FORM_NEAREST;
        mesh.pose = pose_at(middle);
        return sim.create_collider(ball_mesh(64), mesh);
    }
    auto collider = smooth_collider();
    collider.pose = pose_at(middle);
    collider.capsule.radius_a = collider.capsule.radius_b = radius;
    if (body == Body::box) {
        collider.kind = PLAIT_COLLIDER_KIND_BOX;
        std::fill_n(collider.box.half_extents, 3, 0.0f);
        collider.box.rounding = radius;
    }
    return sim.create_collider(collider);
}

float distance(const float* a, const float* b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

struct Seen {
    float deepest = 0;      // m, of a follow in the ball
    float worst_length = 0; // m, of a segment
};

Seen look(plait::Sim& sim) {
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    Seen seen;
    for (size_t row = guide_count * vertices; row < (guide_count + follow_count) * vertices;
         ++row) {
        seen.deepest = std::max(seen.deepest, radius - distance(&x[4 * row], middle.data()));
        if (row % vertices > 0)
            seen.worst_length = std::max(
                seen.worst_length, std::abs(distance(&x[4 * row], &x[4 * row - 4]) - 0.0125f));
    }
    return seen;
}

// For a second, in which it falls past the ball.
Seen watch(plait::Sim& sim) {
    Seen worst;
    for (int frames = 0; frames < 60; ++frames) {
        sim.step(frame);
        const Seen now = look(sim);
        worst.deepest = std::max(worst.deepest, now.deepest);
        worst.worst_length = std::max(worst.worst_length, now.worst_length);
    }
    return worst;
}

plait::SimDesc sim_of(const Hair& hair, plait_model model = PLAIT_MODEL_ARTICULATED) {
    plait::SimDesc desc;
    desc.model = model;
    desc.follow_map = *hair.map;
    desc.material.bend_stiffness = 1e-9f;
    return desc;
}

TEST_P(FollowContact, KeepsThemOutOfBodies) {
    const Hair hair;
    for (const Body body : bodies)
        for (const uint32_t on : {1u, 0u}) {
            auto desc = sim_of(hair);
            desc.params.follow_contact = on;
            plait::Sim sim(context, hair.guides, desc);
            add_body(sim, body);
            const Seen worst = watch(sim);
            const int which = static_cast<int>(body);
            EXPECT_LT(worst.worst_length, 2e-7f) << which;
            if (on)
                EXPECT_LT(worst.deepest, depth_of_faces(body)) << which;
            else
                EXPECT_GT(worst.deepest, 0.02f) << which;
        }
}

// Both models', whose guides go their own ways.
TEST_P(FollowContact, IsOfEveryModel) {
    const Hair hair;
    for (const plait_model model : {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED}) {
        auto desc = sim_of(hair, model);
        desc.tressfx.global_stiffness = desc.tressfx.local_stiffness = 0;
        plait::Sim sim(context, hair.guides, desc);
        add_body(sim, Body::ball);
        EXPECT_LT(watch(sim).deepest, 3e-4f) << model;
        auto params = sim.params();
        params.follow_contact = 0;
        sim.set_params(params);
        sim.reset();
        EXPECT_GT(watch(sim).deepest, 0.02f) << model;
    }
}

// Guides, and follows that meet nothing, keep their bits.
TEST_P(FollowContact, MovesNothingElse) {
    const Hair hair;
    const auto positions = [&](uint32_t on, bool far) {
        auto desc = sim_of(hair);
        desc.params.follow_contact = on;
        plait::Sim sim(context, hair.guides, desc);
        const plait_collider_id id = add_body(sim, Body::ball);
        if (far)
            sim.set_collider_pose(id, pose_at({5, 0, 0}));
        run(sim, 9); // it falls past the ball
        return sim.read(PLAIT_FIELD_POSITION);
    };
    EXPECT_EQ(positions(1, true), positions(0, true));
    auto with = positions(1, false), without = positions(0, false);
    EXPECT_NE(with, without);
    with.resize(4 * guide_count * vertices);
    without.resize(with.size());
    EXPECT_EQ(with, without);
}

// Calls of a quarter of a step: the ball's way is that of all four, as without follows in contact.
TEST_P(FollowContact, LeavesTheWayOfCollidersBetweenSteps) {
    const Hair hair;
    for (const Body body : {Body::ball, Body::nearest}) {
        const auto guides = [&](uint32_t on) {
            auto desc = sim_of(hair);
            desc.params.follow_contact = on;
            plait::Sim sim(context, hair.guides, desc);
            const plait_collider_id id = add_body(sim, body);
            for (int call = 1; call <= 80; ++call) { // 1 m/s, through both guides
                const float z = -0.2f + 0.4f * static_cast<float>(call) / 80;
                sim.set_collider_pose(id, pose_at({middle[0], middle[1], z}));
                sim.step(frame / 4);
            }
            auto x = sim.read(PLAIT_FIELD_POSITION);
            x.resize(4 * guide_count * vertices);
            return x;
        };
        EXPECT_EQ(guides(1), guides(0)) << static_cast<int>(body);
    }
}

TEST_P(FollowContact, CostsNothingWithoutColliders) {
    const Hair hair;
    const auto stages = [&](uint32_t on, Body body) {
        auto desc = sim_of(hair);
        desc.params.follow_contact = on;
        plait::Sim sim(context, hair.guides, desc);
        if (body != Body::none)
            add_body(sim, body);
        std::vector<std::string> names;
        for (const auto& [name, calls] : stages_of(sim))
            if (calls > 0 && name.starts_with("follow_"))
                names.push_back(name);
        return names;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(stages(1, Body::none), Names{"follow_turns"});
    EXPECT_EQ(stages(0, Body::ball), Names{"follow_turns"});
    EXPECT_EQ(stages(1, Body::ball), (Names{"follow_turns", "follow_collide"}));
    EXPECT_EQ(stages(1, Body::field), (Names{"follow_turns", "follow_field"}));
    EXPECT_EQ(stages(1, Body::nearest), (Names{"follow_turns", "follow_nearest"}));
}

// A collider that no step has seen yet is where it was made.
TEST_P(FollowContact, IsThereAfterResetAndTeleport) {
    const Hair hair;
    plait::Sim sim(context, hair.guides, sim_of(hair));
    auto collider = smooth_collider();
    collider.capsule.a[0] = collider.capsule.b[0] = middle[0]; // in the hair as it is groomed
    collider.capsule.a[1] = collider.capsule.b[1] = -0.03f;
    collider.capsule.radius_a = collider.capsule.radius_b = radius;
    sim.create_collider(collider);
    const auto deepest = [&](const Point& at) {
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        float most = 0;
        for (size_t row = guide_count * vertices; row < x.size() / 4; ++row)
            most = std::max(most, radius - distance(&x[4 * row], at.data()));
        return most;
    };
    EXPECT_GT(deepest({middle[0], -0.03f, 0}), 0.01f) << "as it was shown before";
    sim.reset();
    EXPECT_LT(deepest({middle[0], -0.03f, 0}), 3e-4f);
    sim.teleport(head_at({0, 0.2f, 0}));
    EXPECT_EQ(deepest({middle[0], -0.03f, 0}), 0) << "which stayed where it is";
    sim.teleport(head_at({0, 0, 0}));
    EXPECT_LT(deepest({middle[0], -0.03f, 0}), 3e-4f);
}

} // namespace
