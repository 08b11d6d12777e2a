#include "io/usd/text.hpp"

#include "io/words.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace plait {
namespace {

constexpr std::string_view SKIPPED = " \t\r\n;";
constexpr std::string_view ENDS_WORD = " \t\r\n;()[]{}<>,=\"'@#";

} // namespace

Error UsdText::bad(const std::string& what) const {
    const std::string_view before = text_.substr(0, std::min(at_, text_.size()));
    return {PLAIT_BAD_DATA, format("%s: line %td: %s", file_.c_str(),
                                   std::ranges::count(before, '\n') + 1, what.c_str())};
}

void UsdText::skip_blanks() {
    while (true) {
        at_ = std::min(text_.find_first_not_of(SKIPPED, at_), text_.size());
        if (at_ == text_.size() || text_[at_] != '#')
            return;
        at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
    }
}

bool UsdText::at_end() {
    skip_blanks();
    return at_ == text_.size();
}

bool UsdText::next_is(char c) {
    skip_blanks();
    return at_ < text_.size() && text_[at_] == c;
}

bool UsdText::take(char c) {
    const bool taken = next_is(c);
    at_ += taken;
    return taken;
}

Status UsdText::need(char c) {
    if (take(c))
        return {};
    return bad(at_ < text_.size()
                   ? format("has \"%s\"; allowed is \"%c\"", shown(text_.substr(at_, 8)).c_str(), c)
                   : format("the text ends; allowed is \"%c\"", c));
}

Result<std::string_view> UsdText::word() {
    skip_blanks();
    const size_t end = std::min(text_.find_first_of(ENDS_WORD, at_), text_.size());
    const std::string_view found = text_.substr(at_, end - at_);
    if (found.empty())
        return bad(at_ < text_.size() ? format("has \"%s\"; allowed is a word",
                                               shown(text_.substr(at_, 8)).c_str())
                                      : std::string("the text ends; allowed is a word"));
    at_ = end;
    return found;
}

// One quote or three of it.
bool UsdText::take_quotes(std::string_view& mark) {
    for (const std::string_view quotes : {"\"\"\"", "'''", "\"", "'", "@@@", "@"})
        if (text_.substr(at_).starts_with(quotes)) {
            mark = quotes;
            at_ += quotes.size();
            return true;
        }
    return false;
}

Result<std::string_view> UsdText::string() {
    skip_blanks();
    std::string_view mark;
    if (!take_quotes(mark))
        return bad(
            format("has \"%s\"; allowed is a text in quotes", shown(text_.substr(at_, 8)).c_str()));
    const size_t first = at_;
    for (; at_ < text_.size(); ++at_) {
        if (text_[at_] == '\\' && mark[0] != '@') {
            ++at_;
        } else if (text_.substr(at_).starts_with(mark)) {
            const std::string_view found = text_.substr(first, at_ - first);
            at_ += mark.size();
            return found;
        }
    }
    at_ = first;
    return bad("a text in quotes does not end");
}

Status UsdText::skip_brackets() {
    const size_t first = at_;
    std::string open;
    do {
        if (at_end()) {
            at_ = first;
            return bad(format("\"%c\" is not closed", text_[first]));
        }
        const char c = text_[at_];
        if (c == '"' || c == '\'' || c == '@') {
            PLAIT_TRY(string());
            continue;
        }
        ++at_;
        if (c == '(' || c == '[' || c == '{')
            open.push_back(c == '(' ? ')' : c == '[' ? ']' : '}');
        if (c == ')' || c == ']' || c == '}') {
            if (open.back() != c)
                return bad(format("has \"%c\"; allowed is \"%c\"", c, open.back()));
            open.pop_back();
        }
    } while (!open.empty());
    return {};
}

Status UsdText::skip_value() {
    skip_blanks();
    const char c = at_ < text_.size() ? text_[at_] : '\0';
    if (c == '(' || c == '[' || c == '{')
        return skip_brackets();
    if (c == '"' || c == '\'' || c == '@') {
        PLAIT_TRY(string());
    } else if (c == '<') {
        const size_t end = text_.find('>', at_);
        if (end == text_.npos)
            return bad("\"<\" is not closed");
        at_ = end + 1;
    } else {
        PLAIT_TRY(word());
    }
    return {};
}

template <typename T> Status UsdText::parse(T& value) {
    skip_blanks();
    const char* const first = text_.data() + at_;
    const auto result = std::from_chars(first, text_.data() + text_.size(), value);
    if (result.ec == std::errc())
        at_ += static_cast<size_t>(result.ptr - first);
    else
        return bad(format(
            "has \"%s\"; allowed is a number of its type",
            shown(text_.substr(at_, std::min<size_t>(text_.find_first_of(",)] \n", at_) - at_, 24)))
                .c_str()));
    return {};
}

// Bytes of 32-bit numbers for a list up to `end`: as its commas say, and no more than its text accounts for.
size_t UsdText::list_bytes(char end) const {
    const std::string_view list = text_.substr(at_, text_.find(end, at_) - at_);
    return std::min(4 * static_cast<size_t>(std::ranges::count(list, ',') + 1),
                    2 * list.size() + 4);
}

template <typename Parse> Status UsdText::tuple(size_t width, const Parse& parse_one) {
    PLAIT_TRY(need('('));
    for (size_t i = 0; i < width; ++i) {
        PLAIT_TRY(parse_one());
        if (i + 1 < width)
            PLAIT_TRY(need(','));
    }
    take(',');
    return need(')');
}

// Where `width` is 1 there may be threes all the same, as int3[] and float3[] have them.
template <typename Parse> Status UsdText::elements(size_t width, const Parse& parse_one) {
    while (!take(']')) {
        if (width > 1 || next_is('('))
            PLAIT_TRY(tuple(width > 1 ? width : 3, parse_one));
        else
            PLAIT_TRY(parse_one());
        if (!take(',') && !next_is(']'))
            return need(']');
    }
    return {};
}

Status UsdText::floats(size_t width, ByteWriter& out) {
    PLAIT_TRY(need('['));
    out.reserve(list_bytes(']'));
    return elements(width, [&]() -> Status {
        float value = 0;
        PLAIT_TRY(parse(value));
        out.f32(value);
        return {};
    });
}

Status UsdText::integers(ByteWriter& out) {
    const auto parse_one = [&]() -> Status {
        int32_t value = 0;
        if (next_is('t') || next_is('f')) {
            auto truth = word();
            PLAIT_TRY(truth);
            if (*truth != "true" && *truth != "false")
                return bad(format("has \"%s\"; allowed is a whole number, true or false",
                                  shown(*truth).c_str()));
            value = *truth == "true";
        } else {
            PLAIT_TRY(parse(value));
        }
        out.u32(static_cast<uint32_t>(value));
        return {};
    };
    const bool list = take('[');
    out.reserve(list ? list_bytes(']') : 4);
    return list ? elements(1, parse_one) : parse_one();
}

Status UsdText::number(double& value) {
    return parse(value);
}

Status UsdText::doubles(double* out, size_t most, size_t& count) {
    count = 0;
    size_t open = 0;
    do {
        if (take('(')) {
            ++open;
        } else if (open > 0 && take(')')) {
            --open;
        } else if (open == 0 || !take(',')) {
            double value = 0;
            PLAIT_TRY(parse(value));
            if (count == most)
                return bad(format("has more than %zu numbers", most));
            out[count++] = value;
        }
    } while (open > 0);
    return {};
}

} // namespace plait
