// rod: damped Gauss-Newton on the rod energy. Unknowns of segment i are the displacement of vertex
// i + 1 and the rotation vector of q_i. With C = edge/l - t, dC/dx = +-I/l, dC/dw = [t]x, the
// Hessian is EA l J^T J + kb/4 |w_i - w_{i-1}|^2 (kb + kt, kb, kb + kc in the joint's axes) +
// max(0, l t.F)(I - t t^T), F the tension: without the last, geometric term it diverges under
// tension. Up to four halvings of the step; where all fail, two iterations of cosserat instead. A
// strand that touches something takes one step more, and ends it within 4 % of its lengths.
#include "backend/reference/strands/rod_model.hpp"

#include <plait/constants.h>

#include <algorithm>

namespace plait::reference {
namespace {

Mat3 cross_matrix(const Vec3& t) {
    Mat3 m;
    m << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
    return m;
}

constexpr Eigen::Index X = 0, W = 3, unknowns = 6;

} // namespace

// Solves H u = -gradient, assembled segment by segment and joint by joint.
Eigen::VectorXd RodModel::direction() const {
    const auto n = static_cast<Eigen::Index>(segments());
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(unknowns * n, unknowns * n);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(unknowns * n);
    const auto block = [&](Eigen::Index a, Eigen::Index b) { return H.block<3, 3>(a, b); };
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index x1 = unknowns * i + X, w = unknowns * i + W, x0 = x1 - unknowns;
        const Vec3 t = director(i), F = stretch_[i] * strain(i);
        const double EA = stretch_[i] * length_[i];
        const Mat3 T = cross_matrix(t), across = Mat3::Identity() - t * t.transpose();
        block(x1, x1) += (vertex_stiffness(i + 1) + stretch_[i]) * Mat3::Identity();
        g.segment<3>(x1) += F - vertex_force(i + 1);
        if (contacts_) {
            block(x1, x1) += contacts_->hessian(i + 1, x[i + 1]);
            g.segment<3>(x1) -= contacts_->force(i + 1, x[i + 1]);
        }
        block(x1, w) += EA * T;
        block(w, x1) += EA * T.transpose();
        block(w, w) += (EA * length_[i] + std::max(0.0, length_[i] * t.dot(F))) * across;
        g.segment<3>(w) -= length_[i] * t.cross(F);
        if (i > 0) {
            block(x0, x0) += stretch_[i] * Mat3::Identity();
            block(x0, x1) -= stretch_[i] * Mat3::Identity();
            block(x1, x0) -= stretch_[i] * Mat3::Identity();
            block(x0, w) -= EA * T;
            block(w, x0) -= EA * T.transpose();
            g.segment<3>(x0) -= F;
        }
        const Quat m = expected(i) * q[i].conjugate();
        // Turning q_i by w changes u = bent(i).vec() by (u.w w' + w' x u)/2, w' = w in the joint's
        // axes.
        const Quat u = bent(i);
        const Mat3 axes = expected(i).toRotationMatrix();
        const Vec3 ku = section_[i].cwiseProduct(u.vec());
        const Vec3 moment = bend_[i] / 2 * std::copysign(1.0, m.w()) * m.vec() -
                            axes * (u.w() * ku + u.vec().cross(ku)) / 2;
        const Mat3 joint = bend_[i] / 4 * Mat3::Identity() +
                           axes * section_[i].asDiagonal() * axes.transpose() / 4;
        block(w, w) += joint;
        g.segment<3>(w) -= moment;
        if (i > 0) {
            const Eigen::Index w0 = w - unknowns;
            block(w0, w0) += joint;
            block(w0, w) -= joint;
            block(w, w0) -= joint;
            g.segment<3>(w0) += moment;
        }
    }
    // Rows past a strand's tip hold nothing: leave their unknowns at zero.
    for (Eigen::Index r = 0; r < H.rows(); ++r)
        if (H(r, r) == 0)
            H(r, r) = 1;
    return H.ldlt().solve(-g);
}

void RodModel::newton() {
    renew_contacts();
    const double limit = energy() * PLAIT_ROD_POTENTIAL_FACTOR + PLAIT_ROD_POTENTIAL_MIN;
    const RodModel from = *this;
    const Eigen::VectorXd u = direction();
    double alpha = 1;
    for (int trial = 0; trial <= PLAIT_ROD_HALVINGS; ++trial, alpha /= 2) {
        for (size_t i = 0; i < segments(); ++i) {
            const auto at = unknowns * static_cast<Eigen::Index>(i);
            const Vec3 turn = alpha * u.segment<3>(at + W);
            x[i + 1] = from.x[i + 1] + alpha * u.segment<3>(at + X);
            q[i] = Quat(Eigen::AngleAxisd(turn.norm(), reference::direction(turn))) * from.q[i];
        }
        if (energy() <= limit)
            return;
    }
    *this = from;
    alternate(PLAIT_ROD_FALLBACK_ITERATIONS, false);
}

void rod(uint32_t item_count, const plait_lane_params& params, const rod_args& args) {
    step_rods(item_count, params, args, [&](RodModel& model) {
        model.hold_lengths_in_contact(PLAIT_ROD_CONTACT_STRAIN);
        model.alternate(1);
        for (uint32_t k = 0; k < params.iterations; ++k)
            model.newton();
        if (model.touched())
            model.newton();
    });
}

} // namespace plait::reference
