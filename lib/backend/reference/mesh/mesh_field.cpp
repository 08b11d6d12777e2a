// mesh_field: of each vertex the plane of a mesh that it may meet. With f the distance to the mesh
// less the offset o of the vertex, x_A where the mesh would carry it and y where inertia puts it:
//   the plane of the first place on the way from x_A to y with f < e, found by steps of f; if there
//   is none, of the one of the least f that was looked at; and instead of it that of the foot of y,
//   y - (height of y) n, if |f| there is below a cell's edge and the normals agree,
//   o = min(clearance, min(f_root, 0) + s arc).
// f is trilinear between nodes, its normal the gradient of that over its size.
// Source: ours; signs by Baerentzen & Aanaes 2005, on the host.
#include "backend/reference/mesh/field_sample.hpp"
#include "backend/reference/mesh/mesh_ways.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plait::reference {
namespace {

std::optional<MeshPlaneAt> plane_of(const FieldSample& sample, const Vec3& point, double offset) {
    if (!sample.gradient || !(sample.gradient->norm() > PLAIT_MESH_MIN_SLOPE))
        return {};
    return MeshPlaneAt{sample.gradient->normalized(), point, sample.distance - offset};
}

std::optional<MeshPlaneAt> met(const MeshField& field, const Vec3& from, const Vec3& to,
                               double offset) {
    double t = 0, distance = std::numeric_limits<double>::infinity();
    std::optional<MeshPlaneAt> nearest;
    for (int k = 0; k <= PLAIT_MESH_MARCH_STEPS; ++k) {
        const Vec3 at = from + t * (to - from);
        const FieldSample sample = field.at(at);
        distance = sample.distance - offset;
        const auto plane = plane_of(sample, at, offset);
        if (plane && (!nearest || plane->height < nearest->height))
            nearest = plane;
        if (distance < PLAIT_MESH_MARCH_LEAST || t >= 1)
            break;
        const double step = std::max(distance, PLAIT_MESH_MARCH_STEP * field.edge());
        t = std::min(t + step / std::max((to - from).norm(), 1e-9), 1.0);
    }
    if (!nearest)
        return {};
    const Vec3 foot = to - nearest->height_of(to) * nearest->normal;
    const auto there = plane_of(field.at(foot), foot, offset);
    const bool agrees = there && std::abs(there->height) < field.edge() &&
                        there->normal.dot(nearest->normal) > PLAIT_SWEEP_SAME_SIDE;
    return agrees ? there : nearest;
}

// A mesh over a substep.
struct FieldBody {
    FieldBody(const mesh_field_args& args, size_t collider, size_t mesh)
        : field(args, mesh), motion(args.collider, collider) {}
    MeshField field;
    MeshMotion motion;
};

std::optional<MeshTouch> touch_of(const FieldBody& body, const MeshWays& ways, size_t vertex,
                                  double clearance, double arc) {
    const double depth = body.field.at(body.motion.pose.invert(ways.root)).distance;
    const double offset =
        std::min(clearance, std::min(depth, 0.0) + PLAIT_CONTACT_ROOT_CLEARANCE * arc);
    const Vec3 anchor = body.motion.carried(ways.root + ways.begin[vertex]);
    const Vec3 from = body.motion.pose.invert(anchor);
    const Vec3 to = body.motion.pose.invert(ways.root + ways.end[vertex]);
    const double start = body.field.at(from).distance - offset;
    if (start > (to - from).norm() + body.field.room())
        return {};
    const auto plane = met(body.field, from, to, offset);
    if (!plane)
        return {};
    MeshTouch touch{
        {body.motion.pose.q * plane->normal, anchor - ways.root, plane->height_of(from)},
        start,
        body.motion.friction,
        plane->height_of(to)};
    if (ways.is_tip(vertex))
        touch.crease = crease_of(
            *plane, body.field.room(), from, to, [&](const Vec3& x) -> std::optional<Hollow::Wall> {
                const auto other = plane_of(body.field.at(x), x, 0);
                return other ? wall_beside(*plane, offset, from, x - other->height * other->normal,
                                           other->normal, PLAIT_MESH_CREASE)
                             : std::nullopt;
            });
    if (touch.crease)
        touch.crease->normal = body.motion.pose.q * touch.crease->normal;
    return touch;
}

} // namespace

void mesh_field(uint32_t item_count, const plait_lane_params& params, const mesh_field_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const MeshWays ways(
            lane, params, args,
            root_of(args.rest, pose_of(args.pose, strand), strand, params.row_stride));
        std::vector<std::optional<MeshTouch>> list(params.vertex_stride);
        find_touches(params, strand, ways, args.mesh_clearance, list,
                     [&](size_t mesh, size_t i, double clearance, double arc) {
                         return touch_of(FieldBody(args, params.collider_first + mesh, mesh), ways,
                                         i, clearance, arc);
                     });
        store_planes(args.lane_plane, lane, list);
    }
}

} // namespace plait::reference
