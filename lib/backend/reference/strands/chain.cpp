// chain: inextensible, without bending. From the inertial targets, K projections on the linearised
// lengths, J M^-1 J^T lambda = C with C capped at one rest length; where the step is coarse the
// first of them is the minimum of sum m/2 |x - y|^2 + max(lambda, 0)/(2 l) |edge|^2, lambda for the
// directions at the step's begin. Then one exact sweep from the
// root whose displacement d of the next vertex is taken from a vertex's velocity, v_i -=
// d_{i+1}/(2h). Source: Han & Harada 2013 (tridiagonal lengths), Mueller et al. 2012 (sweep and
// correction). Contacts: ours, see contact.hpp.
#include "backend/reference/contact/contact.hpp"
#include "backend/reference/strands/energy.hpp"

#include <plait/constants.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

struct Links {
    std::vector<double> length; // [V - 1]; the root does not move
    // [V]: of a vertex alone, and with k h^2/(1 + c h) of its pin, which resists like a mass at
    // `goal`
    std::vector<double> own, mass;
    std::vector<Vec3> goal;
    double reach; // h^2/(1 + c h)

    // Whether there is a segment after this one, which may be the tip's: rows past it have none.
    bool follows(Eigen::Index segment) const {
        const auto next = static_cast<size_t>(segment) + 1;
        return next < length.size() && length[next] > 0;
    }
};

// Inverse masses; where a contact holds, (m I + reach B)^-1 with its Hessian B.
std::vector<Mat3> mobilities(const Links& links, const Contacts* contacts,
                             const std::vector<Vec3>& x) {
    std::vector<Mat3> W{Mat3::Zero()};
    for (size_t i = 1; i < x.size(); ++i) {
        Mat3 resists = links.mass[i] * Mat3::Identity();
        if (contacts)
            resists += links.reach * contacts->hessian(i, x[i]);
        W.push_back(resists.inverse());
    }
    return W;
}

Vec3 direction_or_down(const Vec3& d) {
    return d.squaredNorm() > 1e-30 ? Vec3(d.normalized()) : Vec3(-Vec3::UnitY());
}

void project_lengths(const Links& links, const std::vector<Mat3>& W, std::vector<Vec3>& x) {
    const auto n = static_cast<Eigen::Index>(links.length.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd residual(n);
    std::vector<Vec3> u(links.length.size());
    for (Eigen::Index i = 0; i < n; ++i)
        u[i] = direction_or_down(x[i + 1] - x[i]);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double l = links.length[i];
        residual[i] = l > 0 ? std::min((x[i + 1] - x[i]).dot(u[i]) - l, l) : 0;
        system(i, i) = u[i].dot((W[i] + W[i + 1]) * u[i]);
        if (links.follows(i))
            system(i, i + 1) = system(i + 1, i) = -u[i].dot(W[i + 1] * u[i + 1]);
    }
    const Eigen::VectorXd lambda = system.partialPivLu().solve(residual);
    for (Eigen::Index i = 0; i < n; ++i) {
        x[i] += lambda[i] * W[i] * u[i];
        x[i + 1] -= lambda[i] * W[i + 1] * u[i];
    }
}

// A vertex swings sideways faster than the step, pulled by what hangs on it: h^2 T/(m l).
bool coarse(const Links& links, const Motion& motion) {
    double below = 0;
    for (size_t i = links.length.size(); i > 0; --i) {
        const double l = links.length[i - 1], m = links.own[i];
        if (l == 0)
            continue; // past the tip
        below += m * motion.pull[i].norm();
        if (links.reach * below > PLAIT_CHAIN_IMPLICIT_TENSION * m * l)
            return true;
    }
    return false;
}

// Where the tension that the step needs takes the targets y.
std::vector<Vec3> pulled(const Links& links, const Motion& motion) {
    const auto n = static_cast<Eigen::Index>(links.length.size());
    std::vector<Vec3> u;
    for (Eigen::Index i = 0; i < n; ++i)
        u.push_back(direction_or_down(motion.start[i + 1] - motion.start[i]));
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd residual(n);
    const auto w = [&](Eigen::Index i) { return i == 0 ? 0 : 1 / links.mass[i]; };
    for (Eigen::Index i = 0; i < n; ++i) {
        const double l = links.length[i];
        residual[i] =
            l > 0 ? std::clamp((links.goal[i + 1] - links.goal[i]).dot(u[i]) - l, -l, l) : 0;
        system(i, i) = w(i) + w(i + 1);
        if (links.follows(i))
            system(i, i + 1) = system(i + 1, i) = -u[i].dot(u[i + 1]) * w(i + 1);
    }
    const Eigen::VectorXd lambda = system.partialPivLu().solve(residual);

    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n, n); // of the vertices 1..n
    Eigen::MatrixX3d right(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        hessian(i, i) += links.mass[i + 1];
        right.row(i) = links.mass[i + 1] * links.goal[i + 1].transpose();
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const double k = links.length[i] > 0 ? std::max(lambda[i], 0.0) / links.length[i] : 0;
        hessian(i, i) += k;
        if (i == 0)
            continue; // the root is at 0
        hessian(i - 1, i - 1) += k;
        hessian(i - 1, i) -= k;
        hessian(i, i - 1) -= k;
    }
    const Eigen::MatrixX3d solved = hessian.partialPivLu().solve(right);
    std::vector<Vec3> x = links.goal;
    for (Eigen::Index i = 0; i < n; ++i)
        x[i + 1] = solved.row(i).transpose();
    return x;
}

void sweep(const Links& links, const Contacts* contacts, std::vector<Vec3>& x) {
    for (size_t i = 0; i + 1 < x.size(); ++i) {
        const double l = links.length[i];
        const Vec3 exact = x[i] + l * direction_or_down(x[i + 1] - x[i]);
        x[i + 1] = contacts && contacts->touching()
                       ? contacts->keep_off(i + 1, x[i], l, x[i + 1], exact)
                       : exact;
    }
}

// Rounds of contact: where inertia, tension in coarse steps, and contact alone put a vertex,
// then the lengths.
std::vector<Vec3> solve(const Links& links, const Motion& motion, const plait_lane_params& params,
                        Contacts* contacts) {
    bool pinned = false; // far more stiffly than by inertia
    for (size_t i = 1; i < motion.pin.size(); ++i)
        pinned = pinned || motion.pin[i].stiffness >
                               PLAIT_CHAIN_PIN_STIFFNESS * motion.inertia * links.own[i];
    const uint32_t count =
        pinned ? std::max<uint32_t>(params.iterations, PLAIT_CHAIN_PIN_SOLVES) : params.iterations;
    const bool pulls = params.iterations > 0 && !params.bdf2 && coarse(links, motion);
    const std::vector<Vec3> target = pulls ? pulled(links, motion) : links.goal;
    std::vector<Vec3> x = target;
    for (int round = 0; round < (contacts ? PLAIT_CHAIN_CONTACT_ROUNDS : 1); ++round) {
        if (contacts)
            contacts->renew(x);
        const bool touched = contacts && contacts->touched();
        if (round > 0 && !touched)
            return x;
        const auto W = mobilities(links, contacts, x);
        for (size_t i = 1; i < x.size() && touched; ++i)
            x[i] = target[i] + links.reach * W[i] * contacts->force(i, target[i]);
        for (uint32_t k = pulls && !touched ? 1 : 0; k < count; ++k)
            project_lengths(links, W, x);
    }
    return x;
}

// Lengths, exact; again where that pulled a vertex through a surface.
void follow(const Links& links, Contacts* contacts, std::vector<Vec3>& x) {
    if (contacts)
        contacts->renew(x);
    sweep(links, contacts, x);
    if (!contacts)
        return;
    contacts->renew(x);
    bool crossed = false;
    for (size_t i = 1; i < x.size(); ++i)
        crossed = crossed || contacts->excess(i, x[i]) > 0;
    if (crossed)
        sweep(links, contacts, x);
}

} // namespace

void chain(uint32_t item_count, const plait_lane_params& params, const chain_args& args) {
    const LaneState state{args.lane_x,        args.lane_v,        args.lane_x_before,
                          args.lane_v_before, args.lane_material, args.lane_acceleration,
                          args.lane_pin,      args.lane_plane};
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Vec3 root = root_of(args.rest, pose_of(args.pose, strand), strand, params.row_stride);
        Motion motion(lane, params, state, root);
        Links links;
        links.reach = motion.h * motion.h / (1 + motion.drag * motion.h);
        std::vector<double> before(1, 0.0), stretch(1, 0.0); // of the segment before a vertex
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const auto material = [&](size_t component) {
                return args.lane_material[lane.index(i, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
            };
            const double mass = material(PLAIT_LANE_MASS);
            links.own.push_back(mass);
            links.mass.push_back(mass + links.reach * motion.pin[i].stiffness);
            links.goal.push_back(motion.goal(i, mass));
            if (i + 1 == params.vertex_stride)
                break;
            links.length.push_back(material(PLAIT_LANE_LENGTH));
            before.push_back(links.length.back());
            stretch.push_back(material(PLAIT_LANE_STRETCH));
        }
        std::optional<Contacts> contacts;
        if (params.collider_count > 0 || params.planes)
            contacts.emplace(params, args.collider, motion, before, stretch, links.own,
                             mesh_planes_of(lane, params, args.lane_plane));
        Contacts* held = contacts ? &*contacts : nullptr;
        const std::vector<Vec3> solved = solve(links, motion, params, held);
        std::vector<Vec3> x = solved;
        follow(links, held, x);
        for (size_t i = 1; links.follows(static_cast<Eigen::Index>(i) - 1); ++i)
            motion.w[i] -= PLAIT_CHAIN_VELOCITY_CORRECTION * (x[i + 1] - solved[i + 1]) / motion.h;
        std::vector<Vec3> v = motion.velocities(x);
        // The sweep is exact in lengths alone: springs that it pressed give nothing.
        const double given = held ? held->work(x) - std::max(held->work_of_springs(x), 0.0) : 0;
        const Limit limit = limit_energy({params, motion, links.own, before}, given, x, v);
        if (held)
            held->store(lane, state, x, v);
        else
            motion.store(lane, state, x, v);
        if (params.bdf2)
            limit.apply_before(lane, state, x.size());
    }
}

} // namespace plait::reference
