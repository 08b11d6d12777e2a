#include "modes.hpp"

#include <Eigen/Eigenvalues>

namespace lab {

namespace {

// (EI / 2 l)(theta_i - theta_{i-1})^2 of every joint, theta_i = (x_{i+1} - x_i) / l_i.
void add_joints(const HangingChain& chain, Eigen::MatrixXd& stiffness) {
    const auto& l = chain.lengths;
    for (size_t i = 0; i < l.size(); ++i) {
        Eigen::RowVectorXd turn = Eigen::RowVectorXd::Zero(stiffness.cols());
        const auto at = static_cast<Eigen::Index>(i);
        turn[at + 1] += 1 / l[i];
        turn[at] -= 1 / l[i];
        if (i > 0) {
            turn[at] -= 1 / l[i - 1];
            turn[at - 1] += 1 / l[i - 1];
        }
        const double joint = 0.5 * (l[i] + (i > 0 ? l[i - 1] : 0));
        stiffness += chain.bending / joint * turn.transpose() * turn;
    }
}

// Tension of segment j is the weight of all masses below it: K = sum_j (T_j/l_j)(x_{j+1}-x_j)^2
// / 2.
Modes solve(const HangingChain& chain, double gravity) {
    const std::vector<double> mass = chain.masses();
    const auto vertices = static_cast<Eigen::Index>(mass.size());
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(vertices, vertices);
    double below = 0;
    for (Eigen::Index j = vertices - 2; j >= 0; --j) {
        const auto at = static_cast<size_t>(j);
        below += mass[at + 1];
        const double k = gravity * below / chain.lengths[at];
        stiffness(j, j) += k;
        stiffness(j + 1, j + 1) += k;
        stiffness(j, j + 1) -= k;
        stiffness(j + 1, j) -= k;
    }
    if (chain.bending > 0)
        add_joints(chain, stiffness);
    const Eigen::Index free = vertices - chain.pinned;
    const Eigen::VectorXd diagonal =
        Eigen::Map<const Eigen::VectorXd>(mass.data(), vertices).tail(free);
    return modes_of(stiffness.bottomRightCorner(free, free), diagonal.asDiagonal());
}

} // namespace

Modes modes_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> found(stiffness, mass);
    return {found.eigenvalues(), found.eigenvectors()};
}

std::vector<double> HangingChain::masses() const {
    std::vector<double> mass(lengths.size() + 1, 0.0);
    for (size_t i = 0; i < lengths.size(); ++i) {
        mass[i] += half_tip ? 0.5 * lengths[i] : 0.0;
        mass[i + 1] += half_tip ? 0.5 * lengths[i] : lengths[i];
    }
    return mass;
}

Eigen::VectorXd HangingChain::frequencies(double gravity) const {
    return solve(*this, gravity).squares.cwiseSqrt();
}

Eigen::MatrixXd HangingChain::modes(double gravity) const {
    const Eigen::MatrixXd free = solve(*this, gravity).shapes;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(free.rows() + pinned, free.cols());
    all.bottomRows(free.rows()) = free;
    return all;
}

} // namespace lab
