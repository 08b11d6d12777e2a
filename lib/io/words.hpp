// Words of a line of a text file.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace plait {

constexpr std::string_view BLANKS = " \t"; // of OBJ and its kin

inline bool is_one_of(std::string_view name, std::span<const std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
}

// The first word of `rest` between `blanks`; rest goes on after it. "" at the end.
inline std::string_view next_word(std::string_view& rest, std::string_view blanks) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
    rest.remove_prefix(word.size());
    return word;
}

// The text of a file behind the mark of UTF-8 that some programs begin it with.
inline std::string_view after_mark(std::string_view text) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    text.remove_prefix(text.starts_with(mark) ? mark.size() : 0);
    return text;
}

// A word of the file as a message shows it: no longer than a glance takes in.
inline std::string shown(std::string_view word) {
    return std::string(word.substr(0, 32));
}

} // namespace plait
