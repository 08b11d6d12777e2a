#include "io/curves/cubic.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr double TOLERANCE = 0.01; // of a chord's length

CurvePoint blend(const CurvePoint& a, const CurvePoint& b, double share) {
    CurvePoint p;
    for (size_t i = 0; i < 3; ++i)
        p[i] = a[i] + share * (b[i] - a[i]);
    return p;
}

double dot(const CurvePoint& a, const CurvePoint& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

CurvePoint minus(const CurvePoint& a, const CurvePoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// From p to the segment from a to b.
double distance(const CurvePoint& p, const CurvePoint& a, const CurvePoint& b) {
    const CurvePoint chord = minus(b, a), way = minus(p, a);
    const double length2 = dot(chord, chord);
    const double share = length2 > 0 ? std::clamp(dot(way, chord) / length2, 0.0, 1.0) : 0;
    const CurvePoint off = minus(way, minus(blend(a, b, share), a));
    return std::sqrt(dot(off, off));
}

// The part of a cubic from t0 to t1, by its blossom.
CurvePoint blossom(const std::array<CurvePoint, 4>& b, double r, double s, double t) {
    std::array<CurvePoint, 4> p = b;
    const double at[3] = {r, s, t};
    for (size_t level = 0; level < 3; ++level)
        for (size_t i = 0; i + level < 3; ++i)
            p[i] = blend(p[i], p[i + 1], at[level]);
    return p[0];
}

// The distance to a chord is convex: a curve is no farther than its inner points' distances, by the
// weight that these have together, 3/4 at most.
bool is_flat(const std::array<CurvePoint, 4>& b, double t0, double t1) {
    const CurvePoint from = blossom(b, t0, t0, t0), to = blossom(b, t1, t1, t1);
    const double off = 0.75 * std::max(distance(blossom(b, t0, t0, t1), from, to),
                                       distance(blossom(b, t0, t1, t1), from, to));
    const CurvePoint chord = minus(to, from);
    return off <= TOLERANCE * std::sqrt(dot(chord, chord));
}

bool is_flat(const std::array<CurvePoint, 4>& b, size_t chords) {
    const double n = static_cast<double>(chords);
    for (size_t i = 0; i < chords; ++i)
        if (!is_flat(b, static_cast<double>(i) / n, static_cast<double>(i + 1) / n))
            return false;
    return true;
}

} // namespace

std::optional<size_t> span_count(CurveBasis basis, CurveEnds ends, size_t points) {
    if (basis == CurveBasis::BEZIER)
        return points >= 4 && points % 3 == 1 ? std::optional((points - 1) / 3) : std::nullopt;
    if (ends == CurveEnds::OUTER)
        return points >= 2 ? std::optional(points - 1) : std::nullopt;
    return points >= 4 ? std::optional(points - 3) : std::nullopt;
}

CubicCurve::Bezier CubicCurve::bezier(std::span<const CurvePoint> points, size_t span) const {
    if (basis_ == CurveBasis::BEZIER)
        return {points[3 * span], points[3 * span + 1], points[3 * span + 2], points[3 * span + 3]};
    // A point before the first, and one past the last, as far from these as their other neighbours.
    const auto at = [&](size_t i) {
        if (ends_ == CurveEnds::INNER)
            return points[i];
        if (i == 0)
            return blend(points[1], points[0], 2);
        return i <= points.size() ? points[i - 1]
                                  : blend(points[points.size() - 2], points.back(), 2);
    };
    const CurvePoint p[4] = {at(span), at(span + 1), at(span + 2), at(span + 3)};
    Bezier b;
    for (size_t i = 0; i < 3; ++i)
        if (basis_ == CurveBasis::CATMULL_ROM) {
            b[0][i] = p[1][i];
            b[1][i] = p[1][i] + (p[2][i] - p[0][i]) / 6;
            b[2][i] = p[2][i] - (p[3][i] - p[1][i]) / 6;
            b[3][i] = p[2][i];
        } else {
            b[0][i] = (p[0][i] + 4 * p[1][i] + p[2][i]) / 6;
            b[1][i] = (2 * p[1][i] + p[2][i]) / 3;
            b[2][i] = (p[1][i] + 2 * p[2][i]) / 3;
            b[3][i] = (p[1][i] + 4 * p[2][i] + p[3][i]) / 6;
        }
    return b;
}

void CubicCurve::add_span(const Bezier& span) {
    size_t chords = 1;
    for (const size_t n : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32}) {
        chords = n;
        if (is_flat(span, n))
            break;
    }
    sharp_spans_ += chords == MOST_CHORDS && !is_flat(span, chords);
    for (size_t i = 1; i < chords; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(chords);
        out_.push_back(blossom(span, t, t, t));
    }
    out_.push_back(span[3]);
}

std::span<const CurvePoint> CubicCurve::polyline(std::span<const CurvePoint> points) {
    out_.clear();
    const size_t spans = *span_count(basis_, ends_, points.size());
    for (size_t span = 0; span < spans; ++span)
        begin_span(bezier(points, span));
    return out_;
}

std::span<const CurvePoint> CubicCurve::polyline(std::span<const CurvePoint> points,
                                                 std::span<const double> knots) {
    out_.clear();
    for (size_t j = 3; j < points.size(); ++j) {
        const double from = knots[j], to = knots[j + 1];
        if (!(from < to))
            continue;
        // The blossom of the span between knots j and j + 1, by de Boor's recursion.
        const auto at = [&](double r, double s, double t) {
            std::array<CurvePoint, 4> p{points[j - 3], points[j - 2], points[j - 1], points[j]};
            const double u[3] = {r, s, t};
            for (size_t level = 1; level < 4; ++level)
                for (size_t k = 3; k >= level; --k) {
                    const size_t i = j - 3 + k;
                    p[k] = blend(p[k - 1], p[k],
                                 (u[level - 1] - knots[i]) / (knots[i + 4 - level] - knots[i]));
                }
            return p[3];
        };
        begin_span({at(from, from, from), at(from, from, to), at(from, to, to), at(to, to, to)});
    }
    return out_;
}

} // namespace plait
