// Cem Yuksel's .hair: strands of any number of segments, with a thickness per point.
#include "io/formats.hpp"

#include <limits>

namespace plait {
namespace {

constexpr uint64_t HEADER_SIZE = 128;
constexpr uint64_t HAIR_STRANDS_AT = 4, POINTS_AT = 8, FLAGS_AT = 12, SEGMENTS_AT = 16,
                   THICKNESS_AT = 20;
enum Flags : uint32_t {
    HAS_SEGMENTS = 1,
    HAS_POINTS = 2,
    HAS_THICKNESS = 4,
    HAS_TRANSPARENCY = 8,
    HAS_COLOURS = 16,
    ALL_FLAGS = 31
};
// What usual writers leave in the header's thickness where nobody set one.
constexpr float NOT_GIVEN = 1.0f;
constexpr uint32_t MAX_SEGMENTS = 65535; // a strand's are a u16

struct HairContents {
    uint64_t strands;
    uint64_t points;
    uint64_t segments_at; // 0: every strand has `segments`
    uint64_t points_at;
    uint64_t thickness_at; // 0: every strand has `thickness`
    uint32_t segments;
    float thickness;
};

Status check_header(const ByteReader& file) {
    PLAIT_TRY(file.check_range("header", 0, 0, 1, HEADER_SIZE));
    if (file.text(0, 4) != "HAIR")
        return file.bad(0, "signature is not HAIR");
    for (uint64_t at : {HAIR_STRANDS_AT, POINTS_AT})
        if (file.u32(at) == 0)
            return file.bad(at, format("number of %s is 0; allowed 1 to 4294967295",
                                       at == HAIR_STRANDS_AT ? "strands" : "points"));
    const uint32_t flags = file.u32(FLAGS_AT);
    if (!(flags & HAS_POINTS) || (flags & ~ALL_FLAGS))
        return file.bad(FLAGS_AT, format("flags are 0x%" PRIx32 "; bit 1 (points) must be set and "
                                         "bits 5 to 31 clear",
                                         flags));
    return {};
}

// Claims the next array of the file, if the header says it is there; returns its offset or 0.
Result<uint64_t> next_array(const ByteReader& file, const char* what, uint32_t flag, uint64_t count,
                            uint64_t element, uint64_t& end) {
    if (!(file.u32(FLAGS_AT) & flag))
        return uint64_t{0};
    const uint64_t field = flag == HAS_SEGMENTS ? HAIR_STRANDS_AT : POINTS_AT;
    PLAIT_TRY(file.check_range(what, field, end, count, element));
    return std::exchange(end, end + count * element);
}

// The strands' points, segment by segment, must be exactly the points there are.
Status check_points(const ByteReader& file, const HairContents& contents) {
    uint64_t points = contents.strands * (uint64_t{contents.segments} + 1);
    if (contents.segments_at) {
        points = contents.strands;
        for (uint64_t s = 0; s < contents.strands; ++s)
            points += file.u16(contents.segments_at + 2 * s);
    }
    if (points == contents.points)
        return {};
    return file.bad(POINTS_AT, format("number of points is %" PRIu64 "; the strands' segments need "
                                      "%" PRIu64,
                                      contents.points, points));
}

Result<HairContents> read_hair_contents(const ByteReader& file) {
    PLAIT_TRY(check_header(file));
    uint64_t end = HEADER_SIZE;
    const uint64_t strands = file.u32(HAIR_STRANDS_AT), points = file.u32(POINTS_AT);
    auto segments = next_array(file, "segments", HAS_SEGMENTS, strands, 2, end);
    PLAIT_TRY(segments);
    auto positions = next_array(file, "points", HAS_POINTS, points, 12, end);
    PLAIT_TRY(positions);
    auto thickness = next_array(file, "thickness", HAS_THICKNESS, points, 4, end);
    PLAIT_TRY(thickness);
    PLAIT_TRY(next_array(file, "transparency", HAS_TRANSPARENCY, points, 4, end));
    PLAIT_TRY(next_array(file, "colours", HAS_COLOURS, points, 12, end));
    const HairContents contents = {strands,
                                   points,
                                   *segments,
                                   *positions,
                                   *thickness,
                                   file.u32(SEGMENTS_AT),
                                   file.f32(THICKNESS_AT)};
    PLAIT_TRY(check_points(file, contents));
    return contents;
}

void read_vertex_counts(const ByteReader& file, const HairContents& contents, StrandSet& strands) {
    strands.vertex_counts.assign(static_cast<size_t>(contents.strands), contents.segments + 1);
    if (contents.segments_at)
        for (size_t s = 0; s < strands.vertex_counts.size(); ++s)
            strands.vertex_counts[s] = file.u16(contents.segments_at + 2 * s) + 1u;
}

// A strand's thickness is the mean of its points'.
void read_thickness(const ByteReader& file, const HairContents& contents, float scale,
                    StrandSet& strands) {
    uint64_t at = contents.thickness_at;
    strands.thickness.reserve(strands.vertex_counts.size());
    for (uint32_t vertices : strands.vertex_counts) {
        double sum = 0;
        for (uint32_t v = 0; v < vertices; ++v, at += 4)
            sum += static_cast<double>(file.f32(at));
        strands.thickness.push_back(scale * static_cast<float>(sum / vertices));
    }
}

Status check_writable(const StrandSet& strands) {
    constexpr uint64_t MAX_COUNT = std::numeric_limits<uint32_t>::max();
    const uint64_t count = strands.vertex_counts.size(), points = strands.positions.size() / 3;
    if (count == 0 || count > MAX_COUNT || points > MAX_COUNT)
        return Error{PLAIT_UNSUPPORTED, format("%" PRIu64 " strands of %" PRIu64 " points; a .hair "
                                               "file holds 1 to 4294967295 of each",
                                               count, points)};
    for (size_t s = 0; s < count; ++s)
        if (strands.vertex_counts[s] == 0 || strands.vertex_counts[s] > MAX_SEGMENTS + 1)
            return Error{PLAIT_UNSUPPORTED, format("strand %zu has %" PRIu32
                                                   " vertices; a .hair file allows 1 to %" PRIu32,
                                                   s, strands.vertex_counts[s], MAX_SEGMENTS + 1)};
    return {};
}

void write_header(ByteWriter& out, const StrandSet& strands) {
    uint32_t flags = HAS_SEGMENTS | HAS_POINTS;
    if (!strands.thickness.empty())
        flags |= HAS_THICKNESS;
    out.text("HAIR");
    out.u32(static_cast<uint32_t>(strands.vertex_counts.size()));
    out.u32(static_cast<uint32_t>(strands.positions.size() / 3));
    out.u32(flags);
    out.u32(0); // segments of a strand, were there no array of them
    for (float value : {0.0f, 0.0f, 0.0f, 0.0f, 0.0f}) // thickness, transparency, colour: unknown
        out.f32(value);
    out.text("plait");
    out.zeros(HEADER_SIZE - out.size());
}

} // namespace

Result<StrandSet> read_hair(const ByteReader& file, const ReadOptions& options) {
    auto contents = read_hair_contents(file);
    PLAIT_TRY(contents);
    StrandSet strands(options.memory);
    read_vertex_counts(file, *contents, strands);
    strands.positions.reserve(static_cast<size_t>(contents->points * 3));
    for (uint64_t i = 0; i < contents->points * 3; ++i)
        strands.positions.push_back(options.scale * file.f32(contents->points_at + 4 * i));
    if (contents->thickness_at)
        read_thickness(file, *contents, options.scale, strands);
    else if (contents->thickness > 0 && contents->thickness != NOT_GIVEN)
        strands.thickness.assign(strands.vertex_counts.size(), options.scale * contents->thickness);
    return strands;
}

Result<ByteVector> write_hair(const StrandSet& strands) {
    PLAIT_TRY(check_writable(strands));
    ByteWriter out(strands.positions.get_allocator().resource());
    write_header(out, strands);
    for (uint32_t vertices : strands.vertex_counts)
        out.u16(static_cast<uint16_t>(vertices - 1));
    for (float value : strands.positions)
        out.f32(value);
    for (size_t s = 0; s < strands.thickness.size(); ++s)
        for (uint32_t v = 0; v < strands.vertex_counts[s]; ++v)
            out.f32(strands.thickness[s]);
    return std::move(out).take();
}

} // namespace plait
