// TressFX strands, versions 3 and 4. All strands of a file have the same number of vertices.
#include "io/formats.hpp"

#include <array>
#include <limits>

namespace plait {
namespace {

// One array of the file: where in the header its offset is, and what an element is.
struct Section {
    const char* name;
    uint64_t header_offset;
    uint32_t floats;
    bool per_vertex;
};

enum SectionId { POSITIONS, STRAND_UV, VERTEX_UV, THICKNESS, VERTEX_COLOUR, SECTIONS };

struct Version {
    uint64_t header_size;
    std::array<Section, SECTIONS> sections;
};

constexpr Version VERSION_3 = {296,
                               {{{"positions", 144, 3, true},
                                 {"strand UV", 152, 2, false},
                                 {"vertex UV", 164, 2, true},
                                 {"strand thickness", 148, 1, false},
                                 {"vertex colour", 156, 4, true}}}};
constexpr Version VERSION_4 = {160,
                               {{{"positions", 12, 4, true},
                                 {"strand UV", 16, 2, false},
                                 {"vertex UV", 20, 2, true},
                                 {"strand thickness", 24, 1, false},
                                 {"vertex colour", 28, 4, true}}}};
constexpr uint64_t TFX_STRANDS_AT = 4, VERTICES_AT = 8;

struct TfxContents {
    const Version* version;
    uint64_t strands;
    uint64_t vertices; // all strands together
    uint32_t vertices_per_strand;
    std::array<uint64_t, SECTIONS> offsets; // 0: absent
};

Result<const Version*> read_version(const ByteReader& file) {
    PLAIT_TRY(file.check_range("version", 0, 0, 1, 4));
    const float version = file.f32(0);
    if (!(version >= 3.0f && version < 5.0f))
        return file.bad(0, format("version is %g; allowed 3 and 4", static_cast<double>(version)));
    const Version* layout = version < 4.0f ? &VERSION_3 : &VERSION_4;
    PLAIT_TRY(file.check_range("header", 0, 0, layout->header_size, 1));
    return layout;
}

Result<uint32_t> read_count(const ByteReader& file, const char* what, uint64_t at) {
    const uint32_t count = file.u32(at);
    if (count == 0)
        return file.bad(at, format("%s is 0; allowed 1 to %" PRIu32, what,
                                   std::numeric_limits<uint32_t>::max()));
    return count;
}

Result<uint64_t> read_offset(const ByteReader& file, const TfxContents& contents, SectionId id) {
    const Section& section = contents.version->sections[id];
    const uint64_t at = section.header_offset;
    const uint64_t offset = file.u32(at);
    if (offset == 0 && id != POSITIONS)
        return offset;
    if (offset < contents.version->header_size)
        return file.bad(at, format("offset of %s is %" PRIu64 ", inside the header of %" PRIu64
                                   " bytes",
                                   section.name, offset, contents.version->header_size));
    const uint64_t count = section.per_vertex ? contents.vertices : contents.strands;
    PLAIT_TRY(file.check_range(section.name, at, offset, count, section.floats * sizeof(float)));
    return offset;
}

// Everything the header says, checked against the size of the file.
Result<TfxContents> read_tfx_contents(const ByteReader& file) {
    auto version = read_version(file);
    PLAIT_TRY(version);
    auto strands = read_count(file, "number of strands", TFX_STRANDS_AT);
    PLAIT_TRY(strands);
    auto vertices = read_count(file, "number of vertices per strand", VERTICES_AT);
    PLAIT_TRY(vertices);
    TfxContents contents = {*version, *strands, uint64_t{*strands} * *vertices, *vertices, {}};
    for (int id = POSITIONS; id < SECTIONS; ++id) {
        auto offset = read_offset(file, contents, static_cast<SectionId>(id));
        PLAIT_TRY(offset);
        contents.offsets[id] = *offset;
    }
    return contents;
}

// The first `kept` floats of each element; in version 4 the fourth of a position is its inverse
// mass, which plait derives itself (vertices 0 and 1 are pinned).
void read_floats(const ByteReader& file, const TfxContents& contents, SectionId id, uint32_t kept,
                 float scale, std::pmr::vector<float>& values) {
    const Section& section = contents.version->sections[id];
    const uint64_t count = section.per_vertex ? contents.vertices : contents.strands;
    values.reserve(static_cast<size_t>(count * kept));
    for (uint64_t i = 0; i < count; ++i)
        for (uint32_t c = 0; c < kept; ++c)
            values.push_back(
                scale * file.f32(contents.offsets[id] + (i * section.floats + c) * sizeof(float)));
}

// Checks that the strands can be written, and returns their vertices per strand.
Result<uint32_t> equal_vertex_count(const StrandSet& strands) {
    if (strands.vertex_counts.empty())
        return Error{PLAIT_UNSUPPORTED, "a .tfx file cannot hold 0 strands"};
    const uint32_t vertices = strands.vertex_counts.front();
    for (size_t s = 0; s < strands.vertex_counts.size(); ++s)
        if (strands.vertex_counts[s] != vertices)
            return Error{PLAIT_UNSUPPORTED,
                         format("strand %zu has %" PRIu32 " vertices and strand 0 has %" PRIu32
                                "; in a .tfx file all have the same: resample them or save .hair",
                                s, strands.vertex_counts[s], vertices)};
    return vertices;
}

// Offsets in the order positions, strand UV, thickness; all must fit 32 bits.
Result<std::array<uint64_t, SECTIONS>> plan_offsets(const StrandSet& strands) {
    std::array<uint64_t, SECTIONS> offsets = {};
    uint64_t end = VERSION_4.header_size;
    offsets[POSITIONS] = end;
    end += strands.positions.size() / 3 * 4 * sizeof(float);
    if (!strands.strand_uv.empty())
        offsets[STRAND_UV] = end;
    end += strands.strand_uv.size() * sizeof(float);
    if (!strands.thickness.empty())
        offsets[THICKNESS] = end;
    end += strands.thickness.size() * sizeof(float);
    if (end > std::numeric_limits<uint32_t>::max())
        return Error{PLAIT_UNSUPPORTED,
                     format("%" PRIu64 " bytes; the 32-bit offsets of .tfx allow 4294967295", end)};
    return offsets;
}

void write_header(ByteWriter& out, const StrandSet& strands, uint32_t vertices_per_strand,
                  const std::array<uint64_t, SECTIONS>& offsets) {
    out.f32(4.0f);
    out.u32(static_cast<uint32_t>(strands.vertex_counts.size()));
    out.u32(vertices_per_strand);
    for (uint64_t offset : offsets) // SectionId is in the order of version 4's header
        out.u32(static_cast<uint32_t>(offset));
    out.zeros(static_cast<size_t>(VERSION_4.header_size) - out.size());
}

} // namespace

Result<StrandSet> read_tfx(const ByteReader& file, const ReadOptions& options) {
    auto contents = read_tfx_contents(file);
    PLAIT_TRY(contents);
    StrandSet strands(options.memory);
    strands.vertex_counts.assign(static_cast<size_t>(contents->strands),
                                 contents->vertices_per_strand);
    read_floats(file, *contents, POSITIONS, 3, options.scale, strands.positions);
    if (contents->offsets[STRAND_UV] != 0)
        read_floats(file, *contents, STRAND_UV, 2, 1.0f, strands.strand_uv);
    if (contents->offsets[THICKNESS] != 0)
        read_floats(file, *contents, THICKNESS, 1, options.scale, strands.thickness);
    return strands;
}

Result<ByteVector> write_tfx(const StrandSet& strands) {
    auto vertices = equal_vertex_count(strands);
    PLAIT_TRY(vertices);
    auto offsets = plan_offsets(strands);
    PLAIT_TRY(offsets);
    ByteWriter out(strands.positions.get_allocator().resource());
    write_header(out, strands, *vertices, *offsets);
    for (size_t v = 0; v < strands.positions.size() / 3; ++v) {
        for (size_t c = 0; c < 3; ++c)
            out.f32(strands.positions[3 * v + c]);
        out.f32(v % *vertices < 2 ? 0.0f : 1.0f); // inverse mass: TressFX pins the first two
    }
    for (float value : strands.strand_uv)
        out.f32(value);
    for (float value : strands.thickness)
        out.f32(value);
    return std::move(out).take();
}

} // namespace plait
