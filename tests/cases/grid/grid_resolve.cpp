#include "grid/grid_inputs.hpp"

namespace plait::cases {
namespace {

void put_sum(std::vector<uint32_t>& words, double value, double scale) {
    const auto bits = static_cast<uint64_t>(static_cast<int64_t>(value * scale));
    words.push_back(static_cast<uint32_t>(bits));
    words.push_back(static_cast<uint32_t>(bits >> 32));
}

// Sums of thousands of vertices, beyond 32 bits, of both signs; some voxels empty.
std::vector<uint32_t> make_sums(uint32_t voxels) {
    Random random(voxels);
    std::vector<uint32_t> words;
    for (uint32_t voxel = 0; voxel < voxels; ++voxel) {
        const double density = voxel % 4 == 2 ? 0 : random.uniform(0.01, 3000);
        put_sum(words, density, PLAIT_SUM_DENSITY_SCALE);
        for (int lane = 0; lane < 3; ++lane)
            put_sum(words, density * random.uniform(-3, 3), PLAIT_SUM_MOMENTUM_SCALE);
        put_sum(words, density * random.uniform(0, 30), PLAIT_SUM_ENERGY_SCALE);
    }
    return words;
}

} // namespace

// One conversion and one division of each: densities to 3000, velocities to 3 m/s, rms to 6 m/s.
Case grid_resolve_case() {
    Case result = {PLAIT_STAGE_grid_resolve,
                   {},
                   {{"grid_density", 5e-4}, {"grid_velocity", 2e-6}},
                   {"voxel_edge", "q", "t", "h", "slot_hash", "frame", "seed", "tent",
                    "diffuse_rule", "diffuse_ratio", "diffuse_factor", "diffuse_floor"}};
    for (const GridHair& hair : make_grid_hair()) {
        Setup setup = hair.setup();
        setup.items = hair.voxels();
        setup.buffers = {uints(make_sums(hair.voxels())), unwritten_floats(hair.voxels()),
                         unwritten_float4s(hair.voxels())};
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
