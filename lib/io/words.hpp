// Words of a line of a text file.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace plait {

// The first word of `rest` between `blanks`; rest goes on after it. "" at the end.
inline std::string_view next_word(std::string_view& rest, std::string_view blanks) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
    rest.remove_prefix(word.size());
    return word;
}

// A word of the file as a message shows it: no longer than a glance takes in.
inline std::string shown(std::string_view word) {
    return std::string(word.substr(0, 32));
}

} // namespace plait
