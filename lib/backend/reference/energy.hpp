// The energy budget of a substep of backward Euler: what a strand's velocities relative to its root
// may carry, given what they carried, what its potential released, and the work of the forces on
// it. docs/models/cosserat.md derives it.
#pragma once

#include "backend/reference/lanes.hpp"

namespace plait::reference {

struct Substep {
    const plait_lane_params& params;
    const Motion& motion;
    const std::vector<double>& mass;   // kg, [V]
    const std::vector<double>& length; // m, of the segment before a vertex; 0: it is none
};

// Takes from the velocities v at the solved positions x what is above the budget, and returns the
// share that they keep, 1 where they were within it. `released`: the potential before less that
// after, and what contact gave, J.
double limit_energy(const Substep& step, double released, const std::vector<Vec3>& x,
                    std::vector<Vec3>& v);

} // namespace plait::reference
