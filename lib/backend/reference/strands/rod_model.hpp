// An inextensible rod as an energy over dense vectors, which `articulated` minimises.
//   E = sum_i m_i (1 + c h)/(2 h^2) |x_i - y_i|^2             inertia and drag
//     + sum_i kb_i (1 - |<q_i, q_{i-1} r_i>|)                 bend and twist; q_{-1} is the root
//     frame
//     + sum_i u_i' diag(kt_i, 0, kc_i) u_i / 2                twist and section, u_i the vector
//     part of conj(q_{i-1} r_i) q_i
//     + k_i/2 |x_i - p_i|^2                                   pins
//     + the terms of contact.hpp
// Source: Kugelstadt & Schoemer 2016, Hsu et al. 2025.
#pragma once

#include "backend/reference/contact/contact_placer.hpp"
#include "backend/reference/strands/energy.hpp"

#include <Eigen/Dense>
#include <memory>

namespace plait::reference {

struct RodBuffers {
    const View<const uint32_t>& lane_strand;
    const View<const Vec4>& rest;
    const View<const Vec4>& pose;
    const View<const double>& material;
    const View<const double>& rest_rotation;
    const View<const Vec4>& colliders;
    const View<double>& q;
    const View<double>& q_before;
    LaneState state;
    const View<double>& normal_force;
    const View<const double>& hollow; // of sheets, where there are any
};

class RodModel {
  public:
    RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot);
    RodModel(const RodModel&) = default; // shares the contacts
    RodModel& operator=(const RodModel&) = default;
    void store(const RodBuffers& buffers);

    size_t segments() const { return q.size(); }
    double energy() const;
    // Its elastic part, also of other orientations.
    double elastic(const std::vector<Quat>& turned) const;
    // One substep of an inextensible rod in `steps` Newton steps, see articulated.cpp; `force`: N, of
    // contact at every vertex in the substep before.
    void articulate(uint32_t steps, const std::vector<double>& force);
    // Did anything touch in the step?
    bool touched() const { return contacts_ && contacts_->touched(); }

    std::vector<Vec3> x; // relative to the root
    std::vector<Quat> q;

  private:
    RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot,
             size_t strand);
    // Only this share of the way: the potential is convex along it.
    void shorten(double share);
    Quat expected(size_t segment) const; // q_{i-1} r_i
    // Elastic energy, J, since the substep's begin.
    double released() const;
    double released_of_pairs() const;
    struct JointStrain {
        Vec4 bend;
        Vec3 section; // in the joint's own axes
        double cosine;
    };
    JointStrain joint_strain(size_t segment, const std::vector<Quat>& turned, double side) const;
    Quat bent(size_t segment) const { return expected(segment).conjugate() * q[segment]; }
    // Of inertia and pin: minus the gradient, second derivative, and what they hold above their
    // least.
    Vec3 vertex_force(size_t vertex) const;
    double vertex_stiffness(size_t vertex) const;
    double vertex_energy(size_t vertex) const;
    Vec3 director(size_t segment) const { return q[segment] * Vec3::UnitX(); }
    // Of articulated.cpp.
    void rebuild(); // vertices from orientations
    void load();
    void follow_target();
    void add_vertices(Eigen::MatrixXd& H, Eigen::VectorXd& g) const;
    void add_joints(Eigen::MatrixXd& H, Eigen::VectorXd& g) const;
    Eigen::VectorXd turns(double most) const; // of each segment at most so far
    void follow_turns(const RodModel& from, const Eigen::VectorXd& w, ContactPlacer* placer);
    void follow_less(const RodModel& from, const Eigen::VectorXd& w, double share,
                     ContactPlacer* placer);
    void place(size_t segment, const Vec3& end, ContactPlacer* placer);
    void turn_to(size_t segment, const Vec3& place);
    // One Newton step. `placer`: null, or what places vertices.
    void turn_segments(ContactPlacer* placer);
    bool wants_step(uint32_t k, const ContactPlacer* placer) const;
    bool off_pin() const; // any vertex that its pin, far stiffer than its inertia, has not got to

    const plait_lane_params* params_;
    Lane lane_;
    Motion motion_;
    Quat root_frame_;
    std::vector<double> length_, bend_, mass_;
    std::vector<double> length_before_;    // of the segment before a vertex
    std::vector<Quat> q_start_, q_before_; // at the substep's begin, and a substep earlier
    std::vector<Vec3> section_;            // (kt, 0, kc)
    std::vector<Quat> rest_;
    std::shared_ptr<Contacts> contacts_; // null: no colliders
};

} // namespace plait::reference
