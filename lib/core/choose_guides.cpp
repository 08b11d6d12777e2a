// Guides out of a groom's own strands, and what the others follow.
#include "core/follow_map.hpp"

#include "base/format.hpp"
#include "base/hash.hpp"
#include "core/polyline.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <limits>

namespace plait {
namespace {

using Vec3 = Eigen::Vector3f;

constexpr size_t nearest = FollowMap::per_strand; // guides of a follow
constexpr float side = 0.5f;       // cos 60 deg: across a parting hair is further apart
constexpr double grown = 0.25;     // share of the length over which a strand's direction is taken
constexpr float same_root = 1e-6f; // m
constexpr float far_off = std::numeric_limits<float>::infinity();

// Of every strand.
struct Roots {
    std::pmr::vector<Vec3> at;
    std::pmr::vector<Vec3> way; // unit, over the first quarter of the length
};

Roots roots_of(const StrandSet& strands, std::pmr::memory_resource* memory) {
    Roots roots{std::pmr::vector<Vec3>(memory), std::pmr::vector<Vec3>(memory)};
    Points points(memory);
    std::pmr::vector<double> arc(memory);
    const float* p = strands.positions.data();
    for (const uint32_t count : strands.vertex_counts) {
        points.clear();
        for (uint32_t i = 0; i < count; ++i, p += 3)
            points.push_back({p[0], p[1], p[2]});
        const Point ahead = point_at(points, arc, grown * measure(points, arc));
        roots.at.emplace_back(points[0].data());
        roots.way.push_back((Vec3(ahead.data()) - roots.at.back()).normalized());
    }
    return roots;
}

// Each is the strand whose root is farthest from those of all before (Gonzalez 1985), so that no
// other set covers the scalp more than twice as closely; the first is the seed's. Ascending.
std::pmr::vector<uint32_t> spread(const Roots& roots, size_t guides, uint64_t seed,
                                  std::pmr::memory_resource* memory) {
    const size_t strands = roots.at.size();
    std::pmr::vector<float> squares(strands, far_off, memory); // to the nearest; -1: chosen
    std::pmr::vector<uint32_t> chosen(memory);
    size_t next = mix64(seed) % strands;
    while (chosen.size() < guides) {
        chosen.push_back(static_cast<uint32_t>(next));
        squares[next] = -1;
        const Vec3 root = roots.at[next];
        for (size_t i = 0; i < strands; ++i) {
            squares[i] = std::min(squares[i], (roots.at[i] - root).squaredNorm());
            if (squares[i] > squares[next])
                next = i;
        }
    }
    std::ranges::sort(chosen);
    return chosen;
}

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
struct Near {
    uint32_t guide = 0;
    float square = far_off; // distance^2 of the roots; infinite: there is none
};
using Nearest = std::array<Near, nearest + 1>;

void insert(Nearest& list, Near candidate) {
    for (Near& place : list)
        if (candidate.square < place.square)
            std::swap(candidate, place);
}

Nearest nearest_guides(const Roots& roots, uint32_t strand, std::span<const uint32_t> chosen) {
    Nearest beside, any;
    for (uint32_t g = 0; g < chosen.size(); ++g) {
        const float square = (roots.at[chosen[g]] - roots.at[strand]).squaredNorm();
        if (square < beside.back().square && roots.way[chosen[g]].dot(roots.way[strand]) >= side)
            insert(beside, {g, square});
        if (square < any[0].square)
            any[0] = {g, square};
    }
    return beside[0].square < far_off ? beside : any;
}

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

} // namespace

Status choose_guides(const Groom& groom, size_t guides, uint64_t seed, Groom& out, FollowMap& map) {
    const size_t strands = groom.shape.strands;
    if (guides < 1 || guides > strands)
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("guides is %zu, range is [1, %zu], the groom's strands", guides, strands)};
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    const Roots roots = roots_of(groom.strands, memory);
    const auto chosen = spread(roots, guides, seed, memory);
    const auto left = others(chosen, strands, memory);
    out = take_strands(groom, chosen, memory);
    Groom follows = take_strands(groom, left, memory);
    map.strands = std::move(follows.strands);
    map.max_vertices = follows.shape.max_vertices;
    map.guide_count = static_cast<uint32_t>(guides);
    map.origin.assign(chosen.begin(), chosen.end());
    map.origin.insert(map.origin.end(), left.begin(), left.end());
    std::pmr::vector<uint32_t> of(memory);
    std::pmr::vector<float> weights(memory);
    for (const uint32_t strand : left) {
        const Nearest list = nearest_guides(roots, strand, chosen);
        const auto shares = weights_of(list);
        for (size_t k = 0; k < FollowMap::per_strand; ++k)
            of.push_back(list[k].guide);
        weights.insert(weights.end(), shares.begin(), shares.end());
    }
    return set_guides(map, of, weights);
}

} // namespace plait
