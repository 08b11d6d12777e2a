// Air: turbulence against a table that another program made, that it has no sources, shelter against
// the law's integral, and the drag of a single segment.
#include "closed_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plait::conformance {

using namespace cases;

namespace {

using Vector = std::array<double, 3>;

constexpr std::array<double, 6> table[] = {
#include "wind_field.inc"
};

// A grid of voxels so small that all its nodes are the corner.
plait_wind_field_params at_point(const double* place, float amplitude, uint32_t octaves) {
    plait_wind_field_params params{};
    params.edge_count = 1;
    params.voxel_edge = 1e-30f;
    params.q[3] = 1;
    for (int i = 0; i < 3; ++i) {
        const double low = std::floor(place[i]);
        params.cell[i] = static_cast<uint32_t>(static_cast<int64_t>(low));
        params.fraction[i] = static_cast<float>(place[i] - low);
    }
    params.amplitude = amplitude;
    params.octaves = octaves;
    params.gain = 0.5f;
    params.seed = 1;
    return params;
}

std::vector<float> velocities(Bench& bench, const plait_wind_field_params& params) {
    const uint32_t nodes = params.edge_count * params.edge_count * params.edge_count;
    return bench.run(PLAIT_STAGE_wind_field, nodes, 1, params, {unwritten_float4s(nodes)})[0]
        .floats;
}

void air_field_is_the_table_s(Bench& bench) {
    const double norm = std::sqrt(1 + 0.25 + 0.0625); // of the gains
    for (const auto& row : table) {
        const auto got = velocities(bench, at_point(row.data(), static_cast<float>(1 / norm), 3));
        for (size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(double(got[i]), row[3 + i], 1e-4) << "at " << row[0] << " " << row[1];
    }
}

// By central differences, a thousandth of the gradient's own size.
void air_field_has_no_sources(Bench& bench) {
    constexpr uint32_t n = 3;
    constexpr double edge = 0.004;
    double divergence = 0, gradient = 0;
    for (const auto& row : table) {
        plait_wind_field_params params = at_point(row.data(), 1, 1);
        params.edge_count = n;
        params.voxel_edge = static_cast<float>(edge);
        const auto u = velocities(bench, params);
        const size_t middle = 13, step[] = {1, n * n, n};
        double sum = 0;
        for (size_t i = 0; i < 3; ++i)
            for (size_t k = 0; k < 3; ++k) {
                const double slope = (double(u[4 * (middle + step[i]) + k]) -
                                      double(u[4 * (middle - step[i]) + k])) /
                                     (2 * edge);
                gradient += slope * slope / 9;
                sum += i == k ? slope : 0;
            }
        divergence += sum * sum;
    }
    EXPECT_LT(std::sqrt(divergence), 1e-3 * std::sqrt(gradient));
    EXPECT_GT(gradient / std::size(table), 0.5);
}

struct Segment {
    Vector direction, velocity;
    double tangential = 0.5;
};

plait_lane_wind_params still_air(uint32_t bdf2) {
    plait_lane_wind_params params{};
    params.vertex_stride = params.row_stride = 2;
    params.tile = 1;
    params.h = 1.0f / 60;
    params.bdf2 = bdf2;
    params.drag = static_cast<float>(0.5 * 1.204 * 70e-6);
    params.viscous = static_cast<float>(10 * std::pow(1.516e-5 / 70e-6, 2.0 / 3));
    params.edge_count = 1;
    params.voxel_edge = 1;
    params.q[3] = 1;
    return params;
}

// m/s^2 of the tip of one segment that goes on as it does: of spring and push together.
Vector drag_on(Bench& bench, const Segment& segment, uint32_t bdf2) {
    constexpr float length = 0.01f, mass = 0.5f * 5e-6f * length;
    plait_lane_wind_params params = still_air(bdf2);
    params.tangential = static_cast<float>(segment.tangential);
    const float whole = params.h;
    std::vector<float> x(6, 0.0f), v(6, 0.0f), before(6, 0.0f), pose{0, 0, 0, 1, 0, 0, 0, 0};
    for (size_t i = 0; i < 3; ++i) {
        v[3 + i] = static_cast<float>(segment.velocity[i]);
        x[3 + i] = length * static_cast<float>(segment.direction[i]);
        before[3 + i] = x[3 + i];
        before[i] = -whole * v[3 + i]; // the root goes along
        pose[4 + i] = whole * v[3 + i];
    }
    const std::vector<float> material{length, 0, 0, 0, 0, 0, 0, 1, 1, mass, 0, 0};
    const auto out = bench.run(
        PLAIT_STAGE_lane_wind, 1, 2, params,
        {null_array(), uints({2}), float4s(std::vector<float>(8, 0.0f)), float4s(pose),
         null_array(), null_array(), lane_floats(material, PLAIT_LANE_MATERIAL_COMPONENTS),
         lane_floats(x, 3), lane_floats(v, 3), lane_floats(before, 3), lane_floats(v, 3),
         null_array(), lane_floats(std::vector<float>(6, 9), 3),
         lane_floats(std::vector<float>(8, 0), 4)});
    Vector all{};
    for (size_t i = 0; i < 3; ++i) // x relative to the root is where it was
        all[i] =
            double(out[12].floats[3 + i]) + double(out[13].floats[7]) / double(mass) *
                                                (double(out[13].floats[4 + i]) - double(x[3 + i]));
    return all;
}

// Terminal velocities of segments tilted by 15 degrees each, at half the drag along them: drag holds
// them against gravity within 0.5 %.
void lane_air_holds_at_terminal_velocity(Bench& bench) {
    constexpr std::array<double, 3> rows[] = {{0, 0, -0.386331959539},
                                              {15, 0.136204674297, -0.426797704572},
                                              {30, 0.160061674248, -0.495428966936},
                                              {45, 0.134629752708, -0.562144942963},
                                              {60, 0.0792433095467, -0.609448434254},
                                              {75, 0.0164632580763, -0.629223010214},
                                              {90, 0, -0.626903982174}};
    for (const uint32_t bdf2 : {0u, 1u})
        for (const auto& [degrees, x, y] : rows) {
            const double tilt = degrees * 3.14159265358979 / 180;
            const Vector drag =
                drag_on(bench, {{std::cos(tilt), -std::sin(tilt), 0}, {x, y, 0}}, bdf2);
            EXPECT_NEAR(drag[0], 0, 0.005 * 9.81) << degrees;
            EXPECT_NEAR(drag[1], 9.81, 0.005 * 9.81) << degrees;
            EXPECT_NEAR(drag[2], 0, 1e-4) << degrees;
        }
}

// A cube of `nodes`^3 voxels of `edge` m, centred at the origin; its extinction is a number per voxel.
struct ShelterGrid {
    uint32_t nodes;
    double edge;
    std::vector<float> density;

    template <typename Density> void fill(const Density& at) {
        density.clear();
        for (uint32_t y = 0; y < nodes; ++y)
            for (uint32_t z = 0; z < nodes; ++z)
                for (uint32_t x = 0; x < nodes; ++x)
                    density.push_back(static_cast<float>(at(place(x, y, z))));
    }
    Vector place(uint32_t x, uint32_t y, uint32_t z) const {
        const double low = 0.5 - nodes / 2.0;
        return {edge * (x + low), edge * (y + low), edge * (z + low)};
    }
    // Share of a wind in `way` that is left at every node.
    std::vector<double> open(Bench& bench, const Vector& way) const {
        const size_t count = density.size();
        plait_wind_shelter_params params{};
        params.edge_count = nodes;
        params.voxel_edge = static_cast<float>(edge);
        params.q[3] = 1;
        uint32_t axis = 0;
        for (uint32_t i = 1; i < 3; ++i)
            axis = std::abs(way[i]) > std::abs(way[axis]) ? i : axis;
        const double most = std::abs(way[axis]);
        params.axis = axis;
        params.reversed = way[axis] < 0;
        params.foot[0] = static_cast<float>(way[axis == 0 ? 1 : 0] / most);
        params.foot[1] = static_cast<float>(way[axis == 2 ? 1 : 2] / most);
        params.way = static_cast<float>(edge * std::hypot(way[0], way[1], way[2]) / most);
        Array depth = floats(std::vector<float>(count, 0.0f));
        Array air = float4s(std::vector<float>(4 * count, 0.0f));
        for (params.plane = 0; params.plane < nodes; ++params.plane) {
            auto out = bench.run(PLAIT_STAGE_wind_shelter, nodes * nodes, 1, params,
                                 {floats(density), floats(density),
                                  float4s(std::vector<float>(4 * count, 0.0f)), depth, air});
            depth = out[3];
            air = out[4];
        }
        std::vector<double> left;
        for (size_t i = 0; i < count; ++i)
            left.push_back(double(air.floats[4 * i + 3]));
        return left;
    }
};

// Hair of uniform density, of a density that grows linearly to the end of 10 cm, and a bump of 5 cm, from
// the face that the wind meets on.
double profile(int kind, double depth) {
    if (depth < 0)
        return 0;
    if (kind == 0)
        return depth <= 0.1 ? 1 : 0;
    if (kind == 1)
        return depth <= 0.1 ? depth / 0.1 : 0;
    return depth <= 0.05 ? 0.5 * std::sin(3.14159265358979 * depth / 0.05) : 0;
}
// The integral of the same.
double depth_of(int kind, double depth) {
    const double d = std::clamp(depth, 0.0, kind == 2 ? 0.05 : 0.1);
    if (kind == 0)
        return d;
    if (kind == 1)
        return d * d / 0.2;
    return 0.05 / (2 * 3.14159265358979) * (1 - std::cos(3.14159265358979 * d / 0.05));
}

// e^-sigma times the integral of the density, within .01 rms, in every direction of the axes.
void air_shelter_of_layers_is_the_integral_s(Bench& bench) {
    ShelterGrid grid{32, 0.11 / 31, {}};
    for (uint32_t axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0})
            for (const int kind : {0, 1, 2})
                for (const double sigma : {5.0, 20.0, 60.0}) {
                    const double face = -0.05;
                    const auto depth_at = [&](const Vector& x) { return side * x[axis] - face; };
                    grid.fill([&](const Vector& x) { return sigma * profile(kind, depth_at(x)); });
                    Vector way{};
                    way[axis] = side;
                    const auto open = grid.open(bench, way);
                    double squares = 0;
                    for (uint32_t i = 0; i < 32; ++i) {
                        const uint32_t cell[3] = {axis == 0 ? i : 7, axis == 1 ? i : 7,
                                                  axis == 2 ? i : 7};
                        const double exact = std::exp(
                            -sigma *
                            depth_of(kind, depth_at(grid.place(cell[0], cell[1], cell[2]))));
                        const double error = open[(cell[1] * 32 + cell[2]) * 32 + cell[0]] - exact;
                        squares += error * error / 32;
                    }
                    EXPECT_LT(std::sqrt(squares), 0.01) << "axis " << axis << " side " << side
                                                        << " profile " << kind << " " << sigma;
                }
}

// In a ball the wind has come through a chord.
void air_shelter_of_a_ball_is_its_chord_s(Bench& bench) {
    constexpr double radius = 0.3, edge = 1.0 / 32;
    ShelterGrid grid{32, edge, {}};
    for (const Vector& direction : {Vector{1, 0, 0}, Vector{1, 0.6, 0.3}, Vector{-0.2, 0.5, -1}})
        for (const double sigma : {4.0, 15.0}) {
            const double length = std::hypot(direction[0], direction[1], direction[2]);
            const auto chord = [&](const Vector& x) {
                double along = 0, square = 0;
                for (size_t i = 0; i < 3; ++i) {
                    along += x[i] * direction[i] / length;
                    square += x[i] * x[i];
                }
                return along + std::sqrt(std::max(0.0, radius * radius - square + along * along));
            };
            // the share of a voxel that is in the ball
            grid.fill([&](const Vector& x) {
                constexpr int parts = 4;
                double inside = 0;
                for (int p = 0; p < parts * parts * parts; ++p) {
                    const int at[3] = {p % parts, p / parts % parts, p / (parts * parts)};
                    double square = 0;
                    for (size_t i = 0; i < 3; ++i) {
                        const double y = x[i] + edge * ((at[i] + 0.5) / parts - 0.5);
                        square += y * y;
                    }
                    inside += square < radius * radius;
                }
                return sigma * inside / (parts * parts * parts);
            });
            const auto open = grid.open(bench, direction);
            double squares = 0, number = 0;
            for (uint32_t y = 0; y < 32; ++y)
                for (uint32_t z = 0; z < 32; ++z)
                    for (uint32_t x = 0; x < 32; ++x) {
                        const Vector at = grid.place(x, y, z);
                        if (std::hypot(at[0], at[1], at[2]) > radius - edge)
                            continue;
                        const double error =
                            open[(y * 32 + z) * 32 + x] - std::exp(-sigma * chord(at));
                        squares += error * error;
                        ++number;
                    }
            EXPECT_LT(std::sqrt(squares / number), 0.01) << direction[1] << " " << sigma;
        }
}

} // namespace

const std::vector<ClosedForm>& air_closed_forms() {
    static const std::vector<ClosedForm> list = {
        PLAIT_CLOSED_FORM(air_field_is_the_table_s), PLAIT_CLOSED_FORM(air_field_has_no_sources),
        PLAIT_CLOSED_FORM(air_shelter_of_layers_is_the_integral_s),
        PLAIT_CLOSED_FORM(air_shelter_of_a_ball_is_its_chord_s),
        PLAIT_CLOSED_FORM(lane_air_holds_at_terminal_velocity)};
    return list;
}

} // namespace plait::conformance
