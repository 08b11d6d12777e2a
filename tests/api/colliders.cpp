// Colliders: hair stays out of them, and ids do not come back.
#include "support.hpp"

namespace {

class Colliders : public OnBackend {};
ON_EVERY_BACKEND(Colliders);

TEST_P(Colliders, HairStaysOutsideAMovingSphere) {
    plait::Sim sim(context, make_groom(tuft(3, 8)), tressfx_desc()); // which pushes out exactly
    auto desc = plait_collider_desc_defaults();
    desc.radius_a = desc.radius_b = 0.05f;
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

} // namespace
