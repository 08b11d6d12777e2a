// On which line of a JSON text each key stands, for messages about its value.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace common {

// "colliders[0].friction" -> 12. Elements of lists have a line when they are objects or lists.
using JsonLines = std::map<std::string, size_t>;

// A key that its object has had already.
struct DuplicateKey {
    std::string path; // "colliders[0].friction"
    size_t first, line;
};

// Empty where the text is no JSON; comments are skipped. `duplicates`: in the order of the text.
JsonLines find_lines(const std::string& text, std::vector<DuplicateKey>& duplicates);

} // namespace common
