#include "core/groom/groom.hpp"

#include "base/format.hpp"
#include "base/hash.hpp"
#include "core/groom/repair.hpp"
#include "core/groom/root_ends.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plait {
namespace {

constexpr uint32_t max_bones = 65536;

// Appends the `width` values of element `index`; an absent field stays absent.
template <typename T>
void append(std::pmr::vector<T>& to, const std::pmr::vector<T>& from, size_t index, size_t width) {
    if (!from.empty())
        to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(index * width),
                  from.begin() + static_cast<std::ptrdiff_t>((index + 1) * width));
}

void append_strand(StrandSet& to, const StrandSet& from, size_t index, const Points& strand) {
    for (const Point& p : strand)
        to.positions.insert(to.positions.end(), p.begin(), p.end());
    to.vertex_counts.push_back(static_cast<uint32_t>(strand.size()));
    append(to.strand_uv, from.strand_uv, index, 2);
    append(to.thickness, from.thickness, index, 1);
    append(to.bone_indices, from.bone_indices, index, 4);
    append(to.bone_weights, from.bone_weights, index, 4);
    append(to.group, from.group, index, 1);
    append(to.id, from.id, index, 1);
    append(to.guide_ids, from.guide_ids, index, StrandSet::guides_of_file);
    append(to.guide_weights, from.guide_weights, index, StrandSet::guides_of_file);
}

void read_strand(const StrandSet& raw, size_t first, size_t count, Points& strand) {
    strand.resize(count);
    for (size_t i = 0; i < count; ++i)
        std::copy_n(raw.positions.data() + 3 * (first + i), 3, strand[i].begin());
}

Error bad(size_t strand, const char* field, double value, const char* range) {
    return {PLAIT_BAD_DATA,
            format("strand %zu: %s is %g, range is %s", strand, field, value, range)};
}

Status check_values(const StrandSet& set, size_t strand) {
    for (size_t i = 0; i < 2 && !set.strand_uv.empty(); ++i)
        if (const float uv = set.strand_uv[2 * strand + i]; !std::isfinite(uv))
            return bad(strand, "uv", uv, "finite");
    if (!set.thickness.empty())
        if (const float d = set.thickness[strand]; !(d >= 0 && d <= 1))
            return bad(strand, "thickness", d, "[0, 1] m");
    return {};
}

// Weights are used as shares: rounding is taken out, anything more is refused.
// `strand`: its number in the input, for the message.
Status check_last_skin(StrandSet& set, size_t strand) {
    if (set.bone_weights.empty())
        return {};
    float* weights = set.bone_weights.data() + set.bone_weights.size() - 4;
    const uint32_t* bones = set.bone_indices.data() + set.bone_indices.size() - 4;
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) {
        if (!(weights[i] >= 0 && weights[i] <= 1.01f))
            return bad(strand, "bone weight", weights[i], "[0, 1]");
        if (const uint32_t bone = bones[i]; bone >= max_bones)
            return bad(strand, "bone index", bone, "[0, 65535]");
        sum += double(weights[i]);
    }
    if (!(std::abs(sum - 1) <= 1e-2))
        return bad(strand, "sum of bone weights", sum, "1 +- 0.01");
    for (size_t i = 0; i < 4; ++i)
        weights[i] = static_cast<float>(weights[i] / sum);
    return {};
}

Status check_sizes(const StrandSet& raw) {
    const size_t strands = raw.vertex_counts.size();
    const auto wrong = [](const char* field, size_t have, size_t need) {
        return Error{PLAIT_BAD_DATA,
                     format("%s has %zu values, %zu are needed", field, have, need)};
    };
    const uint64_t vertices =
        std::accumulate(raw.vertex_counts.begin(), raw.vertex_counts.end(), uint64_t{0});
    if (raw.positions.size() != 3 * vertices)
        return wrong("positions", raw.positions.size(), 3 * vertices);
    if (!raw.strand_uv.empty() && raw.strand_uv.size() != 2 * strands)
        return wrong("strand_uv", raw.strand_uv.size(), 2 * strands);
    if (!raw.thickness.empty() && raw.thickness.size() != strands)
        return wrong("thickness", raw.thickness.size(), strands);
    if (raw.bone_indices.size() != raw.bone_weights.size())
        return wrong("bone_indices", raw.bone_indices.size(), raw.bone_weights.size());
    if (!raw.bone_weights.empty() && raw.bone_weights.size() != 4 * strands)
        return wrong("bone_weights", raw.bone_weights.size(), 4 * strands);
    return {};
}

void add_strand(GroomShape& shape, const Points& strand, double length) {
    const auto count = static_cast<uint32_t>(strand.size());
    const bool first = shape.strands == 0;
    if (first)
        shape.bounds_min = shape.bounds_max = strand.front();
    for (const Point& p : strand)
        for (size_t axis = 0; axis < 3; ++axis) {
            shape.bounds_min[axis] = std::min(shape.bounds_min[axis], p[axis]);
            shape.bounds_max[axis] = std::max(shape.bounds_max[axis], p[axis]);
        }
    shape.min_vertices = first ? count : std::min(shape.min_vertices, count);
    shape.max_vertices = std::max(shape.max_vertices, count);
    shape.mean_length += (length - shape.mean_length) / double(++shape.strands);
    shape.min_length = first ? length : std::min(shape.min_length, length);
    shape.max_length = std::max(shape.max_length, length);
    shape.vertices += count;
}

// After repairs, which leave strands that have ends.
void judge_roots(Groom& groom, plait_root_end wanted, std::pmr::memory_resource* memory) {
    constexpr int passes = 8; // each sees those of the one before the right way round
    auto list = contradicted_roots(groom.strands, memory);
    for (int k = 0; k < passes && wanted == PLAIT_ROOT_END_AGREED && !list.empty(); ++k) {
        turn_around(groom.strands, list);
        list = contradicted_roots(groom.strands, memory, true);
    }
    groom.roots_contradicted = list.size();
    groom.first_contradicted = list.empty() ? 0 : list.front();
}

uint32_t count_bones(const StrandSet& set) {
    if (set.bone_indices.empty())
        return 0;
    return *std::max_element(set.bone_indices.begin(), set.bone_indices.end()) + 1;
}

} // namespace

std::string groom_warning(const Groom& groom) {
    std::string text;
    const auto strands = static_cast<unsigned long long>(groom.shape.strands);
    if (groom.roots_contradicted > 0)
        text = format(
            "groom: %llu of %llu strands, the first of them strand %u, have their root among "
            "the tips of others and their tip among roots: stored from tip to root "
            "(plait_import_options.root_end)",
            static_cast<unsigned long long>(groom.roots_contradicted), strands,
            groom.first_contradicted);
    if (groom.thickness_unlikely > 0) {
        const auto& all = groom.strands.thickness;
        const auto first = std::ranges::find_if(all, [](float d) { return !is_hair_diameter(d); });
        text += format(
            "%sgroom: %llu of %llu strands are not as thick as hair, 10 um to 1 mm (strand "
            "%td: %.3g m): the wind takes the mean of the others, or 70 um where there "
            "are none",
            text.empty() ? "" : "; ", static_cast<unsigned long long>(groom.thickness_unlikely),
            strands, first - all.begin(), double(*first));
    }
    return text;
}

uint64_t Repairs::total() const {
    return std::accumulate(count.begin(), count.end(), uint64_t{0});
}

Groom take_strands(const Groom& from, std::span<const uint32_t> which,
                   std::pmr::memory_resource* memory) {
    Groom groom{StrandSet(memory), {}, {}};
    std::pmr::vector<size_t> first(memory);
    size_t vertices = 0;
    for (const uint32_t count : from.strands.vertex_counts) {
        first.push_back(vertices);
        vertices += count;
    }
    Points strand(memory);
    std::pmr::vector<double> arc(memory);
    for (const uint32_t i : which) {
        read_strand(from.strands, first[i], from.strands.vertex_counts[i], strand);
        append_strand(groom.strands, from.strands, i, strand);
        add_strand(groom.shape, strand, measure(strand, arc));
    }
    groom.shape.bones = count_bones(groom.strands);
    return groom;
}

uint64_t fingerprint(const Groom& groom) {
    const StrandSet& strands = groom.strands;
    Hash hash;
    hash.add(strands.vertex_counts.data(), strands.vertex_counts.size() * sizeof(uint32_t));
    hash.add(strands.positions.data(), strands.positions.size() * sizeof(float));
    return hash.value();
}

Result<Groom> build_groom(const StrandSet& raw, const ImportRules& rules,
                          std::pmr::memory_resource* memory) {
    PLAIT_TRY(check_sizes(raw));
    StrandMender mender(rules, memory);
    Groom groom{StrandSet(memory), {}, {}};
    groom.strands.positions.reserve(raw.positions.size());
    groom.strands.vertex_counts.reserve(raw.vertex_counts.size());
    Points strand(memory);
    std::pmr::vector<double> arc(memory);
    size_t first = 0;
    for (size_t i = 0; i < raw.vertex_counts.size(); first += raw.vertex_counts[i++]) {
        read_strand(raw, first, raw.vertex_counts[i], strand);
        PLAIT_TRY(check_values(raw, i));
        const auto kept = mender.mend(i, strand);
        if (!kept)
            return kept.error();
        if (!*kept)
            continue;
        append_strand(groom.strands, raw, i, strand);
        add_strand(groom.shape, strand, measure(strand, arc));
        PLAIT_TRY(check_last_skin(groom.strands, i));
    }
    groom.repairs = mender.repairs();
    if (groom.shape.strands == 0)
        return Error{PLAIT_BAD_DATA, raw.vertex_counts.empty()
                                         ? std::string("the groom has no strands")
                                         : "no strand can be kept; " + groom.repairs.first};
    groom.shape.bones = count_bones(groom.strands);
    judge_roots(groom, rules.root_end, memory);
    groom.thickness_unlikely = static_cast<uint64_t>(std::ranges::count_if(
        groom.strands.thickness, [](float d) { return !is_hair_diameter(d); }));
    return groom;
}

} // namespace plait
