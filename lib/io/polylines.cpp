// Polylines of OBJ (`l`). Programs write a strand as one line of all its vertices or as one line per
// segment, in any order and from either end: lines that share a vertex are one strand, but for those of
// more than a segment that begin, or end, at the same.
#include "io/chains.hpp"
#include "io/file.hpp"
#include "io/formats.hpp"
#include "io/obj_check.hpp"
#include "io/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cinttypes>
#include <limits>

namespace plait {
namespace {

constexpr uint32_t NONE = Chains::NONE;

using Point = std::array<float, 3>;

// Of text that check_obj() has passed.
double number_of(std::string_view word) {
    word.remove_prefix(word.starts_with('+') ? 1 : 0);
    double value = 0;
    std::from_chars(word.data(), word.data() + word.size(), value);
    return value;
}

template <typename Visit> void for_each_line(std::string_view text, const Visit& visit) {
    for (uint64_t number = 1; !text.empty(); ++number) {
        const size_t end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view rest = text.substr(0, end);
        const std::string_view keyword = next_word(rest, BLANKS);
        visit(number, keyword, rest);
        text.remove_prefix(end);
        text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
    }
}

class Lines {
  public:
    Lines(const std::string& file, const ReadOptions& options)
        : file_(file), options_(options), points_(options.memory), chains_(options.memory),
          shared_(options.memory), points_only_(options.memory), line_(options.memory) {}

    Status read(std::string_view text) {
        for_each_line(text, [&](uint64_t, std::string_view keyword, std::string_view rest) {
            if (keyword == "v")
                add_point(rest);
        });
        chains_.resize(points_.size());
        shared_.resize(points_.size());
        Status status;
        size_t points_so_far = 0;
        for_each_line(text, [&](uint64_t number, std::string_view keyword, std::string_view rest) {
            points_so_far += keyword == "v";
            if (keyword == "l" && status)
                status = add_line(number, rest, points_so_far);
        });
        return status;
    }

    Result<StrandSet> strands() {
        StrandSet strands(options_.memory);
        const uint32_t ring = chains_.for_each([&](std::span<const uint32_t> way) {
            for (const uint32_t vertex : way)
                push(vertex, strands);
            strands.vertex_counts.push_back(static_cast<uint32_t>(way.size()));
        });
        if (ring != NONE)
            return Error{PLAIT_BAD_DATA,
                         format("%s: the lines of vertex %u close a ring; allowed are strands "
                                "with two ends",
                                file_.c_str(), ring + 1)};
        for (const uint32_t point : points_only_) {
            push(point, strands);
            push(point, strands);
            strands.vertex_counts.push_back(2);
        }
        if (strands.vertex_counts.empty())
            return Error{PLAIT_BAD_DATA, format("%s: has no polylines", file_.c_str())};
        return strands;
    }

  private:
    void add_point(std::string_view rest) {
        double values[6] = {};
        size_t count = 0;
        for (auto word = next_word(rest, BLANKS); !word.empty() && count < 6;
             word = next_word(rest, BLANKS))
            values[count++] = number_of(word);
        const double share = count == 4 ? 1 / values[3] : 1; // x y z w; more: a colour
        points_.push_back({static_cast<float>(values[0] * share),
                           static_cast<float>(values[1] * share),
                           static_cast<float>(values[2] * share)});
    }

    // Negative indices count from the vertices so far.
    static uint32_t vertex_of(std::string_view word, size_t points_so_far) {
        int64_t index = 0;
        std::from_chars(word.data(), word.data() + word.find_first_of("/ \t"), index);
        return static_cast<uint32_t>(index > 0 ? index - 1 : int64_t(points_so_far) + index);
    }

    Status add_line(uint64_t number, std::string_view rest, size_t points_so_far) {
        const uint32_t before = line_.empty() ? NONE : line_.back();
        line_.clear();
        for (auto word = next_word(rest, BLANKS); !word.empty(); word = next_word(rest, BLANKS))
            if (const uint32_t vertex = vertex_of(std::string(word) + ' ', points_so_far);
                line_.empty() || line_.back() != vertex)
                line_.push_back(vertex);
        // a line that goes on where the one before ended, at a vertex of its own
        if (before != NONE && line_.front() != before && chains_.is_free(line_.front()) &&
            points_[line_.front()] == points_[before])
            line_.front() = before;
        if (line_.size() == 1)
            points_only_.push_back(line_.front());
        if (line_.size() > 2 && line_.front() != line_.back()) {
            give_own(line_.front(), 1);
            give_own(line_.back(), -1);
        }
        for (size_t i = 0; i + 1 < line_.size(); ++i) {
            const int grows = line_.size() > 2 ? 1 : 0;
            PLAIT_TRY(link(number, line_[i], line_[i + 1], grows));
            PLAIT_TRY(link(number, line_[i + 1], line_[i], -grows));
        }
        return {};
    }

    // The end of a line that is that of another, too, is a vertex of its own: they are two strands.
    void give_own(uint32_t& vertex, int end) {
        if (chains_.is_end(vertex) != end)
            return;
        shared_[vertex] = true;
        points_.push_back(points_[vertex]);
        vertex = static_cast<uint32_t>(points_.size() - 1);
        chains_.resize(points_.size());
        shared_.resize(points_.size());
    }

    Status link(uint64_t number, uint32_t from, uint32_t to, int grows) {
        if (!shared_[from] && chains_.link(from, to, grows))
            return {};
        return Error{PLAIT_BAD_DATA,
                     format("%s: line %" PRIu64 ": vertex %u is of three lines; allowed are two, "
                            "which are one strand, and any number that all begin or all end there",
                            file_.c_str(), number, from + 1)};
    }

    void push(uint32_t vertex, StrandSet& strands) const {
        for (const float c : points_[vertex])
            strands.positions.push_back(options_.scale * c);
    }

    const std::string& file_;
    const ReadOptions& options_;
    std::pmr::vector<Point> points_;
    Chains chains_;
    std::pmr::vector<bool> shared_;          // by strands that begin, or end, there
    std::pmr::vector<uint32_t> points_only_; // lines of one place: strands without length
    std::pmr::vector<uint32_t> line_;        // in hand
};

} // namespace

Result<StrandSet> read_polylines(const std::string& path, const ReadOptions& options) {
    auto text = read_file(path, options.memory);
    PLAIT_TRY(text);
    return read_polylines(std::move(*text), path, options);
}

Result<StrandSet> read_polylines(ByteVector bytes, const std::string& file,
                                 const ReadOptions& options) {
    const std::string_view text =
        after_mark({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    PLAIT_TRY(check_obj(text, file));
    Lines lines(file, options);
    PLAIT_TRY(lines.read(text));
    return lines.strands();
}

} // namespace plait
