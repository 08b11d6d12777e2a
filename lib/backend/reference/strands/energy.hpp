// The energy budget of a substep: what a strand's velocities relative to its root may carry, given
// what they carried, what its potential released, and the work of the forces on it, pins' too.
// docs/models/cosserat.md derives it.
#pragma once

#include "backend/reference/base/lanes.hpp"

namespace plait::reference {

struct Substep {
    const plait_lane_params& params;
    const Motion& motion;
    const std::vector<double>& mass;   // kg, [V]
    const std::vector<double>& length; // m, of the segment before a vertex; 0: it is none
};

// Whether energy is counted of a state and the one before it, which BDF2 never raises where forces
// are linear. Not where the velocities change more in a substep than by 0.45 of themselves and by
// twice what gravity does: there the two have little in common.
bool counts_pairs(const Substep& step);

// Energy of a quantity of stiffness 1 that was `before` a substep ago; of pairs in the norm of
// Dahlquist 1978.
template <typename Vector> double held(bool pairs, const Vector& now, const Vector& before) {
    return pairs ? (now.squaredNorm() + (2 * now - before).squaredNorm()) / 4
                 : now.squaredNorm() / 2;
}

struct Limit {
    double share = 1; // of the velocities relative to the root that the budget leaves
    double way = 1;   // share of the way that a strand of BDF2 can pay for, standing still then
    Vec3 root;        // the root's velocity
    // Also to those that BDF2 remembers of the step before, once the state is stored.
    void apply_before(const Lane& lane, const LaneState& state, size_t vertices) const;
};

// Takes from the velocities v at the solved positions x what is above the budget. `released`: the
// potential before less that after, and what contact gave, J.
Limit limit_energy(const Substep& step, double released, const std::vector<Vec3>& x,
                   std::vector<Vec3>& v);

} // namespace plait::reference
