// Contact in one Newton step: the solve begins with what was pressed at the substep's begin, its normal
// force that of the substep before, friction a spring drawn as far as the vertex slipped; what the step
// would carry under a surface is placed on it, root to tip.
#pragma once

#include "backend/reference/contact/contact.hpp"

namespace plait::reference {

class ContactPlacer {
  public:
    // `force`: N, of all vertices in the substep before.
    ContactPlacer(Contacts& contacts, std::vector<double> force);

    // Where a vertex goes that the step would leave at p.
    Vec3 place(size_t vertex, Vec3 p);
    // Where the vertex stays that was to go to `to`, and that its segment's length left at x.
    Vec3 left(size_t vertex, const Vec3& to, const Vec3& leader, const Vec3& x);
    // All vertices have been.
    void placed();
    // Before another step.
    void press(const std::vector<Vec3>& x);

    bool pressed() const { return pressed_; } // any vertex, at the begin
    bool slips() const { return slips_; }     // any vertex, in the step
    bool back() const { return back_; }       // what slid came back
    bool deep() const { return deep_; }       // the step was not enough
    void fail() { deep_ = true; }

  private:
    using Contact = Contacts::Contact;
    struct Nearest {
        double gap, friction;
        Vec3 normal, anchor;
        bool body; // else of a mesh or a strand
    };
    double gap(const Collider& collider, size_t vertex, const Surface& surface) const;
    Vec3 carried(const Collider& collider, size_t vertex) const; // relative to the root
    void begin(size_t vertex);
    const MeshPlane* mesh(size_t vertex) const; // null: it has none
    // The deepest of that one and those around it, at p.
    Hollow::Wall deepest(size_t vertex, const MeshPlane& plane, const Vec3& p) const;
    double grip(size_t vertex, const Vec3& normal, const Vec3& anchor) const;
    std::optional<Tangent> crossing(const Collider& collider, size_t vertex, const Vec3& p) const;
    std::optional<Nearest> nearest_body(size_t vertex, const Vec3& p, double reach, bool sweeps);
    std::optional<Nearest> nearest(size_t vertex, double reach, Vec3& p);
    std::optional<Nearest> holder(size_t vertex, const Vec3& x);
    double behind(size_t vertex, const Vec3& x);
    static Vec3 on_circle(const Vec3& n, const Vec3& out, double depth, double length);
    Vec3 in_edge(size_t vertex, const Vec3& leader, Vec3 n, Vec3 out);
    void arrive(size_t vertex, const Nearest& found);
    void rub(Contact& at, const Vec3& to);
    void bring(size_t vertex, const Vec3& to, const Vec3& x);
    bool strays(size_t vertex, const Vec3& p) const;
    double tolerance(size_t vertex) const;
    double stiffness(size_t vertex) const;

    Contacts& contacts_;
    std::vector<Collider> colliders_;
    std::vector<double> force_;
    double depth_ = 0;    // m, below the surface, of what place() left last
    bool held_ = false;   // does it touch a surface that keeps it out?
    bool astray_ = false; // did it leave its way?
    int step_ = 0;
    bool pressed_ = false, slips_ = false, back_ = false, deep_ = false;
};

} // namespace plait::reference
