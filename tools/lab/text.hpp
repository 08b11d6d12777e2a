// printf into a string.
#pragma once

#include <cstdio>
#include <string>

namespace lab {

// At most 1023 characters.
template <typename... Values> std::string text(const char* pattern, Values... values) {
    char line[1024];
    std::snprintf(line, sizeof line, pattern, values...);
    return line;
}

} // namespace lab
