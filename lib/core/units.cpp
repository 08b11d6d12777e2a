#include "core/units.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// Mean length of hair, m: from short fur to hair down to the knees.
constexpr double shortest = 5e-3, longest = 2;

bool is_hair(double length) {
    return length >= shortest && length <= longest;
}

// The unit that a scale stands for.
const char* unit_of(double scale) {
    if (scale == 1e-2)
        return ", as for a file in centimetres";
    return scale == 1e-3 ? ", as for a file in millimetres" : "";
}

} // namespace

double likely_scale(double mean_length) {
    if (is_hair(mean_length))
        return 1;
    for (const double scale : {1e-2, 1e-3, 1e2, 1e3}) // the commonest first
        if (is_hair(mean_length * scale))
            return scale;
    const double middle = std::sqrt(shortest * longest);
    const double exponent = std::round(std::log10(middle / mean_length));
    return std::pow(10.0, std::clamp(exponent, -6.0, 6.0));
}

std::string length_warning(double mean_length) {
    const double scale = likely_scale(mean_length);
    if (scale == 1)
        return {};
    return format(
        "strands are %.3g m long in the mean, hair's are %g to %g m: import the groom with "
        "scale %g%s",
        mean_length, shortest, longest, scale, unit_of(scale));
}

} // namespace plait
