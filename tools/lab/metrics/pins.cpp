#include "input.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

namespace {

// A limp strand of N equal segments at rest between its root and its tip, which are about level:
// the polygon that weights w = rho A g l at its inner vertices give it. Segment k carries the
// vertical force w ((N-1)/2 - k), and all carry the pull, N, of which they span what they do.
struct Polygon {
    double segments, length; // of a segment, m
    double weight;           // w, N

    double upward(double k) const { return weight * ((segments - 1) / 2 - k); }
    double span(double pull) const {
        double sum = 0;
        for (double k = 0; k < segments; ++k)
            sum += length * pull / std::hypot(pull, upward(k));
        return sum;
    }
    double sag(double pull) const {
        double sum = 0;
        for (double k = 0; k < segments; ++k)
            sum += length * std::max(upward(k), 0.0) / std::hypot(pull, upward(k));
        return sum;
    }
};

struct Hung {
    double sag = 0, pull = 0; // m, N
};

std::string hung_at_both_ends(const MetricInput& in, Hung& found) {
    const Strand& strand = in.strand();
    if (!in.scene.tip_pin || in.scene.bend_stiffness(strand) > 0 || strand.segment_ratio != 1)
        return "a catenary is a limp strand's of equal segments whose tip is pinned";
    const Vec3 chord = in.last().back() - in.last().front();
    const double drop = chord.dot(in.down()), L = in.length();
    const double span = (chord - drop * in.down()).norm(), N = strand.segments;
    if (!(span < L) || std::abs(drop) > 0.01 * L)
        return "its ends are not level, or farther apart than it is long";
    const double weight = in.scene.material.line_density * in.scene.gravity.norm() * L / N;
    const Polygon polygon{N, L / N, weight};
    double low = 0, high = 1e3 * weight * N;
    for (int i = 0; i < 200; ++i) {
        const double pull = (low + high) / 2;
        (polygon.span(pull) < span ? low : high) = pull;
    }
    found = {polygon.sag(low), low};
    return "";
}

} // namespace

// How far its lowest vertex is from where the polygon of its segments and span has its own.
Value catenary_sag(const MetricInput& in) {
    Hung hung;
    if (const std::string why = hung_at_both_ends(in, hung); !why.empty())
        return none(why);
    const auto& x = in.last();
    double lowest = 0;
    for (const Vec3& vertex : x)
        lowest = std::max(lowest, (vertex - x.front()).dot(in.down()));
    lowest -= (x.back() - x.front()).dot(in.down()) / 2;
    return {std::abs(lowest - hung.sag) / in.length(), ""};
}

// Horizontal pull of the pin's spring over the polygon's, less 1.
Value catenary_pull(const MetricInput& in) {
    Hung hung;
    if (const std::string why = hung_at_both_ends(in, hung); !why.empty())
        return none(why);
    const TipPin& pin = *in.scene.tip_pin;
    Vec3 pull = pin.stiffness * (pin.at - in.last().back());
    pull -= pull.dot(in.down()) * in.down();
    return {std::abs(pull.norm() / hung.pull - 1), ""};
}

} // namespace lab
