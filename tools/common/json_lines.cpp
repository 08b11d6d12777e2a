#include "common/json_lines.hpp"

#include <nlohmann/json.hpp>

#include <iterator>
#include <vector>

namespace common {

namespace {

// Counts the lines it has passed.
struct CountingIterator {
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char* at;
    size_t* line;

    reference operator*() const { return *at; }
    CountingIterator& operator++() {
        *line += *at == '\n';
        ++at;
        return *this;
    }
    CountingIterator operator++(int) {
        const CountingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountingIterator& other) const { return at == other.at; }
};

// Follows the parser through the document and notes where keys stand.
class Finder final : public nlohmann::json_sax<nlohmann::json> {
  public:
    explicit Finder(const size_t& line) : line_(line) {}

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_object(size_t) override { return open(false); }
    bool start_array(size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        levels_.back().key = name;
        const auto [known, fresh] = levels_.back().keys.emplace(name, line_);
        if (!fresh)
            duplicates.push_back({path(), known->second, line_});
        lines.emplace(path(), line_);
        return true;
    }
    bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override {
        lines.clear();
        duplicates.clear();
        return false;
    }

    JsonLines lines;
    std::vector<DuplicateKey> duplicates;

  private:
    struct Level {
        bool list;
        size_t index;
        std::string key;
        std::map<std::string, size_t> keys; // of an object so far, with their lines
    };

    std::string path() const {
        std::string path;
        for (const Level& level : levels_)
            if (level.list) {
                path += '[';
                path += std::to_string(level.index);
                path += ']';
            } else {
                path += path.empty() ? "" : ".";
                path += level.key;
            }
        return path;
    }
    bool value() {
        if (!levels_.empty())
            ++levels_.back().index;
        return true;
    }
    bool open(bool list) {
        if (!levels_.empty() && levels_.back().list)
            lines.emplace(path(), line_);
        levels_.push_back({list, 0, "", {}});
        return true;
    }
    bool close() {
        levels_.pop_back();
        return value();
    }

    const size_t& line_;
    std::vector<Level> levels_;
};

} // namespace

JsonLines find_lines(const std::string& text, std::vector<DuplicateKey>& duplicates) {
    size_t line = 1;
    Finder finder(line);
    const CountingIterator first{text.data(), &line}, last{text.data() + text.size(), &line};
    if (!nlohmann::json::sax_parse(first, last, &finder, nlohmann::json::input_format_t::json, true,
                                   true))
        finder.lines.clear();
    duplicates = std::move(finder.duplicates);
    return std::move(finder.lines);
}

} // namespace common
