// Contact of one strand with colliders, as terms of an incremental potential: per vertex one
// plane n.x = o with a push s/2 min(n.x - o, 0)^2, and friction mu N psi(|u|) against the anchor,
// psi quadratic up to the slip e and linear beyond, u the tangential part of x - anchor.
#pragma once

#include "backend/reference/base/lanes.hpp"
#include "backend/reference/contact/collider.hpp"

#include <optional>

namespace plait::reference {

using Mat3 = Eigen::Matrix3d;

// At least this far from a collider, and from most no farther than that: of a capsule with the
// greater radius all along, of a hull also of the box around it.
double clearance(const Collider& collider, const Vec3& x);

// A tangent plane of a collider's distance: `height` of the end of the way above it.
struct Tangent {
    Vec3 normal;
    double height;
};

// Where the way, along which the distance is convex, first crosses the surface; nothing if it ends or turns
// away before.
std::optional<Tangent> first_crossing(const Collider& collider, const Vec3& from, const Vec3& to);

class Contacts {
  public:
    // `planes`: of meshes, as mesh_planes_of. `length[i]` and `stretch[i]`, EA/l, of the segment before vertex i, 0 past the tip; `mass[i]`
    // of vertex i.
    Contacts(const plait_lane_params& params, const View<const Vec4>& colliders,
             const Motion& motion, std::vector<double> length, std::vector<double> stretch,
             std::vector<double> mass, std::vector<std::optional<MeshPlane>> planes);

    // What slid in the substep before slides on in the first solve; else it begins as if it stuck.
    void slide_on() { slides_on_ = true; }
    // `y`: inertial targets of all vertices, which planes of meshes were found on the way to.
    void aim(std::vector<Vec3> y);
    // Look for the contacts of vertices at x again.
    void renew(const std::vector<Vec3>& x);
    // The push of every contact where a solve left the vertices, after the last renewal.
    void press(const std::vector<Vec3>& x);
    bool touching() const; // any vertex now
    bool touched() const { return touched_; }
    // Did the last renewal find another force than the solve before had?
    bool changed() const { return changed_; }

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
    // nearer to the tip has.
    Vec3 within(size_t vertex, const Vec3& to) const;
    // Where a step that would carry the vertex to `to` leaves it, if its surface did not push in it.
    Vec3 stopped(size_t vertex, const Vec3& to, double inertia) const;
    // Near `solved`, at this length from `leader`, and no deeper than a solve may leave it.
    Vec3 put_back(size_t vertex, const Vec3& leader, double length, const Vec3& solved) const;
    // How much deeper the vertex is than a solve may leave it.
    double excess(size_t vertex, const Vec3& x) const;
    // `to`, or the place above it where nothing pushes the vertex.
    Vec3 lifted(size_t vertex, const Vec3& to) const;
    double push(size_t vertex) const { return at_[vertex].push; } // N, of the last press()
    // Positions and velocities; what is pressed to a surface moves with it.
    void store(const Lane& lane, const LaneState& state, const std::vector<Vec3>& x,
               const std::vector<Vec3>& solved) const;

  private:
    friend class WarmContacts;
    struct Contact {
        Vec3 normal = Vec3::Zero(), anchor = Vec3::Zero(), slide = Vec3::Zero();
        double offset = 0, stiffness = 0, push = 0, friction = 0;
        double level = 0, begin = 0; // of the surface above the offset; how deep the vertex began
        double grip = 1;             // the slip at which what sticks is held by mu N, m
        bool stiff = false;          // from outside: it may not be left deep
        bool sticks() const { return slide.isZero(0); }
    };
    // A vertex and the collider it is nearest to.
    struct Touch {
        double gap, start, friction;
        Vec3 normal, anchor;
    };
    Touch touch(const Collider& collider, size_t vertex, const Vec3& x) const;
    Touch touch_surface(const Collider& collider, size_t vertex, const Vec3& x) const;
    bool meets(const Collider& collider, size_t vertex, const Vec3& x) const;
    std::optional<Touch> nearest(size_t vertex, const Vec3& x) const;
    Contact renewed(size_t vertex, const Vec3& x) const;
    void rub(const Contact& before, const Vec3& u, double mobility, bool tries, Contact& now) const;
    static bool differ(const Contact& before, const Contact& now);
    Vec3 slid_before(size_t vertex, const Touch& found) const;
    Vec3 slip_of(const Contact& at, const Vec3& x) const;
    double depth_allowed(size_t vertex) const;
    double released(size_t vertex, const Vec3& x, double begin) const;

    const plait_lane_params& params_;
    const View<const Vec4>& colliders_;
    const Motion& motion_;
    std::vector<double> length_, stretch_, mass_, arc_; // arc_[i]: from the root to vertex i
    std::vector<std::optional<MeshPlane>> planes_;
    std::vector<Vec3> y_;
    std::vector<Contact> at_;
    bool along_ = true; // meshes go along with the root
    bool solved_ = false, touched_ = false, changed_ = false, slides_on_ = false;
};

} // namespace plait::reference
