// Whether lengths are those of hair, in metres; grooms come in centimetres as often as not.
#pragma once

#include <string>

namespace plait {

// 1 where hair has such a mean length, 5 mm to 2 m; else what likely brings it there.
double likely_scale(double mean_length);

// What there is to say about a mean length in m; "" where it is that of hair.
std::string length_warning(double mean_length);

} // namespace plait
