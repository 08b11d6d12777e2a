#include "backend/reference/strands/energy.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

struct Balance {
    double before, after;      // J, the work of the substep in the former
    double creep = 0;          // BDF2, J: what it may always have
    double kinetic_before = 0; // BDF2, J: of `before`, the energy of motion before the substep
};

// What a vertex at x may always have.
double creep(double mass, double h, const Vec3& x) {
    return PLAIT_ENERGY_ROUNDING * mass / 2 * x.squaredNorm() / (h * h);
}

// What positions are relative to moves at, as the balance takes it.
Vec3 root_velocity(const Substep& step, bool pairs) {
    return pairs ? step.motion.root_velocity : Vec3(-step.motion.start[0] / step.params.h);
}

Balance of_backward_euler(const Substep& step, const std::vector<Vec3>& x,
                          const std::vector<Vec3>& v) {
    const auto& [params, motion, mass, length] = step;
    const double h = motion.h, gain = 1 + motion.drag * h;
    Balance sum{0, 0};
    for (size_t i = 1; i < x.size(); ++i) {
        if (length[i] == 0)
            continue;
        const Vec3 inertial = motion.v[i] / gain - motion.root_velocity;
        const Vec3 moves = v[i] - motion.root_velocity;
        sum.before +=
            gain * (mass[i] / 2 * inertial.squaredNorm() + creep(mass[i], h, x[i])) +
            mass[i] * (motion.pull[i] + motion.drag * vec3(params.air)).dot(x[i] - motion.from[i]) +
            motion.pin[i].force(x[i]).dot(x[i] - motion.from[i]);
        sum.after += gain * mass[i] / 2 * moves.squaredNorm();
    }
    return sum;
}

// Of BDF2, by (3a - 4b + c).a/2 = G(a, b) - G(b, c) + |a - 2b + c|^2/4 of its velocities; of one
// state after another where pairs do not count.
Balance of_bdf2(const Substep& step, bool pairs, const std::vector<Vec3>& x,
                const std::vector<Vec3>& v) {
    const auto& [params, motion, mass, length] = step;
    const Vec3 root = root_velocity(step, pairs);
    Balance sum{0, 0};
    double weight = 0, reach = 0;
    for (size_t i = 1; i < x.size(); ++i) {
        if (length[i] == 0)
            continue;
        const Vec3 now = v[i] - root, before = motion.v[i] - root, ago = motion.v_before[i] - root;
        const Vec3 way = pairs ? Vec3(params.h / motion.h * (x[i] - motion.from[i]))
                               : Vec3(x[i] - (motion.start[i] - motion.start[0]));
        const Vec3 force = motion.pull[i] + motion.drag * (vec3(params.air) - v[i]);
        const double moves = held(pairs, before, ago), least = creep(mass[i], motion.h, x[i]);
        sum.kinetic_before += mass[i] * moves + least;
        sum.before +=
            mass[i] * (moves + force.dot(way)) + motion.pin[i].force(x[i]).dot(way) + least;
        sum.after += mass[i] * held(pairs, now, before);
        weight += mass[i] * motion.pull[i].norm();
        reach += length[i];
    }
    sum.creep = PLAIT_ENERGY_BDF2_ALLOWANCE * weight * reach;
    return sum;
}

} // namespace

bool counts_pairs(const Substep& step) {
    const auto& [params, motion, mass, length] = step;
    if (!params.bdf2)
        return false;
    double turned = 0, may = 0;
    for (size_t i = 1; i < length.size(); ++i) {
        if (length[i] == 0)
            continue;
        turned += mass[i] * (motion.v[i] - motion.v_before[i]).squaredNorm();
        const double fall = (2 * params.h * motion.pull[i]).squaredNorm();
        may +=
            mass[i] *
            (PLAIT_ENERGY_BDF2_CHANGE * (motion.v[i] - motion.root_velocity).squaredNorm() + fall);
    }
    return turned <= may;
}

Limit limit_energy(const Substep& step, double released, const std::vector<Vec3>& x,
                   std::vector<Vec3>& v) {
    const bool pairs = counts_pairs(step);
    Limit limit{1, 1, root_velocity(step, pairs)};
    const Balance sum =
        step.params.bdf2 ? of_bdf2(step, pairs, x, v) : of_backward_euler(step, x, v);
    const double paid = released + sum.before;
    const double budget = std::max({paid, sum.creep, PLAIT_ENERGY_MIN});
    if (sum.after <= budget)
        return limit;
    if (step.params.bdf2 && paid + sum.creep < 0)
        limit.way = (sum.kinetic_before + sum.creep) / (sum.kinetic_before - paid);
    limit.share = std::sqrt(budget / sum.after);
    for (size_t i = 1; i < x.size(); ++i)
        v[i] = limit.root + limit.share * (v[i] - limit.root);
    return limit;
}

void Limit::apply_before(const Lane& lane, const LaneState& state, size_t vertices) const {
    if (share == 1)
        return;
    for (size_t i = 1; i < vertices; ++i) {
        const Vec3 v_before = lane.vector(state.v_before, i);
        lane.store(state.v_before, i, Vec3(root + share * (v_before - root)));
    }
}

} // namespace plait::reference
