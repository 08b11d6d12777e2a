// Vertices in a turned and shifted grid, well inside their voxels: which voxel a vertex is in must
// not depend on rounding, how much it weighs there may.
#pragma once

#include "inputs.hpp"

#include <optional>

namespace plait::cases {

struct GridHair {
    std::string name;
    Size size;
    plait_grid_params params;
    std::vector<uint32_t> vertex_count;
    std::vector<float> position, position_prev; // float4 [strands][V]

    uint32_t vertices() const { return size.strands * size.stride; }
    uint32_t voxels() const { return params.edge_count * params.edge_count * params.edge_count; }
    Setup setup() const; // name and parameters
};

// A few shapes of hair and grid, the last larger than a work-group's local memory; about one vertex in
// ten lies outside the grid.
std::vector<GridHair> make_grid_hair();
// So many strands that work-items of lane_splat take several times their lanes.
GridHair make_much_grid_hair();

// Voxel of a vertex by figure 4.1 of the thesis, straight from the definition.
std::optional<uint32_t> voxel_of(const plait_grid_params& params, const float* position);

// Slot by the pcg hash of params.h, straight from the definition.
uint32_t pcg_slot_of(const plait_grid_params& params, uint32_t vertex);

// Slots as a device may leave them: [nv^3 * C], filled vertex by vertex.
std::vector<uint32_t> filled_slots(const GridHair& hair);

// Densities [nv^3] and velocities (float4 [nv^3]) that have nothing to do with the hair; some
// voxels are empty.
struct GridField {
    std::vector<float> density, velocity;
};
GridField make_grid_field(const GridHair& hair);

// The same hair and grid as strands over lanes have them: [strand][V][3] and parameters.
struct LaneGridHair {
    std::vector<float> x, v, v_before;
    plait_lane_grid_params params;
};
LaneGridHair over_lanes(const GridHair& hair);

// Compares a grid_sum, as sums. Per vertex a weight is good to 2e-6 and a velocity below 2 m/s to
// 1e-5 m/s; up to 100 vertices.
std::string compare_sums(const Array& expected, const Array& got);

} // namespace plait::cases
