#include "core/levels/levels.hpp"

#include "base/format.hpp"
#include "core/base/strand_order.hpp"
#include "core/follows/bind.hpp"
#include "core/follows/nearest_guides.hpp"
#include "core/follows/root_pose.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace plait {
namespace {

// Measured for three grooms of 3,000 to 4,000 strands that hang on a head and shoulders, which turns,
// shakes and walks, and in gusts: within a factor of two of each.
struct Rung {
    double guides, share;
};
constexpr std::array<Rung, 4> rungs{{{8, 0.8}, {32, 0.7}, {128, 0.6}, {512, 0.45}}};
constexpr double share_of_all = 0.2, share_of_none = 1.1;

// Between rungs as the logarithm of guides; the last leads to that of all strands.
double share_of(double guides, double strands) {
    if (guides == 0)
        return share_of_none;
    if (guides >= strands)
        return share_of_all;
    if (guides <= rungs[0].guides)
        return rungs[0].share;
    Rung from = rungs[0];
    for (const Rung& to : rungs) {
        if (guides <= to.guides && to.guides < strands)
            return std::lerp(from.share, to.share,
                             from.guides == to.guides ? 0
                                                      : std::log(guides / from.guides) /
                                                            std::log(to.guides / from.guides));
        if (to.guides >= strands)
            break;
        from = to;
    }
    return std::lerp(from.share, share_of_all,
                     std::log(guides / from.guides) / std::log(strands / from.guides));
}

// Of a small groom eighths of eighths: few guides are soon too few for its partings.
std::array<uint32_t, 5> default_guides(uint32_t strands) {
    if (strands >= 2000)
        return {strands, 512, 128, 32, 0};
    const auto share = [&](uint32_t part) {
        return std::min(strands, std::max(8u, strands / part));
    };
    return {strands, share(8), share(32), share(128), 0};
}

Status check_guides(std::span<const uint32_t> guides, size_t strands) {
    for (size_t level = 0; level < guides.size(); ++level) {
        const size_t below = level > 0 ? size_t{guides[level - 1]} : strands + 1;
        if (below == 0)
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("desc->guides[%zu] is %u, but level %zu has none already: "
                                "level_count is at most %zu here",
                                level, guides[level], level - 1, level)};
        if (guides[level] >= below)
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("desc->guides[%zu] is %u, range is [0, %zu], %s", level,
                                guides[level], below - 1,
                                level > 0 ? "fewer than the level before" : "the groom's strands")};
    }
    return {};
}

// Those of `sorted` that are farthest apart in it come first: every part from the begin is spread over all.
void append_spread(std::span<const uint32_t> sorted, std::pmr::vector<uint32_t>& to) {
    const size_t places = std::bit_ceil(sorted.size());
    size_t at = 0; // i, its bits from the last to the first
    for (size_t i = 0; i < places; ++i) {
        if (at < sorted.size())
            to.push_back(sorted[at]);
        size_t bit = places >> 1;
        for (; (at & bit) != 0; bit >>= 1)
            at ^= bit;
        at |= bit;
    }
}

// Farthest roots first, as many as are ever guides of a part of the hair; the rest along a curve through
// the roots, every second, every fourth, ...
std::pmr::vector<uint32_t> order_of(const Groom& groom, std::span<const uint32_t> guides,
                                    uint64_t seed, std::pmr::memory_resource* memory) {
    const size_t strands = groom.shape.strands;
    size_t spread = 0;
    for (const uint32_t count : guides)
        if (count < strands)
            spread = std::max<size_t>(spread, count);
    auto order = spread_order(roots_of(groom.strands, memory), spread, seed, memory);
    std::pmr::vector<unsigned char> taken(strands, memory);
    for (const uint32_t strand : order)
        taken[strand] = 1;
    auto rest = order_by_root(groom.strands.positions, groom.strands.vertex_counts, memory);
    std::erase_if(rest, [&](uint32_t strand) { return taken[strand] != 0; });
    append_spread(rest, order);
    return order;
}

// Of a strand's `count` vertices those at quarters of them, without the root.
Eigen::Vector<float, 12> quarters_of(const float* vertices, uint32_t count) {
    Eigen::Vector<float, 12> places;
    for (uint32_t k = 0; k < 4; ++k)
        places.segment<3>(3 * k) =
            Eigen::Vector3f(vertices + 3 * (size_t{count - 1} * (k + 1) / 4));
    return places;
}

} // namespace

Status Levels::create(const Groom& groom, std::span<const uint32_t> guides, uint64_t seed) {
    std::pmr::memory_resource* const memory = order_.get_allocator().resource();
    PLAIT_TRY(check_guides(guides, groom.shape.strands));
    if (guides.empty()) {
        for (const uint32_t count : default_guides(static_cast<uint32_t>(groom.shape.strands)))
            if (guides_.empty() || count < guides_.back())
                guides_.push_back(count);
    } else {
        guides_.assign(guides.begin(), guides.end());
    }
    groom_ = groom;
    order_ = order_of(groom, guides_, seed, memory);
    return {};
}

Status Levels::hang(const RootPoses& roots, const HairFrame& frame) {
    PLAIT_TRY(check_frame(roots, frame, groom_.strands.vertex_counts, "desc->hung"));
    hung_.reserve(3 * strands() * longest());
    for (size_t strand = 0; strand < strands(); ++strand) {
        const RootPose pose = pose_of(roots, strand);
        const size_t last = groom_.strands.vertex_counts[strand] - size_t{1};
        for (size_t i = 0; i < longest(); ++i)
            for (const double x :
                 pose.undo(Eigen::Vector3d(frame.at(strand, std::min(i, last)).data())))
                hung_.push_back(static_cast<float>(x));
    }
    // all as guides: what any level refuses is refused now
    FollowMap map(hung_.get_allocator().resource());
    map.guide_count = static_cast<uint32_t>(strands());
    const HairFrame own{reinterpret_cast<const unsigned char*>(hung_.data()), 3 * sizeof(float),
                        longest(), 1};
    FollowMap bound(hung_.get_allocator().resource());
    return bind_map(groom_, map, {}, own, bound, "desc->hung");
}

double Levels::share(size_t level) const {
    return share_of(guides_[level], static_cast<double>(strands()));
}

std::pmr::vector<uint32_t> Levels::ends() const {
    const auto all = static_cast<uint32_t>(strands());
    std::pmr::vector<uint32_t> ends(guides_, order_.get_allocator().resource());
    ends.insert(ends.end(), {all / 8, all / 4, all / 2, all});
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::erase(ends, 0u);
    return ends;
}

Status Levels::take(size_t level, Groom& out, FollowMap& map) const {
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    const uint32_t guides = guides_[level];
    if (guides == 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("level %zu has no guides: its hair is not simulated, it goes with the "
                            "head as it hangs",
                            level)};
    const auto order = std::span(order_);
    StrandRoots roots = roots_of(groom_.strands, memory);
    if (hung_.empty())
        return follow_nearest(groom_, roots, order.first(guides), order.subspan(guides), out, map);
    for (size_t strand = 0; strand < strands(); ++strand)
        roots.hung.push_back(
            quarters_of(&hung_[3 * strand * longest()], groom_.strands.vertex_counts[strand]));
    FollowMap groomed(memory);
    PLAIT_TRY(
        follow_nearest(groom_, roots, order.first(guides), order.subspan(guides), out, groomed));
    const HairFrame frame{reinterpret_cast<const unsigned char*>(hung_.data()), 3 * sizeof(float),
                          longest(), 1};
    return bind_map(groom_, groomed, {}, frame, map, "desc->hung");
}

} // namespace plait
