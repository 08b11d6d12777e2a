// Strands follow the guides that their file says.
#include "core/follows/nearest_guides.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr size_t named = StrandSet::guides_of_file;

struct NamedGuide {
    uint32_t id, index;
    auto operator<=>(const NamedGuide&) const = default;
};

// By their ids.
Result<std::pmr::vector<NamedGuide>> list_names(const Groom& guides,
                                                std::pmr::memory_resource* memory) {
    std::pmr::vector<NamedGuide> list(memory);
    for (const uint32_t id : guides.strands.id)
        list.push_back({id, static_cast<uint32_t>(list.size())});
    if (list.empty())
        return Error{PLAIT_BAD_DATA, "strands have closest_guides, and not all guides have an id"};
    std::ranges::sort(list);
    const auto twice = std::ranges::adjacent_find(list, {}, &NamedGuide::id);
    if (twice != list.end())
        return Error{PLAIT_BAD_DATA, format("id %u is that of guide %u and of guide %u", twice->id,
                                            twice->index, (twice + 1)->index)};
    return list;
}

// What may have had an id.
std::string left_out(const Groom& guides) {
    if (guides.repairs.total() == 0)
        return "";
    return "; import has mended or left out others, the first: " + guides.repairs.first;
}

Result<float> sum_of(const float* weights, size_t strand) {
    float sum = 0;
    for (size_t k = 0; k < named; ++k) {
        if (!(weights[k] >= 0 && std::isfinite(weights[k])))
            return Error{PLAIT_BAD_DATA,
                         format("follow %zu: guide_weights[%zu] is %g, allowed is 0 and more",
                                strand, k, double(weights[k]))};
        sum += weights[k];
    }
    if (!(sum > 0 && std::isfinite(sum)))
        return Error{
            PLAIT_BAD_DATA,
            format("follow %zu: its guide_weights add up to %g, allowed is more than 0 and finite",
                   strand, double(sum))};
    return sum;
}

} // namespace

Status follow_named(const Groom& guides, const Groom& follows, FollowMap& map) {
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    const StrandSet& from = follows.strands;
    map.strands.positions.assign(from.positions.begin(), from.positions.end());
    map.strands.vertex_counts.assign(from.vertex_counts.begin(), from.vertex_counts.end());
    map.max_vertices = follows.shape.max_vertices;
    map.guide_count = static_cast<uint32_t>(guides.shape.strands);
    if (from.guide_ids.empty())
        return follow_nearest(guides, map);
    const auto names = list_names(guides, memory);
    if (!names)
        return names.error();
    std::pmr::vector<uint32_t> of(FollowMap::per_strand * map.count(), 0, memory);
    std::pmr::vector<float> weights(of.size(), 0.0f, memory);
    for (size_t strand = 0; strand < map.count(); ++strand) {
        const float* const given = &from.guide_weights[named * strand];
        const auto sum = sum_of(given, strand);
        if (!sum)
            return sum.error();
        for (size_t k = 0; k < named; ++k) {
            if (given[k] == 0)
                continue;
            const uint32_t id = from.guide_ids[named * strand + k];
            const auto found = std::ranges::lower_bound(*names, id, {}, &NamedGuide::id);
            if (found == names->end() || found->id != id)
                return Error{PLAIT_BAD_DATA,
                             format("follow %zu: closest_guides[%zu] is %u, the id of none of the "
                                    "%u guides%s",
                                    strand, k, id, map.guide_count, left_out(guides).c_str())};
            of[FollowMap::per_strand * strand + k] = found->index;
            weights[FollowMap::per_strand * strand + k] = given[k] / *sum;
        }
    }
    return set_guides(map, of, weights);
}

} // namespace plait
