// The words and values of USD text.
#pragma once

#include "io/bytes.hpp"

#include <string>
#include <string_view>

namespace plait {

class UsdText {
  public:
    UsdText(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

    const std::string& file() const { return file_; }
    uint64_t size() const { return text_.size(); }
    size_t place() const { return at_; }
    void go_to(size_t place) { at_ = place; }
    Error bad(const std::string& what) const; // BAD_DATA, at the present line

    bool at_end(); // past blanks and comments
    // Whether `c` comes next, past blanks and comments; if so it is taken.
    bool take(char c);
    bool next_is(char c);
    Status need(char c);
    // A keyword, type, name or number; BAD_DATA where none comes.
    Result<std::string_view> word();
    // What stands in quotes, as it stands there.
    Result<std::string_view> string();
    // A value of any kind: list, tuple, dictionary, text, asset, path, word.
    Status skip_value();
    // A parenthesis behind a property or prim, if there is one.
    Status skip_metadata() { return next_is('(') ? skip_value() : Status(); }

    // [(x, y, z), ...] or [x, ...], each element with `width` numbers; of width 1 threes, too.
    Status floats(size_t width, ByteWriter& out);
    // Whole numbers and truth values, or threes of them, as 32-bit numbers.
    Status integers(ByteWriter& out);
    Status number(double& value);
    // Numbers of a value in whatever parentheses, at most `most`.
    Status doubles(double* out, size_t most, size_t& count);

  private:
    void skip_blanks();
    bool take_quotes(std::string_view& mark);
    Status skip_brackets();
    template <typename T> Status parse(T& value);
    template <typename Parse> Status tuple(size_t width, const Parse& parse_one);
    template <typename Parse> Status elements(size_t width, const Parse& parse_one);
    size_t list_bytes(char end) const;

    std::string_view text_;
    std::string file_;
    size_t at_ = 0;
};

} // namespace plait
