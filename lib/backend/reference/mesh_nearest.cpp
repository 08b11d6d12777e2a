// mesh_nearest: of each vertex the plane of a mesh that bends, by the nearest point c of its triangles:
// f = |x - c|, negative where n.(x - c) < 0 with n the face's normal, on an edge the sum of its faces',
// in a corner that of the faces' normals times their angles there. Corners are those at a share of the
// fixed step, x = x_from + share (x_to - x_from).
//   x_A  c_end + R (x - c_begin), c in its triangle at the substep's begin and at its end, R the least
//        turn of the normal there; at most the substep's bending and ROOM/2 from where it was in the frame
//   plane: of the place with the least f - o on the way from x_A to y, walked by steps of f - o unless
//          f at its ends covers it, or of y, where that is no farther off and the normals agree
//   where f is beyond ROOM there is none. Of a sheet |f| counts, on the side where the vertex came from.
// Source: ours; Ericson 2005, 5.1.5; sides by Baerentzen & Aanaes 2005.
#include "backend/reference/mesh_ways.hpp"

#include <plait/constants.h>

#include <cmath>
#include <limits>

namespace plait::reference {
namespace {

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    size_t triangle = 0;
    Vec3 shares = Vec3::Zero(); // of the corners
    Vec3 point = Vec3::Zero();
};

struct Sample {
    double distance; // negative inside
    Vec3 normal;
    bool rim;
};

Vec3 unit(const Vec3& v) {
    return v.norm() > 0 ? Vec3(v / v.norm()) : Vec3(Vec3::Zero());
}

// Of a segment, its share.
double nearest_share(const Vec3& from, const Vec3& to, const Vec3& x) {
    const Vec3 way = to - from;
    return std::clamp(way.dot(x - from) / way.squaredNorm(), 0.0, 1.0);
}

class Surface {
  public:
    Surface(const mesh_nearest_args& args, size_t mesh) : args_(args) {
        const auto first = [&](size_t what) {
            return size_t{args.mesh_first[mesh * PLAIT_MESH_FIRST_STRIDE + what]};
        };
        triangle_ = first(PLAIT_MESH_FIRST_TRIANGLE);
        vertex_ = first(PLAIT_MESH_FIRST_VERTEX);
        two_sided = first(PLAIT_MESH_FIRST_TWO_SIDED) != 0;
        bends = args.mesh_bends[mesh];
        count_ = first(PLAIT_MESH_FIRST_COUNT);
    }

    Vec3 corner(size_t triangle, size_t k, double share) const {
        return vertex(word(triangle, k), share);
    }
    Vec3 face(size_t triangle, double share) const {
        const Vec3 a = corner(triangle, 0, share);
        return (corner(triangle, 1, share) - a).cross(corner(triangle, 2, share) - a);
    }

    std::optional<Nearest> nearest(const Vec3& x, double share, double bound) const {
        Nearest best;
        best.distance = bound;
        bool found = false;
        for (size_t t = 0; t < count_; ++t) {
            const Vec3 p[3] = {corner(t, 0, share), corner(t, 1, share), corner(t, 2, share)};
            const Vec3 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]),
                       high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
            if ((low - x).cwiseMax(x - high).cwiseMax(0.0).norm() > best.distance)
                continue;
            const Vec3 shares = shares_of(p, x);
            const Vec3 point = shares[0] * p[0] + shares[1] * p[1] + shares[2] * p[2];
            if (const double distance = (x - point).norm(); distance < best.distance) {
                best = {distance, t, shares, point};
                found = true;
            }
        }
        return found ? std::optional(best) : std::nullopt;
    }

    std::optional<Sample> at(const Vec3& x, double share, double bound) const {
        const auto found = nearest(x, share, bound);
        if (!found)
            return {};
        bool rim = false;
        const Vec3 outward = outward_of(*found, share, rim), way = x - found->point;
        const double sign = way.dot(outward) < 0 ? -1 : 1;
        const bool round = found->shares.minCoeff() <= 0 && found->distance > PLAIT_MESH_TOUCH;
        return Sample{sign * found->distance, unit(round ? Vec3(sign * way) : outward), rim};
    }

    // Where what is at x at one share is at another.
    Vec3 carried(const Nearest& under, const Vec3& x, double begin, double end, double most) const {
        Vec3 point = Vec3::Zero();
        for (size_t k = 0; k < 3; ++k)
            point += under.shares[static_cast<Eigen::Index>(k)] * corner(under.triangle, k, end);
        bool rim = false;
        const Vec3 from = outward_of(under, begin, rim), to = outward_of(under, end, rim);
        if (!(from.norm() > 0 && to.norm() > 0))
            return x;
        const Vec3 moved = point + Quat::FromTwoVectors(from, to) * (x - under.point) - x;
        return x + moved * std::min(1.0, most / std::max(moved.norm(), 1e-9));
    }

    bool two_sided;
    double bends;

  private:
    size_t word(size_t triangle, size_t k) const {
        return args_.mesh_triangle[(triangle_ + triangle) * PLAIT_MESH_TRIANGLE_STRIDE + k];
    }
    Vec3 vertex(size_t index, double share) const {
        const Vec3 from = xyz(args_.mesh_from[vertex_ + index]);
        return from + share * (xyz(args_.mesh_to[vertex_ + index]) - from);
    }

    // Of the corners, of the nearest point: inside where the plane's foot is, else on an edge.
    static Vec3 shares_of(const Vec3 (&p)[3], const Vec3& x) {
        const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
        Vec3 shares;
        for (Eigen::Index k = 0; k < 3; ++k)
            shares[k] = (p[(k + 2) % 3] - p[(k + 1) % 3]).cross(x - p[(k + 1) % 3]).dot(normal) /
                        normal.squaredNorm();
        if (shares.minCoeff() > 0)
            return shares;
        double least = std::numeric_limits<double>::infinity();
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Vec3 &from = p[k], &to = p[(k + 1) % 3];
            const double share = nearest_share(from, to, x);
            const double distance = (from + share * (to - from) - x).norm();
            if (!(distance < least))
                continue;
            least = distance;
            shares.setZero();
            shares[k] = 1 - share;
            shares[(k + 1) % 3] = share;
        }
        return shares;
    }

    Vec3 outward_of(const Nearest& found, double share, bool& rim) const {
        for (size_t k = 0; k < 3; ++k)
            if (found.shares[static_cast<Eigen::Index>(k)] >= 1)
                return outward_of_corner(word(found.triangle, k), share, rim);
        const Vec3 own = face(found.triangle, share);
        for (size_t k = 0; k < 3; ++k)
            if (found.shares[static_cast<Eigen::Index>(k)] <= 0) {
                const size_t other = word(found.triangle, 3 + (k + 1) % 3);
                rim = other == PLAIT_MESH_NO_TRIANGLE;
                return unit(own) + (rim ? Vec3(Vec3::Zero()) : unit(face(other, share)));
            }
        return own;
    }

    Vec3 outward_of_corner(size_t index, double share, bool& rim) const {
        Vec3 sum = Vec3::Zero();
        for (size_t t = 0; t < count_; ++t)
            for (size_t k = 0; k < 3; ++k) {
                if (word(t, k) != index)
                    continue;
                const Vec3 a = corner(t, (k + 1) % 3, share) - corner(t, k, share),
                           b = corner(t, (k + 2) % 3, share) - corner(t, k, share);
                sum += unit(a.cross(b)) * std::atan2(a.cross(b).norm(), a.dot(b));
                rim = rim || word(t, 3 + k) == PLAIT_MESH_NO_TRIANGLE ||
                      word(t, 3 + (k + 2) % 3) == PLAIT_MESH_NO_TRIANGLE;
            }
        return sum;
    }

    const mesh_nearest_args& args_;
    size_t triangle_, vertex_, count_;
};

// A mesh over a substep.
struct Body {
    Body(const mesh_nearest_args& args, size_t collider, size_t mesh)
        : surface(args, mesh), motion(args.collider, collider),
          bends(surface.bends * (motion.end - motion.begin)) {}

    std::optional<Sample> at(const Vec3& x, double bound) const {
        return surface.at(x, motion.end, bound);
    }
    double depth_of(const Vec3& root) const {
        const auto sample = surface.two_sided
                                ? std::nullopt
                                : at(motion.pose.invert(root), double{PLAIT_MESH_ROOT_DEPTH});
        return sample ? std::min(sample->distance, 0.0) : 0;
    }
    Vec3 carried(const Vec3& rigid, const Vec3& to) const {
        if (!(surface.bends > 0))
            return rigid;
        const auto under =
            surface.nearest(rigid, motion.begin, (to - rigid).norm() + bends + 2 * PLAIT_MESH_ROOM);
        return under ? surface.carried(*under, rigid, motion.begin, motion.end,
                                       bends + 0.5 * PLAIT_MESH_ROOM)
                     : rigid;
    }

    Surface surface;
    MeshMotion motion;
    double bends;
};

// The way of a vertex past a mesh, seen from the side where it is.
class Walk {
  public:
    Walk(const Body& body, double offset) : body_(body), offset_(offset) {}

    // f - o; of a sheet it says on which side the place is, too, if that is beyond its rim.
    std::optional<double> look(const Vec3& x, double bound) {
        seen_ = false;
        const auto sample = body_.at(x, bound);
        if (!sample)
            return {};
        double sign = 1;
        if (body_.surface.two_sided) {
            if (side_ == 0 || sample->rim)
                side_ = sample->distance < 0 ? -1 : 1;
            sign = side_;
        }
        const double height = sign * sample->distance - offset_;
        if (std::abs(sample->distance) <= PLAIT_MESH_ROOM && sample->normal.norm() > 0.5) {
            seen_ = true;
            plane_ = {sign * sample->normal, x, height};
        }
        return height;
    }
    // Of what was looked at last.
    std::optional<MeshPlaneAt> plane() const {
        return seen_ ? std::optional(plane_) : std::nullopt;
    }

  private:
    const Body& body_;
    double offset_, side_ = 0;
    bool seen_ = false;
    MeshPlaneAt plane_{Vec3::Zero(), Vec3::Zero(), 0};
};

// The plane of the place with the least f - o on the way, up to where that is nothing.
std::optional<MeshPlaneAt> met(Walk walk, const Vec3& from, const Vec3& to, double start,
                               double offset) {
    const double way = (to - from).norm();
    std::optional<MeshPlaneAt> nearest = walk.plane();
    double distance = start, t = 0;
    for (int k = 0; k < PLAIT_MESH_MARCH_STEPS; ++k) {
        if (distance < PLAIT_MESH_MARCH_LEAST || t >= 1)
            break;
        const double before = t;
        t = std::min(t + distance / std::max(way, 1e-9), 1.0);
        const auto next = walk.look(from + t * (to - from),
                                    std::abs(distance + offset) + (t - before) * way + 1e-5);
        if (!next)
            break;
        distance = *next;
        if (walk.plane() && (!nearest || walk.plane()->height < nearest->height))
            nearest = walk.plane();
    }
    return nearest;
}

std::optional<MeshTouch> touch_of(const Body& body, const MeshWays& ways, size_t vertex,
                                  double clearance, double depth, double arc) {
    const double offset = std::min(clearance, depth + PLAIT_CONTACT_ROOT_CLEARANCE * arc);
    const Pose& pose = body.motion.pose;
    const Vec3 rigid = pose.invert(body.motion.carried(ways.root + ways.begin[vertex]));
    const Vec3 to = pose.invert(ways.root + ways.end[vertex]);
    const Vec3 from = body.carried(rigid, to);
    const double room = (to - from).norm() + PLAIT_MESH_ROOM;
    Walk walk(body, offset);
    const auto start = walk.look(from, room + std::max(offset, 0.0));
    if (!start || *start > room)
        return {};
    Walk last = walk;
    const double way = (to - from).norm();
    const auto height = last.look(to, std::abs(*start + offset) + way + 1e-5);
    auto plane = walk.plane();
    if (height && *start + *height < way)
        plane = met(walk, from, to, *start, offset);
    const auto end = last.plane();
    if (end && plane) {
        const double off = std::abs(end->height - plane->height_of(to));
        if (off < way + PLAIT_MESH_MARCH_LEAST &&
            end->normal.dot(plane->normal) > PLAIT_SWEEP_SAME_SIDE)
            plane = end;
    } else if (end) {
        plane = end;
    }
    if (!plane)
        return {};
    return MeshTouch{{pose.q * plane->normal, pose.apply(from) - ways.root, plane->height_of(from)},
                     *start,
                     body.motion.friction,
                     plane->height_of(to)};
}

// What meshes before it have left.
std::vector<std::optional<MeshTouch>> touches_left(const mesh_nearest_args& args, const Lane& lane,
                                                   const plait_lane_params& params,
                                                   const MeshWays& ways) {
    std::vector<std::optional<MeshTouch>> list(params.vertex_stride);
    const auto planes = mesh_planes_of(lane, params, args.lane_plane.as_const());
    for (size_t i = 0; i < planes.size(); ++i)
        if (const auto& plane = planes[i])
            list[i] = MeshTouch{{plane->normal, plane->anchor, plane->height},
                                plane->start,
                                plane->friction,
                                plane->height + plane->normal.dot(ways.end[i] - plane->anchor)};
    return list;
}

} // namespace

void mesh_nearest(uint32_t item_count, const plait_lane_params& params,
                  const mesh_nearest_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const MeshWays ways(
            lane, params, args,
            root_of(args.rest, pose_of(args.pose, strand), strand, params.row_stride));
        auto list = touches_left(args, lane, params, ways);
        std::vector<Body> bodies;
        std::vector<double> depths;
        for (size_t mesh = 0; mesh < params.collider_count; ++mesh) {
            bodies.emplace_back(args, params.collider_first + mesh, mesh);
            depths.push_back(bodies.back().depth_of(ways.root));
        }
        find_touches(params, strand, ways, args.mesh_clearance, list,
                     [&](size_t mesh, size_t i, double clearance, double arc) {
                         return touch_of(bodies[mesh], ways, i, clearance, depths[mesh], arc);
                     });
        store_planes(args.lane_plane, lane, list);
    }
}

} // namespace plait::reference
