// Reading, writing, saving and restoring.
#include "support.hpp"

#include <cstring>

namespace {

class State : public OnBackend {};
ON_EVERY_BACKEND(State);

plait_sim_desc busy() {
    auto desc = plait_sim_desc_defaults();
    desc.follows_per_guide = 1;
    desc.interpolate_output = 1;
    desc.substeps = 2;
    desc.params.interhair = PLAIT_INTERHAIR_EXACT;
    return desc;
}

// A sim under way: a head half-way to its target, roots of their own, a moving collider.
void stir(plait::Sim& sim) {
    auto collider = plait_collider_desc_defaults();
    collider.pose.t[1] = -0.15f;
    const auto id = sim.create_collider(collider);
    const std::vector<plait_pose> own(6, {{0, 0, 0, 1}, {0.01f, 0, 0}});
    auto roots = head_at({0.02f, 0, 0});
    roots.root_poses = plait::view(own);
    sim.set_roots(roots);
    sim.step(3.4 * frame);
    sim.set_roots(head_at({0.05f, 0, 0}));
    collider.pose.t[0] = 0.1f;
    sim.set_collider_pose(id, collider.pose);
}

TEST_P(State, RestoredStateHasTheSameHashAndTheSameFuture) {
    const auto groom = make_groom(tuft(6, 7));
    plait::Sim a(context, groom, busy());
    stir(a);
    const auto saved = a.save();
    const uint64_t hash = a.hash();
    plait::Sim b(context, groom, busy());
    b.restore(saved);
    EXPECT_EQ(b.hash(), hash);
    EXPECT_EQ(b.save(), saved);
    run(a, 10);
    run(b, 10);
    EXPECT_EQ(a.stats().steps, b.stats().steps);
    // `reference` keeps doubles and a snapshot floats: there the futures differ by rounding.
    EXPECT_LT(largest_difference(a.read(PLAIT_FIELD_POSITION), b.read(PLAIT_FIELD_POSITION)),
              GetParam() == "opencl" ? 1e-30f : 1e-4f);
}

TEST_P(State, DamagedSnapshotsAreRefusedAndChangeNothing) {
    plait::Sim sim(context, make_groom(tuft(6, 7)), busy());
    stir(sim);
    const auto saved = sim.save();
    const uint64_t hash = sim.hash();
    for (size_t size : {size_t{0}, size_t{3}, size_t{100}, saved.size() - 1})
        EXPECT_EQ(plait_sim_restore(sim, saved.data(), size), PLAIT_BAD_DATA) << size;
    for (size_t at = 0; at + 4 <= saved.size(); at += 4) { // a NaN in any place
        auto damaged = saved;
        std::memset(damaged.data() + at, 0xff, 4);
        const plait_result result = plait_sim_restore(sim, damaged.data(), damaged.size());
        if (result == PLAIT_OK) // counters and ids take any value
            sim.restore(saved);
    }
    EXPECT_EQ(sim.hash(), hash);
    EXPECT_EQ(sim.stats().nonfinite, 0u);
}

TEST_P(State, SnapshotsOfAnotherGroomAreRefusedByName) {
    plait::Sim six(context, make_groom(tuft(6, 7)));
    plait::Sim five(context, make_groom(tuft(5, 7)));
    const auto saved = six.save();
    EXPECT_EQ(plait_sim_restore(five, saved.data(), saved.size()), PLAIT_INVALID_ARGUMENT);
    const std::string text = plait_last_error();
    EXPECT_NE(text.find("6 guides of 7"), std::string::npos) << text;
    EXPECT_NE(text.find("5 of 7"), std::string::npos) << text;
}

TEST_P(State, WrittenPositionsAreReadBackAndKeepTheirMass) {
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    auto p = sim.read(PLAIT_FIELD_POSITION);
    const auto mass = p;
    for (size_t i = 0; i < p.size(); ++i)
        p[i] = static_cast<float>(i) * 0.25f;
    sim.write(PLAIT_FIELD_POSITION, p);
    const auto back = sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < p.size(); ++i)
        EXPECT_EQ(back[i], i % 4 == 3 ? mass[i] : p[i]);
}

TEST_P(State, WrittenVelocityIsReadBack) {
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    std::vector<float> v(2 * 4 * 4, 0.0f);
    v[4 * 3] = 2;
    v[4 * 6 + 1] = -1;
    sim.write(PLAIT_FIELD_VELOCITY, v);
    EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_VELOCITY), v), 2e-5f);
}

TEST_P(State, NonFiniteValuesAreRefusedWithTheirIndex) {
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    const uint64_t hash = sim.hash();
    std::vector<float> p(2 * 4 * 4, 0.0f);
    p[4 * 5 + 1] = NAN;
    EXPECT_EQ(plait_sim_write(sim, PLAIT_FIELD_POSITION, p.data(), p.size() * 4),
              PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("position[5].y"), std::string::npos);
    EXPECT_EQ(sim.hash(), hash);
}

} // namespace
