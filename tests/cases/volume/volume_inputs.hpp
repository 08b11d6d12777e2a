// Nodes for the stages of volume: densities, velocities and pressures that have nothing to do with
// one another.
#pragma once

#include "grid/grid_inputs.hpp"

namespace plait::cases {

// Of [n^3] nodes: floats of FLOAT4 buffers four each.
struct VolumeNodes {
    uint32_t edge_count;
    std::vector<float> density, velocity, rest, solid, potential, before, link, node, pressure,
        wetness;

    uint32_t count() const { return edge_count * edge_count * edge_count; }
    std::string name() const { return std::to_string(edge_count) + " nodes"; }
};
// Every fifth node is empty, every seventh inside a collider; the outermost hold hair, too, and take
// no pressure.
VolumeNodes make_volume_nodes(uint32_t edge_count);
const std::vector<uint32_t>& volume_sizes();

// Hair over lanes and its grid, as over_lanes() has them.
plait_lane_volume_params volume_params_of(const plait_lane_grid_params& grid);

// A collider at both ends of its substep, as params.h lays it out.
std::vector<float> colliders_among_nodes();

} // namespace plait::cases
