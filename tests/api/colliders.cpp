// Colliders: hair stays out of them, and ids do not come back.
#include "support.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>

namespace {

class Colliders : public OnBackend {};
ON_EVERY_BACKEND(Colliders);

TEST_P(Colliders, HairStaysOutsideAMovingSphere) {
    plait::Sim sim(context, make_groom(tuft(3, 8)), tressfx_desc()); // which pushes out exactly
    auto desc = plait_collider_desc_defaults();
    desc.capsule.radius_a = desc.capsule.radius_b = 0.05f;
    desc.pose.t[0] = 0.1f;
    desc.pose.t[1] = -0.2f;
    const auto id = sim.create_collider(desc);
    for (int i = 0; i < 20; ++i) {
        desc.pose.t[1] += 0.005f;
        sim.set_collider_pose(id, desc.pose);
        sim.step(frame);
    }
    const auto p = sim.read(PLAIT_FIELD_POSITION);
    bool touched = false;
    for (size_t i = 0; i < p.size(); i += 4) {
        const float d = std::hypot(p[i] - desc.pose.t[0], p[i + 1] - desc.pose.t[1], p[i + 2]);
        touched = touched || d < 0.0501f;
        if (p[i + 3] != 0) {
            EXPECT_GT(d, 0.04999f) << "vertex " << i / 4;
        }
    }
    EXPECT_TRUE(touched);
}

TEST_P(Colliders, IdsAreGenerational) {
    plait::Sim sim(context, make_groom(tuft(1, 4)));
    const auto desc = plait_collider_desc_defaults();
    const auto first = sim.create_collider(desc);
    EXPECT_NE(first.value, 0u);
    sim.destroy_collider(first);
    const auto second = sim.create_collider(desc);
    EXPECT_NE(first.value, second.value);
    EXPECT_EQ(plait_collider_destroy(sim, first), PLAIT_NOT_FOUND);
    EXPECT_EQ(plait_collider_set_pose(sim, first, &desc.pose), PLAIT_NOT_FOUND);
    EXPECT_EQ(plait_collider_destroy(sim, {0}), PLAIT_NOT_FOUND);
    EXPECT_EQ(plait_collider_destroy(sim, second), PLAIT_OK);
}

TEST_P(Colliders, AreListedAndReadBack) {
    plait::Sim sim(context, make_groom(tuft(1, 4)));
    EXPECT_TRUE(sim.colliders().empty());
    auto desc = plait_collider_desc_defaults();
    std::vector<plait_collider_id> made;
    for (int i = 0; i < 3; ++i) {
        desc.capsule.radius_a = 0.1f + 0.01f * static_cast<float>(i);
        desc.capsule.b[1] = 0.2f;
        desc.friction = 0.25f;
        desc.pose.t[2] = static_cast<float>(i);
        made.push_back(sim.create_collider(desc));
    }
    sim.destroy_collider(made[1]);
    const auto ids = sim.colliders();
    ASSERT_EQ(ids.size(), 2u);
    EXPECT_EQ(ids[0].value, made[0].value);
    EXPECT_EQ(ids[1].value, made[2].value);
    const auto back = sim.describe_collider(ids[1]);
    EXPECT_EQ(back.struct_size, sizeof back);
    EXPECT_EQ(back.capsule.radius_a, desc.capsule.radius_a);
    EXPECT_EQ(back.capsule.b[1], 0.2f);
    EXPECT_EQ(back.friction, 0.25f);
    EXPECT_EQ(back.pose.t[2], 2);
    desc.pose.t[2] = 5;
    sim.set_collider_pose(ids[1], desc.pose);
    EXPECT_EQ(sim.describe_collider(ids[1]).pose.t[2], 5) << "at the end of the next step";
    plait_collider_id one{};
    size_t count = 1;
    ASSERT_EQ(plait_colliders_list(sim, &one, &count), PLAIT_OK);
    EXPECT_EQ(count, 1u);
    EXPECT_EQ(one.value, made[0].value);
    auto out = plait_collider_desc_defaults();
    EXPECT_EQ(plait_collider_describe(sim, made[1], &out), PLAIT_NOT_FOUND);
    EXPECT_EQ(plait_collider_set_shape(sim, made[1], &desc), PLAIT_NOT_FOUND);
}

TEST_P(Colliders, ANewShapeIsThatOfAColliderMadeSo) {
    const auto groom = make_groom(tuft(3, 8));
    plait::Sim changed(context, groom), made(context, groom);
    auto desc = plait_collider_desc_defaults();
    desc.capsule.radius_a = desc.capsule.radius_b = 0.01f;
    desc.pose.t[0] = 0.08f;
    desc.pose.t[1] = -0.08f;
    const auto id = changed.create_collider(desc);
    desc.capsule.b[0] = 0.1f;
    desc.capsule.radius_a = 0.07f;
    desc.capsule.radius_b = 0.05f;
    desc.friction = 0.5f;
    auto elsewhere = desc; // its pose is not used
    elsewhere.pose.t[0] = 9;
    changed.set_collider_shape(id, elsewhere);
    made.create_collider(desc);
    run(changed, 12);
    run(made, 12);
    EXPECT_EQ(changed.read(PLAIT_FIELD_POSITION), made.read(PLAIT_FIELD_POSITION));
    plait::Sim without(context, groom);
    run(without, 12);
    EXPECT_NE(changed.read(PLAIT_FIELD_POSITION), without.read(PLAIT_FIELD_POSITION));
    // and while it runs: out of the way
    desc.capsule.radius_a = desc.capsule.radius_b = 1e-3f;
    changed.set_collider_shape(id, desc);
    changed.step(frame);
    made.step(frame);
    EXPECT_NE(changed.read(PLAIT_FIELD_POSITION), made.read(PLAIT_FIELD_POSITION));
}

TEST_P(Colliders, EveryKindIsReadBack) {
    plait::Sim sim(context, make_groom(tuft(1, 4)));
    auto desc = plait_collider_desc_defaults();
    EXPECT_EQ(desc.kind, PLAIT_COLLIDER_KIND_CAPSULE);
    EXPECT_EQ(desc.friction, 0.3f) << "as of meshes and hulls";
    desc.kind = PLAIT_COLLIDER_KIND_BOX;
    desc.box.half_extents[2] = 0.3f;
    desc.box.rounding = 0.02f;
    desc.box.orientation[2] = 0.6f;
    desc.box.orientation[3] = 0.8f;
    const auto id = sim.create_collider(desc);
    auto back = sim.describe_collider(id);
    EXPECT_EQ(std::memcmp(&back.box, &desc.box, sizeof desc.box), 0);
    EXPECT_EQ(back.capsule.radius_a, 0) << "of another kind";
    desc.kind = PLAIT_COLLIDER_KIND_PLANE;
    desc.plane.normal[2] = 2;
    sim.set_collider_shape(id, desc);
    back = sim.describe_collider(id);
    EXPECT_EQ(std::memcmp(&back.plane, &desc.plane, sizeof desc.plane), 0);
    EXPECT_EQ(back.box.rounding, 0);
}

// A table that comes up under hanging hair, turned and moved by its pose, in both kinds.
TEST_P(Colliders, HairStaysAboveATable) {
    const auto groom = make_groom(tuft(3, 8));
    for (const plait_collider_kind kind : {PLAIT_COLLIDER_KIND_PLANE, PLAIT_COLLIDER_KIND_BOX}) {
        plait::Sim sim(context, groom, tressfx_desc()); // which pushes out exactly
        auto desc = plait_collider_desc_defaults();
        desc.kind = kind;
        desc.box.centre[0] = -0.5f; // its top at the own x = 0
        desc.plane.normal[0] = 2;
        desc.plane.normal[1] = 0;
        desc.box.half_extents[0] = 0.49f;
        desc.box.half_extents[1] = desc.box.half_extents[2] = 2;
        desc.box.rounding = 0.01f;
        desc.pose.q[2] = desc.pose.q[3] = std::sqrt(0.5f); // x to y
        desc.pose.t[1] = -0.22f;
        const auto id = sim.create_collider(desc);
        for (int i = 0; i < 20; ++i) {
            desc.pose.t[1] += 0.01f;
            sim.set_collider_pose(id, desc.pose);
            sim.step(frame);
        }
        const auto p = sim.read(PLAIT_FIELD_POSITION);
        bool touched = false;
        for (size_t i = 0; i < p.size(); i += 4) {
            const float above = p[i + 1] - desc.pose.t[1];
            touched = touched || above < 1e-5f;
            if (p[i + 3] != 0) {
                EXPECT_GT(above, -1e-5f) << "kind " << kind << ", vertex " << i / 4;
            }
        }
        EXPECT_TRUE(touched) << "kind " << kind;
    }
}

TEST_P(Colliders, ADestroyedColliderIsGone) {
    const auto groom = make_groom(tuft(2, 8));
    plait::Sim with(context, groom);
    plait::Sim without(context, groom);
    auto desc = plait_collider_desc_defaults();
    desc.pose.t[1] = -0.1f;
    with.destroy_collider(with.create_collider(desc));
    run(with, 10);
    run(without, 10);
    EXPECT_EQ(with.read(PLAIT_FIELD_POSITION), without.read(PLAIT_FIELD_POSITION));
}

plait_collider_desc under_the_tuft() {
    auto sphere = plait_collider_desc_defaults();
    sphere.capsule.a[0] = sphere.capsule.b[0] = 0.07f;
    sphere.capsule.a[1] = sphere.capsule.b[1] = -0.1f;
    sphere.capsule.radius_a = sphere.capsule.radius_b = 0.09f;
    sphere.friction = 0.5f;
    return sphere;
}

// A sphere that hair lies on is carried 20 m away with the head: it is there at once, as the hair is,
// which goes on as if nothing had been. Half a segment: contacts make millimetres of what is
// rounded at 20 m.
TEST_P(Colliders, GoAlongWithATeleport) {
    const Point moved{20, -8, 5};
    const plait_roots there = head_at(moved);
    for (const plait_model model : {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED}) {
        auto desc = model == PLAIT_MODEL_TRESSFX ? tressfx_desc() : plait::SimDesc();
        desc.model = model;
        plait::Sim stays(context, make_groom(tuft(3, 8)), desc);
        plait::Sim goes(context, make_groom(tuft(3, 8)), desc);
        (void)stays.create_collider(under_the_tuft());
        const plait_collider_id id = goes.create_collider(under_the_tuft());
        run(stays, 60);
        run(goes, 60);
        goes.set_collider_pose(id, there.head);
        goes.teleport(there);
        run(stays, 5);
        run(goes, 5);
        const auto expected = stays.read(PLAIT_FIELD_POSITION);
        const auto got = goes.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < got.size(); i += 4)
            for (size_t axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(got[i + axis] - moved[axis], expected[i + axis], 0.01f)
                    << model << " vertex " << i / 4;
    }
}

} // namespace
