#include "core/follows/hair_frame.hpp"

#include "base/format.hpp"

#include <cmath>
#include <cstring>
#include <numeric>

namespace plait {
namespace {

constexpr double far = 1e6; // m

} // namespace

std::array<double, 3> HairFrame::at(size_t strand, size_t vertex) const {
    float p[3];
    std::memcpy(p, positions + (strand * row + vertex) * stride, sizeof p);
    return {double(p[0]) / scale, double(p[1]) / scale, double(p[2]) / scale};
}

Status check_frame(const RootPoses& roots, const HairFrame& frame,
                   std::span<const uint32_t> vertex_counts, const char* name) {
    const size_t strands = vertex_counts.size();
    if (!roots.own.empty() && roots.own.size() != strands)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("roots->root_poses.count is %zu, the groom has %zu strands",
                            roots.own.size(), strands)};
    for (size_t strand = 0; strand < strands; ++strand)
        for (size_t i = 0; i < vertex_counts[strand]; ++i) {
            const auto at = frame.at(strand, i);
            for (size_t axis = 0; axis < 3; ++axis) {
                const double x = at[axis] * frame.scale;
                if (!(std::abs(x) <= far))
                    return Error{PLAIT_INVALID_ARGUMENT,
                                 format("%s[%zu][%zu][%zu], of strand, vertex and axis, is "
                                        "%g, range is [-1e6, 1e6] m",
                                        name, strand, i, axis, x)};
            }
        }
    return {};
}

std::pmr::vector<uint32_t> origin_of(const FollowMap& map, std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> origin(map.origin, memory);
    if (origin.empty()) {
        origin.resize(size_t{map.guide_count} + map.count());
        std::iota(origin.begin(), origin.end(), 0u);
    }
    return origin;
}

Status check_strands(const Groom& groom, const FollowMap& map, std::span<const uint32_t> origin) {
    if (groom.shape.strands != origin.size())
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the groom has %zu strands, the map is of %u guides and %zu follows",
                            size_t(groom.shape.strands), map.guide_count, map.count())};
    for (size_t follow = 0; follow < map.count(); ++follow) {
        const size_t strand = origin[map.guide_count + follow];
        const uint32_t has = groom.strands.vertex_counts[strand];
        if (has != map.strands.vertex_counts[follow])
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("strand %zu of the groom has %u vertices, the map's follow %zu, "
                                "which should be it, has %u",
                                strand, has, follow, map.strands.vertex_counts[follow])};
    }
    return {};
}

} // namespace plait
