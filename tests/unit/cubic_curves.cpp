#include "io/curves/cubic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

using Points = std::vector<CurvePoint>;

Points helix(size_t n, double turn) {
    Points points;
    for (size_t i = 0; i < n; ++i) {
        const double t = static_cast<double>(i) * turn;
        points.push_back({std::cos(t), std::sin(t), 0.1 * t});
    }
    return points;
}

// Straight from the bases' definitions.
CurvePoint exact(CurveBasis basis, const CurvePoint* p, double t) {
    const double u = 1 - t;
    std::array<double, 4> w;
    if (basis == CurveBasis::BEZIER)
        w = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    else if (basis == CurveBasis::B_SPLINE)
        w = {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
             (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
    else
        w = {(-t + 2 * t * t - t * t * t) / 2, (2 - 5 * t * t + 3 * t * t * t) / 2,
             (t + 4 * t * t - 3 * t * t * t) / 2, (-t * t + t * t * t) / 2};
    CurvePoint x{};
    for (size_t k = 0; k < 4; ++k)
        for (size_t i = 0; i < 3; ++i)
            x[i] += w[k] * p[k][i];
    return x;
}

double distance(const CurvePoint& p, const CurvePoint& a, const CurvePoint& b) {
    double chord2 = 0, along = 0, off2 = 0;
    for (size_t i = 0; i < 3; ++i) {
        chord2 += (b[i] - a[i]) * (b[i] - a[i]);
        along += (b[i] - a[i]) * (p[i] - a[i]);
    }
    const double share = chord2 > 0 ? std::clamp(along / chord2, 0.0, 1.0) : 0;
    for (size_t i = 0; i < 3; ++i) {
        const double off = a[i] + share * (b[i] - a[i]) - p[i];
        off2 += off * off;
    }
    return std::sqrt(off2);
}

double length(const CurvePoint& a, const CurvePoint& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(CubicCurves, NoChordIsOffByMoreThanAHundredthOfItsLength) {
    for (const CurveBasis basis :
         {CurveBasis::BEZIER, CurveBasis::B_SPLINE, CurveBasis::CATMULL_ROM})
        for (const double turn : {0.05, 0.4, 0.9}) {
            const Points points = helix(10, turn);
            CubicCurve curve(basis, CurveEnds::INNER);
            const auto found = curve.polyline(points);
            const Points line(found.begin(), found.end());
            EXPECT_EQ(curve.sharp_spans(), 0u);
            const size_t spans = *span_count(basis, CurveEnds::INNER, points.size());
            const size_t stride = basis == CurveBasis::BEZIER ? 3 : 1;
            for (size_t s = 0; s < spans; ++s)
                for (int i = 0; i <= 100; ++i) {
                    const CurvePoint x = exact(basis, &points[stride * s], i / 100.0);
                    double share = 1e9;
                    for (size_t k = 0; k + 1 < line.size(); ++k)
                        share = std::min(share, distance(x, line[k], line[k + 1]) /
                                                    length(line[k], line[k + 1]));
                    EXPECT_LE(share, 0.01) << "turn " << turn << ", span " << s;
                }
        }
}

TEST(CubicCurves, AStraightOneTakesOneChordForEachSpan) {
    Points points;
    for (int i = 0; i < 7; ++i)
        points.push_back({0, 0.1 * i, 0});
    EXPECT_EQ(CubicCurve(CurveBasis::BEZIER, CurveEnds::INNER).polyline(points).size(), 3u);
    EXPECT_EQ(CubicCurve(CurveBasis::B_SPLINE, CurveEnds::INNER).polyline(points).size(), 5u);
    EXPECT_EQ(CubicCurve(CurveBasis::CATMULL_ROM, CurveEnds::OUTER).polyline(points).size(), 7u);
}

TEST(CubicCurves, OuterEndsAreTheFirstAndTheLastPoint) {
    const Points points = helix(5, 0.5);
    for (const CurveBasis basis : {CurveBasis::B_SPLINE, CurveBasis::CATMULL_ROM}) {
        CubicCurve curve(basis, CurveEnds::OUTER);
        const auto line = curve.polyline(points);
        EXPECT_LT(length(line.front(), points.front()), 1e-12);
        EXPECT_LT(length(line.back(), points.back()), 1e-12);
    }
}

TEST(CubicCurves, ACuspGetsTheMostChordsAndIsCounted) {
    CubicCurve curve(CurveBasis::BEZIER, CurveEnds::INNER);
    EXPECT_EQ(curve.polyline(Points{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}}).size(), 33u);
    EXPECT_EQ(curve.sharp_spans(), 1u);
}

TEST(CubicCurves, TheBasisAllowsSomeNumbersOfPoints) {
    EXPECT_EQ(span_count(CurveBasis::BEZIER, CurveEnds::INNER, 7), 2u);
    EXPECT_FALSE(span_count(CurveBasis::BEZIER, CurveEnds::INNER, 6));
    EXPECT_FALSE(span_count(CurveBasis::B_SPLINE, CurveEnds::INNER, 3));
    EXPECT_EQ(span_count(CurveBasis::B_SPLINE, CurveEnds::OUTER, 2), 1u);
    EXPECT_FALSE(span_count(CurveBasis::CATMULL_ROM, CurveEnds::OUTER, 1));
}

} // namespace
} // namespace plait
