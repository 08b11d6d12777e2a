// A number as text: as short as it can be and still be read to the bit, with a point in every country.
#pragma once

#include <charconv>
#include <string>

namespace plait {

inline std::string number_text(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

} // namespace plait
