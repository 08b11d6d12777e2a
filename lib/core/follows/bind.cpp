#include "core/follows/bind.hpp"

#include "base/format.hpp"
#include "core/base/polyline.hpp"
#include "core/follows/root_pose.hpp"

#include <cmath>

namespace plait {
namespace {

// Of a guide's length: a root farther from the groom's was bound with the head elsewhere, and turns
// since then would have the head's in them twice.
constexpr double root_share = 0.01;

Point at(std::span<const float> positions, size_t vertex) {
    return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
}

// Turns need directions.
Status check_segments(std::span<const float> positions, std::span<const uint32_t> vertex_counts,
                      const char* name, const char* kind) {
    size_t first = 0;
    for (size_t strand = 0; strand < vertex_counts.size(); ++strand) {
        for (size_t i = 1; i < vertex_counts[strand]; ++i)
            if (!(distance(at(positions, first + i - 1), at(positions, first + i)) > 0))
                return Error{PLAIT_INVALID_ARGUMENT,
                             format("%s: %s %zu has vertex %zu where the one before it is, "
                                    "segments need a length",
                                    name, kind, strand, i)};
        first += vertex_counts[strand];
    }
    return {};
}

double length_of(std::span<const float> positions, size_t first, size_t count) {
    double length = 0;
    for (size_t i = first + 1; i < first + count; ++i)
        length += distance(at(positions, i - 1), at(positions, i));
    return length;
}

Status check_roots(const FollowMap& map, std::span<const float> guides,
                   std::span<const uint32_t> vertex_counts, const char* name) {
    size_t first = 0;
    for (size_t guide = 0; guide < vertex_counts.size(); ++guide) {
        const double away = distance(at(map.bound, first), at(guides, first));
        const double most = root_share * length_of(guides, first, vertex_counts[guide]);
        if (!(away <= most))
            return Error{
                PLAIT_INVALID_ARGUMENT,
                format("%s: guide %zu has its root %g m from where its groom has it, range "
                       "is [0, %g], 1 %% of its length: bind as if the head were as in "
                       "the groom",
                       name, guide, away, most)};
        first += vertex_counts[guide];
    }
    return {};
}

void append(std::pmr::vector<float>& to, const Eigen::Vector3d& p) {
    for (const double x : p)
        to.push_back(static_cast<float>(x));
}

} // namespace

Status check_bound(const FollowMap& map, std::span<const float> guides,
                   std::span<const uint32_t> vertex_counts, const char* name) {
    if (map.bound.empty())
        return {};
    if (map.bound.size() != guides.size())
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("%s has %zu vertices, the %zu guides' groom has %zu", name,
                            map.bound.size() / 3, vertex_counts.size(), guides.size() / 3)};
    PLAIT_TRY(check_segments(map.bound, vertex_counts, name, "guide"));
    return check_roots(map, guides, vertex_counts, name);
}

Status bind_map(const Groom& groom, const FollowMap& map, const RootPoses& roots,
                const HairFrame& frame, FollowMap& out, const char* name) {
    std::pmr::memory_resource* const memory = out.guides.get_allocator().resource();
    const auto origin = origin_of(map, memory);
    PLAIT_TRY(check_strands(groom, map, origin));
    PLAIT_TRY(check_frame(roots, frame, groom.strands.vertex_counts));
    out = map;
    out.bound.clear();
    out.strands.positions.clear();
    for (size_t i = 0; i < origin.size(); ++i) {
        const RootPose pose = pose_of(roots, origin[i]);
        auto& to = i < map.guide_count ? out.bound : out.strands.positions;
        for (size_t v = 0; v < groom.strands.vertex_counts[origin[i]]; ++v)
            append(to, pose.undo(Eigen::Vector3d(frame.at(origin[i], v).data())));
    }
    const Groom guides = take_strands(groom, std::span(origin).first(map.guide_count), memory);
    PLAIT_TRY(check_bound(out, guides.strands.positions, guides.strands.vertex_counts, name));
    return check_segments(out.strands.positions, out.strands.vertex_counts, name, "follow");
}

} // namespace plait
