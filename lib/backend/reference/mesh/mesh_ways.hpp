// What the stages that find planes of meshes have in common: how a mesh moves, the ways of vertices, and
// where planes go.
#pragma once

#include "backend/reference/base/lanes.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace plait::reference {

struct MeshPlaneAt {
    Vec3 normal, point;
    double height; // of the point
    double height_of(const Vec3& x) const { return height + normal.dot(x - point); }
};

// How a mesh moves over a substep, but for what bends.
struct MeshMotion {
    Pose pose; // at the end
    Vec3 from; // where its origin is at the begin
    Quat turn;
    double friction;
    double begin, end; // shares of the fixed step

    MeshMotion(const View<const Vec4>& colliders, size_t collider) {
        const auto row = [&](size_t element) -> Vec4 {
            return colliders[collider * PLAIT_COLLIDER_STRIDE + element];
        };
        pose = {quat(row(PLAIT_COLLIDER_BEGIN + 1)), xyz(row(PLAIT_COLLIDER_END))};
        from = xyz(row(PLAIT_COLLIDER_BEGIN));
        turn = quat(row(PLAIT_COLLIDER_TURN));
        friction = row(PLAIT_COLLIDER_FRICTION).x();
        begin = row(PLAIT_COLLIDER_BEGIN).w();
        end = row(PLAIT_COLLIDER_END).w();
    }
    Vec3 carried(const Vec3& x) const { return pose.t + turn * (x - from); }
    Vec3 carried_from(const Vec3& x) const { return from + turn.conjugate() * (x - pose.t); }
};

// Where a strand's vertices are at the substep's begin, and where inertia and pins alone put them,
// relative to the root of the end.
struct MeshWays {
    Vec3 root;
    std::vector<Vec3> begin, end;
    std::vector<double> length; // of the segment before a vertex; 0 past the tip
    bool is_tip(size_t i) const { return i + 1 == length.size() || length[i + 1] == 0; }

    template <typename Args>
    MeshWays(const Lane& lane, const plait_lane_params& params, const Args& args,
             const Vec3& root_now)
        : root(root_now) {
        const double h = params.bdf2 ? params.h * 2.0 / 3.0 : params.h;
        const double drag =
            params.drag * scale_of(lane, args.lane_material, params.vertex_stride, PLAIT_LANE_DRAG);
        const auto continued = [&](const auto& data, const auto& before, size_t i) -> Vec3 {
            const Vec3 now = lane.vector(data, i);
            return params.bdf2 ? Vec3(now + (now - lane.vector(before, i)) / 3) : now;
        };
        const auto material = [&](size_t i, size_t component) {
            return args.lane_material[lane.index(i, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
        };
        const Vec3 root_from = continued(args.lane_x, args.lane_x_before, 0) - root;
        const Vec3 start = lane.vector(args.lane_x, 0) - root;
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            Vec3 pull = vec3(params.gravity) + drag * vec3(params.air);
            if (params.accelerates)
                pull += lane.vector(args.lane_acceleration, i);
            const Vec3 v = continued(args.lane_v, args.lane_v_before, i);
            const Vec3 x = continued(args.lane_x, args.lane_x_before, i);
            Vec3 y = root_from + x + h * (v + h * pull) / (1 + drag * h);
            if (params.pins && i > 0) {
                const Vec3 p(args.lane_pin[lane.index(i, 0, 4)], args.lane_pin[lane.index(i, 1, 4)],
                             args.lane_pin[lane.index(i, 2, 4)]);
                const double k = args.lane_pin[lane.index(i, 3, 4)];
                const double mu = material(i, PLAIT_LANE_MASS) * (1 + drag * h) / (h * h);
                if (k > 0)
                    y = (mu * y + k * p) / (mu + k);
            }
            begin.push_back(start + lane.vector(args.lane_x, i));
            end.push_back(y);
            length.push_back(i > 0 ? material(i - 1, PLAIT_LANE_LENGTH) : 0);
        }
    }
};

// The plane of `found`, a place of a mesh of that normal, beside `plane`, the plane of a vertex whose way begins at `from`:
// if the vertex begins no deeper than `sunk` under it, and each place lies on the free side of the other plane. The mesh
// begins `offset` outside its surface.
inline std::optional<Hollow::Wall> wall_beside(const MeshPlaneAt& plane, double offset,
                                               const Vec3& from, const Vec3& found,
                                               const Vec3& normal, double sunk) {
    const Vec3 rise = found - (plane.point - (plane.height + offset) * plane.normal);
    const double height = normal.dot(from - found) - offset;
    if (height < -sunk || plane.normal.dot(rise) < -PLAIT_MESH_FLAT ||
        normal.dot(rise) > PLAIT_MESH_FLAT)
        return {};
    return Hollow::Wall{normal, height};
}

// The second plane of a tip, which may be thrown farther than its way goes, and across a crease: of two walls that are found
// by `beside`(x) from places x, `above` the plane over both ends of the way, the deeper one at the way's end.
template <typename Beside>
std::optional<Hollow::Wall> crease_of(const MeshPlaneAt& plane, double above, const Vec3& from,
                                      const Vec3& to, const Beside& beside) {
    const auto wall_over = [&](const Vec3& x) -> std::optional<Hollow::Wall> {
        return beside(Vec3(x + (above - plane.height_of(x)) * plane.normal));
    };
    const auto depth = [&](const Hollow::Wall& wall) {
        return -(wall.height + wall.normal.dot(to - from));
    };
    const auto one = wall_over(from), other = wall_over(to);
    return one && other ? depth(*other) > depth(*one) ? other : one : one ? one : other;
}

struct MeshTouch {
    MeshPlaneAt plane; // in the world, its point the anchor, relative to the root
    double start, friction, gap;
    std::optional<Hollow::Wall> crease = {}; // of a tip; in the world
};

// Of every mesh of a strand and every vertex, by `touch_of`(mesh, vertex, clearance, arc), the deepest;
// `list` [V] may hold some of other meshes.
template <typename TouchOf>
void find_touches(const plait_lane_params& params, size_t strand, const MeshWays& ways,
                  const View<const double>& clearance, std::vector<std::optional<MeshTouch>>& list,
                  const TouchOf& touch_of) {
    double arc = 0;
    for (uint32_t i = 0; i < params.vertex_stride; ++i) {
        arc += ways.length[i];
        for (size_t mesh = 0; mesh < params.collider_count && ways.length[i] > 0; ++mesh) {
            const size_t row = strand * params.row_stride + i;
            const std::optional<MeshTouch> touch =
                touch_of(mesh, i, clearance[row * params.collider_count + mesh], arc);
            if (touch && (!list[i] || touch->gap < list[i]->gap))
                list[i] = touch;
        }
    }
}

inline const Hollow::Wall no_wall{Vec3::Zero(), 0};

// Rows up to the last that has one.
inline void store_planes(const View<double>& planes, const Lane& lane,
                         const std::vector<std::optional<MeshTouch>>& list) {
    const auto at = [&](size_t row, size_t c) -> double& {
        return planes[lane.index(row, c, PLAIT_LANE_PLANE_COMPONENTS)];
    };
    size_t last = list.size() - 1;
    while (last > 0 && !list[last])
        --last;
    at(0, PLAIT_LANE_PLANE_LAST) = double(last);
    const Hollow::Wall crease =
        last > 0 ? list[last]->crease.value_or(no_wall) : no_wall; // no other vertex has one
    for (int c = 0; c < 3; ++c)
        at(0, PLAIT_LANE_PLANE_CREASE + size_t(c)) = crease.normal[c];
    at(0, PLAIT_LANE_PLANE_CREASE + 3) = crease.height;
    for (size_t i = 1; i <= last; ++i) {
        std::vector<double> values(3); // no normal
        if (const auto& touch = list[i])
            values = {touch->plane.normal.x(), touch->plane.normal.y(),
                      touch->plane.normal.z(), touch->plane.point.x(),
                      touch->plane.point.y(),  touch->plane.point.z(),
                      touch->plane.height,     touch->start,
                      touch->friction};
        for (size_t c = 0; c < values.size(); ++c)
            at(i, c) = values[c];
    }
}

} // namespace plait::reference
