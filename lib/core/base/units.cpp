#include "core/base/units.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// Mean length of hair, m: from short fur to hair down to the knees.
constexpr double shortest = 5e-3, longest = 2;
// m: extent of a groom, a mammoth's; and of one that another unit would make of it, a bear's.
constexpr double largest = 10, largest_guess = 3;

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

double likely_scale(double mean_length, double extent) {
    constexpr double scales[] = {1, 1e-2, 1e-3, 1e2, 1e3}; // the commonest first
    for (const double scale : scales)
        if (is_hair(mean_length * scale) &&
            extent * scale <= (scale == 1 ? largest : largest_guess))
            return scale;
    for (const double scale : scales)
        if (is_hair(mean_length * scale))
            return scale;
    const double middle = std::sqrt(shortest * longest);
    const double exponent = std::round(std::log10(middle / mean_length));
    return std::pow(10.0, std::clamp(exponent, -6.0, 6.0));
}

std::string size_warning(double mean_length, double extent) {
    const double scale = likely_scale(mean_length, extent);
    if (scale == 1)
        return {};
    if (is_hair(mean_length))
        return format("the groom is %.3g m large, hair %g m at most: import it with scale %g%s",
                      extent, largest, scale, unit_of(scale));
    return format(
        "strands are %.3g m long in the mean, hair's are %g to %g m: import the groom with "
        "scale %g%s",
        mean_length, shortest, longest, scale, unit_of(scale));
}

} // namespace plait
