// The four winds: each as fast as the wind, each leaning by the cone's angle, together along it.
#include "core/tressfx/wind_cone.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(WindCone, LeansToFourSidesAtTheWindsSpeed) {
    const float winds[][3] = {{3, 0, 0}, {-2, 0, 0}, {0, 5, 0}, {1, -2, 2}};
    for (const auto& wind : winds)
        for (const float angle : {0.0f, 0.3f, 0.7f}) {
            float corner[16];
            plait::wind_cone(wind, angle, corner);
            const double speed = std::hypot(wind[0], wind[1], wind[2]);
            double sum[3] = {};
            for (int i = 0; i < 4; ++i) {
                const float* c = corner + 4 * i;
                EXPECT_NEAR(std::hypot(c[0], c[1], c[2]), speed, 1e-6 * speed);
                const double dot =
                    double(c[0]) * wind[0] + double(c[1]) * wind[1] + double(c[2]) * wind[2];
                EXPECT_NEAR(dot / (speed * speed), std::cos(double(angle)), 1e-6);
                EXPECT_EQ(c[3], 0);
                for (int axis = 0; axis < 3; ++axis)
                    sum[axis] += double(c[axis]);
            }
            for (int axis = 0; axis < 3; ++axis) // opposite leans cancel
                EXPECT_NEAR(sum[axis], 4 * std::cos(double(angle)) * wind[axis], 1e-5 * speed);
        }
}

TEST(WindCone, LeansAboutTheTurnedYAndZAxes) {
    const float wind[3] = {2, 0, 0};
    float corner[16];
    plait::wind_cone(wind, 0.5f, corner);
    const float c = 2 * std::cos(0.5f), s = 2 * std::sin(0.5f);
    const float expected[16] = {c, 0, -s, 0, c, 0, s, 0, c, s, 0, 0, c, -s, 0, 0};
    for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(corner[i], expected[i], 1e-6) << i;
}

} // namespace
