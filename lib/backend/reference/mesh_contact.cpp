// mesh_contact: of each vertex the plane of a mesh that it may meet. With f the distance to the mesh
// less the offset o of the vertex, x_A where the mesh would carry it and y where inertia puts it:
//   the plane of the first place on the way from x_A to y with f < e, found by steps of f; if there
//   is none, of the one of the least f that was looked at; and instead of it that of the foot of y,
//   y - (height of y) n, if |f| there is below a cell's edge and the normals agree,
//   o = min(clearance, min(f_root, 0) + s arc).
// f is trilinear between nodes, its normal the gradient of that over its size.
// Source: ours; signs by Baerentzen & Aanaes 2005, on the host.
#include "backend/reference/lanes.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace plait::reference {
namespace {

struct Sample {
    double distance;
    std::optional<Vec3> gradient; // where the distance is exact
};

class Field {
  public:
    Field(const mesh_contact_args& args, size_t mesh)
        : values_(args.mesh_values), origin_(xyz(args.mesh_grid[mesh])),
          edge_(args.mesh_grid[mesh].w()) {
        for (size_t k = 0; k < 3; ++k) {
            nodes_[k] = args.mesh_nodes[4 * mesh + k];
            if (nodes_[k] < 2)
                throw BadDispatch(
                    format("mesh_nodes[%zu] is %zu, allowed from 2 on", 4 * mesh + k, nodes_[k]));
        }
        first_ = args.mesh_nodes[4 * mesh + 3];
    }

    double edge() const { return edge_; }

    Sample at(const Vec3& x) const {
        const Vec3 cells = (x - origin_) / edge_;
        std::array<size_t, 3> cell{};
        Vec3 share, outside = Vec3::Zero();
        for (Eigen::Index k = 0; k < 3; ++k) {
            const auto axis = static_cast<size_t>(k);
            const double inside = std::clamp(cells[k], 0.0, double(nodes_[axis] - 1));
            outside[k] = cells[k] - inside;
            cell[axis] = std::min(static_cast<size_t>(inside), nodes_[axis] - 2);
            share[k] = inside - double(cell[axis]);
        }
        if (!outside.isZero(0))
            return {edge_ * (outside.norm() + 2), {}};
        double value = 0;
        Vec3 slope = Vec3::Zero();
        for (size_t corner = 0; corner < 8; ++corner) {
            const std::array<size_t, 3> upper{corner & 1, corner >> 1 & 1, corner >> 2};
            Vec3 weight, change;
            for (Eigen::Index k = 0; k < 3; ++k) {
                const bool up = upper[static_cast<size_t>(k)] != 0;
                weight[k] = up ? share[k] : 1 - share[k];
                change[k] = up ? 1 : -1;
            }
            const double node =
                value_at(cell[0] + upper[0], cell[1] + upper[1], cell[2] + upper[2]);
            value += weight.prod() * node;
            slope += node * Vec3(change.x() * weight.y() * weight.z(),
                                 change.y() * weight.z() * weight.x(),
                                 change.z() * weight.x() * weight.y());
        }
        if (value > 2 * edge_)
            return {value, {}};
        return {value, Vec3(slope / edge_)};
    }

  private:
    double value_at(size_t x, size_t y, size_t z) const {
        return values_[first_ + (z * nodes_[1] + y) * nodes_[0] + x];
    }

    const View<const double>& values_;
    Vec3 origin_;
    double edge_;
    std::array<size_t, 3> nodes_{};
    size_t first_;
};

struct Plane {
    Vec3 normal, point;
    double height; // of the point
    double height_of(const Vec3& x) const { return height + normal.dot(x - point); }
};

std::optional<Plane> plane_of(const Sample& sample, const Vec3& point, double offset) {
    if (!sample.gradient || !(sample.gradient->norm() > PLAIT_MESH_MIN_SLOPE))
        return {};
    return Plane{sample.gradient->normalized(), point, sample.distance - offset};
}

std::optional<Plane> met(const Field& field, const Vec3& from, const Vec3& to, double offset) {
    double t = 0, distance = std::numeric_limits<double>::infinity();
    std::optional<Plane> nearest;
    for (int k = 0; k <= PLAIT_MESH_MARCH_STEPS; ++k) {
        const Vec3 at = from + t * (to - from);
        const Sample sample = field.at(at);
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
struct Body {
    Field field;
    Pose pose; // at the end
    Vec3 from;
    Quat turn;
    double friction;

    Body(const mesh_contact_args& args, size_t collider, size_t mesh) : field(args, mesh) {
        const auto row = [&](size_t element) -> Vec4 {
            return args.collider[collider * PLAIT_COLLIDER_STRIDE + element];
        };
        pose = {quat(row(PLAIT_COLLIDER_BEGIN + 1)), xyz(row(PLAIT_COLLIDER_END))};
        from = xyz(row(PLAIT_COLLIDER_BEGIN));
        turn = quat(row(PLAIT_COLLIDER_TURN));
        friction = row(PLAIT_COLLIDER_FRICTION).x();
    }
    Vec3 carried(const Vec3& x) const { return pose.t + turn * (x - from); }
};

// Where a strand's vertices are at the substep's begin, and where inertia and pins alone put them,
// relative to the root of the end.
struct Ways {
    Vec3 root;
    std::vector<Vec3> begin, end;
    std::vector<double> length; // of the segment before a vertex; 0 past the tip

    Ways(const Lane& lane, const plait_lane_params& params, const mesh_contact_args& args,
         const Vec3& root_now)
        : root(root_now) {
        const double h = params.bdf2 ? params.h * 2.0 / 3.0 : params.h, drag = params.drag;
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

struct Touch {
    Plane plane; // in the world, its point the anchor, relative to the root
    double start, friction, gap;
};

std::optional<Touch> touch_of(const Body& body, const Ways& ways, size_t vertex, double clearance,
                              double arc) {
    const double depth = body.field.at(body.pose.invert(ways.root)).distance;
    const double offset =
        std::min(clearance, std::min(depth, 0.0) + PLAIT_CONTACT_ROOT_CLEARANCE * arc);
    const Vec3 anchor = body.carried(ways.root + ways.begin[vertex]);
    const Vec3 from = body.pose.invert(anchor);
    const Vec3 to = body.pose.invert(ways.root + ways.end[vertex]);
    const double start = body.field.at(from).distance - offset;
    if (start > (to - from).norm() + 2 * body.field.edge())
        return {};
    const auto plane = met(body.field, from, to, offset);
    if (!plane)
        return {};
    return Touch{{body.pose.q * plane->normal, anchor - ways.root, plane->height_of(from)},
                 start,
                 body.friction,
                 plane->height_of(to)};
}

void store(const View<double>& planes, const Lane& lane, size_t row,
           const std::optional<Touch>& touch) {
    std::vector<double> values(3); // no normal
    if (touch)
        values = {touch->plane.normal.x(), touch->plane.normal.y(),
                  touch->plane.normal.z(), touch->plane.point.x(),
                  touch->plane.point.y(),  touch->plane.point.z(),
                  touch->plane.height,     touch->start,
                  touch->friction};
    for (size_t c = 0; c < values.size(); ++c)
        planes[lane.index(row, c, PLAIT_LANE_PLANE_COMPONENTS)] = values[c];
}

} // namespace

void mesh_contact(uint32_t item_count, const plait_lane_params& params,
                  const mesh_contact_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const Ways ways(lane, params, args,
                        root_of(args.rest, pose_of(args.pose, strand), strand, params.row_stride));
        double arc = 0;
        std::vector<std::optional<Touch>> list(params.vertex_stride);
        size_t last = 0;
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            arc += ways.length[i];
            std::optional<Touch>& deepest = list[i];
            for (size_t mesh = 0; mesh < params.collider_count && ways.length[i] > 0; ++mesh) {
                const double clearance =
                    args.mesh_clearance[(strand * params.row_stride + i) * params.collider_count +
                                        mesh];
                const auto touch = touch_of(Body(args, params.collider_first + mesh, mesh), ways, i,
                                            clearance, arc);
                if (touch && (!deepest || touch->gap < deepest->gap))
                    deepest = touch;
            }
            if (deepest)
                last = i;
        }
        args.lane_plane[lane.index(0, PLAIT_LANE_PLANE_LAST, PLAIT_LANE_PLANE_COMPONENTS)] =
            double(last);
        for (size_t i = 1; i <= last; ++i)
            store(args.lane_plane, lane, i, list[i]);
    }
}

} // namespace plait::reference
