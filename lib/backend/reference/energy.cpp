#include "backend/reference/energy.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {

double limit_energy(const Substep& step, double released, const std::vector<Vec3>& x,
                    std::vector<Vec3>& v) {
    const auto& [params, motion, mass, length] = step;
    if (params.bdf2)
        return 1;
    constexpr double still = 1e-10; // 1e-5 of its distance from the root a vertex may always move
    const double h = motion.h, drag = params.drag;
    const Vec3 push = vec3(params.gravity) + drag * vec3(params.air);
    const Vec3 root_moved = -motion.start[0];
    double before = released, after = 0;
    for (size_t i = 1; i < x.size(); ++i) {
        if (length[i] == 0)
            continue;
        const double k = mass[i] * (1 + drag * h) / (h * h);
        const Vec3 start = motion.start[i] + root_moved; // relative to the root of then
        const Vec3 inertial = h / (1 + drag * h) * motion.v[i] - root_moved;
        before += k / 2 * (inertial.squaredNorm() + still * x[i].squaredNorm()) +
                  mass[i] * push.dot(x[i] - start);
        after += k / 2 * (h * v[i] - root_moved).squaredNorm();
    }
    constexpr double none = 1e-30; // J: nothing moves
    if (after <= std::max(before, none))
        return 1;
    const double share = std::sqrt(std::max(before, 0.0) / after);
    for (size_t i = 1; i < x.size(); ++i)
        v[i] = root_moved / h + share * (v[i] - root_moved / h);
    return share;
}

} // namespace plait::reference
