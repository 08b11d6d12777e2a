// wind_field: a wind without sources or sinks, the curl of three scalar potentials of gradient noise,
// octave over octave. A potential is the mean of the eight linear functions g . (p - corner) of the
// corners' random gradients, weighted by quintics 6t^5 - 15t^4 + 10t^3 along each axis.
#include "backend/reference/base/noise.hpp"
#include "backend/reference/base/stages.hpp"

#include <cmath>

namespace plait::reference {
namespace {

struct Place {
    std::array<uint32_t, 3> cell;
    Vec3 in_cell;
};

// 2^octave of what `corner` and `offset` add up to.
Place refined(const plait_wind_field_params& params, const Vec3& offset, uint32_t octave) {
    Place place;
    for (int axis = 0; axis < 3; ++axis) {
        const double scaled = std::ldexp(params.fraction[axis] + offset[axis], int(octave));
        const double low = std::floor(scaled);
        place.cell[axis] =
            (params.cell[axis] << octave) + static_cast<uint32_t>(static_cast<int64_t>(low));
        place.in_cell[axis] = scaled - low;
    }
    return place;
}

Vec3 curl(const Place& place, uint32_t seed) {
    Vec3 derivative[3];
    for (uint32_t potential = 0; potential < 3; ++potential)
        derivative[potential] =
            noise_derivatives(place.cell, place.in_cell, hash_of(seed ^ (potential * 0x9e3779b9u)));
    return {derivative[2].y() - derivative[1].z(), derivative[0].z() - derivative[2].x(),
            derivative[1].x() - derivative[0].y()};
}

} // namespace

void wind_field(uint32_t item_count, const plait_wind_field_params& params,
                const wind_field_args& args) {
    const uint32_t n = params.edge_count;
    const Quat q = quat(params.q);
    for (uint32_t item = 0; item < item_count; ++item) {
        const Vec3 cell(item % n, item / (n * n), item / n % n);
        const Vec3 offset = q * Vec3((cell + Vec3::Constant(0.5)) * params.voxel_edge);
        Vec3 wind = Vec3::Zero();
        for (uint32_t octave = 0; octave < params.octaves; ++octave)
            wind += params.amplitude * std::pow(params.gain, octave) *
                    curl(refined(params, offset, octave), params.seed + octave);
        args.wind_velocity[item] = with_w(wind, 1);
    }
}

} // namespace plait::reference
