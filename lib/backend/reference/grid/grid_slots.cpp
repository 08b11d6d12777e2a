// grid_slots: every vertex writes its number into a random slot of its voxel; the last writer wins.
// Here the order is that of the vertices, so the highest number stays; a parallel device may keep
// any. Source: Ugurca 2015, figures 4.1 and 4.6.
#include "backend/reference/grid/grid.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

// Figure 4.6: frac(cos(fmod(123456789, 1e-7 + 256 dot(p, r)))), r = (e^pi, 2^sqrt 2), p the
// fractional parts of x and y in voxels. In float32 as published: fmod leaves noise in the low
// bits, which is where the hash comes from, so float64 would be another function.
uint32_t thesis_slot(const Vec3& p, uint32_t capacity) {
    const auto x = static_cast<float>(p.x() - std::floor(p.x()));
    const auto y = static_cast<float>(p.y() - std::floor(p.y()));
    const float dot = x * 23.14069263277f + y * 2.66514414269f;
    const float c = std::cos(std::fmod(123456789.0f, 1e-7f + 256.0f * dot));
    const float random = c - std::floor(c);
    return std::min(static_cast<uint32_t>(random * static_cast<float>(capacity)), capacity - 1);
}

// PCG-RXS-M-XS 32 (O'Neill 2014; as a hash: Jarzynski and Olano 2020).
uint32_t pcg(uint32_t value) {
    const uint32_t state = value * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

uint32_t pcg_slot(uint32_t vertex, const plait_grid_params& params) {
    const uint64_t hash = pcg(vertex ^ pcg(params.frame ^ pcg(params.seed)));
    return static_cast<uint32_t>(hash * params.capacity >> 32);
}

} // namespace

void grid_slots(uint32_t item_count, const plait_grid_params& params, const grid_slots_args& args) {
    const Grid grid(params);
    for (uint32_t item = 0; item < item_count; ++item) {
        const auto [strand, i] = strand_vertex(item, params.vertex_stride);
        if (i >= vertices_of(args.vertex_count, strand, params.vertex_stride))
            continue;
        const Vec3 p = grid.coordinates(xyz(args.position[item]));
        const auto voxel = grid.voxel_at(p);
        if (!voxel) {
            ++args.grid_outside[0];
            continue;
        }
        const uint32_t slot = params.slot_hash == PLAIT_SLOT_HASH_THESIS
                                  ? thesis_slot(p, params.capacity)
                                  : pcg_slot(item, params);
        args.grid_slot[*voxel * params.capacity + slot] = item;
    }
}

} // namespace plait::reference
