// Strands of PLY: points that edges join, or runs of points of one colour.
#include "io/chains.hpp"
#include "io/curves/notes.hpp"
#include "io/formats.hpp"
#include "io/points/ply_header.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace plait {
namespace {

// Where the values that are used stand among an element's properties.
template <size_t N> using Places = std::array<std::optional<size_t>, N>;

template <size_t N>
Places<N> places_of(const PlyElement& element, const std::string_view (&names)[N]) {
    Places<N> places;
    for (size_t i = 0; i < element.properties.size(); ++i)
        for (size_t k = 0; k < N; ++k)
            if (element.properties[i].name == names[k] && !element.properties[i].is_list())
                places[k] = i;
    return places;
}

template <size_t N> bool has_all(const Places<N>& places) {
    return std::ranges::all_of(places, [](const auto& place) { return place.has_value(); });
}

class Ply {
  public:
    Ply(const ByteReader& file, const ReadOptions& options)
        : file_(file), options_(options), points_(options.memory), starts_(options.memory),
          chains_(options.memory), strands_(options.memory) {}

    Result<StrandSet> read() {
        auto header = read_ply_header(file_);
        PLAIT_TRY(header);
        format_ = header->format;
        at_ = header->end;
        for (const PlyElement& element : header->elements)
            PLAIT_TRY(read_element(element));
        if (points_.empty())
            return bad("has no vertices");
        PLAIT_TRY(check_end());
        if (has_edges_)
            PLAIT_TRY(take_chains());
        else
            PLAIT_TRY(take_runs());
        if (options_.notes)
            *options_.notes = notes_.take();
        return std::move(strands_);
    }

  private:
    Error bad(const std::string& text) const {
        return {PLAIT_BAD_DATA, file_.file() + ": " + text};
    }

    // Each value takes a byte or, of text, two with the blank between: an element cannot be longer.
    Status check_room(const PlyElement& element) const {
        uint64_t least = 0;
        for (const PlyProperty& property : element.properties)
            least += format_ == PlyFormat::TEXT ? 2
                     : property.is_list()       ? property.count.bytes
                                                : property.type.bytes;
        if (element.count == 0 || least == 0 || element.count <= (file_.size() - at_ + 1) / least)
            return {};
        return bad(format("element %s: %" PRIu64 " of at least %" PRIu64
                          " bytes do not fit in what is left of the file of %" PRIu64 " bytes",
                          shown(element.name).c_str(), element.count, least, file_.size()));
    }

    // Values left over: of a row too many or, of text, of a row too long, which has moved all that follow.
    Status check_end() const {
        std::string_view rest = file_.view(at_, file_.size() - at_);
        if (format_ != PlyFormat::TEXT && !rest.empty())
            return file_.bad(
                at_, format("%zu bytes follow the last element; allowed is the end of the file",
                            rest.size()));
        const std::string_view word = next_word(rest, " \t\r\n");
        if (!word.empty())
            return file_.bad(
                at_, format("\"%s\" follows the last element; allowed is the end of the file",
                            shown(word).c_str()));
        return {};
    }

    Status read_element(const PlyElement& element) {
        PLAIT_TRY(check_room(element));
        if (element.properties.empty())
            return {};
        if (element.name == "vertex")
            return read_vertices(element);
        if (element.name == "edge")
            return read_edges(element);
        if (element.count > 0)
            notes_.add(format("%" PRIu64 " elements %s are not read", element.count,
                              shown(element.name).c_str()));
        return each(element, [](uint64_t, std::span<const double>) { return Status(); });
    }

    // Calls `visit(index, values)` with the values of each, of lists 0.
    template <typename Visit> Status each(const PlyElement& element, const Visit& visit) {
        std::vector<double> values(element.properties.size());
        for (uint64_t i = 0; i < element.count; ++i) {
            for (size_t p = 0; p < values.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                if (property.is_list())
                    PLAIT_TRY(skip_list(element, i, property));
                else
                    PLAIT_TRY(value(element, i, property.type, values[p]));
            }
            PLAIT_TRY(visit(i, values));
        }
        return {};
    }

    Status skip_list(const PlyElement& element, uint64_t index, const PlyProperty& property) {
        double count = 0, skipped = 0;
        PLAIT_TRY(value(element, index, property.count, count));
        for (double i = 0; i < count; ++i)
            PLAIT_TRY(value(element, index, property.type, skipped));
        return {};
    }

    Status value(const PlyElement& element, uint64_t index, const PlyType& type, double& out) {
        if (format_ == PlyFormat::TEXT)
            return word(element, index, out);
        PLAIT_TRY(file_.check_range(shown(element.name).c_str(), at_, at_, 1, type.bytes));
        uint64_t bits = 0;
        for (uint32_t b = 0; b < type.bytes; ++b) {
            const uint32_t place = format_ == PlyFormat::BIG ? type.bytes - 1 - b : b;
            bits |= uint64_t{file_.u8(at_ + b)} << 8 * place;
        }
        at_ += type.bytes;
        const uint32_t unused = 64 - 8 * type.bytes;
        if (type.is_float)
            out = type.bytes == 8
                      ? std::bit_cast<double>(bits)
                      : static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(bits)));
        else
            out = type.has_sign
                      ? static_cast<double>(static_cast<int64_t>(bits << unused) >> unused)
                      : static_cast<double>(bits);
        return {};
    }

    Status word(const PlyElement& element, uint64_t index, double& out) {
        std::string_view rest = file_.view(at_, file_.size() - at_);
        const size_t before = rest.size();
        std::string_view found = next_word(rest, " \t\r\n");
        at_ += before - rest.size();
        const std::string_view text = found;
        found.remove_prefix(found.starts_with('+') ? 1 : 0);
        const auto result = std::from_chars(found.data(), found.data() + found.size(), out);
        if (result.ec == std::errc() && result.ptr == found.data() + found.size())
            return {};
        return file_.bad(at_, format("%s %" PRIu64 " has \"%s\"; allowed is a number",
                                     shown(element.name).c_str(), index, shown(text).c_str()));
    }

    Status read_vertices(const PlyElement& element) {
        constexpr std::string_view position[] = {"x", "y", "z"},
                                   colour[] = {"red", "green", "blue"};
        const auto xyz = places_of(element, position);
        const auto rgb = places_of(element, colour);
        if (!has_all(xyz))
            return bad("element vertex has not all of the properties x, y and z");
        has_colours_ = has_all(rgb);
        points_.reserve(static_cast<size_t>(3 * element.count));
        std::array<double, 3> run{}; // the colour of the strand in hand
        return each(element, [&](uint64_t i, std::span<const double> values) -> Status {
            for (const auto& place : xyz)
                points_.push_back(options_.scale * static_cast<float>(values[*place]));
            if (!has_colours_)
                return {};
            const std::array<double, 3> here{values[*rgb[0]], values[*rgb[1]], values[*rgb[2]]};
            if (i == 0 || here != run)
                starts_.push_back(static_cast<uint32_t>(i));
            run = here;
            return {};
        });
    }

    Status read_edges(const PlyElement& element) {
        constexpr std::string_view names[] = {"vertex1", "vertex2"};
        const auto ends = places_of(element, names);
        const uint64_t count = points_.size() / 3;
        if (!has_all(ends) || count == 0)
            return bad(
                "element edge has not both of the properties vertex1 and vertex2, or comes before "
                "the vertices");
        has_edges_ = true;
        chains_.resize(static_cast<size_t>(count));
        return each(element, [&](uint64_t i, std::span<const double> values) -> Status {
            uint32_t vertex[2];
            for (size_t k = 0; k < 2; ++k) {
                const double index = values[*ends[k]];
                if (!(index >= 0 && index < static_cast<double>(count)) ||
                    std::floor(index) != index)
                    return bad(format("edge %" PRIu64 ": vertex%zu is %g; allowed is 0 to %" PRIu64,
                                      i, k + 1, index, count - 1));
                vertex[k] = static_cast<uint32_t>(index);
            }
            if (vertex[0] == vertex[1])
                return bad(format("edge %" PRIu64 ": joins vertex %u to itself", i, vertex[0]));
            for (size_t k = 0; k < 2; ++k)
                if (!chains_.link(vertex[k], vertex[1 - k], 0))
                    return bad(format("edge %" PRIu64
                                      ": vertex %u is of three edges; allowed are two, "
                                      "which are one strand",
                                      i, vertex[k]));
            return {};
        });
    }

    void push(uint32_t vertex) {
        for (size_t k = 0; k < 3; ++k)
            strands_.positions.push_back(points_[3 * size_t{vertex} + k]);
    }

    Status take_chains() {
        size_t taken = 0;
        strands_.positions.reserve(points_.size());
        const uint32_t ring = chains_.for_each([&](std::span<const uint32_t> way) {
            for (const uint32_t vertex : way)
                push(vertex);
            taken += way.size();
            strands_.vertex_counts.push_back(static_cast<uint32_t>(way.size()));
        });
        if (ring != Chains::NONE)
            return bad(format(
                "the edges of vertex %u close a ring; allowed are strands with two ends", ring));
        if (strands_.vertex_counts.empty())
            return bad("has no edges");
        if (const size_t alone = points_.size() / 3 - taken; alone > 0)
            notes_.add(format("%zu vertices without an edge are not read", alone));
        return {};
    }

    Status take_runs() {
        const auto count = static_cast<uint32_t>(points_.size() / 3);
        if (!has_colours_)
            return bad(
                "has points, and neither edges (vertex1, vertex2) nor colours (red, green, blue) "
                "that say which are of one strand");
        if (starts_.size() == count && count > 1)
            return bad("has points without edges, and no two of one colour in a row, which would "
                       "be of one "
                       "strand");
        for (size_t s = 0; s < starts_.size(); ++s)
            strands_.vertex_counts.push_back((s + 1 < starts_.size() ? starts_[s + 1] : count) -
                                             starts_[s]);
        strands_.positions = std::move(points_);
        notes_.add(format("its %zu strands are runs of points of one colour", starts_.size()));
        return {};
    }

    const ByteReader& file_;
    const ReadOptions& options_;
    PlyFormat format_ = PlyFormat::TEXT;
    uint64_t at_ = 0;
    std::pmr::vector<float> points_;
    std::pmr::vector<uint32_t> starts_; // of runs of one colour
    Chains chains_;
    StrandSet strands_;
    Notes notes_;
    bool has_colours_ = false, has_edges_ = false;
};

} // namespace

Result<StrandSet> read_ply(const ByteReader& file, const ReadOptions& options) {
    return Ply(file, options).read();
}

} // namespace plait
