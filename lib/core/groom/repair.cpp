#include "core/groom/repair.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace plait {
namespace {

// The spacing of float32 at the strand's largest coordinate: no two vertices can be closer.
double float_spacing(const Points& strand) {
    float largest = 0;
    for (const Point& p : strand)
        largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return double(largest) * std::numeric_limits<float>::epsilon();
}

double shortest_segment(const Points& strand) {
    double shortest = std::numeric_limits<double>::infinity();
    for (size_t i = 1; i < strand.size(); ++i)
        shortest = std::min(shortest, distance(strand[i - 1], strand[i]));
    return shortest;
}

// Arc lengths no closer than `gap`, root and tip fixed, others moved no further than needed:
// push towards the tip, then back from it.
void spread(std::pmr::vector<double>& arc, double gap) {
    const double length = arc.back();
    for (size_t i = 1; i < arc.size(); ++i)
        arc[i] = std::max(arc[i], arc[i - 1] + gap);
    arc.back() = length;
    for (size_t i = arc.size() - 1; i > 1; --i)
        arc[i - 1] = std::min(arc[i - 1], arc[i] - gap);
}

} // namespace

size_t StrandMender::RootHash::operator()(const Point& p) const {
    uint64_t hash = 0xcbf29ce484222325u; // FNV-1a
    for (const float coordinate : p) {
        uint32_t bits;
        std::memcpy(&bits, &coordinate, sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3u;
    }
    return static_cast<size_t>(hash ^ (hash >> 32));
}

Status StrandMender::note(plait_repair kind, size_t strand, const std::string& what) {
    const std::string sentence = format("strand %zu%s", strand, what.c_str());
    if (rules_.policy == PLAIT_REPAIR_POLICY_REFUSE)
        return Error{PLAIT_BAD_DATA, sentence + " (policy: refuse)"};
    if (repairs_.total() == 0)
        repairs_.first = sentence;
    ++repairs_.count[kind];
    return {};
}

Result<bool> StrandMender::has_finite_vertices(size_t index, const Points& strand) {
    for (size_t i = 0; i < strand.size(); ++i)
        for (const float c : strand[i])
            if (!(std::abs(c) <= max_coordinate)) {
                PLAIT_TRY(note(PLAIT_REPAIR_NONFINITE, index,
                               format(", vertex %zu: coordinate %g is outside [-1e6, 1e6] m, the "
                                      "strand is dropped",
                                      i, double(c))));
                return false;
            }
    return true;
}

Result<bool> StrandMender::has_length(size_t index, const Points& strand) {
    if (strand.size() < PLAIT_MIN_VERTICES) {
        PLAIT_TRY(note(PLAIT_REPAIR_SHORT_STRAND, index,
                       format(": %zu vertices, at least %d are needed, the strand is dropped",
                              strand.size(), PLAIT_MIN_VERTICES)));
        return false;
    }
    const double length = measure(strand, arc_);
    const double needed =
        std::max(min_strand_length, 8 * float_spacing(strand) * double(strand.size()));
    if (length >= needed)
        return true;
    PLAIT_TRY(note(PLAIT_REPAIR_SHORT_STRAND, index,
                   format(": %g m long, at least %g m is needed there, the strand is dropped",
                          length, needed)));
    return false;
}

Status StrandMender::fit_vertex_count(size_t index, Points& strand) {
    const bool too_long = strand.size() > PLAIT_MAX_VERTICES;
    if (too_long && rules_.resample == 0)
        PLAIT_TRY(
            note(PLAIT_REPAIR_TOO_LONG, index,
                 format(": %zu vertices, resampled to %d", strand.size(), PLAIT_MAX_VERTICES)));
    if (rules_.resample != 0)
        resample(strand, rules_.resample, memory_);
    else if (too_long)
        resample(strand, PLAIT_MAX_VERTICES, memory_);
    return {};
}

// Counts the segments of `arc_` below the limits; `any`: there were some.
Status StrandMender::note_short_segments(size_t index, double shortest, double resolution,
                                         bool& any) {
    any = false;
    for (size_t i = 1; i < arc_.size(); ++i) {
        const double length = arc_[i] - arc_[i - 1];
        if (length >= shortest)
            continue;
        any = true;
        const bool zero = length <= resolution;
        PLAIT_TRY(note(zero ? PLAIT_REPAIR_ZERO_SEGMENT : PLAIT_REPAIR_TINY_SEGMENT, index,
                       format(", vertex %zu: segment of %g m, at least %g m is needed, the vertex "
                              "is moved along the strand",
                              i, length, shortest)));
    }
    return {};
}

Result<bool> StrandMender::space_vertices(size_t index, Points& strand) {
    const double length = measure(strand, arc_);
    const double resolution = 2 * float_spacing(strand);
    const double shortest =
        std::max(rules_.min_segment * length / double(strand.size() - 1), 2 * resolution);
    bool any = false;
    PLAIT_TRY(note_short_segments(index, shortest, resolution, any));
    if (!any)
        return true;
    const Points before(strand, memory_);
    const std::pmr::vector<double> old_arc(arc_, memory_);
    spread(arc_, shortest);
    for (size_t i = 1; i + 1 < strand.size(); ++i)
        if (arc_[i] != old_arc[i])
            strand[i] = point_at(before, old_arc, arc_[i]);
    if (shortest_segment(strand) > resolution)
        return true;
    PLAIT_TRY(note(PLAIT_REPAIR_SHORT_STRAND, index,
                   ": folds back onto itself where a segment has no length, the strand is "
                   "dropped"));
    return false;
}

Status StrandMender::note_root(size_t index, const Point& root) {
    const Point key = {root[0] + 0.0f, root[1] + 0.0f, root[2] + 0.0f}; // -0 and 0 are one place
    if (roots_.insert(key).second)
        return {};
    return note(PLAIT_REPAIR_DUPLICATE_ROOT, index,
                format(", vertex 0: root (%g, %g, %g) m is that of an earlier strand, kept",
                       double(root[0]), double(root[1]), double(root[2])));
}

Result<bool> StrandMender::mend(size_t index, Points& strand) {
    for (const auto keep : {&StrandMender::has_finite_vertices, &StrandMender::has_length}) {
        auto kept = (this->*keep)(index, strand);
        if (!kept || !*kept)
            return kept;
    }
    PLAIT_TRY(fit_vertex_count(index, strand));
    auto kept = space_vertices(index, strand);
    if (!kept || !*kept)
        return kept;
    PLAIT_TRY(note_root(index, strand.front()));
    return true;
}

} // namespace plait
