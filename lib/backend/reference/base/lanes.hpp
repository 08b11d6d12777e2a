// Strands in the lane layout [tile][V][components][tile strands], one at a time, and what is
// done around their solve: inertial targets before, velocities after.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <optional>
#include <vector>

namespace plait::reference {

// One strand's rows in the lane layout.
class Lane {
  public:
    Lane(size_t lane, uint32_t vertices, uint32_t tile)
        : base_(lane / tile * vertices), tile_(tile), lane_(lane % tile) {}

    size_t index(size_t row, size_t component, size_t components) const {
        return ((base_ + row) * components + component) * tile_ + lane_;
    }
    template <typename T> Vec3 vector(const View<T>& data, size_t row) const {
        return {data[index(row, 0, 3)], data[index(row, 1, 3)], data[index(row, 2, 3)]};
    }
    template <typename T> Quat rotation(const View<T>& data, size_t row) const {
        return {data[index(row, 3, 4)], data[index(row, 0, 4)], data[index(row, 1, 4)],
                data[index(row, 2, 4)]};
    }
    void store(const View<double>& data, size_t row, const Vec3& v) const {
        for (int c = 0; c < 3; ++c)
            data[index(row, c, 3)] = v[c];
    }
    void store(const View<double>& data, size_t row, const Quat& q) const {
        for (int c = 0; c < 4; ++c)
            data[index(row, c, 4)] = q.coeffs()[c]; // (x, y, z, w)
    }

  private:
    size_t base_, tile_, lane_;
};

// Strand of a lane; where no list is given they lie in order.
inline size_t strand_of(const View<const uint32_t>& lane_strand, size_t lane) {
    return lane_strand.size() > 0 ? lane_strand[lane] : lane;
}

// PLAIT_LANE_DRAG or PLAIT_LANE_FRICTION of a strand, in its last row.
inline double scale_of(const Lane& lane, const View<const double>& material, uint32_t vertices,
                       size_t component) {
    return material[lane.index(vertices - 1, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
}

// World position of a strand's root under a pose.
Vec3 root_of(const View<const Vec4>& rest, const Pose& pose, size_t strand, uint32_t stride);

struct LaneState {
    const View<double>& x;        // row 0: the root in the world; else relative to it
    const View<double>& v;        // row 0: the root's own
    const View<double>& x_before; // BDF2 only
    const View<double>& v_before;
    const View<const double>& material;
    const View<const double>& acceleration; // beside gravity, where there is any
    const View<const double>& pin;          // where there are any
    const View<const double>& plane;        // of meshes, where there are any
};

// A spring to a point, as stiff in every direction.
struct Pin {
    Vec3 target = Vec3::Zero(); // relative to the root
    double stiffness = 0;       // N/m; 0: none
    Vec3 force(const Vec3& x) const { return stiffness * (target - x); }
};

// One step of one strand: y is where inertia, what pulls and drag alone would put each vertex,
// relative to the root; w the velocity that goes with it; h the step of the integrator (2/3 of the
// substep for BDF2).
struct Motion {
    Motion(const Lane& lane, const plait_lane_params& params, const LaneState& state,
           const Vec3& root);
    // v = w + (x - y)/h of solved positions, relative to the root.
    std::vector<Vec3> velocities(const std::vector<Vec3>& x) const;
    void store(const Lane& lane, const LaneState& state, const std::vector<Vec3>& x,
               const std::vector<Vec3>& solved) const;
    std::vector<Vec3> relative_start() const; // `start`, relative to the root of then
    // Where inertia, mu = mass (1 + c h)/h^2, and the pin alone would put a vertex: at the minimum
    // of mu/2 |x - y|^2 + k/2 |x - p|^2.
    Vec3 goal(size_t vertex, double mass) const;

    double whole; // the substep
    double h;
    Vec3 root;
    std::vector<Vec3> start;              // positions at the substep's begin, [0] that of the root
    std::vector<Vec3> v;                  // velocities at the substep's begin
    std::vector<Vec3> x_before, v_before; // BDF2: relative to the root, a substep earlier
    std::vector<Vec3> pull;               // m/s^2: gravity, and what else a vertex has
    std::vector<Vec3> from;               // relative to the root, what v = (x - from)/h counts from
    Vec3 root_velocity;
    std::vector<Vec3> y, w;
    std::vector<Pin> pin; // of every vertex
    double drag;          // c of the strand, 1/s
    double friction;      // scale of the coefficient of what it touches
    double inertia;       // (1 + c h)/h^2, 1/s^2
};

// The plane of a mesh that a vertex may meet in the substep.
// What else keeps a vertex on its side of a sheet.
struct Hollow {
    struct Wall {
        Vec3 normal;
        double height; // of the anchor of its plane above this one
    };
    std::vector<Wall> walls;    // of one that has the sheet's plane
    std::optional<double> room; // m, that one that has none may go off its way,
    Vec3 begin = Vec3::Zero();  // which begins here, relative to the root
};
struct MeshPlane {
    Vec3 normal, anchor; // anchor: relative to the root
    double height;       // of the anchor above the plane
    double start;        // of the anchor above the mesh
    double friction;
    std::optional<Hollow::Wall> crease; // of a tip
};
// One per vertex, or none at all.
std::vector<std::optional<MeshPlane>>
mesh_planes_of(const Lane& lane, const plait_lane_params& params, const View<const double>& planes);
// The same.
std::vector<Hollow> hollows_of(const Lane& lane, const plait_lane_params& params,
                               const View<const double>& hollows);

} // namespace plait::reference
