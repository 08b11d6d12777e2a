// plait-simulate as it is run: files left behind, statistics, exit codes, Ctrl-C.
#include "program.hpp"

#include <plait/plait_backend.h>

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>
#include <thread>
#include <vector>

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

namespace {

constexpr int interrupted = 128 + SIGINT; // the exit code

TEST_F(Program, leaves_statistics) {
    ASSERT_EQ(run({"--strands", "200", "--seconds", "0.2", "--no-pictures", "--out", path("out"),
                   "--json", path("a.json")}),
              0)
        << text();
    const Json stats = json("a.json");
    ASSERT_TRUE(stats.is_object()) << text();
    EXPECT_EQ(stats, json("out/stats.json"));
    EXPECT_FALSE(stats.at("device").get<std::string>().empty());
    EXPECT_EQ(stats.at("strands"), 200);
    EXPECT_EQ(stats.at("vertices"), 16);
    EXPECT_EQ(stats.at("frames"), 12);
    EXPECT_GT(stats.at("ms_per_frame").get<double>(), 0.0);
    const auto model = stats.at("model").get<std::string>();
    EXPECT_GT(stats.at("stage_ms").at(model).get<double>(), 0.0) << "the library's default";
    EXPECT_EQ(stats.at("groom_vertices"), 200 * 16);
    EXPECT_LT(stats.at("worst_segment").at("segment").get<int>(), 15);
    EXPECT_THAT(text(), HasSubstr("200 strands of 16 vertices, 3200 in all"));
    EXPECT_THAT(text(), HasSubstr("worst segment: "));
    EXPECT_GT(stats.at("stage_ms").at("grid_resolve").get<double>(), 0.0);
    EXPECT_GE(stats.at("max_stretch").get<double>(), 0.0);
    EXPECT_LT(stats.at("max_stretch").get<double>(), 1.0);
    EXPECT_EQ(stats.at("nonfinite"), 0);
    EXPECT_EQ(stats.at("import_repairs"), 0);
    EXPECT_EQ(stats.at("hash").get<std::string>().size(), 16u);
    EXPECT_EQ(stats.at("interrupted"), false);
    EXPECT_THAT(text(), HasSubstr("ms/frame"));
}

TEST_F(Program, simulates_guides_and_draws_what_follows) {
    ASSERT_EQ(run({"--strands", "200", "--guides", "20", "--seconds", "0.2", "--no-pictures",
                   "--out", path("out")}),
              0)
        << text();
    const Json stats = json("out/stats.json");
    EXPECT_EQ(stats.at("guides"), 20);
    EXPECT_EQ(stats.at("strands"), 200);
    EXPECT_LT(stats.at("max_stretch").get<double>(), 0.01);
    EXPECT_GT(stats.at("stage_ms").at("follow_turns").get<double>(), 0.0);
    EXPECT_THAT(text(), HasSubstr("of which 20 are simulated"));
}

// Budgets that no machine is too slow or too fast for: what a frame takes chooses nothing here.
TEST_F(Program, directs_a_crowd_within_a_budget) {
    const auto budget_of = [&](const char* ms) {
        EXPECT_EQ(run({"--strands", "200", "--seconds", "0.2", "--settle", "0.1", "--budget", ms,
                       "--crowd", "3", "--no-pictures", "--out", path("out")}),
                  0)
            << text();
        return json("out/stats.json").at("budget");
    };
    const auto last = [](const Json& head) { return head.at("levels").back(); };
    const Json ample = budget_of("10000");
    EXPECT_THAT(text(), testing::Not(HasSubstr("went rigid")));
    const Json none = budget_of("0.01");
    EXPECT_THAT(text(), HasSubstr("warning: the budget of 0.01 ms is too small for 3 heads"));
    for (const Json* budget : {&ample, &none}) {
        ASSERT_EQ(budget->at("heads").size(), 3u);
        EXPECT_GT(budget->at("median_ms"), 0.0);
        EXPECT_GE(budget->at("p95_ms"), budget->at("median_ms"));
    }
    EXPECT_FLOAT_EQ(ample.at("ms"), 10000.0f);
    EXPECT_FLOAT_EQ(ample.at("heads")[0].at("distance"), 0.7f);
    EXPECT_FLOAT_EQ(ample.at("heads")[1].at("distance"), std::sqrt(0.7f * 30));
    EXPECT_FLOAT_EQ(ample.at("heads")[2].at("distance"), 30.0f);
    EXPECT_NEAR(ample.at("heads")[0].at("pixels_per_metre"), 2119.5, 0.1);
    for (size_t head = 0; head < 3; ++head) {
        EXPECT_EQ(last(ample.at("heads")[head]).at("level"), 0) << "all strands are stepped";
        EXPECT_EQ(last(none.at("heads")[head]).at("level"), 3) << "none is";
        EXPECT_EQ(none.at("heads")[head].at("levels")[0].at("frame"), 0);
    }
    EXPECT_EQ(last(ample.at("heads")[0]).at("shown"), 200);
    EXPECT_LT(last(none.at("heads")[2]).at("shown"), 200);
    EXPECT_THAT(text(), HasSubstr("budget 0.01 ms: median frame "));
}

// Strands that a level does not place are not neighbours.
TEST_F(Program, measures_neighbours_where_all_strands_are_placed) {
    const auto speed_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"--strands",     "200",   "--seconds", "0.2",
                                     "--no-pictures", "--out", path("out")};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(run(all), 0) << text();
        return json("out/stats.json").at("neighbour_speed");
    };
    EXPECT_TRUE(speed_with({"--switch", "0.1:2"}).is_null());
    EXPECT_GT(speed_with({"--level", "2"}).get<double>(), 0.0);
}

TEST_F(Program, compares_a_budget_with_all_strands) {
    const std::string scene = write("scene.json", R"({"strands": 200, "seconds": 0.1, "picture":
        {"width": 40, "height": 50, "samples": 1, "video_samples": 1, "cells": 2}})");
    ASSERT_EQ(run({"--scene", scene, "--budget", "0.01", "--out", path("out")}), 0) << text();
    const Json stats = json("out/stats.json");
    EXPECT_EQ(stats.at("budget").at("heads").size(), 1u);
    EXPECT_TRUE(stats.at("neighbour_speed").is_null());
    if (text().find("without pictures") != std::string::npos)
        GTEST_SKIP() << text();
    ASSERT_EQ(stats.at("compared").size(), 1u);
    EXPECT_EQ(stats.at("compared")[0].at("label"), "all strands");
    EXPECT_NE(stats.at("compared")[0].at("hash"), stats.at("hash"));
    EXPECT_GT(std::filesystem::file_size(path("out/ab.png")), 1000u);
}

TEST_F(Program, binds_follows_where_hair_hangs) {
    const auto stats_of = [&](const char* bind) {
        EXPECT_EQ(run({"--strands", "200", "--guides", "20", "--seconds", "0.1", "--settle", "0.3",
                       "--no-pictures", "--no-compare", "--bind", bind, "--out", path("out")}),
                  0)
            << text();
        return json("out/stats.json");
    };
    const Json hung = stats_of("hung"), groomed = stats_of("groomed");
    EXPECT_EQ(hung.at("bind"), "hung");
    EXPECT_EQ(groomed.at("bind"), "groomed");
    const auto bytes = [](const Json& stats) { return stats.at("device_bytes").get<uint64_t>(); };
    EXPECT_EQ(bytes(hung) - bytes(groomed), 20u * 16 * 16) << "16 vertices of 16 bytes";
    EXPECT_NE(run({"--bind", "nowhere", "--out", path("out")}), 0);
    EXPECT_THAT(text(), HasSubstr("nowhere"));
}

TEST_F(Program, records_a_clip_that_it_can_load) {
    for (const char* name : {"clip.abc", "clip.usda"}) {
        ASSERT_EQ(run({"--groom", "short", "--strands", "200", "--guides", "20", "--seconds", "0.2",
                       "--no-pictures", "--out", path("out"), "--cache", path(name)}),
                  0)
            << text();
        ASSERT_EQ(
            run({"--groom", path(name), "--seconds", "0.1", "--no-pictures", "--out", path("out")}),
            0)
            << text();
        EXPECT_THAT(text(), HasSubstr("200 strands of "));
        EXPECT_THAT(text(), HasSubstr("are read at their first sample"));
    }
}

TEST_F(Program, moves_a_body_by_its_animation) {
    const std::string scene = PLAIT_SCENES "/walk.json";
    const int code = run({"--scene", scene, "--strands", "200", "--seconds", "0.5", "--settle",
                          "0.1", "--no-pictures", "--out", path("out")});
    if (text().find("assimp") != std::string::npos)
        GTEST_SKIP() << "built without assimp";
    ASSERT_EQ(code, 0) << text();
    const Json stats = json("out/stats.json");
    EXPECT_EQ(stats.at("motion"), "walk of character.gltf");
    EXPECT_GT(stats.at("stage_ms").at("mesh_nearest").get<double>(), 0.0);
    EXPECT_LT(stats.at("max_stretch").get<double>(), 0.05);
    EXPECT_THAT(text(), HasSubstr("1 mesh of 2864 triangles"));
}

std::set<std::string> stage_names() {
    std::set<std::string> names;
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage)
        names.insert(plait_stage_describe(static_cast<plait_stage>(stage))->name);
    return names;
}

// Complete events of a trace, by thread, in order of time.
std::map<int, std::vector<Json>> events_of(const Json& trace) {
    std::map<int, std::vector<Json>> threads;
    for (const Json& event : trace.at("traceEvents"))
        if (event.at("ph") == "X")
            threads[event.at("tid").get<int>()].push_back(event);
    for (auto& [thread, events] : threads)
        std::ranges::stable_sort(events, {},
                                 [](const Json& e) { return e.at("ts").get<double>(); });
    return threads;
}

TEST_F(Program, profiles_and_traces) {
    ASSERT_EQ(run({"--strands", "200", "--seconds", "0.2", "--no-pictures", "--profile", "--trace",
                   path("trace.json"), "--out", path("out")}),
              0)
        << text();
    const Json stats = json("out/stats.json"), profile = stats.at("profile");
    const Json trace = json("trace.json");
    ASSERT_TRUE(trace.is_object()) << text();
    const bool has_times = profile.at("has_device_times").get<bool>();
    const auto threads = events_of(trace);
    ASSERT_EQ(threads.size(), has_times ? 2u : 1u);

    std::map<std::string, int> calls;
    for (const Json& event : threads.begin()->second)
        ++calls[event.at("name")];
    EXPECT_EQ(calls, (std::map<std::string, int>{{"set_roots", 12},
                                                 {"set_colliders", 12},
                                                 {"step", 12},
                                                 {"wait", 12},
                                                 {"measure", 12},
                                                 {"read", 12}}));
    for (const auto& [thread, events] : threads) { // one after another, on host and device
        double before = 0;
        for (const Json& event : events) {
            EXPECT_GE(event.at("ts").get<double>(), before - 1e-3) << event;
            before = event.at("ts").get<double>() + event.at("dur").get<double>();
        }
    }
    if (!has_times)
        GTEST_SKIP() << "no times on the device: " << text();

    const std::set<std::string> names = stage_names();
    std::map<std::string, double> us;
    for (const Json& event : threads.rbegin()->second) {
        EXPECT_TRUE(names.contains(event.at("name"))) << event;
        us[event.at("name")] += event.at("dur").get<double>();
    }
    ASSERT_EQ(us.size(), profile.at("stages").size());
    for (const Json& stage : profile.at("stages")) {
        const auto name = stage.at("stage").get<std::string>();
        EXPECT_NEAR(us[name], 12 * stage.at("us").get<double>(), 1e-6 * us[name]) << name;
        // What the library adds up by itself is the same, of stages that only frames have.
        const bool only_frames =
            name.starts_with("grid_") || name == stats.at("model").get<std::string>();
        if (only_frames) {
            EXPECT_NEAR(us[name], 12e3 * stats.at("stage_ms").at(name).get<double>(),
                        1e-3 * us[name] + 1e-3)
                << name;
        }
        EXPECT_GT(stage.at("bytes_per_second").get<double>(), 0) << name;
    }
    EXPECT_GT(profile.at("copy_bytes_per_second").get<double>(), 0);
    EXPECT_NEAR(profile.at("stages_us").get<double>() + profile.at("other_us").get<double>(),
                profile.at("frame_us").get<double>(), 1e-6);
    EXPECT_THAT(text(), HasSubstr("not in a stage"));
    EXPECT_THAT(text(), HasSubstr("a copy of memory on this device: "));
}

TEST_F(Program, measures_no_replay) {
    EXPECT_EQ(run({"--replay", path("a.cache"), "--profile", "--out", path("out")}), 1);
    EXPECT_THAT(text(), HasSubstr("there is nothing to profile or to trace"));
}

// Under a head that stands still, hair that has settled hardly moves, and what it did before is not
// in the numbers.
TEST_F(Program, settles_before_the_motion) {
    const auto stats_after = [&](const char* settle) {
        EXPECT_EQ(run({"--strands", "100", "--seconds", "0.1", "--motion", "still", "--settle",
                       settle, "--no-pictures", "--out", path("out")}),
                  0)
            << text();
        return json("out/stats.json");
    };
    const Json drawn = stats_after("0"), settled = stats_after("1");
    EXPECT_EQ(settled.at("frames"), drawn.at("frames"));
    EXPECT_THAT(text(), ContainsRegex("roots +[0-9.]+ +[0-9.]+% +12\n"))
        << "the calls of the six frames with two substeps each, and of none before";
    EXPECT_GT(drawn.at("neighbour_speed").get<double>(), 0.0);
    EXPECT_LT(settled.at("neighbour_speed").get<double>(),
              0.3 * drawn.at("neighbour_speed").get<double>());
}

TEST_F(Program, repeats_itself) {
    const std::vector<std::string> words{"--strands",     "100",   "--seconds", "0.1",
                                         "--no-pictures", "--out", path("out")};
    ASSERT_EQ(run(words), 0) << text();
    const Json first = json("out/stats.json");
    ASSERT_EQ(run(words), 0) << text();
    EXPECT_EQ(first.at("hash"), json("out/stats.json").at("hash"));
}

TEST_F(Program, meets_meshes) {
    ASSERT_EQ(run({"--scene", PLAIT_SCENES "/bust.json", "--strands", "100", "--seconds", "0.5",
                   "--no-pictures", "--out", path("out")}),
              0)
        << text();
    EXPECT_THAT(text(), HasSubstr("1 mesh of 18564 triangles"));
    EXPECT_EQ(json("out/stats.json")["nonfinite"], 0);
    EXPECT_LT(json("out/stats.json")["max_stretch"], 0.05);
    if (const Json inside = json("out/stats.json")["inside"]; !inside.is_null()) {
        EXPECT_EQ(inside["frames"], 5);
        EXPECT_LT(inside["worst_share"], 0.005);
        EXPECT_LE(inside["share"], inside["worst_share"]);
        EXPECT_THAT(text(), HasSubstr("inside what is drawn, deeper than 1 mm: "));
    }
    const std::string scene = write("scene.json", R"({"meshes": [{"file": "none.obj"}]})");
    EXPECT_EQ(run({"--scene", scene, "--out", path("out")}), 1);
    EXPECT_THAT(text(), AllOf(HasSubstr("meshes[0].file"), HasSubstr("none.obj")));
}

// On 14 capsules 1.4 % of it lies deeper than a millimetre in the mannequin.
TEST_F(Program, hair_stays_out_of_the_mannequin) {
    ASSERT_EQ(run({"--strands", "500", "--seconds", "1", "--no-pictures", "--out", path("out")}), 0)
        << text();
    const Json inside = json("out/stats.json")["inside"];
    if (inside.is_null())
        GTEST_SKIP() << "built without Embree, which measures it";
    EXPECT_EQ(inside["groomed"], 0);
    EXPECT_LT(inside["share"], 0.0005);
    EXPECT_LT(inside["deepest"], 0.003);
}

TEST_F(Program, draws_sheets) {
    const std::string scene = write("scene.json", R"({"strands": 200, "seconds": 0.1, "picture":
        {"width": 40, "height": 50, "samples": 1, "video_samples": 1, "cells": 2}})");
    ASSERT_EQ(run({"--scene", scene, "--out", path("out")}), 0) << text();
    if (text().find("without pictures") == std::string::npos) {
        EXPECT_GT(std::filesystem::file_size(path("out/sheet.png")), 1000u);
        EXPECT_GT(std::filesystem::file_size(path("out/ab.png")), 1000u);
        EXPECT_TRUE(std::filesystem::exists(path("out/motion.gif")) ||
                    std::filesystem::exists(path("out/motion.mp4")));
        for (const auto& entry : std::filesystem::directory_iterator(path("out")))
            EXPECT_NE(entry.path().extension(), ".part") << entry.path();
        const Json compared = json("out/stats.json").at("compared");
        ASSERT_EQ(compared.size(), 2u);
        EXPECT_EQ(compared.at(0).at("label"), "TressFX");
        EXPECT_EQ(compared.at(1).at("grid"), "slots");
    } else {
        EXPECT_FALSE(std::filesystem::exists(path("out/sheet.png")));
    }
}

TEST_F(Program, draws_only_what_is_asked) {
    const std::string scene = write("scene.json", R"({"strands": 50, "seconds": 0.1, "picture":
        {"width": 40, "height": 50, "samples": 1, "video_samples": 1, "cells": 2}})");
    ASSERT_EQ(run({"--scene", scene, "--no-compare", "--no-film", "--out", path("out")}), 0)
        << text();
    EXPECT_FALSE(std::filesystem::exists(path("out/ab.png")));
    EXPECT_FALSE(std::filesystem::exists(path("out/motion.mp4")));
    EXPECT_FALSE(std::filesystem::exists(path("out/motion.gif")));
    EXPECT_EQ(json("out/stats.json").value("compared", Json::array()).size(), 0u) << text();
}

TEST_F(Program, passes_the_librarys_warnings_on) {
    const std::string scene = write("scene.json", R"({"strands": 20, "seconds": 0.05,
        "sag_free": "rest", "groom": "short", "colliders": [],
        "params": {"stretch_stiffness": 3, "grid_slot_capacity": 7, "bend_stiffness": 1e-12}})");
    ASSERT_EQ(run({"--scene", scene, "--no-pictures", "--out", path("out")}), 0) << text();
    for (const char* sentence :
         {"stretch_stiffness is set, and no model of the library reads it",
          "grid_slot_capacity is set, and is not read by", "strands are not in balance"})
        EXPECT_THAT(text(), HasSubstr(sentence));
    EXPECT_EQ(json("out/stats.json").at("warnings").size(), 3u) << text();
}

TEST_F(Program, ends_well_on_interrupt) {
    const pid_t pid = start({"--strands", "200", "--seconds", "3600", "--no-pictures", "--out",
                             path("out"), "--cache", path("a.cache")});
    const uintmax_t header = 32 + 4 * 200, frame = 4 * (7 + 3 * 200 * 16);
    const auto grown = [&] {
        std::error_code error;
        const uintmax_t size = std::filesystem::file_size(path("a.cache"), error);
        return !error && size >= header + 2 * frame;
    };
    while (!grown() && waitpid(pid, nullptr, WNOHANG) == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    kill(pid, SIGINT);
    ASSERT_EQ(wait_for(pid), interrupted) << text();
    const Json stats = json("out/stats.json");
    ASSERT_TRUE(stats.is_object()) << text();
    EXPECT_EQ(stats.at("interrupted"), true);
    const auto frames = stats.at("frames").get<uintmax_t>();
    EXPECT_GE(frames, 2u);
    EXPECT_EQ(std::filesystem::file_size(path("a.cache")), header + frames * frame);
}

// Ctrl-C on a terminal goes to the whole process group: to the compilers and linkers that an OpenCL
// driver starts, too. The cache is empty, so that it has to start them.
TEST_F(Program, interrupt_while_kernels_are_compiled_leaves_no_log) {
    setenv("POCL_CACHE_DIR", path("kernels").c_str(), 1);
    const pid_t pid = start({"--strands", "50", "--seconds", "3600", "--no-pictures", "--out",
                             path("out"), "--cache", path("a.cache")},
                            true);
    unsetenv("POCL_CACHE_DIR");
    const auto compiling = [&] {
        return std::filesystem::exists(path("kernels")) || std::filesystem::exists(path("a.cache"));
    };
    bool over = false;
    while (!compiling() && !over) {
        over = waitpid(pid, nullptr, WNOHANG) != 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_FALSE(over) << text();
    kill(-pid, SIGINT);
    ASSERT_EQ(wait_for(pid), interrupted) << text();
    EXPECT_EQ(json("out/stats.json").at("interrupted"), true);
    for (const char* word : {"error", "Error", "failed", "signal"})
        EXPECT_EQ(text().find(word), std::string::npos) << text();
}

// Width and height if `bytes` are a PNG that is whole: chunk after chunk up to IEND, and no more.
std::pair<uint32_t, uint32_t> size_of_png(const std::string& bytes) {
    const auto number = [&](size_t at) {
        uint32_t value = 0;
        for (size_t i = at; i < at + 4; ++i)
            value = value << 8 | static_cast<unsigned char>(bytes.at(i));
        return value;
    };
    if (bytes.size() < 24 || bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0)
        return {};
    size_t at = 8, pixels = 0;
    std::string type;
    for (; at + 12 <= bytes.size() && type != "IEND"; at += size_t{12} + number(at)) {
        type = bytes.substr(at + 4, 4);
        pixels += type == "IDAT" ? number(at) : 0;
    }
    if (type != "IEND" || at != bytes.size() || pixels == 0)
        return {};
    return {number(16), number(20)};
}

TEST_F(Program, leaves_the_sheet_of_what_there_is_on_interrupt) {
    const std::string scene = write("scene.json", R"({"strands": 20, "seconds": 60,
        "picture": {"width": 40, "height": 50, "samples": 1, "video": false, "cells": 64}})");
    const pid_t pid = start({"--scene", scene, "--out", path("out"), "--cache", path("a.cache")});
    const uintmax_t header = 32 + 4 * 20, frame = 4 * (7 + 3 * 20 * 16);
    const auto drawn = [&] { // two of the 64 pictures of 3600 frames
        std::error_code error;
        const uintmax_t size = std::filesystem::file_size(path("a.cache"), error);
        return !error && size >= header + 130 * frame;
    };
    bool over = false;
    while (!drawn() && !over) {
        over = waitpid(pid, nullptr, WNOHANG) != 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_FALSE(over) << text();
    kill(pid, SIGINT);
    ASSERT_EQ(wait_for(pid), interrupted) << text();
    const Json stats = json("out/stats.json");
    ASSERT_TRUE(stats.is_object()) << text();
    EXPECT_EQ(stats.at("interrupted"), true);
    EXPECT_LT(stats.at("frames").get<uint32_t>(), 3600u);
    if (text().find("without pictures") != std::string::npos)
        GTEST_SKIP() << text();
    std::ifstream stream(path("out/sheet.png"), std::ios::binary);
    const std::string sheet{std::istreambuf_iterator<char>(stream), {}};
    const auto [width, height] = size_of_png(sheet);
    EXPECT_GE(width, 2 * 40u) << text();
    EXPECT_GE(height, 50u);
    EXPECT_THAT(text(), HasSubstr("sheet.png"));
    EXPECT_FALSE(std::filesystem::exists(path("out/ab.png"))) << "nothing was compared";
}

// A machine without any OpenCL platform; the reference is always there.
class WithoutOpenCl : public Program {
  protected:
    void SetUp() override {
        Program::SetUp();
        setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
        unsetenv("OCL_ICD_FILENAMES");
    }
};

TEST_F(WithoutOpenCl, says_so_where_it_is_asked_for) {
    EXPECT_EQ(run({"--backend", "opencl", "--strands", "5", "--out", path("out")}), 1);
    EXPECT_THAT(text(), HasSubstr("no device of backend \"opencl\"; there are: reference: "));
    EXPECT_FALSE(std::filesystem::exists(path("out/stats.json")));
}

TEST_F(WithoutOpenCl, lists_and_runs_on_the_reference) {
    EXPECT_EQ(run({"--list-devices"}), 0);
    EXPECT_THAT(text(), HasSubstr("reference"));
    EXPECT_EQ(run({"--strands", "5", "--seconds", "0.1", "--no-pictures", "--out", path("out")}),
              0);
    EXPECT_EQ(json("out/stats.json").at("device"), "one CPU thread");
}

TEST_F(WithoutOpenCl, profiles_on_the_reference) {
    ASSERT_EQ(run({"--strands", "5", "--seconds", "0.1", "--no-pictures", "--profile", "--out",
                   path("out")}),
              0)
        << text();
    const Json profile = json("out/stats.json").at("profile");
    EXPECT_EQ(profile.at("has_device_times"), true);
    EXPECT_GT(profile.at("copy_bytes_per_second").get<double>(), 0);
}

TEST_F(Program, names_what_is_wrong) {
    EXPECT_EQ(run({"--strands", "0", "--out", path("out")}), 1);
    EXPECT_THAT(text(), HasSubstr("command line: strands is 0"));
    EXPECT_EQ(run({"--stands", "5"}), 1);
    EXPECT_THAT(text(), HasSubstr("--stands"));
    EXPECT_EQ(run({"--device", "no such device", "--no-pictures", "--out", path("out")}), 1);
    EXPECT_THAT(text(), HasSubstr("no such device"));
    EXPECT_EQ(run({"--scale", "cm", "--out", path("out")}), 1);
    EXPECT_THAT(text(), HasSubstr("neither a number nor \"auto\""));
    EXPECT_EQ(run({"--groom", path("missing.tfx"), "--out", path("out")}), 1);
    EXPECT_THAT(text(), HasSubstr("missing.tfx"));
    EXPECT_EQ(run({"--strands", "10", "--motion", "shakes", "--out", path("out")}), 1);
    EXPECT_THAT(text(), HasSubstr("shake"));
}

TEST_F(Program, lists_devices) {
    EXPECT_EQ(run({"--list-devices"}), 0);
    EXPECT_THAT(text(), HasSubstr("reference"));
}

TEST_F(Program, lists_parameters) {
    EXPECT_EQ(run({"--list-params"}), 0);
    for (const char* part :
         {"gravity[3]", "0, -9.81, 0", "[-10000, 10000]", "m/s^2", "(0, 0.1]", "of the model",
          "slots, exact", "strand_contact", "\n    Gravity pulls all hair"})
        EXPECT_THAT(text(), HasSubstr(part));
}

} // namespace
