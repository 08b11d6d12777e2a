#include "io/points/ply_header.hpp"

#include "io/words.hpp"

#include <algorithm>
#include <charconv>

namespace plait {
namespace {

constexpr size_t MOST_PROPERTIES = 1024; // of all elements

struct NamedType {
    std::string_view name, other;
    PlyType type;
};

constexpr NamedType TYPES[] = {
    {"char", "int8", {1, true, false}},    {"uchar", "uint8", {1, false, false}},
    {"short", "int16", {2, true, false}},  {"ushort", "uint16", {2, false, false}},
    {"int", "int32", {4, true, false}},    {"uint", "uint32", {4, false, false}},
    {"float", "float32", {4, true, true}}, {"double", "float64", {8, true, true}}};

class Header {
  public:
    explicit Header(const ByteReader& file) : file_(file) {}

    Result<PlyHeader> read() {
        if (std::string_view first; !next_line(first) || first != "ply")
            return bad("does not begin with \"ply\"");
        bool has_format = false;
        for (std::string_view line; next_line(line);) {
            const std::string_view keyword = next_word(line, " \t");
            if (keyword == "end_header" && has_format) {
                header_.end = at_;
                return std::move(header_);
            }
            if (keyword == "format")
                has_format = true;
            PLAIT_TRY(read_line(keyword, line));
        }
        return bad(has_format ? "the header does not end" : "no format is given");
    }

  private:
    Error bad(const std::string& text) const {
        return {PLAIT_BAD_DATA,
                format("%s: line %" PRIu64 ": %s", file_.file().c_str(), line_, text.c_str())};
    }

    bool next_line(std::string_view& line) {
        const std::string_view rest = file_.view(at_, file_.size() - at_);
        const size_t end = rest.find('\n');
        if (end == rest.npos)
            return false;
        line = rest.substr(0, end);
        line.remove_suffix(line.ends_with('\r') ? 1 : 0);
        at_ += end + 1;
        ++line_;
        return true;
    }

    Status read_line(std::string_view keyword, std::string_view rest) {
        if (keyword == "comment" || keyword == "obj_info")
            return {};
        if (keyword == "format")
            return read_format(next_word(rest, " \t"));
        if (keyword == "element")
            return read_element(rest);
        if (keyword == "property" && !header_.elements.empty())
            return read_property(rest);
        return bad(
            format("has \"%s\"; allowed are comment, obj_info, format, element and, behind an "
                   "element, property",
                   shown(keyword).c_str()));
    }

    Status read_format(std::string_view name) {
        constexpr std::string_view names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
        const auto found = std::ranges::find(names, name);
        if (found == std::end(names))
            return bad(format("format is \"%s\"; allowed are ascii, binary_little_endian and "
                              "binary_big_endian",
                              shown(name).c_str()));
        header_.format = static_cast<PlyFormat>(found - std::begin(names));
        return {};
    }

    Status read_element(std::string_view rest) {
        PlyElement element;
        element.name = next_word(rest, " \t");
        for (const PlyElement& other : header_.elements)
            if (other.name == element.name)
                return bad(format("element \"%s\" comes twice", shown(element.name).c_str()));
        const std::string_view number = next_word(rest, " \t");
        const auto result =
            std::from_chars(number.data(), number.data() + number.size(), element.count);
        if (result.ec != std::errc() || result.ptr != number.data() + number.size() ||
            element.count > 0xffffffff)
            return bad(format("number of elements is \"%s\"; allowed is 0 to 4294967295",
                              shown(number).c_str()));
        if (++properties_ > MOST_PROPERTIES)
            return bad(format("has more than %zu elements and properties", MOST_PROPERTIES));
        header_.elements.push_back(element);
        return {};
    }

    Status read_type(std::string_view name, PlyType& type) const {
        for (const NamedType& known : TYPES)
            if (name == known.name || name == known.other) {
                type = known.type;
                return {};
            }
        return bad(
            format("type is \"%s\"; allowed are char, uchar, short, ushort, int, uint, float and "
                   "double",
                   shown(name).c_str()));
    }

    Status read_property(std::string_view rest) {
        PlyProperty property;
        std::string_view word = next_word(rest, " \t");
        if (word == "list") {
            PLAIT_TRY(read_type(next_word(rest, " \t"), property.count));
            if (property.count.is_float)
                return bad("the number of a list's values is no whole number");
            word = next_word(rest, " \t");
        }
        PLAIT_TRY(read_type(word, property.type));
        property.name = next_word(rest, " \t");
        if (++properties_ > MOST_PROPERTIES)
            return bad(format("has more than %zu elements and properties", MOST_PROPERTIES));
        header_.elements.back().properties.push_back(property);
        return {};
    }

    const ByteReader& file_;
    PlyHeader header_;
    uint64_t at_ = 0, line_ = 0;
    size_t properties_ = 0;
};

} // namespace

Result<PlyHeader> read_ply_header(const ByteReader& file) {
    return Header(file).read();
}

} // namespace plait
