// Contact of one strand with colliders, as terms of an incremental potential: per vertex one
// plane n.x = o with a push s/2 min(n.x - o, 0)^2, and friction mu N psi(|u|) against the anchor,
// psi quadratic up to the slip e and linear beyond, u the tangential part of x - anchor.
#pragma once

#include "backend/reference/base/lanes.hpp"
#include "backend/reference/contact/collider.hpp"

#include <optional>

namespace plait::reference {

using Mat3 = Eigen::Matrix3d;

class Contacts {
  public:
    // `planes`: of meshes, as mesh_planes_of; `hollows` as hollows_of. `length[i]` and `stretch[i]`, EA/l, of the segment before vertex i, 0 past the tip; `mass[i]`
    // of vertex i.
    Contacts(const plait_lane_params& params, const View<const Vec4>& colliders,
             const Motion& motion, std::vector<double> length, std::vector<double> stretch,
             std::vector<double> mass, std::vector<std::optional<MeshPlane>> planes,
             std::vector<Hollow> hollows);

    // `y`: inertial targets of all vertices, which planes of meshes were found on the way to.
    void aim(std::vector<Vec3> y);
    // The push of every contact of vertices at x.
    void press(const std::vector<Vec3>& x);
    bool touching() const; // any vertex now
    bool touched() const { return touched_; }

    Mat3 hessian(size_t vertex, const Vec3& x) const;
    Vec3 force(size_t vertex,
               const Vec3& x) const; // minus the gradient, slip in its last direction
    // The potential with friction as `force` and `hessian` have it: linear along the direction of slip
    // whatever way the vertex went, quadratic where it sticks.
    double model(size_t vertex, const Vec3& x) const;

    // At most, J, that contact gave vertices on their way to x: push and friction along the way of
    // the surface, and what the springs let go, of the last solve.
    double work(const std::vector<Vec3>& x) const;
    // Less what the springs hold that no solve has pushed yet.
    double work_of_new(const std::vector<Vec3>& x) const;

    // Are strands among what is met? They give way.
    bool of_strands() const { return params_.planes > 1; }
    // m, of p from the way of the vertex, from where it was, as its root sees it, to its target; from the
    // nearest place on it.
    Vec3 astray(size_t vertex, const Vec3& p) const;
    // Where a step leaves the vertex that would carry it to `to`, if it has no plane of a mesh, and one
    // nearer to the tip has, or a sheet is near.
    Vec3 within(size_t vertex, const Vec3& to) const;
    // `to`, or the place above it where nothing pushes the vertex.
    Vec3 lifted(size_t vertex, const Vec3& to) const;
    double push(size_t vertex) const { return at_[vertex].push; } // N, of the last press()
    // Positions and velocities; what is pressed to a surface moves with it.
    void store(const Lane& lane, const LaneState& state, const std::vector<Vec3>& x,
               const std::vector<Vec3>& solved) const;

  private:
    friend class ContactPlacer;
    struct Contact {
        Vec3 normal = Vec3::Zero(), anchor = Vec3::Zero(), slide = Vec3::Zero();
        double offset = 0, stiffness = 0, push = 0, friction = 0;
        double begin = 0; // m, how deep the vertex began
        double grip = 1;  // the slip at which what sticks is held by mu N, m
        bool sticks() const { return slide.isZero(0); }
    };
    Vec3 slip_of(const Contact& at, const Vec3& x) const;
    double released(size_t vertex, const Vec3& x, double begin) const;
    Vec3 off_way(size_t vertex, const Vec3& begin, const Vec3& p) const;

    const plait_lane_params& params_;
    const View<const Vec4>& colliders_;
    const Motion& motion_;
    std::vector<double> length_, stretch_, mass_, arc_; // arc_[i]: from the root to vertex i
    std::vector<std::optional<MeshPlane>> planes_;
    std::vector<Hollow> hollows_;
    std::vector<Vec3> y_;
    std::vector<Contact> at_;
    bool along_ = true; // meshes go along with the root
    bool touched_ = false;
};

} // namespace plait::reference
