// cosserat: alternate exact positions and closed-form orientations, with Anderson acceleration of
// depth one on the orientations: with residual r = g - q of a sweep that takes q to g,
//   theta = <r, r - r_> / (|r - r_|^2 + eps) in [min, max],  q <- n(g - theta (g - g_)),
// the underscore one iteration earlier; taken back to g if the energy, positions solved, rises
// above that of the iteration before. eps, min, max: PLAIT_ANDERSON_* of constants.h.
// Source: Hsu et al. 2025; exact positions, acceleration and its guard: ours.
#include "backend/reference/strands/rod_model.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <limits>

namespace plait::reference {
namespace {

Eigen::VectorXd coefficients(const std::vector<Quat>& q) {
    Eigen::VectorXd all(4 * static_cast<Eigen::Index>(q.size()));
    for (size_t i = 0; i < q.size(); ++i)
        all.segment<4>(4 * static_cast<Eigen::Index>(i)) = q[i].coeffs();
    return all;
}

std::vector<Quat> rotations(const Eigen::VectorXd& all) {
    std::vector<Quat> q;
    for (Eigen::Index i = 0; i < all.size(); i += 4)
        q.push_back(Quat(Vec4(all.segment<4>(i))).normalized());
    return q;
}

} // namespace

void RodModel::alternate(uint32_t count, bool renew) {
    if (renew)
        renew_contacts();
    solve_positions();
    Eigen::VectorXd g_before, r_before;
    double limit = std::numeric_limits<double>::infinity();
    for (uint32_t k = 0; k < count; ++k) {
        if (renew)
            renew_contacts();
        if (renew && k > 0 && touched())
            limit = energy(); // another one, with the contacts renewed
        const Eigen::VectorXd start = coefficients(q);
        sweep_orientations();
        const std::vector<Quat> plain = q;
        const Eigen::VectorXd g = coefficients(q), r = g - start;
        if (k > 0) {
            const Eigen::VectorXd d = r - r_before;
            const double theta =
                std::clamp(r.dot(d) / (PLAIT_ANDERSON_REGULARISATION + d.squaredNorm()),
                           PLAIT_ANDERSON_MIN, PLAIT_ANDERSON_MAX);
            q = rotations(g - theta * (g - g_before));
        }
        g_before = g;
        r_before = r;
        solve_positions();
        if (energy() > limit * PLAIT_ROD_POTENTIAL_FACTOR) {
            q = plain;
            solve_positions();
        } else {
            limit = energy();
        }
    }
}

void cosserat(uint32_t item_count, const plait_lane_params& params, const cosserat_args& args) {
    step_rods(item_count, params, args, [&](RodModel& rod) {
        rod.hold_lengths_in_contact(PLAIT_ROD_MIN_STRAIN);
        rod.sweep_sections();
        rod.alternate(params.iterations);
    });
}

} // namespace plait::reference
