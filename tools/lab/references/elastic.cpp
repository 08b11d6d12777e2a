#include "elastic.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

namespace {

// Joint i lies before segment i; the first is of half a length, against the clamp.
double joint_stiffness(const ElasticStrand& s, size_t i) {
    return s.EI / (0.5 * (s.lengths[i] + (i > 0 ? s.lengths[i - 1] : 0)));
}

double cos_of_half(const Vec3& a, const Vec3& b) {
    return std::sqrt(std::max(0.0, 0.5 * (1 + a.dot(b))));
}

// Stretch and shear EA l/2 |edge/l - t|^2, bending 4 EI/lbar (1 - cos(angle/2)).
double energy_of(const ElasticStrand& s, const std::vector<Vec3>& edges,
                 const std::vector<Vec3>& t) {
    double sum = 0;
    for (size_t i = 0; i < t.size(); ++i) {
        sum += 0.5 * s.EA * s.lengths[i] * (edges[i] - t[i]).squaredNorm();
        sum += 4 * joint_stiffness(s, i) * (1 - cos_of_half(i > 0 ? t[i - 1] : s.clamp, t[i]));
    }
    return sum;
}

// One sweep over the directions, each to where its own forces balance; the largest change.
double relax(const ElasticStrand& s, const std::vector<Vec3>& edges, std::vector<Vec3>& t) {
    double change = 0;
    for (size_t i = 0; i < t.size(); ++i) {
        const auto pull = [&](const Vec3& other, size_t joint) -> Vec3 {
            return joint_stiffness(s, joint) / std::max(0.05, cos_of_half(other, t[i])) * other;
        };
        Vec3 force = s.EA * s.lengths[i] * edges[i] + pull(i > 0 ? t[i - 1] : s.clamp, i);
        if (i + 1 < t.size())
            force += pull(t[i + 1], i + 1);
        const Vec3 turned = force.normalized();
        change = std::max(change, (turned - t[i]).norm());
        t[i] = turned;
    }
    return change;
}

} // namespace

double least_elastic_energy(const ElasticStrand& strand, const std::vector<Vec3>& x) {
    std::vector<Vec3> edges, t; // edges in lengths
    for (size_t i = 0; i < strand.lengths.size(); ++i) {
        edges.push_back((x[i + 1] - x[i]) / strand.lengths[i]);
        t.push_back(edges.back().normalized());
    }
    const double along_edges = energy_of(strand, edges, t);
    constexpr int sweeps = 500;
    for (int k = 0; k < sweeps && strand.EI > 0; ++k)
        if (relax(strand, edges, t) < 1e-7)
            break;
    return std::min(along_edges, energy_of(strand, edges, t));
}

} // namespace lab
