// Cubic curves as polylines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plait {

enum class CurveBasis { LINEAR, BEZIER, B_SPLINE, CATMULL_ROM };

// Where a curve of a B-spline or Catmull-Rom basis begins and ends: at the second and the last but one
// of its points, or near them, or at the first and the last.
enum class CurveEnds { INNER, OUTER };

using CurvePoint = std::array<double, 3>;

// Number of cubic spans of a curve of so many points; none: the basis does not allow that many.
std::optional<size_t> span_count(CurveBasis basis, CurveEnds ends, size_t points);

// A polyline along the curve, which takes no chord for the curve that is off by more than a hundredth of
// the chord's length. A span that would take more than MOST_CHORDS gets these.
class CubicCurve {
  public:
    static constexpr size_t MOST_CHORDS = 32;

    CubicCurve(CurveBasis basis, CurveEnds ends) : basis_(basis), ends_(ends) {}
    // Of span_count() spans or more than none. Valid until the next call.
    std::span<const CurvePoint> polyline(std::span<const CurvePoint> points);
    // Of a B-spline with knots that rise or stay, four more than points; none, if none of its spans has a
    // length in knots.
    std::span<const CurvePoint> polyline(std::span<const CurvePoint> points,
                                         std::span<const double> knots);
    // Of all curves: those that got MOST_CHORDS and would have taken more.
    uint64_t sharp_spans() const { return sharp_spans_; }

  private:
    using Bezier = std::array<CurvePoint, 4>;
    Bezier bezier(std::span<const CurvePoint> points, size_t span) const;
    void add_span(const Bezier& span);
    void begin_span(const Bezier& span) {
        if (out_.empty())
            out_.push_back(span[0]);
        add_span(span);
    }

    CurveBasis basis_;
    CurveEnds ends_;
    std::vector<CurvePoint> out_;
    uint64_t sharp_spans_ = 0;
};

} // namespace plait
