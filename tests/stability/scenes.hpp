// Scenes that both models are put through.
#pragma once

#include "one_strand.hpp"

#include <random>

namespace plait::test {

struct Stretch {
    float worst = 0.0f, mean = 0.0f; // of any step
};

inline void note_stretch(const OneStrand& strand, Stretch& seen) {
    const plait_sim_measures stats = strand.measure();
    EXPECT_EQ(stats.nonfinite, 0u);
    seen.worst = std::max(seen.worst, stats.max_stretch);
    seen.mean = std::max(seen.mean, stats.mean_stretch);
}

inline float worst_stretch_over(OneStrand& strand, int steps) {
    Stretch seen;
    for (int i = 0; i < steps; ++i) {
        strand.step();
        note_stretch(strand, seen);
    }
    return seen.worst;
}

// The head goes +-0.2 m at 4 Hz for 4 s, 12.9 g at the ends; the first `unseen` steps do not count.
inline Stretch stretch_when_shaken(OneStrand& strand, int unseen = 0) {
    Stretch seen;
    strand.step(); // a head that is known to rest
    strand.step();
    for (int i = 1; i <= 240; ++i) {
        strand.move_head(
            {0.2f * std::sin(6.2831853f * 4.0f * static_cast<float>(i) / 60.0f), 0, 0});
        strand.step();
        if (i > unseen)
            note_stretch(strand, seen);
    }
    return seen;
}

// The greatest speed of a head that sways +-5 cm once a second, from the first second to the third.
// Frames are of 16.7 ms, or with `jitter` of 16.7 ms +-60 %.
template <typename Hair> float peak_speed_over_frames(Hair& strand, bool jitter) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> factor(0.4, 1.6);
    double time = 0.0;
    float peak = 0.0f;
    while (time < 3.0) {
        const double dt = (jitter ? factor(random) : 1.0) / 60.0;
        time += dt;
        strand.move_head({0.05f * std::sin(6.2831853f * static_cast<float>(time)), 0, 0});
        strand.step(dt);
        if (time > 1.0)
            peak = std::max(peak, strand.measure().max_speed);
    }
    return peak;
}
inline float peak_speed_when_swayed(OneStrand strand, bool jitter) {
    return peak_speed_over_frames(strand, jitter);
}

// Straight, but vertex 9 is where vertex 8 is.
inline std::vector<Vec3> with_zero_length_segment(const StrandShape& shape) {
    std::vector<Vec3> points = straight(shape);
    points[9] = points[8];
    return points;
}

} // namespace plait::test
