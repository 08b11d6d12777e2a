// Where a frame's time goes, and the trace of a run: from made-up measurements, whose sums are
// known.
#include "profile/profile.hpp"
#include "common/json_reader.hpp"
#include "profile/trace.hpp"

#include <gtest/gtest.h>

#include <cstring>

using namespace simulate;

namespace {

constexpr uint64_t ahead = 7'000'000'000; // ns of the device's clock

plait_launch launch(const char* stage, uint64_t bytes, uint64_t queued, uint64_t begin,
                    uint64_t end) {
    plait_launch launch = plait_launch_defaults();
    std::strcpy(launch.stage, stage);
    launch.items = 10;
    launch.bytes = bytes;
    launch.queued_ns = queued;
    launch.begin_ns = begin;
    launch.end_ns = end;
    return launch;
}

// Two frames of 100 us; the stages of each take 10, 10 and 40.
Measurements two_frames(bool with_times = true) {
    Measurements run;
    run.frames = 2;
    run.frame_ms = {0.1, 0.1};
    std::strcpy(run.device.name, "copper");
    for (uint32_t frame = 0; frame < 2; ++frame) {
        const uint64_t at = 5'000'000 + 1'000'000 * frame;
        run.timeline.add(HostCall{"set_roots", frame, true, true, at, at + 2'000});
        run.timeline.add(HostCall{"step", frame, true, true, at + 2'000, at + 30'000});
        run.timeline.add(HostCall{"wait", frame, false, true, at + 30'000, at + 100'000});
        run.timeline.add(HostCall{"read", frame, false, false, at + 100'000, at + 900'000});
        const auto add = [&](const char* stage, uint64_t bytes, uint64_t queued, uint64_t begin,
                             uint64_t end) {
            const uint64_t clock = with_times ? at + ahead : 0;
            run.timeline.add(Launch{frame, launch(stage, bytes, with_times ? clock + queued : 0,
                                                  with_times ? clock + begin : 0,
                                                  with_times ? clock + end : 0)});
        };
        add("roots", 100, 1'000, 10'000, 20'000);
        add("clamp", 200'000, 3'000, 20'000, 30'000);
        add("articulated", 4'000'000, 29'000, 35'000, 75'000);
    }
    return run;
}

TEST(Profile, AddsUpToTheFrame) {
    const Profile profile = make_profile(two_frames(), 1000, 200e9);
    ASSERT_EQ(profile.stages.size(), 3u);
    EXPECT_EQ(profile.stages[0].stage, "articulated") << "the slowest first";
    EXPECT_DOUBLE_EQ(profile.stages[0].calls, 1);
    EXPECT_NEAR(profile.stages[0].us, 40, 1e-9);
    EXPECT_NEAR(profile.stages[0].bytes_per_second(), 4e6 / 40e-6, 1);
    EXPECT_NEAR(profile.stages_us, 60, 1e-9);
    EXPECT_NEAR(profile.frame_us, 100, 1e-9);
    EXPECT_NEAR(profile.other_us(), 40, 1e-9);
    ASSERT_EQ(profile.host.size(), 3u) << "reading is of no frame";
    EXPECT_EQ(profile.host[1].call, "step");
    EXPECT_NEAR(profile.host[1].us, 28, 1e-9);
}

TEST(Profile, SaysIt) {
    const std::string text = to_text(make_profile(two_frames(), 1000, 200e9));
    // 40 us of 1000 vertices; 4 MB in 40 us are 100 GB/s, half of the copy's 200
    EXPECT_NE(text.find("articulated            1.00       40.0     40.000    100.00     50.0%"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("not in a stage                    40.0     40.000"), std::string::npos)
        << text;
    EXPECT_NE(text.find("set_roots 2.0, step 28.0, wait 70.0"), std::string::npos) << text;
    EXPECT_NE(text.find("200.00 GB/s"), std::string::npos) << text;
}

TEST(Profile, SaysWhereTheDriverGivesNoTimes) {
    const Profile profile = make_profile(two_frames(false), 1000, 0);
    EXPECT_FALSE(profile.has_device_times);
    const std::string text = to_text(profile);
    EXPECT_NE(text.find("the driver's events carry no times"), std::string::npos) << text;
    EXPECT_EQ(text.find("GB/s"), std::string::npos) << "no rate is made up\n" << text;
    EXPECT_NE(text.find("articulated"), std::string::npos);
    EXPECT_EQ(to_json(profile).at("has_device_times"), false);
}

TEST(Profile, OfNoFrameIsEmpty) {
    const Profile profile = make_profile(Measurements{}, 1000, 1e9);
    EXPECT_TRUE(profile.stages.empty());
    EXPECT_EQ(profile.frame_us, 0);
    EXPECT_EQ(to_text(profile), "no frame was done: there is nothing to profile\n");
}

std::vector<Json> events_of(const Json& trace, const char* category) {
    std::vector<Json> events;
    for (const Json& event : trace.at("traceEvents"))
        if (event.at("ph") == "X" && event.at("cat") == category)
            events.push_back(event);
    return events;
}

// Every frame's launches are queued 1 us after its first call begins, and 1 us before its last
// ends: that leaves the clocks' difference 2 us, in whose middle is the true one.
TEST(Trace, PutsBothClocksOnOne) {
    const Json trace = to_trace(two_frames());
    const auto stages = events_of(trace, "stage"), calls = events_of(trace, "host");
    ASSERT_EQ(stages.size(), 6u);
    ASSERT_EQ(calls.size(), 8u);
    EXPECT_NEAR(calls[0].at("ts").get<double>(), 0, 1e-9) << "from the first call on";
    EXPECT_NEAR(stages[0].at("ts").get<double>(), 10, 1e-3);
    EXPECT_NEAR(stages[3].at("ts").get<double>(), 1010, 1e-3);
    EXPECT_NEAR(stages[2].at("dur").get<double>(), 40, 1e-9);
    EXPECT_EQ(stages[2].at("name"), "articulated");
    EXPECT_NEAR(stages[2].at("args").at("GB/s").get<double>(), 100, 1e-9);
    EXPECT_EQ(stages[5].at("args").at("frame"), 1);
    EXPECT_NE(stages[0].at("tid"), calls[0].at("tid"));
}

TEST(Trace, HasTheHostWhereTheDriverGivesNoTimes) {
    const Json trace = to_trace(two_frames(false));
    EXPECT_TRUE(events_of(trace, "stage").empty());
    EXPECT_EQ(events_of(trace, "host").size(), 8u);
    EXPECT_EQ(trace.at("otherData").at("has_device_times"), false);
}

} // namespace
