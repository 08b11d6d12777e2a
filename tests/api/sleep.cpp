// Hair that is still sleeps: what that costs, what wakes it, and that it wakes as it fell asleep.
#include "level_scenes.hpp"
#include "mesh_shapes.hpp"

#include <functional>
#include <optional>

namespace {

class Sleep : public OnBackend {
  protected:
    Sleep() {
        auto desc = plait_context_desc_defaults();
        desc.backend = GetParam().c_str();
        desc.profile = 1; // so that launches are counted
        profiled_ = plait::Context(desc);
    }
    const plait::Context& counted() const { return *profiled_; }

  private:
    std::optional<plait::Context> profiled_;
};
ON_EVERY_BACKEND(Sleep);

plait_level_choice sleeps(uint32_t level = 0, float rest = 2e-3f) {
    auto choice = choice_of(level, 0);
    choice.rest = rest;
    return choice;
}

// Where it takes many steps, which the reference makes slowly.
Scene few() {
    return Scene(field(6), {36, 12, 0});
}

void stand(plait::Sim& sim) {
    sim.set_roots(head_at({}));
    sim.step(slightly_more);
    sim.wait(); // so that what was asked for has come
}

// How many steps it took.
int fall_asleep(plait::Sim& sim) {
    int steps = 0;
    for (; !sim.level().asleep && steps < 3000; ++steps)
        stand(sim);
    EXPECT_TRUE(sim.level().asleep);
    EXPECT_GE(steps, 30) << "half a second at least";
    return steps;
}

TEST_P(Sleep, CostsNothingAndLetsTimePass) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(counted(), 0, [](auto& desc) { desc.keep_last_frame = 1; });
    sim.set_level(sleeps());
    for (int step = 0; step < 30; ++step)
        move(sim, step);
    fall_asleep(sim);
    double squares = 0;
    const auto v = sim.read(PLAIT_FIELD_VELOCITY);
    for (size_t i = 0; i < v.size(); ++i)
        squares += i % 4 == 3 ? 0 : std::pow(double(v[i]), 2);
    EXPECT_LT(std::sqrt(squares / double(v.size() / 4)), 3e-3);
    const double time = sim.describe().time;
    stand(sim); // the frame before becomes this one
    sim.take_launches();
    const auto x = shown(sim);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION_LAST_FRAME), x) << "no motion is drawn";
    for (int step = 0; step < 59; ++step)
        stand(sim);
    EXPECT_TRUE(sim.take_launches().empty());
    EXPECT_EQ(shown(sim), x);
    EXPECT_NEAR(sim.describe().time - time, 1, 1e-6);
}

// As a sim that was not called meanwhile.
TEST_P(Sleep, EndsWithTheBitsItBeganWith) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context), other = scene.sim(context);
    sim.set_level(sleeps(1));
    other.set_level(choice_of(1, 0));
    const int steps = fall_asleep(sim);
    for (int step = 0; step < steps; ++step)
        stand(other);
    ASSERT_EQ(shown(sim), shown(other));
    for (int step = 0; step < 100; ++step)
        stand(sim);
    for (int step = 1; step < 40; ++step) {
        move(sim, step);
        move(other, step);
        ASSERT_EQ(shown(sim), shown(other)) << step;
        ASSERT_FALSE(sim.level().asleep);
    }
    EXPECT_EQ(sim.read(PLAIT_FIELD_VELOCITY), other.read(PLAIT_FIELD_VELOCITY));
}

// Hair that is not stepped at all need not be still.
TEST_P(Sleep, IsForRigidHairToo) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(counted());
    sim.set_level(sleeps(3));
    fall_asleep(sim);
    stand(sim);
    sim.take_launches();
    stand(sim);
    EXPECT_TRUE(sim.take_launches().empty());
    move(sim, 10);
    EXPECT_FALSE(sim.take_launches().empty());
    EXPECT_FALSE(sim.level().asleep);
}

TEST_P(Sleep, IsAskedForAndIsOfHairThatIsStill) {
    const Scene scene = few();
    plait::Sim awake = scene.sim(context), slow = scene.sim(context);
    slow.set_level(sleeps(0, 1e-4f));
    for (int step = 0; step < 300; ++step) {
        stand(awake);
        move(slow, 0.02 * step); // turns by 0.05 rad a second
        slow.wait();
        ASSERT_FALSE(awake.level().asleep);
        ASSERT_FALSE(slow.level().asleep);
    }
}

// What goes on without the host.
TEST_P(Sleep, DoesNotComeOverHairThatTheWorldMoves) {
    const Scene scene = few();
    auto wind = plait_wind_desc_defaults();
    wind.velocity[0] = 1e-4f;
    auto frame_desc = plait_frame_desc_defaults();
    auto wetness = plait_wetness_desc_defaults();
    const std::function<void(plait::Sim&)> features[] = {
        [&](plait::Sim& sim) { sim.set_wind(wind); },
        [&](plait::Sim& sim) { sim.set_frame(frame_desc); },
        [&](plait::Sim& sim) {
            sim.set_wetness(&wetness);
            sim.write(PLAIT_FIELD_WETNESS, std::vector<float>(sim.describe().guides, 0.5f));
        }};
    for (const auto& feature : features) {
        plait::Sim sim = scene.sim(context);
        sim.set_level(sleeps());
        fall_asleep(sim);
        feature(sim);
        for (int step = 0; step < 200; ++step) {
            stand(sim);
            ASSERT_FALSE(sim.level().asleep) << step;
        }
    }
}

// A ball below the hair.
plait_collider_desc ball(float y) {
    auto desc = plait_collider_desc_defaults();
    desc.pose.t[1] = y;
    return desc;
}

// Of 256 strands one that is not among those looked at first: a hand lifts it and lets go.
TEST_P(Sleep, IsOfAllStrandsOrNone) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    sim.set_level(sleeps(0, 0.02f));
    fall_asleep(sim);
    constexpr size_t strand = 200;
    const uint32_t last = sim.read<uint32_t>(PLAIT_FIELD_VERTEX_COUNT)[strand] - 1;
    plait_pin hand{.strand = strand,
                   .vertex = last,
                   .frame = PLAIT_PIN_FRAME_WORLD,
                   .target = {},
                   .stiffness = 1};
    const size_t tip = 4 * (strand * scene.row + last);
    const auto at = shown(sim);
    std::copy_n(&at[tip], 3, hand.target);
    for (int i = 0; i < 40; ++i) {
        hand.target[1] += 2e-3f;
        sim.set_pins({hand});
        stand(sim);
    }
    sim.set_pins({});
    fall_asleep(sim);
    const auto x = shown(sim);
    for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(x[tip + k], at[tip + k], 0.01f) << "it hangs in the air";
}

// What a device that is behind says of before must not count.
TEST_P(Sleep, DoesNotComeOverHairThatWasStirredMeanwhile) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    sim.set_level(sleeps(0, 0.02f));
    fall_asleep(sim);
    const auto tremble = [&](int i) {
        sim.set_roots(head_at({1e-6f * static_cast<float>(i % 2), 0, 0}));
    };
    for (int i = 0; i < 90; ++i) { // nobody waits
        tremble(i);
        sim.step(slightly_more);
    }
    sim.set_roots(head_at({0.05f, 0, 0}));
    for (int i = 0; i < 20; ++i) {
        sim.step(slightly_more);
        sim.wait();
        ASSERT_FALSE(sim.level().asleep) << i;
    }
}

TEST_P(Sleep, EndsWhereHairIsFasterThanIsAskedForNow) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    for (int step = 0; step < 30; ++step)
        move(sim, step);
    sim.set_level(sleeps(0, 0.05f));
    fall_asleep(sim);
    sim.set_level(sleeps(0, 0.1f));
    EXPECT_TRUE(sim.level().asleep);
    sim.set_level(sleeps(0, 1e-4f));
    EXPECT_FALSE(sim.level().asleep);
}

struct Call {
    const char* name;
    std::function<void(plait::Sim&)> make;
};

TEST_P(Sleep, GoesOnThroughCallsThatChangeNothing) {
    const Scene scene = few();
    plait::Sim sim = scene.sim(context);
    const auto body = sim.create_collider(ball(-2));
    sim.set_level(sleeps());
    fall_asleep(sim);
    const Call calls[] = {
        {"set_roots", [](auto& s) { s.set_roots(head_at({})); }},
        {"collider_set_pose", [&](auto& s) { s.set_collider_pose(body, ball(-2).pose); }},
        {"set_level", [](auto& s) { s.set_level(sleeps()); }},
        {"read", [](auto& s) { s.read(PLAIT_FIELD_POSITION); }},
        {"measure", [](auto& s) { s.measure(); }},
        {"save", [](auto& s) { s.save(); }},
        {"hash", [](auto& s) { s.hash(); }},
        {"step of no time", [](auto& s) { s.step(0); }},
    };
    for (const Call& call : calls) {
        call.make(sim);
        EXPECT_TRUE(sim.level().asleep) << call.name;
    }
}

TEST_P(Sleep, EndsWithEveryCallThatMayChangeTheHair) {
    const Scene scene = few();
    plait::Sim sim = scene.sim(context), beside = scene.sim(context);
    const auto body = sim.create_collider(ball(-2));
    beside.share_colliders(sim);
    const ShapeMesh cube = box_mesh(0.05, 0.05, 0.05);
    const plait_view vertices{cube.positions.data(), cube.positions.size(), 0};
    auto mesh_desc = plait_mesh_desc_defaults();
    mesh_desc.positions = vertices;
    mesh_desc.triangles = {cube.triangles.data(), cube.triangles.size(), 0};
    auto bends = plait_collider_mesh_desc_defaults();
    bends.form = PLAIT_MESH_FORM_NEAREST;
    bends.pose = ball(-4).pose;
    const auto soft = sim.create_collider(plait::Mesh(mesh_desc), bends);
    const std::vector<unsigned char> saved = sim.save();
    const auto velocities = sim.read(PLAIT_FIELD_VELOCITY);
    const auto grid = plait_grid_desc_defaults();
    const Call calls[] = {
        {"set_roots",
         [](auto& s) {
             s.set_roots(head_at({1e-3f, 0, 0}));
         }},
        {"teleport", [](auto& s) { s.teleport(head_at({})); }},
        {"reset", [](auto& s) { s.reset(); }},
        {"restore", [&](auto& s) { s.restore(saved); }},
        {"write", [&](auto& s) { s.write(PLAIT_FIELD_VELOCITY, velocities); }},
        {"set_params", [](auto& s) { s.set_params(s.params()); }},
        {"set_param", [](auto& s) { s.set_param("drag", {1}); }},
        {"set_materials", [](auto& s) { s.set_material(plait_material_defaults()); }},
        {"set_preset", [](auto& s) { s.set_preset("curly"); }},
        {"set_grid", [&](auto& s) { s.set_grid(&grid); }},
        {"set_pins",
         [](auto& s) {
             s.set_pins({{.strand = 0, .vertex = 2, .frame = {}, .target = {}, .stiffness = 1}});
         }},
        {"collider_set_pose", [&](auto& s) { s.set_collider_pose(body, ball(-2.001f).pose); }},
        {"collider_place", [&](auto& s) { s.place_collider(body, ball(-2).pose); }},
        {"collider_set_shape", [&](auto& s) { s.set_collider_shape(body, ball(-2)); }},
        {"collider_set_positions", [&](auto& s) { s.set_collider_positions(soft, vertices); }},
        {"collider_create", [](auto& s) { s.create_collider(ball(-6)); }},
        {"collider_destroy", [&](auto& s) { s.destroy_collider(body); }},
        {"set_level", [](auto& s) { s.set_level(sleeps(1)); }},
        {"share_colliders", [](auto& s) { s.share_colliders(nullptr); }},
    };
    for (plait::Sim* each : {&sim, &beside})
        each->set_level(sleeps());
    for (const Call& call : calls) {
        const bool shared = std::string(call.name).starts_with("collider_");
        fall_asleep(sim);
        if (shared)
            fall_asleep(beside);
        ASSERT_TRUE(sim.level().asleep) << call.name;
        call.make(sim);
        EXPECT_FALSE(sim.level().asleep) << call.name;
        EXPECT_FALSE(shared && beside.level().asleep) << call.name;
    }
}

} // namespace
