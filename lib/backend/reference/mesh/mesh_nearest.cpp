// mesh_nearest: of each vertex the plane of a mesh that bends, by the nearest point c of its triangles:
// f = |x - c|, negative where n.(x - c) < 0 with n the face's normal, on an edge the sum of its faces',
// in a corner that of the faces' normals times their angles there. Corners are those at a share of the
// fixed step, x = x_from + share (x_to - x_from).
//   x_A  c_end + R (x - c_begin), c in its triangle at the substep's begin and at its end, R the least
//        turn of the normal there; at most the substep's bending and ROOM/2 from where it was in the frame
//   plane: of the place with the least f - o on the way from x_A to y, walked by steps of f - o unless
//          f at its ends covers it, or of y, where that is no farther off and the normals agree
//   where f is beyond ROOM there is none. Of a sheet |f| counts, on the side where the vertex belongs: at
//   first that where it is. When it is on the other one, it stays so if its way through the substep before, from
//   x_A to where it is, passed through a triangle, and belongs there if not, or if a rim is nearest.
// Source: ours; Ericson 2005, 5.1.5; sides by Baerentzen & Aanaes 2005.
#include "backend/reference/mesh/mesh_surface.hpp"
#include "backend/reference/mesh/mesh_ways.hpp"

#include <plait/constants.h>

#include <cmath>
#include <limits>

namespace plait::reference {
namespace {

// A mesh over a substep.
struct SurfaceBody {
    SurfaceBody(const mesh_nearest_args& args, size_t collider, size_t mesh)
        : surface(args, mesh), motion(args.collider, collider),
          bends(surface.bends * (motion.end - motion.begin)) {}

    std::optional<SurfaceSample> at(const Vec3& x, double bound) const {
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

    MeshSurface<mesh_nearest_args> surface;
    MeshMotion motion;
    double bends;
};

// The way of a vertex past a mesh, seen from the side where it is.
class Walk {
  public:
    Walk(const SurfaceBody& body, double offset) : body_(body), offset_(offset) {}

    // Before the first look, `from` where the way begins, which is at `rigid` of the frame before the mesh
    // bends. `known`: the row of mesh_side, and what it becomes.
    void belong(const Vec3& from, const Vec3& rigid, double bound, Vec4& known) {
        const Vec4 last = known;
        known.setZero();
        const auto sample = body_.at(from, bound);
        if (!sample) // out of reach
            return;
        const double own = sample->distance < 0 ? -1 : 1, was = last.w() < 0 ? -1 : 1;
        side_ = last.w() == 0 || sample->rim ? own : was;
        const bool astray = std::abs(last.w()) > 0.75 * double{PLAIT_MESH_SIDE_ASTRAY};
        if (side_ != own && !astray && !body_.surface.passed(xyz(last), rigid, body_.motion.begin))
            side_ = own;
        known << from, (side_ == own ? 1 : double{PLAIT_MESH_SIDE_ASTRAY}) * side_;
    }

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
        const double far =
            body_.surface.two_sided ? sign * sample->distance : std::abs(sample->distance);
        if (far <= PLAIT_MESH_ROOM && sample->normal.norm() > 0.5) {
            seen_ = true;
            plane_ = {sign * sample->normal, x, height};
        }
        return height;
    }
    double side() const { return side_; }
    // Of what was looked at last.
    std::optional<MeshPlaneAt> plane() const {
        return seen_ ? std::optional(plane_) : std::nullopt;
    }

  private:
    const SurfaceBody& body_;
    double offset_, side_ = 0;
    bool seen_ = false;
    MeshPlaneAt plane_{Vec3::Zero(), Vec3::Zero(), 0};
};

// The plane of the place with the least f - o on the way, up to where that is nothing.
std::optional<MeshPlaneAt> met_on_the_way(Walk walk, const Vec3& from, const Vec3& to, double start,
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

// What a vertex meets of a mesh.
struct Met {
    std::optional<MeshTouch> touch;
    std::optional<double> room; // m, of one without a plane, to a sheet that is near
    Vec3 anchor;                // relative to the root: where its way begins
    std::vector<Hollow::Wall> walls;
    bool fast = false; // it goes along the plane of a sheet
};

// The plane that a vertex has, and its way.
struct OwnWall {
    const SurfaceBody& body;
    const MeshPlaneAt& plane;
    const Vec3 &from, &to;
    double offset, side;

    // That nearest to x.
    std::optional<Hollow::Wall> beside(const Vec3& x, double bound, double sunk) const {
        const auto sample = body.at(x, bound);
        if (!sample || sample->rim)
            return {};
        return wall_beside(plane, offset, from, sample->point, side * sample->normal, sunk);
    }
};

// The planes of a sheet around the one that a vertex has, each in front of the other.
std::vector<Hollow::Wall> walls_around(const OwnWall& own) {
    const auto& [body, plane, from, to, offset, side] = own;
    const Vec3 &n = plane.normal, way = to - from, along = way - n.dot(way) * n;
    const double far = std::max(PLAIT_MESH_HOLLOW * way.norm(), double{PLAIT_MESH_ROOM});
    const Vec3 ahead = far * along.normalized(), aside = n.cross(ahead),
               below = to - plane.height_of(to) * n;
    std::vector<Hollow::Wall> walls;
    for (const Vec3& way_out :
         {ahead, Vec3(-ahead), aside, Vec3(-aside), Vec3(2 * ahead), Vec3(-2 * ahead)}) {
        walls.push_back(
            own.beside(below + way_out, way_out.norm() + 2 * PLAIT_MESH_ROOM, 0).value_or(no_wall));
        walls.back().normal = body.motion.pose.q * walls.back().normal;
    }
    return walls;
}

Met met_by(const SurfaceBody& body, const MeshWays& ways, size_t vertex, double clearance,
           double depth, double arc, Vec4& known) {
    const double offset = std::min(clearance, depth + PLAIT_CONTACT_ROOT_CLEARANCE * arc);
    const Pose& pose = body.motion.pose;
    const Vec3 rigid = pose.invert(body.motion.carried(ways.root + ways.begin[vertex]));
    const Vec3 to = pose.invert(ways.root + ways.end[vertex]);
    const Vec3 from = body.carried(rigid, to);
    const double way = (to - from).norm(), room = way + PLAIT_MESH_ROOM;
    Met met;
    met.anchor = pose.apply(from) - ways.root;
    Walk walk(body, offset);
    if (body.surface.two_sided)
        walk.belong(from, rigid, room, known);
    const auto start = walk.look(from, room + std::max(offset, 0.0));
    const double side = walk.side();
    if (body.surface.two_sided)
        if (const auto there = body.at(to, 2 * way + 3 * PLAIT_MESH_ROOM)) {
            const double last = std::abs(there->distance),
                         least = start ? (std::abs(*start + offset) + last - way) / 2 : last - way;
            met.room = std::max(least, double{PLAIT_MESH_ROOM});
        }
    if (!start || *start > room)
        return met;
    Walk last = walk;
    const auto height = last.look(to, std::abs(*start + offset) + way + 1e-5);
    auto plane = walk.plane();
    if (height && *start + *height < way)
        plane = met_on_the_way(walk, from, to, *start, offset);
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
        return met;
    met.room.reset();
    met.touch = {{pose.q * plane->normal, met.anchor, plane->height_of(from)},
                 *start,
                 body.motion.friction,
                 plane->height_of(to)};
    const Vec3 along = to - from - plane->normal.dot(to - from) * plane->normal;
    met.fast = body.surface.two_sided && way > PLAIT_MESH_ROOM && along.norm() > PLAIT_MESH_SLIDE;
    const OwnWall own{body, *plane, from, to, offset, body.surface.two_sided ? side : 1};
    if (met.fast)
        met.walls = walls_around(own);
    if (ways.is_tip(vertex) && !body.surface.two_sided) // whose hollows are in lane_hollow
        met.touch->crease = crease_of(*plane, 2 * PLAIT_MESH_ROOM, from, to, [&](const Vec3& x) {
            return own.beside(x, 3 * PLAIT_MESH_ROOM, PLAIT_MESH_CREASE);
        });
    if (met.touch->crease)
        met.touch->crease->normal = pose.q * met.touch->crease->normal;
    return met;
}

// Rows of lane_hollow.
class Hollows {
  public:
    Hollows(const View<double>& rows, const Lane& lane, size_t vertices)
        : rows_(rows), lane_(lane) {
        for (size_t i = 1; i < vertices; ++i)
            at(i, PLAIT_LANE_HOLLOW_KIND) = double(PLAIT_HOLLOW_NONE);
    }

    // `deepest`: a plane of the mesh is the one that the vertex has.
    void take(size_t vertex, const Met& met, bool deepest) {
        if (met.touch && deepest)
            take_walls(vertex, met);
        else if (met.room && least_room(vertex) > *met.room)
            store(vertex, PLAIT_LANE_HOLLOW_ANCHOR,
                  {met.anchor.x(), met.anchor.y(), met.anchor.z(), *met.room}, PLAIT_HOLLOW_ROOM);
    }

  private:
    double& at(size_t vertex, size_t component) {
        return rows_[lane_.index(vertex, component, PLAIT_LANE_HOLLOW_COMPONENTS)];
    }
    double least_room(size_t vertex) {
        const double kind = at(vertex, PLAIT_LANE_HOLLOW_KIND);
        return kind == double(PLAIT_HOLLOW_ROOM)   ? at(vertex, PLAIT_LANE_HOLLOW_ROOM)
               : kind == double(PLAIT_HOLLOW_NONE) ? std::numeric_limits<double>::infinity()
                                                   : 0;
    }
    void take_walls(size_t vertex, const Met& met) {
        std::vector<double> values;
        for (const auto& [normal, height] : met.walls)
            values.insert(values.end(), {normal.x(), normal.y(), normal.z(), height});
        store(vertex, PLAIT_LANE_HOLLOW_PLANE, values,
              met.fast ? PLAIT_HOLLOW_PLANES : PLAIT_HOLLOW_NONE);
    }
    void store(size_t vertex, size_t first, const std::vector<double>& values, float kind) {
        at(vertex, PLAIT_LANE_HOLLOW_KIND) = double(kind);
        for (size_t c = 0; c < values.size(); ++c)
            at(vertex, first + c) = values[c];
    }

    const View<double>& rows_;
    const Lane& lane_;
};

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
                                plane->height + plane->normal.dot(ways.end[i] - plane->anchor),
                                plane->crease};
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
        std::vector<SurfaceBody> bodies;
        std::vector<double> depths;
        for (size_t mesh = 0; mesh < params.collider_count; ++mesh) {
            bodies.emplace_back(args, params.collider_first + mesh, mesh);
            depths.push_back(bodies.back().depth_of(ways.root));
        }
        for (size_t row = 1; row < params.vertex_stride;
             ++row) // past the tip there is nothing to know
            for (size_t mesh = 0; mesh < params.collider_count && ways.length[row] == 0; ++mesh)
                if (bodies[mesh].surface.two_sided)
                    args.mesh_side[(strand * params.row_stride + row) * params.collider_count +
                                   mesh]
                        .setZero();
        std::optional<Hollows> hollows;
        if (params.hollows)
            hollows.emplace(args.lane_hollow, lane, params.vertex_stride);
        find_touches(
            params, strand, ways, args.mesh_clearance, list,
            [&](size_t mesh, size_t i, double clearance, double arc) {
                Vec4 none = Vec4::Zero();
                const size_t row = strand * params.row_stride + i;
                const Met met = met_by(bodies[mesh], ways, i, clearance, depths[mesh], arc,
                                       bodies[mesh].surface.two_sided
                                           ? args.mesh_side[row * params.collider_count + mesh]
                                           : none);
                if (hollows)
                    hollows->take(i, met, !list[i] || (met.touch && met.touch->gap < list[i]->gap));
                return met.touch;
            });
        store_planes(args.lane_plane, lane, list);
    }
}

} // namespace plait::reference
