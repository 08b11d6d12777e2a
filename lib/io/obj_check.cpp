// assimp trusts OBJ text. What 5.2 makes of lines that it does not expect, by experiment under
// valgrind:
// - An `l` of one vertex is not counted when its arrays are sized, but steps on when they are
//   filled: from the second such line on it writes beyond the end of heap blocks. By its first
//   letter alone it takes every keyword (`lod`) for an `l`, `f` or `p`.
// - A `v` of 5 or 7 numbers, or with one like `.5`, is left out: later indices are one too high.
// - Indices like 01 and +1 are read digit by digit, as several.
// - A line that begins with a blank is left out. One that ends in a backslash goes on with the next
//   without a blank between, and a second such line is not joined at all.
// So text is refused unless it is of the OBJ that is read rightly. Indices above the count are
// allowed where they stand: only the end of the file tells how many there are.
#include "io/obj_check.hpp"

#include "base/format.hpp"
#include "io/words.hpp"

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <limits>

namespace plait {
namespace {

// Lines that hold no numbers of ours. Those of free-form curves and surfaces, `lod` and commands to
// a shell (`call`, `csh`) are not among them.
constexpr std::string_view PASSED_OVER[] = {
    "vp",     "o",      "g",     "s",        "mg",       "usemtl",     "usemap",
    "mtllib", "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

struct Element {
    std::string_view keyword;
    unsigned least; // vertices
};
constexpr Element ELEMENTS[] = {{"p", 1}, {"l", 2}, {"f", 3}};

struct Data {
    std::string_view keyword;
    const char* name;
    unsigned lengths; // bit n: a line may have n numbers
    const char* allowed;
    int64_t count = 0;
    int64_t largest = 0; // index to it so far, and where
    uint64_t largest_line = 0;
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_number(std::string_view word) {
    if (!is_digit(word[0]) && word[0] != '-' && word[0] != '+')
        return false;
    if (word.starts_with("+-"))
        return false;
    if (word[0] == '+') // which from_chars() does not know
        word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() &&
           std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

// 0 unless `word` is a whole number without + and leading zeros.
int64_t index_of(std::string_view word) {
    const std::string_view digits = word.substr(word.starts_with('-') ? 1 : 0);
    int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = error == std::errc() && end == word.data() + word.size();
    return whole && !digits.starts_with('0') ? value : 0;
}

class Check {
  public:
    explicit Check(const std::string& file) : file_(file) {}

    Status line(std::string_view line) {
        ++line_;
        const auto control = std::find_if(line.begin(), line.end(), [](char c) {
            return static_cast<unsigned char>(c) < ' ' && c != '\t';
        });
        if (control != line.end())
            return bad(line_, format("byte 0x%02x; allowed are text and tabs",
                                     static_cast<unsigned>(static_cast<unsigned char>(*control))));
        if (line.ends_with('\\'))
            return bad(line_, "goes on after \\; allowed are whole lines");
        std::string_view rest = line;
        const std::string_view keyword = next_word(rest, BLANKS);
        if (keyword.empty() || keyword.starts_with('#'))
            return {};
        if (line.data() != keyword.data())
            return bad(line_,
                       format("blanks before \"%s\"; allowed are none", shown(keyword).c_str()));
        return statement(keyword, rest);
    }

    Status end() const {
        for (const Data& data : data_)
            if (data.largest > data.count)
                return bad_index(data.largest_line, data, data.largest, 1, data.count);
        return {};
    }

  private:
    Status statement(std::string_view keyword, std::string_view rest) {
        for (Data& data : data_)
            if (keyword == data.keyword)
                return numbers(data, rest);
        for (const Element& element : ELEMENTS)
            if (keyword == element.keyword)
                return vertices(element, rest);
        if (std::ranges::find(PASSED_OVER, keyword) != std::end(PASSED_OVER))
            return {};
        std::string known = "v, vt, vn, p, l, f";
        for (std::string_view word : PASSED_OVER)
            known += ", " + std::string(word);
        return bad(line_, format("unknown keyword \"%s\"; known are %s", shown(keyword).c_str(),
                                 known.c_str()));
    }

    Status numbers(Data& data, std::string_view rest) {
        unsigned count = 0;
        for (auto word = next_word(rest, BLANKS); !word.empty();
             word = next_word(rest, BLANKS), ++count)
            if (!is_number(word))
                return bad(line_, format("%s has \"%s\"; allowed are finite numbers that begin "
                                         "with a digit or a sign",
                                         data.name, shown(word).c_str()));
        if (count > 6 || !(data.lengths >> count & 1))
            return bad(line_,
                       format("%s of %u numbers; allowed %s", data.name, count, data.allowed));
        ++data.count;
        return {};
    }

    Status vertices(const Element& element, std::string_view rest) {
        uint64_t count = 0;
        for (auto word = next_word(rest, BLANKS); !word.empty();
             word = next_word(rest, BLANKS), ++count)
            PLAIT_TRY(reference(word));
        if (count < element.least)
            return bad(line_, format("%s of %" PRIu64 " vertices; allowed %u or more",
                                     shown(element.keyword).c_str(), count, element.least));
        return {};
    }

    // v, v/vt, v/vt/vn or v//vn.
    Status reference(const std::string_view word) {
        std::string_view rest = word;
        for (Data& data : data_) {
            const size_t slash = rest.find('/');
            const bool left_out = slash == 0 && data.keyword == "vt";
            if (!left_out)
                PLAIT_TRY(index(data, rest.substr(0, slash)));
            if (slash == rest.npos)
                return {};
            rest.remove_prefix(slash + 1);
        }
        return bad(line_, format("\"%s\" has more than three parts", shown(word).c_str()));
    }

    Status index(Data& data, std::string_view word) {
        const int64_t value = index_of(word);
        if (value == 0)
            return bad(line_, format("%s index is \"%s\"; allowed are whole numbers but 0, without "
                                     "+ and leading zeros",
                                     data.name, shown(word).c_str()));
        if (value < -data.count)
            return bad_index(line_, data, value, -data.count, -1);
        if (value > data.largest) {
            data.largest = value;
            data.largest_line = line_;
        }
        return {};
    }

    Error bad_index(uint64_t line, const Data& data, int64_t value, int64_t first,
                    int64_t last) const {
        const std::string allowed =
            data.count ? format("allowed %" PRId64 " to %" PRId64, first, last) : "there are none";
        return bad(line, format("%s index is %" PRId64 "; %s", data.name, value, allowed.c_str()));
    }

    Error bad(uint64_t line, const std::string& text) const {
        return {PLAIT_BAD_DATA,
                format("%s: line %" PRIu64 ": %s", file_.c_str(), line, text.c_str())};
    }

    const std::string& file_;
    uint64_t line_ = 0;
    Data data_[3] = {{"v", "vertex", 1 << 3 | 1 << 4 | 1 << 6, "3, 4 or 6"}, // xyz, xyzw, xyzrgb
                     {"vt", "texture vertex", 1 << 2 | 1 << 3, "2 or 3"},
                     {"vn", "vertex normal", 1 << 3, "3"}};
};

} // namespace

Status check_obj(std::string_view text, const std::string& file) {
    for (const std::string_view mark : {"\xff\xfe", "\xfe\xff"})
        if (text.starts_with(mark))
            return Error{PLAIT_BAD_DATA, format("%s: is UTF-16; allowed is UTF-8", file.c_str())};
    Check check(file);
    while (!text.empty()) {
        const size_t end = std::min(text.find_first_of("\r\n"), text.size());
        PLAIT_TRY(check.line(text.substr(0, end)));
        text.remove_prefix(end);
        text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
    }
    return check.end();
}

} // namespace plait
