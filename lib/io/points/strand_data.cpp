// .data of research on hair: strands as counts and points.
#include "io/curves/notes.hpp"
#include "io/formats.hpp"

namespace plait {

Result<StrandSet> read_strand_data(const ByteReader& file, const ReadOptions& options) {
    PLAIT_TRY(file.check_range("number of strands", 0, 0, 1, 4));
    const uint32_t count = file.u32(0);
    PLAIT_TRY(file.check_range("strands", 0, 4, count, 4));
    if (count == 0)
        return file.bad(0, "number of strands is 0; allowed are 1 or more");
    StrandSet strands(options.memory);
    strands.vertex_counts.reserve(count);
    uint64_t at = 4, single = 0;
    for (uint32_t s = 0; s < count; ++s) {
        PLAIT_TRY(file.check_range("number of points", at, at, 1, 4));
        const uint32_t points = file.u32(at);
        if (points == 0)
            return file.bad(at, format("strand %u has 0 points; allowed are 1 or more", s));
        PLAIT_TRY(file.check_range("points", at, at + 4, points, 12));
        strands.vertex_counts.push_back(points);
        single += points == 1;
        at += 4 + uint64_t{12} * points;
    }
    strands.positions.reserve(static_cast<size_t>((at - 4 - uint64_t{4} * count) / 4));
    at = 4;
    for (const uint32_t points : strands.vertex_counts) {
        at += 4;
        for (uint32_t i = 0; i < 3 * points; ++i, at += 4)
            strands.positions.push_back(options.scale * file.f32(at));
    }
    Notes notes;
    if (single > 0)
        notes.add(format("%" PRIu64 " of its %" PRIu32 " strands have one point: there is no hair",
                         single, count));
    if (options.notes)
        *options.notes = notes.take();
    return strands;
}

} // namespace plait
