// A groom's strands as the strand models see them: lengths, masses, stiffnesses and the rest
// rotation of every joint, in the lane layout [tile][V][4][tile strands].
#pragma once

#include "core/lane_layout.hpp"

#include <memory_resource>
#include <vector>

namespace plait {

// Strands at rest: xyz of every vertex, and vertices per strand.
struct RestStrands {
    std::pmr::vector<float> positions;
    std::pmr::vector<uint32_t> counts;
};

// What of the parameters the material depends on.
struct Material {
    float line_density;
    float bend_stiffness;
    float stretch_stiffness;
    float tip_stiffness;
    bool equal_masses; // a limp chain's; a rod has half a mass at the tip

    bool operator==(const Material&) const = default;
};

// [rows*4]: PLAIT_LANE_LENGTH, _STRETCH, _BEND, _MASS. Rows past a tip have mass 1 and nothing
// else.
std::pmr::vector<float> lane_material(const RestStrands& strands, const LaneLayout& layout,
                                      const Material& material, std::pmr::memory_resource* memory);

// [rows*4]: quaternion of the joint before each segment at rest; row 0: that of the first segment,
// from the rest space's axes. Frames are carried along a strand by the shortest turn, so that a
// strand as groomed has no twist.
std::pmr::vector<float> lane_rest(const RestStrands& strands, const LaneLayout& layout,
                                  std::pmr::memory_resource* memory);

} // namespace plait
