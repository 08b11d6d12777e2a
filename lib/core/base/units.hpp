// Whether sizes are those of hair, in metres; grooms come in centimetres as often as not.
#pragma once

#include <string>

namespace plait {

// 1 where hair has such a mean length, 5 mm to 2 m, and at most 10 m of extent; else what likely
// brings both there, or the length alone.
double likely_scale(double mean_length, double extent);

// What there is to say about them, in m; "" where they are those of hair.
std::string size_warning(double mean_length, double extent);

} // namespace plait
