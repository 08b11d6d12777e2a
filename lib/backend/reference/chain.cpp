// chain: inextensible, without bending. From the inertial targets, K projections on the linearised
// lengths, J M^-1 J^T lambda = C with C capped at one rest length, then one exact sweep from the
// root whose displacement d of the next vertex is taken from a vertex's velocity, v_i -=
// d_{i+1}/(2h). Source: Han & Harada 2013 (tridiagonal lengths), Mueller et al. 2012 (sweep and
// correction).
#include "backend/reference/lanes.hpp"

#include <Eigen/Dense>

namespace plait::reference {
namespace {

struct Links {
    std::vector<double> length, inverse_mass; // [V - 1], [V]; the root does not move
};

Vec3 direction_or_down(const Vec3& d) {
    return d.squaredNorm() > 1e-30 ? Vec3(d.normalized()) : Vec3(-Vec3::UnitY());
}

void project_lengths(const Links& links, std::vector<Vec3>& x) {
    const auto n = static_cast<Eigen::Index>(links.length.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd residual(n);
    std::vector<Vec3> u(links.length.size());
    for (Eigen::Index i = 0; i < n; ++i)
        u[i] = direction_or_down(x[i + 1] - x[i]);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double l = links.length[i];
        residual[i] = l > 0 ? std::min((x[i + 1] - x[i]).dot(u[i]) - l, l) : 0;
        system(i, i) = links.inverse_mass[i] + links.inverse_mass[i + 1];
        if (i + 1 < n)
            system(i, i + 1) = system(i + 1, i) = -u[i].dot(u[i + 1]) * links.inverse_mass[i + 1];
    }
    const Eigen::VectorXd lambda = system.partialPivLu().solve(residual);
    for (Eigen::Index i = 0; i < n; ++i) {
        x[i] += links.inverse_mass[i] * lambda[i] * u[i];
        x[i + 1] -= links.inverse_mass[i + 1] * lambda[i] * u[i];
    }
}

// Returns the displacement of every vertex.
std::vector<Vec3> sweep(const Links& links, std::vector<Vec3>& x) {
    std::vector<Vec3> d(x.size(), Vec3::Zero());
    for (size_t i = 0; i + 1 < x.size(); ++i) {
        const Vec3 exact = x[i] + links.length[i] * direction_or_down(x[i + 1] - x[i]);
        d[i + 1] = exact - x[i + 1];
        x[i + 1] = exact;
    }
    return d;
}

} // namespace

void chain(uint32_t item_count, const plait_lane_params& params, const chain_args& args) {
    const LaneState state{args.lane_x, args.lane_v, args.lane_x_before, args.lane_v_before};
    for (size_t strand = 0; strand < item_count; ++strand) {
        const Lane lane(strand, params.vertex_stride, params.tile);
        const Vec3 root =
            root_of(args.rest, pose_of(args.pose, strand), strand, params.vertex_stride);
        Motion motion(lane, params, state, root);
        Links links;
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const auto material = [&](size_t component) {
                return args.lane_material[lane.index(i, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
            };
            if (i + 1 < params.vertex_stride)
                links.length.push_back(material(PLAIT_LANE_LENGTH));
            links.inverse_mass.push_back(i == 0 ? 0 : 1 / material(PLAIT_LANE_MASS));
        }
        std::vector<Vec3> x = motion.y;
        for (uint32_t k = 0; k < params.iterations; ++k)
            project_lengths(links, x);
        const std::vector<Vec3> d = sweep(links, x);
        for (size_t i = 1; i + 1 < x.size(); ++i)
            motion.w[i] -= d[i + 1] / (2 * motion.h);
        motion.store(lane, state, x);
    }
}

} // namespace plait::reference
