// One trial of the stability sweep: strands of one material whose roots are shaken, each in its own
// way, and then left alone. What became of each is graded.
#pragma once

#include "common/handles.hpp"

#include <plait/plait.hpp>

#include <Eigen/Geometry>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace lab::stability {

using Point = Eigen::Vector3d;

constexpr double gravity = 9.81; // m/s^2

struct TrialStrand {
    std::vector<Point> rest;                // m
    std::function<plait_pose(double)> root; // at a time, s; still once the shaking is over
    double root_speed = 0;                  // at most, m/s
    double stir = 1;                        // acceleration it feels, in g
};

struct TrialCollider {
    plait_collider_desc shape;
    std::function<plait_pose(double)> pose;
};

// A vertex held at a place in the world.
struct TrialPin {
    uint32_t strand, vertex;
    double stiffness;                    // N/m
    std::function<Point(double)> target; // at a time, m
};

struct Trial {
    plait::SimDesc desc;
    std::vector<TrialStrand> strands;
    std::vector<TrialCollider> colliders;
    std::vector<TrialPin> pins;
    Point offset = Point::Zero(); // of the whole scene in the world, m
    double shake = 2, settle = 5; // s; in the second the drag is 2.4 sqrt(g/L), near critical
    std::vector<double> frames;   // lengths of the frames, s, over and over; empty: the step's
    bool settle_drag = true;
    bool has_energy = true; // the model has masses and stiffnesses to reckon it from
};

// The first of these that applies, in this order.
enum class Grade {
    nonfinite, // N  not finite, or 100 L away from the root
    explosion, // E  faster than 6 (root + 3 sqrt(g L)), or gains 5 % of energy at rest
    frozen,    // F  moves less than a tenth of what it must
    jitter,    // J  moves 1e-4 L in a step when all is over
    shaken,    // s  strain above 10 % while shaken
    rest,      // r  strain above 1 % at rest
    pass,      // .
};
constexpr size_t grades = 7;
char letter_of(Grade grade);
Grade grade_of(char letter); // throws Failure

struct Outcome {
    Grade grade = Grade::pass;
    double distance = 0; // farthest from the root, L
    double speed = 0;    // fastest, of 6 (root + 3 sqrt(g L))
    double energy = 0;   // gained at rest, of what there was
    double response =
        0;             // how far the tip moved against its root, of what it must; 1 if nothing must
    double jitter = 0; // largest move in one step of the last half second, L
    double strain = 0; // largest while shaken
    double rest_strain = 0; // at the end
};

// Throws Failure if the library refuses the trial.
std::vector<Outcome> run(plait_context* context, const Trial& trial);

// The worst of two: the grade that comes first, and each number's larger (smaller, of responses).
Outcome worst(const Outcome& a, const Outcome& b);

} // namespace lab::stability
