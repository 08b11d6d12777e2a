// On which line of a JSON text each key stands, for messages about its value.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace common {

// "colliders[0].friction" -> 12. Elements of lists have a line when they are objects or lists.
using JsonLines = std::map<std::string, size_t>;

// Empty where the text is no JSON; comments are skipped.
JsonLines find_lines(const std::string& text);

} // namespace common
