// Axes of the stability sweep: pins from the softest to the stiffest, with targets that rest, swing
// and jump out of the strand's reach.
#include "axes.hpp"

#include <algorithm>
#include <cmath>

namespace lab::stability {

namespace {

constexpr double swing_rate = 2 * pi * 1.5; // rad/s: not the roots' 2 Hz

// Of the middle vertex and the last one of both strands.
Trial pinned(const Subject& subject, double stiffness, std::function<Point(double)> target,
             double target_speed) {
    Trial trial = base_trial(subject);
    trial.has_energy = false; // what a pin's spring holds is not counted here
    for (uint32_t k = 0; k < trial.strands.size(); ++k)
        for (const uint32_t vertex : {8u, 16u})
            trial.pins.push_back({k, vertex, stiffness, target});
    for (TrialStrand& strand : trial.strands) {
        strand.root_speed += target_speed;
        strand.stir = 0; // where it is held it moves no more
    }
    return trial;
}

void add_stiffnesses(Points& points) {
    for (const double stiffness : {1e-6, 1e-4, 1e-2, 1.0, 100.0, 1e6})
        points.push_back({"pin (N/m)", axis_text(stiffness),
                          [stiffness](const Subject& subject) {
                              return pinned(
                                  subject, stiffness,
                                  [](double t) {
                                      const double angle = swing_rate * std::min(t, 2.0);
                                      return Point(0.5 * length, -0.1 + 0.1 * std::sin(angle),
                                                   0.1 * std::cos(angle));
                                  },
                                  0.1 * swing_rate);
                          },
                          true});
}

// In one step, half a second after the start.
void add_jumps(Points& points) {
    for (const double away : {0.1, 1.0, 10.0, 1e4})
        points.push_back(
            {"pin jumps away (m)", axis_text(away),
             [away](const Subject& subject) {
                 return pinned(
                     subject, 1e6,
                     [away](double t) { return Point(0.5 * length, t > 0.5 ? away : 0, 0); }, 0);
             },
             true});
}

} // namespace

void add_pins(Points& points) {
    add_stiffnesses(points);
    add_jumps(points);
}

} // namespace lab::stability
