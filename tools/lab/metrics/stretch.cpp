// Metrics of what holds all strands of a scene to their lengths.
#include "input.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

namespace {

constexpr double stretched = 0.1; // a segment so much longer or shorter is seen

// |l / l0 - 1| of a strand as a whole.
double strand_strain_of(const std::vector<double>& lengths, const std::vector<Vec3>& x) {
    double now = 0, rest = 0;
    for (size_t i = 0; i < lengths.size(); ++i) {
        now += (x[i + 1] - x[i]).norm();
        rest += lengths[i];
    }
    return std::abs(now / rest - 1);
}

using StrainOf = double (*)(const std::vector<double>&, const std::vector<Vec3>&);

// Worst of all strands in a frame.
double worst_of(const MetricInput& in, const Frame& frame, StrainOf strain_of) {
    double worst = 0;
    for (size_t s = 0; s < frame.x.size(); ++s)
        worst = std::max(worst, strain_of(in.scene.strands[s].segment_lengths(), frame.x[s]));
    return worst;
}

Value worst_of(const MetricInput& in, StrainOf strain_of) {
    double worst = 0;
    in.each([&](const Frame& frame) { worst = std::max(worst, worst_of(in, frame, strain_of)); });
    return {worst, ""};
}

} // namespace

Value segment_strain(const MetricInput& in) {
    return worst_of(in, strain_at);
}

Value strand_strain(const MetricInput& in) {
    return worst_of(in, strand_strain_of);
}

Value stretched_frames(const MetricInput& in) {
    double count = 0;
    in.each([&](const Frame& frame) { count += worst_of(in, frame, strain_at) > stretched; });
    return {count, ""};
}

} // namespace lab
