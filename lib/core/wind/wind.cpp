#include "core/wind/wind.hpp"

#include "core/base/ranges.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr uint32_t nodes = WindGrid::nodes;
constexpr double slowest = 1e-3; // m/s, for which shelter is reckoned
// rms of a component of the curl of three noises, measured; and of a noise in one dimension, the root
// of 2/3 of the integral of (1 - f)^2 t^2, f the fade.
constexpr double rms_of_curl = 0.7047, rms_of_noise = 0.14069;

uint32_t hash_of(uint32_t value) { // pcg, as the kernels have it
    const uint32_t state = value * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// Gradient noise in one dimension.
double noise(double at, uint32_t seed) {
    const double low = std::floor(at), t = at - low;
    const auto cell = static_cast<uint32_t>(static_cast<int64_t>(low));
    const auto slope = [&](uint32_t point) {
        return std::ldexp(double(hash_of(hash_of(point ^ hash_of(seed))) >> 8), -23) - 1;
    };
    const double fade = t * t * t * (t * (6 * t - 15) + 10);
    return (1 - fade) * slope(cell) * t + fade * slope(cell + 1) * (t - 1);
}

// Lattice cell and place in it of a point that may be a million cells away.
void split(double place, plait_u32& cell, float& fraction) {
    const double low = std::floor(place);
    cell = static_cast<plait_u32>(static_cast<int64_t>(low));
    fraction = static_cast<float>(place - low);
}

} // namespace

plait_wind_desc default_wind_desc() {
    plait_wind_desc desc{};
    desc.struct_size = sizeof desc;
    desc.scale = 0.5f;
    desc.octaves = 3;
    desc.gain = 0.5f;
    desc.gust_period = 2;
    desc.tangential = 0.3f;
    desc.air_density = 1.204f;
    desc.viscosity = 1.516e-5f;
    desc.shelter = 1;
    return desc;
}

Status check_wind(const plait_wind_desc& s) {
    for (size_t i = 0; i < 3; ++i)
        PLAIT_TRY(
            check_range(format("velocity[%zu]", i).c_str(), double(s.velocity[i]), -1e3, 1e3));
    PLAIT_RANGE(turbulence, 0, 1e3);
    PLAIT_RANGE(scale, 1e-3f, 1e4);
    PLAIT_RANGE(octaves, 1, 8);
    PLAIT_RANGE(gain, 0, 1);
    PLAIT_RANGE(gusts, 0, 2);
    PLAIT_RANGE(gust_period, 1e-2f, 1e4);
    PLAIT_RANGE(tangential, 0, 1);
    PLAIT_RANGE(diameter, 0, 0.1f);
    PLAIT_TRY(check_range("air_density", double(s.air_density), 0, 1e4, true));
    PLAIT_RANGE(viscosity, 0, 1);
    PLAIT_RANGE(shelter, 0, 1);
    PLAIT_RANGE(hairs_per_strand, 0, 1e6f);
    return {};
}

Status Wind::begin(Device& device, const Wind& from, const plait_wind_desc& desc,
                   const HairSizes& hair) {
    desc_ = desc;
    if (desc_.diameter == 0)
        desc_.diameter = hair.diameter;
    vertex_length_ =
        hair.length * (desc_.hairs_per_strand > 0 ? desc_.hairs_per_strand : hair.strands);
    auto grid = WindGrid::create(device, desc_.turbulence > 0, desc_.shelter != 0);
    if (!grid)
        return grid.error();
    grid_ = std::move(*grid);
    blows_ = true;
    if (!from.blows()) {
        reset();
        return {};
    }
    moving = from.moving;
    const Vector now = mean(moving.time), before = from.mean(moving.time);
    for (size_t i = 0; i < 3; ++i)
        moving.jump[i] += static_cast<float>(now[i] - before[i]);
    return {};
}

// The air was still before.
void Wind::reset() {
    moving = {};
    if (!blows_)
        return;
    const Vector now = mean(0);
    for (size_t i = 0; i < 3; ++i)
        moving.jump[i] = static_cast<float>(now[i]);
}

double Wind::gust(double time) const {
    if (desc_.gusts == 0)
        return 1;
    const double varies = noise(time / double(desc_.gust_period), desc_.seed) / rms_of_noise;
    return std::max(0.0, 1 + double(desc_.gusts) * varies);
}

Wind::Vector Wind::mean(double time) const {
    const double share = gust(time);
    return {share * double(desc_.velocity[0]), share * double(desc_.velocity[1]),
            share * double(desc_.velocity[2])};
}

plait_wind_field_params Wind::field_params(double step) const {
    plait_wind_field_params params{};
    const double scale = double(desc_.scale);
    params.edge_count = nodes;
    params.voxel_edge = static_cast<float>(double(grid_.voxel_edge()) / scale);
    std::copy_n(grid_.corner().q, 4, params.q);
    for (size_t i = 0; i < 3; ++i) {
        const double carried = moving.way[i] + step * double(desc_.velocity[i]);
        split((double(grid_.corner().t[i]) - carried) / scale, params.cell[i], params.fraction[i]);
    }
    double squares = 0;
    for (uint32_t octave = 0; octave < desc_.octaves; ++octave)
        squares += std::pow(double(desc_.gain), 2 * octave);
    params.amplitude =
        static_cast<float>(double(desc_.turbulence) / rms_of_curl / std::sqrt(squares));
    params.octaves = desc_.octaves;
    params.gain = desc_.gain;
    params.seed = desc_.seed;
    return params;
}

std::array<float, 3> Wind::stream(const std::array<float, 3>& air, double step) const {
    const Vector wind = mean(moving.time + step);
    std::array<float, 3> all = air;
    for (size_t i = 0; i < 3; ++i)
        all[i] += static_cast<float>(wind[i]);
    return all;
}

// Cionco 1965, with the frontal area of hairs in all directions, pi/4 of their length times diameter,
// and the drag of lane_wind.
float Wind::extinction(double speed) const {
    const double d = double(desc_.diameter);
    const double reynolds = std::max(speed, slowest) * d / double(desc_.viscosity);
    const double coefficient = 1 + 10 * std::pow(reynolds, -2.0 / 3);
    constexpr double directions = 0.7853981633974483;
    return static_cast<float>(0.5 * coefficient * d * directions * double(vertex_length_) *
                              (desc_.hairs_per_strand > 0 ? 1 : double(crowd)));
}

void Wind::append(Schedule& schedule, const HairNow& hair, const std::array<float, 3>& air,
                  const std::array<float, 3>& still, double step) const {
    if (!grid_.velocity())
        return;
    if (desc_.turbulence > 0)
        schedule.add(PLAIT_STAGE_wind_field, nodes * nodes * nodes, field_params(step),
                     {grid_.velocity()});
    if (!grid_.is_sheltered())
        return;
    const auto wind = stream(air, step);
    const double speed = std::hypot(double(wind[0] - still[0]), double(wind[1] - still[1]),
                                    double(wind[2] - still[2]));
    grid_.append_shelter(schedule, hair, {wind, still, extinction(speed)});
}

void Wind::advance(double step) {
    moving.time += step;
    for (size_t i = 0; i < 3; ++i)
        moving.way[i] += step * double(desc_.velocity[i]);
    moving.jump = {};
}

void Wind::fill(Schedule& schedule, const Part& part, const std::array<float, 3>& air, bool first,
                double step, Doors& doors) const {
    plait_lane_wind_params params{};
    params.vertex_stride = part.lanes.row;
    params.tile = part.lanes.tile;
    params.row_stride = part.row_stride;
    params.h = part.h;
    params.bdf2 = part.bdf2;
    params.pins = doors.spring ? 1 : 0;
    params.accelerates = part.acceleration ? 1 : 0;
    params.pressure = part.pressure ? 1 : 0;
    const double d = double(desc_.diameter);
    params.drag = static_cast<float>(0.5 * double(desc_.air_density) * d);
    params.viscous = static_cast<float>(10 * std::pow(double(desc_.viscosity) / d, 2.0 / 3.0));
    params.tangential = desc_.tangential;
    if (!grid_.is_sheltered()) // else it is in the field
        std::ranges::copy(stream(air, step), params.air);
    if (first)
        std::ranges::copy(moving.jump, params.jump);
    params.field = grid_.velocity() ? 1 : 0;
    params.edge_count = nodes;
    params.voxel_edge = grid_.voxel_edge();
    std::copy_n(grid_.corner().q, 4, params.q);
    std::copy_n(grid_.corner().t, 3, params.t);
    schedule.add(PLAIT_STAGE_lane_wind, part.lanes.strands, params,
                 {&part.strand, &part.vertex_count, &part.rest, &part.pose, &part.acceleration,
                  grid_.velocity(), &part.material, &part.x, &part.v, &part.x_before,
                  &part.v_before, &part.pressure, &part.push, &part.spring},
                 part.lanes.row);
    doors.spring = true;
}

} // namespace plait
