// The director against all there is to choose from, and in what it is for: cameras that move, machines that
// slow down, crowds that double.
#include "core/levels/director.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

namespace {

using plait::DirectedHair;
using plait::Director;
using plait::DirectorGoal;
using plait::LevelChoice;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::array<uint32_t, 5> shown_strands{500, 512, 1000, 2000, 4000};

DirectedHair head(double pixels_per_metre, double swing = 0.03) {
    DirectedHair hair;
    hair.guides = {4000, 512, 128, 32, 0};
    hair.share = {0.2, 0.45, 0.6, 0.7, 1.1};
    hair.level_count = 5;
    std::ranges::copy(shown_strands, hair.shown.begin());
    hair.shown_count = shown_strands.size();
    hair.vertices = 16;
    hair.meets_bodies = true;
    hair.swing = swing;
    hair.pixels_per_metre = pixels_per_metre;
    hair.width = 6.5;
    hair.now = {0, 4000};
    hair.since = never;
    return hair;
}

// Of 1080 lines and a view of 40 degrees.
double pixels_at(double metres) {
    return 1080 / (2 * std::tan(0.349) * metres);
}

std::vector<LevelChoice> choose(Director& director, std::span<const DirectedHair> hair,
                                const DirectorGoal& goal, plait::DirectorReport* report = nullptr) {
    std::vector<LevelChoice> out(hair.size());
    const auto made = director.choose(hair, goal, out);
    if (report)
        *report = made;
    return out;
}

double work(const DirectedHair& hair, LevelChoice choice) {
    const double guides = hair.guides[choice.level];
    return (guides > 0 ? 0.1 : 0) + hair.vertices * (1.06e-4 * guides + 2.8e-5 * choice.shown);
}

// The frames of a scene: choices are taken, and stand for as long as they are not changed.
struct Scene {
    std::vector<DirectedHair> hair;
    DirectorGoal goal;
    Director director{std::pmr::new_delete_resource()};
    double slowness = 1; // of the machine, against what the director takes it for at first
    double fixed = 0;    // ms of every frame
    double last = 0;     // ms that the last frame took
    uint32_t changed = 0;

    void frame() {
        director.took(last, 1 / 60.0);
        plait::DirectorReport report;
        const auto out = choose(director, hair, goal, &report);
        for (size_t i = 0; i < hair.size(); ++i) {
            hair[i].since = out[i] == hair[i].now ? hair[i].since + 1 / 60.0 : 0;
            hair[i].now = out[i];
        }
        changed += report.changed;
        last = fixed + 0.5 * slowness * work_of_all();
    }
    double work_of_all() const {
        double sum = 0;
        for (const DirectedHair& of : hair)
            sum += work(of, of.now);
        return sum;
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i)
            frame();
    }
};

constexpr double budget = 6; // ms; two crowds that go rigid take 4.7

Scene crowd(int count) {
    Scene scene;
    for (int i = 0; i < count; ++i)
        scene.hair.push_back(head(pixels_at(0.6 + 40.0 * i / count), 0.01 + 0.002 * (i % 7)));
    scene.goal.budget = budget;
    scene.goal.tolerance = 0.05;
    return scene;
}

double error2(const DirectedHair& hair, LevelChoice choice) {
    const double motion = 1.5 * hair.share[choice.level] * hair.swing * hair.pixels_per_metre;
    const double width = 2 * std::max(0.0, hair.width * hair.pixels_per_metre / choice.shown - 0.5);
    return motion * motion + width * width;
}

TEST(Director, IsAsGoodAsTryingAll) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> metres(0.6, 20), swing(0.005, 0.08), budgets(0.5, 6);
    int far = 0;
    double total = 0, best_total = 0;
    const int cases = 300;
    for (int c = 0; c < cases; ++c) {
        std::vector<DirectedHair> hair;
        for (int i = 0; i < 3; ++i) {
            hair.push_back(head(pixels_at(metres(random)), swing(random)));
            hair[i].now = {4, 500};
        }
        DirectorGoal goal;
        goal.budget = budgets(random);
        goal.tolerance = 0;
        Director director(std::pmr::new_delete_resource());
        const auto out = choose(director, hair, goal);
        double made = 0, used = 0;
        for (int i = 0; i < 3; ++i) {
            made += error2(hair[i], out[i]);
            used += work(hair[i], out[i]);
        }
        std::vector<LevelChoice> options;
        for (uint32_t level = 0; level < 5; ++level)
            for (const uint32_t shown : shown_strands)
                options.push_back({level, shown});
        double best = never;
        const double most = 0.95 * goal.budget / director.price();
        for (const LevelChoice a : options)
            for (const LevelChoice b : options)
                for (const LevelChoice d : options)
                    if (work(hair[0], a) + work(hair[1], b) + work(hair[2], d) <= most)
                        best = std::min(best, error2(hair[0], a) + error2(hair[1], b) +
                                                  error2(hair[2], d));
        if (best == never) // nothing fits: the cheapest there is
            continue;
        EXPECT_LE(used, most * (1 + 1e-9));
        far += made > 1.05 * best;
        total += std::sqrt(made / best);
        best_total += 1;
    }
    EXPECT_LE(total / best_total, 1.04);
    EXPECT_LE(far, 0.15 * best_total);
    std::printf(
        "error over the best there is: %.4f in the mean; %d of %.0f above 1.05 in its square\n",
        total / best_total, far, best_total);
}

TEST(Director, DoesNotFlicker) {
    Scene scene = crowd(21);
    scene.frames(120);
    scene.changed = 0;
    scene.frames(60);
    EXPECT_EQ(scene.changed, 0u) << "nothing moves";

    // Each camera sways by 5 %, 1 Hz, wherever it stands.
    for (double metres = 0.6; metres < 40; metres *= 1.1) {
        Scene one;
        one.hair.push_back(head(pixels_at(metres)));
        one.goal.tolerance = 2;
        one.frames(60);
        one.changed = 0;
        for (int frame = 0; frame < 600; ++frame) {
            one.hair[0].pixels_per_metre =
                pixels_at(metres * (1 + 0.05 * std::sin(2 * 3.14159265 * frame / 60.0)));
            one.frame();
        }
        EXPECT_LE(one.changed, 2u) << metres << " m";
    }
}

TEST(Director, KeepsTheBudgetWhereMachinesSlowDown) {
    Scene scene = crowd(21);
    scene.frames(120);
    EXPECT_LE(scene.last, 1.05 * budget);
    scene.slowness = 2;
    scene.frames(10);
    EXPECT_LE(scene.last, 1.1 * budget);
    scene.slowness = 1;
    scene.frames(300);
    EXPECT_GE(scene.last, 0.75 * budget) << "takes what there is again";
}

TEST(Director, KeepsTheBudgetWhereCrowdsDouble) {
    Scene scene = crowd(21);
    scene.frames(120);
    for (int i = 0; i < 21; ++i)
        scene.hair.push_back(head(pixels_at(2 + i)));
    scene.frames(10);
    EXPECT_LE(scene.last, 1.1 * budget);
}

TEST(Director, TwoFramesThatStumbleChangeNothing) {
    Scene scene = crowd(21);
    scene.frames(120);
    scene.changed = 0;
    scene.last *= 100;
    scene.frame();
    scene.last *= 100;
    scene.frames(30);
    EXPECT_EQ(scene.changed, 0u);
}

TEST(Director, ComesBackFromAMomentThatWasTooLong) {
    for (const double fixed : {0.0, 1.5}) {
        Scene scene = crowd(21);
        scene.fixed = fixed;
        scene.frames(240);
        const double before = scene.work_of_all();
        for (int i = 0; i < 10; ++i) {
            scene.last = 500;
            scene.frame();
        }
        EXPECT_LT(scene.work_of_all(), 0.8 * before);
        scene.frames(420);
        EXPECT_GT(scene.work_of_all(), 0.8 * before) << fixed << " ms of every frame";
        EXPECT_LE(scene.last, 1.1 * budget);
    }
}

TEST(Director, SpendsNoMoreThanTheToleranceAsks) {
    for (const double metres : {0.6, 2.0, 8.0, 30.0}) {
        Scene scene;
        scene.hair.push_back(head(pixels_at(metres)));
        scene.goal.tolerance = 4;
        scene.frames(2);
        const LevelChoice choice = scene.hair[0].now;
        const double made = std::sqrt(error2(scene.hair[0], choice));
        if (choice != LevelChoice{0, 4000}) {
            EXPECT_LE(made, 4) << metres;
        }
        for (uint32_t level = 0; level < 5; ++level)
            for (const uint32_t shown : shown_strands) {
                const LevelChoice other{level, shown};
                if (work(scene.hair[0], other) < 0.7 * work(scene.hair[0], choice)) {
                    EXPECT_GT(std::sqrt(error2(scene.hair[0], other)), 4 / 1.25) << metres;
                }
            }
    }
}

TEST(Director, WhatNobodySeesGoesRigid) {
    Scene scene = crowd(8);
    scene.frames(60);
    scene.hair[0].pixels_per_metre = 0;
    scene.frames(60);
    EXPECT_EQ(scene.hair[0].now, (LevelChoice{3, 500}));
    scene.hair[0].unseen = 1.5;
    scene.frames(60);
    EXPECT_EQ(scene.hair[0].now, (LevelChoice{4, 500}));
}

TEST(Director, ImportanceBuysAndTheOrderOfTheListDoesNot) {
    Scene scene = crowd(20);
    for (DirectedHair& hair : scene.hair)
        hair.pixels_per_metre = pixels_at(5);
    scene.hair[7].importance = 20;
    scene.frames(240);
    for (size_t i = 0; i < 20; ++i)
        if (i != 7) {
            EXPECT_LE(error2(scene.hair[7], scene.hair[7].now),
                      error2(scene.hair[i], scene.hair[i].now));
        }

    Scene one = crowd(9), two = crowd(9);
    std::reverse(two.hair.begin(), two.hair.end());
    one.frames(200);
    two.frames(200);
    for (size_t i = 0; i < 9; ++i)
        EXPECT_EQ(one.hair[i].now, two.hair[8 - i].now) << i;
}

TEST(Director, TakesMicroseconds) { // measured, not asserted
    Scene scene = crowd(100);
    scene.frames(10);
    std::vector<LevelChoice> out(100);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 1000; ++i)
        scene.director.choose(scene.hair, scene.goal, out);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    std::printf("100 characters: %.1f us a call\n", took.count() / 1000);
}

} // namespace
