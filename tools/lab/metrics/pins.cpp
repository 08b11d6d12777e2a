#include "input.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

namespace {

// A limp strand at rest between its root and its tip, which are about level: parameter a,
// horizontal tension over weight per length, from 2 a sinh(span/2a) = L. All in m.
struct Catenary {
    double span = 0, a = 0, sag = 0;
};

std::string catenary_of(const MetricInput& in, Catenary& found) {
    if (!in.scene.tip_pin || in.scene.bend_stiffness(in.strand()) > 0)
        return "a catenary is a limp strand's whose tip is pinned";
    const Vec3 chord = in.last().back() - in.last().front();
    const double drop = chord.dot(in.down()), L = in.length();
    found.span = (chord - drop * in.down()).norm();
    if (!(found.span < L) || std::abs(drop) > 0.01 * L)
        return "its ends are not level, or farther apart than it is long";
    double low = 1e-3 * L, high = 1e3 * L;
    for (int i = 0; i < 200; ++i) {
        const double a = (low + high) / 2;
        (2 * a * std::sinh(found.span / 2 / a) > L ? low : high) = a;
    }
    found.a = low;
    found.sag = low * (std::cosh(found.span / 2 / low) - 1);
    return "";
}

} // namespace

// How far its lowest vertex is from where a catenary of its length and span has its lowest point.
Value catenary_sag(const MetricInput& in) {
    Catenary catenary;
    if (const std::string why = catenary_of(in, catenary); !why.empty())
        return none(why);
    const auto& x = in.last();
    double lowest = 0;
    for (const Vec3& vertex : x)
        lowest = std::max(lowest, (vertex - x.front()).dot(in.down()));
    lowest -= (x.back() - x.front()).dot(in.down()) / 2;
    return {std::abs(lowest - catenary.sag) / in.length(), ""};
}

// Horizontal pull of the pin's spring over the catenary's tension, less 1.
Value catenary_pull(const MetricInput& in) {
    Catenary catenary;
    if (const std::string why = catenary_of(in, catenary); !why.empty())
        return none(why);
    const TipPin& pin = *in.scene.tip_pin;
    Vec3 pull = pin.stiffness * (pin.at - in.last().back());
    pull -= pull.dot(in.down()) * in.down();
    const double weight = in.scene.material.line_density * in.scene.gravity.norm();
    return {std::abs(pull.norm() / (weight * catenary.a) - 1), ""};
}

} // namespace lab
