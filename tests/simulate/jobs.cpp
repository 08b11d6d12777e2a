// plait-simulate as jobs of a farm run it: killed and started again, and many scenes shared out over tasks.
#include "program.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

using testing::AllOf;
using testing::HasSubstr;

namespace {

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

class Jobs : public Program {
  protected:
    // One thread waits for no other, which takes long where the machine has other work.
    void SetUp() override {
        Program::SetUp();
        setenv("POCL_MAX_PTHREAD_COUNT", "1", 1);
    }

    // Signals the run as soon as it has written out/restart.snapshot anew; its exit code, -1 of one that was killed.
    int end_once_kept(const Words& words, int signal = SIGKILL) const {
        const auto time = [&] {
            std::error_code none; // then it is the least there is
            return std::filesystem::last_write_time(path("out/restart.snapshot"), none);
        };
        const auto before = time();
        const pid_t pid = start(words);
        while (time() == before) {
            if (waitpid(pid, nullptr, WNOHANG) != 0) {
                ADD_FAILURE() << "it was over before: " << text();
                return 0;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        kill(pid, signal);
        return wait_for(pid);
    }

    std::string bytes(const std::string& name) const {
        std::ifstream stream(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    // All but times.
    Json stats_of(const std::string& folder) const {
        Json all = json(folder + "/stats.json");
        EXPECT_TRUE(all.is_object()) << text();
        for (const char* time : {"ms_per_frame", "stage_ms"})
            all.erase(time);
        return all;
    }

    const Words hair_{"--groom",  "ball", "--strands", "40",  "--vertices",  "6",
                      "--settle", "0.1",  "--grid",    "off", "--no-compare"};
    const Words endless_ = hair_ + Words{"--no-pictures", "--seconds", "3600"};
    Words to_out(const Words& words) const { return words + Words{"--out", path("out")}; }
};

// Cut off twice by SIGKILL, after a snapshot each.
TEST_F(Jobs, a_run_that_was_killed_comes_to_what_it_comes_to_without) {
    for (const std::string end : {".abc", ".cache"}) {
        const Words run_of = hair_ + Words{"--no-pictures", "--guides", "20", "--seconds", "6"};
        ASSERT_EQ(run(run_of + Words{"--out", path("whole"), "--cache", path("whole" + end)}), 0)
            << text();
        const Words cut = to_out(run_of) +
                          Words{"--cache", path("cut" + end), "--restart-every", "40", "--resume"};
        EXPECT_EQ(end_once_kept(cut), -1);
        EXPECT_THAT(text(), HasSubstr("out: nothing was kept there, beginning anew"));
        EXPECT_EQ(end_once_kept(cut), -1);
        EXPECT_THAT(text(), HasSubstr("out: going on after frame "));
        ASSERT_EQ(run(cut), 0) << text();
        EXPECT_THAT(text(), HasSubstr("out: going on after frame "));
        EXPECT_EQ(stats_of("out"), stats_of("whole")) << "the hash of the hair among them";
        EXPECT_EQ(json("out/stats.json").at("frames"), 360);
        EXPECT_TRUE(bytes("cut" + end) == bytes("whole" + end));
        EXPECT_FALSE(std::filesystem::exists(path("out/restart.frames")));
        const auto written = std::filesystem::last_write_time(path("out/stats.json"));
        ASSERT_EQ(run(cut), 0) << text();
        EXPECT_THAT(text(), HasSubstr("out: is done"));
        EXPECT_EQ(std::filesystem::last_write_time(path("out/stats.json")), written);
        std::filesystem::remove_all(path("out"));
    }
}

// SIGTERM, as queues send it first, loses no frame; pictures of levels that change are made of what was kept.
TEST_F(Jobs, pictures_of_a_run_that_was_cut_off_are_the_same) {
    const std::string scene = write("scene.json", R"({"seconds": 3, "switch": "0.2:2,2:0",
        "picture": {"width": 40, "height": 50, "samples": 1, "video_samples": 1, "cells": 4}})");
    const Words drawn = hair_ + Words{"--scene", scene};
    ASSERT_EQ(run(drawn + Words{"--out", path("whole")}), 0) << text();
    const Words cut = to_out(drawn) + Words{"--restart-every", "40", "--resume"};
    EXPECT_EQ(end_once_kept(cut, SIGTERM), 128 + SIGTERM) << text();
    EXPECT_EQ(json("out/stats.json").at("interrupted"), true);
    const std::string frames = std::to_string(json("out/stats.json").at("frames").get<int>());
    ASSERT_EQ(run(cut), 0) << text();
    EXPECT_THAT(text(), HasSubstr("going on after frame " + frames + " of 180"));
    EXPECT_EQ(stats_of("out"), stats_of("whole"));
    for (const char* file : {"sheet.png", "motion.gif", "motion.mp4"})
        EXPECT_TRUE(bytes(std::string("out/") + file) == bytes(std::string("whole/") + file))
            << file;
}

// A snapshot holds float32.
TEST_F(Jobs, the_reference_which_would_not_come_to_the_same_is_refused) {
    EXPECT_EQ(run(to_out(endless_) + Words{"--backend", "reference", "--resume"}), 1);
    EXPECT_THAT(text(), HasSubstr("the backend reference computes in float64, of which a snapshot "
                                  "holds float32"));
}

TEST_F(Jobs, what_was_kept_of_another_run_is_refused) {
    const Words kept = to_out(endless_) + Words{"--restart-every", "20"};
    ASSERT_EQ(end_once_kept(kept), -1);
    const std::string before = bytes("out/restart.snapshot");
    EXPECT_EQ(run(kept), 1);
    EXPECT_THAT(text(), AllOf(HasSubstr("out/restart.snapshot: a run was cut off here"),
                              HasSubstr("of 216000; --resume goes on with it")));
    EXPECT_EQ(run(kept + Words{"--resume", "--seed", "5", "--motion", "nod"}), 1);
    EXPECT_THAT(text(), HasSubstr("is of another run: motion is \"nod\", was not given; seed is 5, "
                                  "was not given; give what was given then"));
    EXPECT_EQ(bytes("out/restart.snapshot"), before);
}

TEST_F(Jobs, what_was_kept_and_is_damaged_is_refused) {
    const Words kept =
        to_out(endless_) + Words{"--resume", "--restart-every", "20", "--cache", path("a.cache")};
    ASSERT_EQ(end_once_kept(kept), -1);
    const std::string file = "out/restart.snapshot", snapshot = bytes(file);
    const auto expect_refused = [&](const std::string& name, const std::string& text_of_it,
                                    const char* sentence) {
        std::ofstream(path(name), std::ios::binary) << text_of_it;
        EXPECT_EQ(run(kept), 1);
        EXPECT_THAT(text(), AllOf(HasSubstr(path(name) + ": " + sentence),
                                  HasSubstr("remove it to begin anew")));
    };
    for (const size_t size : {size_t{0}, size_t{20}, size_t{40}, snapshot.size() - 1})
        expect_refused(file, snapshot.substr(0, size), "is ");
    for (const size_t at : {size_t{9}, size_t{17}, size_t{300}, snapshot.size() - 1}) {
        std::string damaged = snapshot;
        damaged[at] = static_cast<char>(damaged[at] ^ 4);
        expect_refused(file, damaged, "is damaged or cut short");
    }
    std::ofstream(path(file), std::ios::binary) << snapshot;
    std::string frames = bytes("a.cache");
    expect_refused("a.cache", frames.substr(0, 9000), "holds not what was kept");
    frames[9000] = static_cast<char>(frames[9000] ^ 4);
    expect_refused("a.cache", frames, "holds not what was kept");
}

TEST_F(Jobs, parts_are_all_scenes_and_one_that_fails_stops_no_other) {
    const std::string good =
        R"({"groom": "ball", "strands": 20, "vertices": 4, "seconds": 0.05, "settle": 0})";
    Words scenes{"--scene"};
    for (const char* name : {"a", "b", "c", "d"})
        scenes.push_back(write(name + std::string(".json"), good));
    write("c.json", R"({"strands": 0})");
    const Words all = to_out(scenes) + Words{"--no-pictures", "--json", "numbers.json"};
    const auto done = [&](const char* name) {
        return std::filesystem::exists(path("out/" + std::string(name) + "/numbers.json"));
    };
    EXPECT_EQ(run(all + Words{"--part", "1/2"}), 1);
    EXPECT_THAT(text(), AllOf(HasSubstr("c.json:1: strands is 0"),
                              testing::EndsWith("plait-simulate: 1 of 2 scenes failed: c\n")));
    EXPECT_TRUE(done("a") && !done("b") && !done("c") && !done("d"));
    EXPECT_EQ(run(all + Words{"--part", "2/2"}), 0) << text();
    EXPECT_TRUE(done("a") && done("b") && !done("c") && done("d"));
    EXPECT_EQ(run(all + Words{"--part", "5/5"}), 0);
    EXPECT_THAT(text(), HasSubstr("part 5 of 5 has none of the 4 scenes"));
    std::filesystem::remove_all(path("out"));
    EXPECT_EQ(run(all), 1);
    EXPECT_TRUE(done("a") && done("b") && !done("c") && done("d"));
}

TEST_F(Jobs, parts_and_scenes_that_make_no_sense_are_refused) {
    const std::string a = write("a.json", "{}"), b = write("b.json", "{}");
    std::filesystem::create_directory(path("more"));
    const std::string also_a = write("more/a.json", "{}");
    const auto expect_refused = [&](const Words& words, const char* sentence) {
        EXPECT_EQ(run(to_out(words)), 1);
        EXPECT_THAT(text(), HasSubstr(sentence));
        EXPECT_FALSE(std::filesystem::exists(path("out")));
    };
    const auto part = [&](const char* given) { return Words{"--scene", a, b, "--part", given}; };
    expect_refused(part("0/0"), "--part is 0/0: N is 0, range is [1, 1000000]");
    expect_refused(part("5/4"), "--part is 5/4: I is 5, range is [1, 4]");
    expect_refused(part("0/4"), "--part is 0/4: I is 0, range is [1, 4]");
    for (const char* text : {"x", "1", "1/", "/2", "1/2x", "-1/2", "1.5/2"})
        expect_refused(part(text), "not I/N, as 2/5: the second of five parts");
    expect_refused({"--part", "1/2"}, "--part shares out the scenes of --scene, and none is given");
    expect_refused({"--scene", a, b, also_a}, "two scenes would leave their results in ");
    expect_refused({"--scene", a, b, "--cache", "/x.abc"}, "--cache is /x.abc, and of several");
    expect_refused({"--scene", a, b, "--json", "../x"}, "--json is ../x, and of several scenes");
    expect_refused({"--scene", a, b, "--replay", "x"}, "--replay is given, and several scenes");
}

} // namespace
