// The check of one number that a caller gives.
#pragma once

#include "base/format.hpp"
#include "base/result.hpp"

namespace plait {

// Refuses NaN, too. `open` excludes the lower end.
inline Status check_range(const char* field, double value, double low, double high,
                          bool open = false) {
    if (value <= high && (open ? value > low : value >= low))
        return {};
    return Error{PLAIT_INVALID_ARGUMENT,
                 format("%s is %g, range is %c%g, %g]", field, value, open ? '(' : '[', low, high)};
}

// Of the struct `s`.
#define PLAIT_RANGE(field, low, high) PLAIT_TRY(check_range(#field, double(s.field), low, high))

} // namespace plait
