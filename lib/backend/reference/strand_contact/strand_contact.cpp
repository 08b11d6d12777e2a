// strand_contact: of each vertex the plane of another strand. With a(s), b(t) the nearest points of
// its segment and of another, n = (a - b)/|a - b|, d how far apart they stay and m the mean of what
// both have moved by in the substep before, the vertex x has the plane
//   n.(x' - x - m) >= -(|a - b| - d)/2,
// anchored at x + m. Of several, and of that of a mesh, it takes the one that it is deepest under at
// x + what it has moved by itself. Vertices with a share of a(s) up to PLAIT_PAIR_SHARE have none.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/strand_contact/segment.hpp"

#include <plait/constants.h>

#include <optional>
#include <vector>

namespace plait::reference {
namespace {

// The anchor relative to where the vertex begins.
struct Plane {
    Vec3 normal, anchor;
    double gap;
    double height(const Vec3& moves) const { return gap + normal.dot(moves - anchor); }
};

std::vector<Plane> planes_of(const strand_contact_args& args, size_t segment, size_t vertex) {
    std::vector<Plane> list;
    const Segment own = segment_at(args.position, segment);
    for (size_t k = 0; k < PLAIT_PAIR_COUNT; ++k) {
        const size_t at = segment * PLAIT_PAIR_COUNT + k;
        const uint32_t other = args.pair_segment[at];
        if (other == PLAIT_PAIR_NONE)
            break;
        const Foot foot = nearest(own, segment_at(args.position, other));
        const double share = vertex == segment ? 1 - foot.s : foot.s;
        const double distance = foot.apart.norm();
        if (share <= PLAIT_PAIR_SHARE || distance <= PLAIT_PAIR_LEAST)
            continue;
        const Vec3 mean = (moves_of(args.position, args.position_prev, segment).at(foot.s) +
                           moves_of(args.position, args.position_prev, other).at(foot.t)) /
                          2;
        list.push_back({foot.apart / distance, mean, (distance - args.pair_offset[at]) / 2});
    }
    return list;
}

std::optional<Plane> deepest(const strand_contact_args& args, size_t vertex, bool is_tip,
                             const Vec3& moves) {
    std::vector<Plane> all = planes_of(args, vertex - 1, vertex);
    if (!is_tip)
        for (const Plane& plane : planes_of(args, vertex, vertex))
            all.push_back(plane);
    std::optional<Plane> found;
    for (const Plane& plane : all)
        if (!found || plane.height(moves) < found->height(moves))
            found = plane;
    return found;
}

} // namespace

void strand_contact(uint32_t item_count, const plait_strand_contact_params& params,
                    const strand_contact_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const Vec3 root = root_of(args.rest, pose_of(args.pose, strand), strand, params.row_stride);
        const auto value = [&](size_t i, size_t component) -> double& {
            return args.lane_plane[lane.index(i, component, PLAIT_LANE_PLANE_COMPONENTS)];
        };
        const auto vector = [&](size_t i, size_t first) -> Vec3 {
            return {value(i, first), value(i, first + 1), value(i, first + 2)};
        };
        const double meshes_to = params.meshes ? value(0, PLAIT_LANE_PLANE_LAST) : 0;
        size_t last = 0;
        for (uint32_t i = 1; i < count; ++i) {
            const size_t vertex = strand * params.row_stride + i;
            const Vec3 begin = lane.vector(args.lane_x, 0) - root + lane.vector(args.lane_x, i);
            const Vec3 moves = xyz(args.position[vertex]) - xyz(args.position_prev[vertex]);
            const auto plane = deepest(args, vertex, i + 1 == count, moves);
            const bool has_mesh = i <= meshes_to && !vector(i, PLAIT_LANE_PLANE_NORMAL).isZero(0);
            if (plane || has_mesh)
                last = i;
            if (has_mesh) {
                const double height = value(i, PLAIT_LANE_PLANE_HEIGHT) +
                                      vector(i, PLAIT_LANE_PLANE_NORMAL)
                                          .dot(begin + moves - vector(i, PLAIT_LANE_PLANE_ANCHOR));
                if (!plane || height <= plane->height(moves))
                    continue;
            }
            const Plane stored = plane.value_or(Plane{Vec3::Zero(), Vec3::Zero(), 0});
            for (Eigen::Index c = 0; c < 3; ++c) {
                value(i, PLAIT_LANE_PLANE_NORMAL + static_cast<size_t>(c)) = stored.normal[c];
                value(i, PLAIT_LANE_PLANE_ANCHOR + static_cast<size_t>(c)) =
                    begin[c] + stored.anchor[c];
            }
            value(i, PLAIT_LANE_PLANE_HEIGHT) = value(i, PLAIT_LANE_PLANE_START) = stored.gap;
            value(i, PLAIT_LANE_PLANE_FRICTION) = double(params.friction);
        }
        value(0, PLAIT_LANE_PLANE_LAST) = double(last);
    }
}

} // namespace plait::reference
