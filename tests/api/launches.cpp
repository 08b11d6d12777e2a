// What a sim runs, launch by launch, with times on the device's clock and bytes by stages.def.
#include "faulty.hpp"
#include "support.hpp"

#include <algorithm>
#include <chrono>
#include <map>

namespace {

constexpr uint32_t strands = 40, row = 8;

plait::Context timed_context(const std::string& backend) {
    auto desc = plait_context_desc_defaults();
    desc.backend = backend.c_str();
    desc.profile = 1;
    return plait::Context(desc);
}

class Launches : public testing::TestWithParam<std::string> {
  protected:
    static plait::SimDesc desc_of() {
        plait::SimDesc desc;
        desc.substeps = 2;
        desc.grid.on = true;
        return desc;
    }

    // The events of some drivers (rusticl of Mesa 22.3) carry no times.
    static bool has_times(const std::vector<plait_launch>& launches) {
        return std::ranges::any_of(launches, [](const plait_launch& l) { return l.end_ns > 0; });
    }

    plait::Context context = timed_context(GetParam());
    plait::Sim sim{context, make_groom(tuft(strands, row)), desc_of()};
};
ON_EVERY_BACKEND(Launches);

TEST_P(Launches, AreThoseOfTheStages) {
    sim.take_launches();
    sim.stage_times(true);
    run(sim, 3);
    std::map<std::string, std::pair<uint64_t, double>> by_stage;
    for (const plait_launch& launch : sim.take_launches()) {
        auto& [calls, seconds] = by_stage[launch.stage];
        ++calls;
        seconds += 1e-9 * static_cast<double>(launch.end_ns - launch.begin_ns);
        EXPECT_GT(launch.items, 0u);
        EXPECT_GT(launch.bytes, 0u) << launch.stage;
    }
    const auto times = sim.stage_times();
    ASSERT_EQ(by_stage.size(), times.size());
    for (const plait_stage_time& time : times) {
        const auto& [calls, seconds] = by_stage[time.stage];
        EXPECT_EQ(calls, time.calls) << time.stage;
        EXPECT_NEAR(seconds, time.seconds, 1e-9 * static_cast<double>(calls)) << time.stage;
    }
}

TEST_P(Launches, FollowEachOther) {
    run(sim, 3);
    const auto launches = sim.take_launches();
    ASSERT_GT(launches.size(), 3u * 5);
    uint64_t before = 0;
    for (const plait_launch& launch : launches) {
        EXPECT_LE(launch.queued_ns, launch.begin_ns) << launch.stage;
        EXPECT_LE(before, launch.begin_ns) << launch.stage;
        EXPECT_LE(launch.begin_ns, launch.end_ns) << launch.stage;
        before = launch.end_ns;
    }
    const auto queued = [](const plait_launch& launch) { return launch.queued_ns > 0; };
    if (has_times(launches)) {
        EXPECT_TRUE(std::ranges::all_of(launches, queued));
    }
}

// All that a step enqueues is queued, on the device's clock, in no more time than the call took.
TEST_P(Launches, AreQueuedInsideTheCall) {
    run(sim, 1);
    sim.take_launches();
    const auto start = std::chrono::steady_clock::now();
    run(sim, 1);
    const auto took = std::chrono::steady_clock::now() - start;
    const auto launches = sim.take_launches();
    ASSERT_FALSE(launches.empty());
    const uint64_t span = launches.back().queued_ns - launches.front().queued_ns;
    EXPECT_LE(std::chrono::nanoseconds(span), took);
}

TEST_P(Launches, AreForgottenWhenTaken) {
    sim.take_launches();
    run(sim, 1);
    size_t count = 0;
    ASSERT_EQ(plait_sim_take_launches(sim, nullptr, &count), PLAIT_OK);
    const size_t all = count;
    ASSERT_GT(all, 3u);
    auto first = plait_launch_defaults();
    count = 1;
    ASSERT_EQ(plait_sim_take_launches(sim, &first, &count), PLAIT_OK);
    EXPECT_EQ(count, 1u);
    EXPECT_STREQ(first.stage, "roots") << "the oldest";
    EXPECT_EQ(first.items, strands);
    const auto others = sim.take_launches();
    EXPECT_EQ(others.size(), all - 1);
    EXPECT_TRUE(sim.take_launches().empty());
}

TEST_P(Launches, AreTheSimsOwn) {
    sim.take_launches();
    {
        plait::Sim gone(context, make_groom(tuft(3, row)), desc_of());
        run(gone, 2);
    }
    plait::Sim other(context, make_groom(tuft(5, row)), desc_of());
    run(other, 1);
    run(sim, 1);
    run(other, 1);
    for (const plait_launch& launch : sim.take_launches())
        EXPECT_TRUE(std::string(launch.stage) != "roots" || launch.items == strands);
    double seconds = 0;
    for (const plait_launch& launch : other.take_launches()) {
        EXPECT_TRUE(std::string(launch.stage) != "roots" || launch.items == 5);
        seconds += 1e-9 * static_cast<double>(launch.end_ns - launch.begin_ns);
    }
    double stages = 0;
    for (const plait_stage_time& time : other.stage_times())
        stages += time.seconds;
    EXPECT_NEAR(seconds, stages, 1e-6) << "nothing of the sim that is gone";
}

TEST_P(Launches, TheNewestAreKept) {
    plait::SimDesc desc;
    desc.max_steps_per_call = 1000;
    desc.step = 1e-4f;
    desc.substeps = 20;
    plait::Sim many(context, make_groom(tuft(1, 2)), desc);
    const auto count = [&] {
        size_t kept = 0;
        EXPECT_EQ(plait_sim_take_launches(many, nullptr, &kept), PLAIT_OK);
        return kept;
    };
    uint64_t calls = 0;
    while (calls <= PLAIT_LAUNCHES_KEPT) {
        many.step(0.05);
        calls = 0;
        for (const plait_stage_time& time : many.stage_times())
            calls += time.calls;
    }
    EXPECT_EQ(count(), size_t{PLAIT_LAUNCHES_KEPT});
    const auto launches = many.take_launches();
    ASSERT_EQ(launches.size(), size_t{PLAIT_LAUNCHES_KEPT});
    EXPECT_STREQ(launches.back().stage, "lane_unpack") << "the last of a step";
}

TEST_P(Launches, AreRefusedWithoutProfiling) {
    auto plain = make_context(GetParam());
    plait::Sim other(plain, make_groom(tuft(2, 4)), desc_of());
    size_t count = 7;
    EXPECT_EQ(plait_sim_take_launches(other, nullptr, &count), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("profile 0, 1 is needed"), std::string::npos)
        << plait_last_error();
    EXPECT_EQ(count, 7u);
}

TEST_P(Launches, TakeStructsOfOneSize) {
    sim.take_launches();
    run(sim, 1);
    std::vector<plait_launch> two(2, plait_launch_defaults());
    two[1].struct_size = 0;
    size_t count = 2;
    EXPECT_EQ(plait_sim_take_launches(sim, two.data(), &count), PLAIT_INVALID_ARGUMENT);
    EXPECT_GT(sim.take_launches().size(), 2u) << "refused: nothing was forgotten";
}

// By hand, of tressfx: `integrate` reads rest (float4), the counts and the poses (2 float4) once,
// reads and writes three arrays of float4. Follows share `position`, which it does not touch.
TEST_P(Launches, MoveTheBytesOfTheirBuffers) {
    auto desc = tressfx_desc();
    desc.follows_per_guide = 3;
    desc.tressfx.local_iterations = desc.tressfx.length_iterations = 0;
    plait::Sim parity(context, make_groom(tuft(strands, row)), desc);
    parity.take_launches();
    run(parity, 1);
    bool seen = false;
    for (const plait_launch& launch : parity.take_launches())
        if (std::string(launch.stage) == "integrate") {
            EXPECT_EQ(launch.items, strands * row);
            EXPECT_EQ(launch.bytes, strands * row * 16 * (1 + 3 * 2) + strands * (4 + 32));
            seen = true;
        }
    EXPECT_TRUE(seen);
}

TEST(Traffic, OfGridsIsWhatVerticesTouch) {
    const size_t elements[] = {100, 3200, 3200, 1 << 20, 1}; // of grid_splat
    const uint64_t splat = plait_stage_traffic(PLAIT_STAGE_grid_splat, 100, 32, elements);
    EXPECT_EQ(splat, 100 * 4 + 2 * 3200 * 16 + 2 * 4 * (3200 * 8 * PLAIT_SUM_STRIDE + 1));
    const size_t small[] = {100, 3200, 3200, 512 * PLAIT_SUM_STRIDE, 1};
    EXPECT_EQ(plait_stage_traffic(PLAIT_STAGE_grid_splat, 100, 32, small),
              100 * 4 + 2 * 3200 * 16 + 2 * 4 * (512 * PLAIT_SUM_STRIDE + 1));
    EXPECT_EQ(plait_stage_traffic(PLAIT_STAGE_COUNT, 1, 2, small), 0u);
}

// A buffer that is not passed is not moved, nor is memory of work-groups.
TEST(Traffic, LeavesOutWhatIsNotThere) {
    const size_t wind[] = {10, 80, 80};
    EXPECT_EQ(plait_stage_traffic(PLAIT_STAGE_tressfx_wind, 10, 8, wind),
              10 * 4 + 80 * 16 + 2 * 80 * 16);
    const size_t roots[] = {0, 0, 0, 20};
    EXPECT_EQ(plait_stage_traffic(PLAIT_STAGE_roots, 10, 8, roots), 20 * 16);
}

} // namespace
