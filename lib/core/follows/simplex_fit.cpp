#include "core/follows/simplex_fit.hpp"

#include <Eigen/Cholesky>

#include <limits>

namespace plait {
namespace {

using Some = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

// Of those that `set` has a bit for, whatever their signs: H w = b + mu 1, mu such that they sum to 1.
Eigen::Vector4d fit_of(const Eigen::Matrix4d& h, const Eigen::Vector4d& b, unsigned set) {
    int at[4], size = 0;
    for (int k = 0; k < 4; ++k)
        if (set >> k & 1u)
            at[size++] = k;
    Block part(size, size);
    Some target(size);
    for (int i = 0; i < size; ++i) {
        target[i] = b[at[i]];
        for (int k = 0; k < size; ++k)
            part(i, k) = h(at[i], at[k]);
    }
    const Eigen::LDLT<Block> factors(part);
    const Some free = factors.solve(target), ones = factors.solve(Some(Some::Ones(size)));
    const Some fit = free + (1 - free.sum()) / ones.sum() * ones;
    Eigen::Vector4d w = Eigen::Vector4d::Zero();
    for (int i = 0; i < size; ++i)
        w[at[i]] = fit[i];
    return w;
}

} // namespace

// The objective is convex: its least is the least over all sets of weights that are not 0 (the active
// sets of Lawson & Hanson 1974, of which there are 15).
Eigen::Vector4d fit_on_simplex(const Eigen::Matrix4d& h, const Eigen::Vector4d& b, int count) {
    Eigen::Vector4d best = Eigen::Vector4d::UnitX();
    double least = std::numeric_limits<double>::infinity();
    for (unsigned set = 1; set < 1u << count; ++set) {
        const Eigen::Vector4d w = fit_of(h, b, set);
        if (!(w.minCoeff() >= 0))
            continue;
        const double error = w.dot(h * w) - 2 * b.dot(w);
        if (error < least) {
            least = error;
            best = w;
        }
    }
    return best;
}

} // namespace plait
