// Small swings of a hanging strand: the reference for frequency and damping.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace lab {

// Squares of the frequencies of K x = w^2 M x, lowest first; columns are the modes. M is positive definite.
struct Modes {
    Eigen::VectorXd squares;
    Eigen::MatrixXd shapes;
};
Modes modes_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

// Masses as the models have them: a segment's at its far end, or shared by both ends (`half_tip`).
// The first `pinned` vertices do not move.
struct HangingChain {
    std::vector<double> lengths; // m
    uint32_t pinned = 1;
    bool half_tip = false;
    double bending = 0; // EI / rho A, m^4/s^2; held by half a joint at the root

    std::vector<double> masses() const;                // per vertex, of a strand of mass 1 kg/m
    Eigen::VectorXd frequencies(double gravity) const; // rad/s, lowest first
    Eigen::MatrixXd
    modes(double gravity) const; // a column per frequency, a row per vertex, pinned ones 0
};

} // namespace lab
