// Weights that are not negative and sum to 1: the least of the objective, against all that are on a
// fine mesh of such weights, and against what can be worked out.
#include "core/follows/simplex_fit.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;

struct Problem {
    Matrix4d h;
    Vector4d b;
    double at(const Vector4d& w) const { return w.dot(h * w) - 2 * b.dot(w); }
};

TEST(SimplexFit, NoWeightsAreBetter) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    constexpr int fine = 20;
    for (int round = 0; round < 200; ++round) {
        Eigen::Matrix<double, 6, 4> columns;
        for (double& value : columns.reshaped())
            value = normal(random);
        Problem problem{columns.transpose() * columns, Vector4d::Zero()};
        for (double& value : problem.b)
            value = normal(random);
        for (int count = 1; count <= 4; ++count) {
            const Vector4d fit = plait::fit_on_simplex(problem.h, problem.b, count);
            EXPECT_GE(fit.minCoeff(), 0);
            EXPECT_NEAR(fit.sum(), 1, 1e-12);
            EXPECT_EQ(fit.tail(4 - count).cwiseAbs().sum(), 0);
            const double least = problem.at(fit);
            for (int i = 0; i <= fine; ++i)
                for (int k = 0; i + k <= fine; ++k)
                    for (int l = 0; i + k + l <= fine; ++l) {
                        const Vector4d w = Vector4d(fine - i - k - l, i, k, l) / fine;
                        if (w.tail(4 - count).sum() == 0) {
                            EXPECT_GE(problem.at(w), least - 1e-12);
                        }
                    }
        }
    }
}

// Two guides that are off by 1 and by -3 along a line: a quarter of the second's weight mends it.
TEST(SimplexFit, MixesWhatIsOffToEitherSide) {
    const Vector4d off(1, -3, 0, 0);
    const Matrix4d h = off * off.transpose() + 1e-9 * Matrix4d::Identity();
    const Vector4d fit = plait::fit_on_simplex(h, Vector4d::Zero(), 2);
    EXPECT_NEAR(fit[0], 0.75, 1e-6);
    EXPECT_NEAR(fit[1], 0.25, 1e-6);
}

// What tells nothing apart leaves the pull to b: w = b where b is on the simplex.
TEST(SimplexFit, StaysWhereNothingPulls) {
    const Vector4d before(0.5, 0.3, 0.2, 0);
    const Vector4d fit = plait::fit_on_simplex(1e-12 * Matrix4d::Identity(), 1e-12 * before, 3);
    EXPECT_LT((fit - before).norm(), 1e-9);
}

} // namespace
