// Strands of one sim that are solved in different ways: substeps, iterations, BDF2.
#include "faulty.hpp"
#include "forged.hpp"
#include "support.hpp"

#include <cstring>

namespace {

class Settings : public OnBackend {};
ON_EVERY_BACKEND(Settings);

constexpr uint32_t of_sim = PLAIT_SETTING_OF_SIM;
constexpr size_t strands = 37, vertices = 9; // no whole number of tiles

using Table = std::vector<plait_strand_settings>;

plait_strand_settings make(uint32_t substeps = of_sim, uint32_t iterations = of_sim,
                           uint32_t bdf2 = of_sim) {
    auto settings = plait_strand_settings_defaults();
    settings.substeps = substeps;
    settings.iterations = iterations;
    settings.bdf2 = bdf2;
    return settings;
}

// As a level of detail has it, and the same number of substeps twice.
Table levels() {
    return {make(2), make(), make(3, 2, 1), make(4, 5), make(1, 1, 0), make(4)};
}

std::vector<uint32_t> scattered(size_t settings, size_t count = strands) {
    std::vector<uint32_t> of;
    for (size_t i = 0; i < count; ++i)
        of.push_back(static_cast<uint32_t>((5 * i + i / 3) % settings));
    return of;
}

Strands ragged() {
    Strands groom = tuft(strands, vertices);
    for (size_t i = 0; i < strands; i += 3)
        groom[i].resize(vertices - i % 5);
    return groom;
}

std::vector<float> row(const std::vector<float>& field, size_t strand) {
    const auto from = field.begin() + static_cast<std::ptrdiff_t>(4 * vertices * strand);
    return {from, from + 4 * vertices};
}

plait::SimDesc desc_of(uint32_t substeps) {
    plait::SimDesc desc;
    desc.substeps = substeps;
    return desc;
}

// A head and a collider that move, one that turns, pins, a teleport, another material.
template <typename Between> void live(plait::Sim& sim, const Between& between) {
    auto ball = smooth_collider();
    ball.capsule.radius_a = ball.capsule.radius_b = 0.05f;
    ball.friction = 0.3f;
    ball.pose.t[0] = 0.08f;
    ball.pose.t[1] = -0.12f;
    const auto moving = sim.create_collider(ball);
    auto box = smooth_collider();
    box.kind = PLAIT_COLLIDER_KIND_BOX;
    std::fill_n(box.box.half_extents, 3, 0.04f);
    box.pose.t[1] = -0.3f;
    const auto turning = sim.create_collider(box);
    sim.set_pins({{7, 4, PLAIT_PIN_FRAME_REST, {0, 0, 0}, 10},
                  {8, 8, PLAIT_PIN_FRAME_WORLD, {0.1f, 0.05f, 0.1f}, 2}});
    for (int i = 0; i < 20; ++i) {
        between(i);
        const float t = static_cast<float>(i) / 60;
        sim.set_roots(head_at({0.1f * std::sin(9 * t), 0, 0}));
        ball.pose.t[0] += 0.002f;
        sim.set_collider_pose(moving, ball.pose);
        box.pose.q[2] = std::sin(t);
        box.pose.q[3] = std::cos(t);
        sim.set_collider_pose(turning, box.pose);
        if (i == 8)
            sim.teleport(head_at({0.02f, 0, 0}, {0, 0.1f, 0, 0.99498743f}));
        if (i == 14) {
            sim.set_param("bend_stiffness", {2 * sim.param("bend_stiffness")[0]});
        }
        sim.step(frame);
    }
}
constexpr auto nothing = [](int) {};

TEST_P(Settings, AreThoseOfTheSimUntilTheyAreSet) {
    auto desc = desc_of(3);
    plait::Sim sim(context, make_groom(tuft(4, 5)), desc);
    for (const auto& settings : sim.settings()) {
        EXPECT_EQ(settings.substeps, 3u);
        EXPECT_EQ(settings.iterations, of_sim);
        EXPECT_EQ(settings.bdf2, of_sim);
    }
    sim.set_settings({make(1, 4, 1), make()}, {1, 0, 0, 1});
    sim.reset();
    sim.set_params(sim.params());
    const auto got = sim.settings();
    EXPECT_EQ(got[2].substeps, 1u);
    EXPECT_EQ(got[2].iterations, 4u);
    EXPECT_EQ(got[2].bdf2, 1u);
    EXPECT_EQ(got[3].substeps, 3u);
    EXPECT_EQ(substeps_of(sim), (std::vector<uint32_t>{3, 1, 1, 3}));
    sim.set_settings({make(2)});
    EXPECT_EQ(substeps_of(sim), std::vector<uint32_t>(4, 2));
    sim.set_settings({make()}); // all is the sim's again
    EXPECT_EQ(sim.settings()[0].substeps, 3u);
}

TEST_P(Settings, ThatCannotBeAreRefusedByIndexValueAndRange) {
    plait::Sim sim(context, make_groom(tuft(4, 5)), desc_of(1));
    run(sim, 2);
    const uint64_t hash = sim.hash();
    const auto refused = [&](const Table& table, const std::vector<uint32_t>& of,
                             const char* sentence) {
        EXPECT_EQ(plait_sim_set_settings(sim, table.data(), table.size(), plait::view(of)),
                  PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
    };
    const auto good = make();
    refused({good, make(0)}, {}, "settings[1]: substeps is 0, range is [1, 1000]");
    refused({make(1001)}, {}, "settings[0]: substeps is 1001, range is [1, 1000]");
    refused({make(1, 65)}, {}, "settings[0]: iterations is 65, range is [0, 64]");
    refused({make(1, 1, 2)}, {}, "settings[0]: bdf2 is 2, range is [0, 1]");
    refused({good}, {0, 0, 1, 0}, "strand_settings[2] is 1, range is [0, 0], the settings");
    refused({good}, {0, 0, 0}, "strand_settings.count is 3, the sim has 4 guides");
    refused({}, {}, "count is 0, range is [1, 64]");
    refused(Table(65, good), {}, "count is 65, range is [1, 64]");
    auto short_one = good;
    short_one.struct_size = 3;
    refused({short_one}, {}, "settings[0]->struct_size is 3");
    EXPECT_EQ(plait_sim_set_settings(sim, nullptr, 1, {}), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(sim.hash(), hash);
    plait::Sim parity(context, make_groom(tuft(2, 5)), tressfx_desc());
    EXPECT_EQ(plait_sim_set_settings(parity, &good, 1, {}), PLAIT_INVALID_STATE);
    std::vector<plait_strand_settings> got(3, plait_strand_settings_defaults());
    size_t count = 3;
    EXPECT_EQ(plait_sim_get_settings(sim, got.data(), &count), PLAIT_INVALID_ARGUMENT);
}

// Bit for bit what it would be in a sim all of its settings, whatever its neighbours are.
TEST_P(Settings, AStrandIsSolvedAsInASimOfItsSettings) {
    const auto groom = make_groom(ragged());
    const auto of = scattered(levels().size());
    plait::Sim sim(context, groom, desc_of(1));
    sim.set_settings(levels(), of);
    live(sim, nothing);
    const auto got = sim.read(PLAIT_FIELD_POSITION);
    for (size_t k = 0; k < levels().size(); ++k) {
        const auto settings = levels()[k];
        auto desc = desc_of(settings.substeps == of_sim ? 1 : settings.substeps);
        if (settings.iterations != of_sim)
            desc.params.iterations = settings.iterations;
        if (settings.bdf2 != of_sim)
            desc.params.bdf2 = settings.bdf2;
        plait::Sim alone(context, groom, desc);
        live(alone, nothing);
        const auto expected = alone.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < strands; ++i) {
            if (of[i] != k)
                continue;
            EXPECT_EQ(row(got, i), row(expected, i)) << "strand " << i << ", settings " << k;
        }
    }
}

// Other strands are solved in other ways at every step; these never are.
TEST_P(Settings, AStrandDoesNotNoticeThatOthersChange) {
    const auto groom = make_groom(ragged());
    plait::Sim quiet(context, groom, desc_of(2)), busy(context, groom, desc_of(2));
    live(quiet, nothing);
    const auto number = static_cast<uint32_t>(levels().size());
    live(busy, [&](int step) {
        auto table = levels();
        table.push_back(make());
        auto of = scattered(number);
        for (size_t i = 0; i < of.size(); ++i)
            of[i] = i % 7 == 3 ? number : (of[i] + static_cast<uint32_t>(step)) % number;
        busy.set_settings(table, of);
    });
    const auto expected = quiet.read(PLAIT_FIELD_POSITION), got = busy.read(PLAIT_FIELD_POSITION);
    for (size_t i = 3; i < strands; i += 7)
        EXPECT_EQ(row(got, i), row(expected, i)) << i;
    EXPECT_NE(row(got, 4), row(expected, 4));
    EXPECT_EQ(busy.measure().nonfinite, 0u);
}

Point tip_of(const plait::Sim& sim) {
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    const auto* tip = &x[4 * (vertices - 1)];
    return {tip[0], tip[1], tip[2]};
}

// m/s^2
float acceleration(const Point& a, const Point& b, const Point& c) {
    float square = 0;
    for (size_t i = 0; i < 3; ++i)
        square += (a[i] - 2 * b[i] + c[i]) * (a[i] - 2 * b[i] + c[i]);
    return std::sqrt(square) * 3600;
}

// Limp strands that swing down, with 2 m/s at the tip. A step before as long ago as the substeps were
// before, taken for one as long ago as they are now, would add 32 to 43 m/s^2; the change itself adds less
// than 10.
TEST_P(Settings, ASwingGoesOnWhenTheSubstepsChange) {
    const auto groom = make_groom(tuft(4, vertices));
    auto desc = desc_of(1);
    desc.params.bdf2 = 1;
    desc.material.bend_stiffness = desc.material.twist_stiffness = 0;
    for (const uint32_t to : {1u, 4u}) {
        desc.substeps = 5 - to;
        plait::Sim kept(context, groom, desc), changed(context, groom, desc);
        run(kept, 12);
        run(changed, 12);
        const Point a = tip_of(kept);
        run(kept, 1);
        run(changed, 1);
        const Point b = tip_of(kept);
        changed.set_settings({make(to)});
        run(kept, 1);
        run(changed, 1);
        EXPECT_LT(acceleration(a, b, tip_of(changed)), acceleration(a, b, tip_of(kept)) + 10)
            << 5 - to << " to " << to << " substeps";
    }
}

TEST_P(Settings, NothingThatIsSeenMovesAtTheChange) {
    plait::Sim sim(context, make_groom(ragged()), desc_of(1));
    run(sim, 5);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    const auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
    for (const size_t number : {levels().size(), size_t{1}, size_t{3}}) {
        sim.set_settings(levels(), scattered(number));
        EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), before);
        EXPECT_EQ(sim.read(PLAIT_FIELD_VELOCITY), velocity);
    }
}

TEST_P(Settings, EachNumberOfSubstepsIsOneRoundOfItsStages) {
    using Stages = std::vector<std::pair<std::string, uint64_t>>;
    plait::Sim sim(context, make_groom(tuft(6, 5)));
    const Stages alone = {{"roots", 3}, {"articulated", 3}, {"lane_unpack", 3}};
    EXPECT_EQ(stages_of(sim), alone);
    const uint64_t bytes = sim.describe().device_bytes;
    sim.set_settings({make(), make(4), make(4, 2)}, {0, 1, 2, 2, 1, 0});
    const Stages of_two = {{"roots", 15}, {"articulated", 27}, {"lane_unpack", 9}};
    EXPECT_EQ(stages_of(sim), of_two);
    sim.set_settings({make()});
    EXPECT_EQ(stages_of(sim), alone);
    EXPECT_EQ(sim.describe().device_bytes, bytes);
}

TEST_P(Settings, AreSavedAndRestoredWithTheState) {
    const auto groom = make_groom(ragged());
    plait::Sim a(context, groom, desc_of(2)), b(context, groom, desc_of(2));
    const auto of_the_sim = a.save();
    run(a, 3);
    a.set_settings(levels(), scattered(levels().size()));
    run(a, 3);
    const auto saved = a.save();
    b.restore(saved);
    EXPECT_EQ(b.hash(), a.hash());
    EXPECT_EQ(b.save(), saved);
    EXPECT_EQ(b.settings()[3].substeps, a.settings()[3].substeps);
    run(a, 5);
    run(b, 5);
    EXPECT_LT(largest_difference(a.read(PLAIT_FIELD_POSITION), b.read(PLAIT_FIELD_POSITION)),
              GetParam() == "opencl" ? 1e-30f : 1e-4f); // `reference` saves floats of its doubles
    b.restore(of_the_sim);
    EXPECT_EQ(b.save(), of_the_sim);
}

// Whether strands have a history hangs on parameters, which a snapshot does not set.
TEST_P(Settings, AreRestoredWhateverTheIntegratorIs) {
    const auto groom = make_groom(ragged());
    const auto contact = plait_strand_contact_desc_defaults();
    struct Sims {
        bool bdf2, contact, own; // strands with settings of their own
    };
    const Sims kinds[] = {{true, false, false}, {false, false, false}, {true, true, false},
                          {true, false, true},  {false, false, true},  {true, true, true}};
    const auto make = [&](const Sims& kind) {
        auto sim = std::make_unique<plait::Sim>(context, groom, desc_of(2));
        auto params = sim->params();
        params.bdf2 = kind.bdf2 ? PLAIT_BDF2_OF_MODEL : 0u;
        sim->set_params(params);
        if (kind.contact)
            sim->set_strand_contact(&contact);
        if (kind.own)
            sim->set_settings(levels(), scattered(levels().size()));
        run(*sim, 4);
        return sim;
    };
    for (const Sims& from : kinds) {
        const auto saved = make(from);
        const auto bytes = saved->save();
        for (const Sims& to : kinds) {
            const auto sim = make(to);
            ASSERT_EQ(plait_sim_restore(*sim, bytes.data(), bytes.size()), PLAIT_OK)
                << plait_last_error();
            for (const auto field : {PLAIT_FIELD_POSITION, PLAIT_FIELD_VELOCITY})
                EXPECT_LE(largest_difference(sim->read(field), saved->read(field)), 1e-6f);
            EXPECT_EQ(sim->params().bdf2, to.bdf2 ? PLAIT_BDF2_OF_MODEL : 0u);
            // 37 mm on; other integrators and strands that meet go other ways
            const auto on = make(from);
            run(*on, 2);
            run(*sim, 2);
            const float bar = from.contact != to.contact ? 0.03f
                              : from.bdf2 != to.bdf2     ? 4e-3f
                                                         : 1e-6f;
            EXPECT_LE(
                largest_difference(sim->read(PLAIT_FIELD_POSITION), on->read(PLAIT_FIELD_POSITION)),
                bar);
        }
    }
}

TEST_P(Settings, OfASnapshotThatCannotBeAreRefused) {
    plait::Sim sim(context, make_groom(tuft(6, 5)), desc_of(2));
    sim.set_settings(levels(), scattered(levels().size(), 6));
    run(sim, 2);
    const auto saved = sim.save();
    const uint64_t hash = sim.hash();
    const size_t first = forged::find_block(saved, "sett") + forged::block_head;
    const std::pair<size_t, const char*> fields[] = {
        {0, "strand 3: substeps is"}, {1, "strand 3: iterations is"}, {2, "strand 3: bdf2 is"}};
    for (const auto& [field, sentence] : fields) {
        auto damaged = saved;
        const uint32_t value = 70000;
        std::memcpy(&damaged[first + (3 * 3 + field) * sizeof value], &value, sizeof value);
        forged::sign(damaged);
        EXPECT_EQ(plait_sim_restore(sim, damaged.data(), damaged.size()), PLAIT_BAD_DATA);
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
    }
    EXPECT_EQ(sim.hash(), hash);
}

TEST(SettingsFaults, AChangeThatFailsChangesNothing) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    const auto groom = make_groom(tuft(6, 5));
    plait::Sim sim(context, groom, desc_of(1)), untouched(context, groom, desc_of(1));
    for (plait::Sim* each : {&sim, &untouched}) {
        each->create_collider(smooth_collider()); // its rows grow, too
        run(*each, 3);
    }
    const auto table = levels();
    const auto of = scattered(table.size(), 6);
    const uint64_t hash = sim.hash();
    int refused = 0;
    for (; refused < 200; ++refused) {
        faults.fail_create_after = refused;
        const auto result =
            plait_sim_set_settings(sim, table.data(), table.size(), plait::view(of));
        faults.fail_create_after = -1;
        if (result == PLAIT_OK)
            break;
        EXPECT_EQ(result, PLAIT_OUT_OF_MEMORY);
        EXPECT_EQ(sim.hash(), hash);
        EXPECT_EQ(sim.settings()[5].substeps, 1u);
    }
    EXPECT_GE(refused, 30);
    untouched.set_settings(table, of);
    run(sim, 3);
    run(untouched, 3);
    EXPECT_EQ(sim.hash(), untouched.hash());
}

} // namespace
