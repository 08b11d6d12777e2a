// The discrete Cosserat rod as an energy over dense vectors: what `cosserat`, `rod` and, without
// stretch, `articulated` minimise.
//   E = sum_i m_i (1 + c h)/(2 h^2) |x_i - y_i|^2             inertia and drag
//     + sum_i ks_i/2 |x_{i+1} - x_i - l_i t_i|^2              stretch and shear, t_i = q_i e_x
//     + sum_i kb_i (1 - |<q_i, q_{i-1} r_i>|)                 bend and twist; q_{-1} is the root
//     frame
//     + sum_i u_i' diag(kt_i, 0, kc_i) u_i / 2                twist and section, u_i the vector
//     part of conj(q_{i-1} r_i) q_i
//     + k_i/2 |x_i - p_i|^2                                   pins
//     + the terms of contact.hpp
// Source: Kugelstadt & Schoemer 2016, Hsu et al. 2025.
#pragma once

#include "backend/reference/contact/contact.hpp"
#include "backend/reference/strands/energy.hpp"

#include <Eigen/Dense>
#include <memory>

namespace plait::reference {

// The buffers they have in common.
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
};

class RodModel {
  public:
    // `inextensible`: no energy of stretch; segments keep their lengths.
    RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot,
             bool inextensible = false);
    RodModel(const RodModel&) = default; // shares the contacts
    RodModel& operator=(const RodModel&) = default;
    void store(const RodBuffers& buffers);

    size_t segments() const { return q.size(); }
    double energy() const;
    // Its elastic part, also of other positions and orientations.
    double elastic(const std::vector<Vec3>& at, const std::vector<Quat>& turned) const;
    // Minimise over all positions for the present orientations.
    void solve_positions();
    // Minimise over one orientation after another, root to tip; without sections unless these are
    // swept, too.
    void sweep_orientations();
    void sweep_sections() { sweeps_sections_ = true; }
    // `count` accelerated iterations, see cosserat.cpp; `renew`: contacts before every solve.
    void alternate(uint32_t count, bool renew = true);
    // One damped Gauss-Newton step, see rod.cpp.
    void newton();
    // One substep of an inextensible rod in `steps` Newton steps, see articulated.cpp.
    void articulate(uint32_t steps);
    // Contacts of the end of the step; did anything touch in it?
    void renew_contacts();
    // What touches ends the substep with its lengths, but for a strain of this or of its weight's.
    void hold_lengths_in_contact(double least) { least_limit_ = least; }
    bool touched() const { return contacts_ && contacts_->touched(); }

    std::vector<Vec3> x; // relative to the root
    std::vector<Quat> q;

  private:
    RodModel(const RodBuffers& buffers, const plait_lane_params& params, size_t slot, size_t strand,
             bool inextensible);
    // Only this share of the way: the potential is convex along it.
    void shorten(double share);
    // Segments of a strand in contact back within the limit, root to tip.
    void hold_lengths();
    double strain_limit() const;
    Quat expected(size_t segment) const; // q_{i-1} r_i
    Vec3 strain(size_t segment) const;   // x_{i+1} - x_i - l_i t_i
    // Elastic energy, J, since the substep's begin.
    double released() const;
    double released_of_pairs() const;
    struct JointStrain {
        Vec3 stretch;
        Vec4 bend;
        Vec3 section; // in the joint's own axes
        double cosine;
    };
    JointStrain joint_strain(size_t segment, const std::vector<Vec3>& at,
                             const std::vector<Quat>& turned, double side) const;
    Quat bent(size_t segment) const { return expected(segment).conjugate() * q[segment]; }
    // Of inertia and pin: minus the gradient, second derivative, and what they hold above their
    // least.
    Vec3 vertex_force(size_t vertex) const;
    double vertex_stiffness(size_t vertex) const;
    double vertex_energy(size_t vertex) const;
    Vec3 director(size_t segment) const { return q[segment] * Vec3::UnitX(); }
    Eigen::VectorXd direction() const;
    // Of articulated.cpp.
    void leave_out_stretch();
    void rebuild(); // vertices from orientations
    void load();
    void follow_target();
    void add_vertices(Eigen::MatrixXd& H, Eigen::VectorXd& g) const;
    void add_joints(Eigen::MatrixXd& H, Eigen::VectorXd& g) const;
    Eigen::VectorXd turns() const;
    void follow_turns(const RodModel& from, const Eigen::VectorXd& w);
    Vec3 stopped(size_t vertex, const Vec3& to) const;
    void turn_to(size_t segment, const Vec3& place);
    void put_back();
    Vec3 hung(size_t segment, const std::vector<Vec3>& solved) const;
    bool turn_segments(); // whether a vertex moved far enough for another step
    bool wants_step(uint32_t k, bool moved) const;
    bool deep() const;    // any vertex, deeper than pull and push balance
    bool off_pin() const; // any vertex that its pin, far stiffer than its inertia, has not got to

    bool inextensible_;
    bool sweeps_sections_ = false;
    double least_limit_ = 0; // strain of a strand that touched; 0: any
    const plait_lane_params* params_;
    Lane lane_;
    Motion motion_;
    Quat root_frame_;
    std::vector<double> length_, stretch_, bend_, mass_;
    std::vector<double> length_before_;    // of the segment before a vertex
    std::vector<Quat> q_start_, q_before_; // at the substep's begin, and a substep earlier
    std::vector<Vec3> section_;            // (kt, 0, kc)
    std::vector<Quat> rest_;
    std::shared_ptr<Contacts> contacts_; // null: no colliders
};

// Steps every strand of a dispatch with `solve`.
template <typename Args, typename Solve>
void step_rods(uint32_t item_count, const plait_lane_params& params, const Args& args,
               const Solve& solve, bool inextensible = false) {
    const RodBuffers buffers{args.lane_strand,
                             args.rest,
                             args.pose,
                             args.lane_material,
                             args.lane_rest,
                             args.collider,
                             args.lane_q,
                             args.lane_q_before,
                             {args.lane_x, args.lane_v, args.lane_x_before, args.lane_v_before,
                              args.lane_material, args.lane_acceleration, args.lane_pin,
                              args.lane_plane}};
    for (size_t slot = 0; slot < item_count; ++slot) {
        RodModel rod(buffers, params, slot, inextensible);
        solve(rod);
        rod.store(buffers);
    }
}

} // namespace plait::reference
