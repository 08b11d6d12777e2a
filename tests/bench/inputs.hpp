// Typical inputs for every stage: a head of hanging strands, slightly in motion.
#pragma once

#include <plait/plait_backend.h>

#include <cstdint>
#include <vector>

namespace bench {

inline constexpr float strand_length = 0.25f; // m
inline constexpr float head_radius = 0.1f;    // m

struct Shape {
    uint32_t strands;
    uint32_t vertices; // per strand
    uint32_t tile = 1; // strands per tile of the device's lane layout
    float lies =
        0.2f; // share of a strand's length that lies on the mesh, of stages that find planes

    size_t total() const { return size_t{strands} * vertices; }
};

// The parameter block of a stage, as bytes.
std::vector<unsigned char> typical_params(plait_stage stage, const Shape& shape);

uint32_t item_count(plait_stage stage, const Shape& shape);
uint32_t item_width(plait_stage stage, const Shape& shape);

// The contents of a buffer by the name of its argument, as 32-bit words. Throws for a name that
// stages.def did not have when this was written.
std::vector<uint32_t> typical_buffer(const plait_stage_info& stage, const plait_stage_arg& arg,
                                     const Shape& shape);

// What the stage has to move through memory at least, bytes, by plait_stage_traffic.
uint64_t traffic(const plait_stage_info& stage, const Shape& shape);

// Root positions spread evenly over the upper half of a sphere (a Fibonacci lattice), xyz each.
std::vector<float> root_positions(uint32_t strands);

} // namespace bench
