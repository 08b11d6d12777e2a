// Meshes near the strands of a case, for the stages that find planes of them.
#pragma once

#include "lane_inputs.hpp"

#include <array>
#include <initializer_list>

namespace plait::cases {

void append_floats(std::vector<float>& to, std::initializer_list<double> values);

using MeshCorners = std::vector<std::array<uint32_t, 3>>;

// Buffers of mesh_nearest.
struct NearestMeshes {
    std::vector<float> rows, box, from, to, bends, clearance;
    std::vector<uint32_t> first, tree, triangle, ring;

    // A mesh without its row and clearances. `from`, `to`: vertices at the begin and end of the step.
    void add(const MeshCorners& corners, const std::vector<Point>& from_where,
             const std::vector<Point>& to_where, bool sheet);
    std::vector<Array> buffers() const; // from mesh_first to mesh_clearance
};

// A ball of 3 to 5 cm with a bulge, that bends by some millimetres in the step or does not; a sheet: open.
void add_ball(NearestMeshes& meshes, Random& random, bool sheet, bool bends);

// The row in `collider` of a mesh some 4 cm in size whose surface is `gap` (m) off the start of a
// vertex, down the way that forces drive it, and that moves and turns a little. `shares`: of the fixed
// step, where the substep begins and ends.
void add_mesh_row(std::vector<float>& rows, Random& random, const LaneHair& lanes, size_t vertex,
                  double gap, std::array<double, 2> shares = {0, 0});

// Pins of the tips, a centimetre off, about as stiff as inertia. `first`: the buffer of pins, before
// that of positions.
void pin_tips(Setup& setup, size_t first);

// As reordered(), of these buffers, by rows of strands, too.
Setup reordered_too(Setup setup, std::initializer_list<size_t> rows);

} // namespace plait::cases
