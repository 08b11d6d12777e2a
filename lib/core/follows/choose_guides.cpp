// Guides out of a groom's own strands, and what the others follow.
#include "core/follows/nearest_guides.hpp"

#include "base/format.hpp"
#include "core/base/polyline.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace plait {
namespace {

constexpr size_t nearest = FollowMap::per_strand; // guides of a follow
constexpr double grown = 0.25;     // share of the length over which a strand's direction is taken
constexpr float same_root = 1e-6f; // m

std::pmr::vector<uint32_t> others(std::span<const uint32_t> chosen, size_t strands,
                                  std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> list(memory);
    list.reserve(strands - chosen.size());
    for (uint32_t i = 0; i < strands; ++i)
        if (!std::ranges::binary_search(chosen, i))
            list.push_back(i);
    return list;
}

// The nearest guides on a strand's own side, the nearest first, and one more.
using Nearest = NearRoots<nearest + 1>;

// (1/d - 1/R)^2, R the distance of the first guide that is left out (Franke & Nielson 1980): a guide
// that another takes the place of has no weight left, so neighbours have nearly the same weights
// everywhere.
std::array<float, FollowMap::per_strand> weights_of(const Nearest& list) {
    std::array<float, FollowMap::per_strand> weights{};
    const float last = 1 / std::sqrt(list[nearest].square);
    float sum = 0;
    for (size_t k = 0; k < nearest; ++k) {
        const float apart = 1 / std::sqrt(list[k].square) - last;
        sum += weights[k] = apart * apart;
    }
    if (list[0].square < same_root * same_root || !(sum > 0))
        return {1};
    for (float& weight : weights)
        weight /= sum;
    return weights;
}

// `guides` and `follows` say where in `roots` theirs are; the map's guides are counted as in `guides`.
Status set_nearest(const StrandRoots& roots, std::span<const uint32_t> guides,
                   std::span<const uint32_t> follows, FollowMap& map) {
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    std::pmr::vector<uint32_t> of(memory);
    std::pmr::vector<float> weights(memory);
    for (const uint32_t strand : follows) {
        const Nearest list = nearest_roots<nearest + 1>(roots, strand, guides);
        const auto shares = weights_of(list);
        for (size_t k = 0; k < FollowMap::per_strand; ++k)
            of.push_back(list[k].index);
        weights.insert(weights.end(), shares.begin(), shares.end());
    }
    return set_guides(map, of, weights);
}

} // namespace

StrandRoots roots_of(const StrandSet& strands, std::pmr::memory_resource* memory) {
    StrandRoots roots(memory);
    Points points(memory);
    std::pmr::vector<double> arc(memory);
    const float* p = strands.positions.data();
    for (const uint32_t count : strands.vertex_counts) {
        points.clear();
        for (uint32_t i = 0; i < count; ++i, p += 3)
            points.push_back({p[0], p[1], p[2]});
        const Point ahead = point_at(points, arc, grown * measure(points, arc));
        roots.append(points[0], ahead);
    }
    return roots;
}

Status follow_nearest(const Groom& groom, const StrandRoots& roots,
                      std::span<const uint32_t> guides, std::span<const uint32_t> follows,
                      Groom& out, FollowMap& map) {
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    out = take_strands(groom, guides, memory);
    Groom rest = take_strands(groom, follows, memory);
    map.strands = std::move(rest.strands);
    map.max_vertices = rest.shape.max_vertices;
    map.guide_count = static_cast<uint32_t>(guides.size());
    map.origin.assign(guides.begin(), guides.end());
    map.origin.insert(map.origin.end(), follows.begin(), follows.end());
    return set_nearest(roots, guides, follows, map);
}

// Roots of guides, then of follows.
Status follow_nearest(const Groom& guides, FollowMap& map) {
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    StrandSet both(memory);
    for (const StrandSet* from : {&guides.strands, static_cast<const StrandSet*>(&map.strands)}) {
        both.positions.insert(both.positions.end(), from->positions.begin(), from->positions.end());
        both.vertex_counts.insert(both.vertex_counts.end(), from->vertex_counts.begin(),
                                  from->vertex_counts.end());
    }
    std::pmr::vector<uint32_t> numbers(both.vertex_counts.size(), 0, memory);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const std::span<const uint32_t> all = numbers;
    return set_nearest(roots_of(both, memory), all.first(guides.shape.strands),
                       all.subspan(guides.shape.strands), map);
}

Status choose_guides(const Groom& groom, size_t guides, uint64_t seed, Groom& out, FollowMap& map) {
    const size_t strands = groom.shape.strands;
    if (guides < 1 || guides > strands)
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("guides is %zu, range is [1, %zu], the groom's strands", guides, strands)};
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    const StrandRoots roots = roots_of(groom.strands, memory);
    const auto chosen = spread_roots(roots, guides, seed, memory);
    return follow_nearest(groom, roots, chosen, others(chosen, strands, memory), out, map);
}

} // namespace plait
