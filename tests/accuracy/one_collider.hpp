// One strand that meets a collider: the model as it is used, and how far apart two states are.
#pragma once

#include "stability/one_strand.hpp"

#include <cmath>
#include <ostream>

namespace plait::test {

inline constexpr float g = 9.81f; // m/s^2
inline constexpr float length = 0.3f;
inline constexpr double pi = 3.14159265358979;

using Points = std::vector<std::array<float, 4>>;

// A model as it is used.
struct Use {
    plait_model model;
    uint32_t substeps;
};

inline void PrintTo(const Use& use, std::ostream* out) {
    *out << "model " << use.model << ", " << use.substeps << " substeps";
}

inline plait::SimDesc desc_of(const Use& use) {
    plait::SimDesc desc;
    desc.model = use.model;
    desc.substeps = use.substeps;
    desc.params.gravity[1] = -g;
    desc.params.drag = 1;
    return desc;
}

inline double largest_move(const Points& a, const Points& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::hypot(double(a[i][0]) - double(b[i][0]),
                                         double(a[i][1]) - double(b[i][1]),
                                         double(a[i][2]) - double(b[i][2])));
    return most;
}

} // namespace plait::test
