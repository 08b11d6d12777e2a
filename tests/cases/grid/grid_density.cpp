#include "grid/grid_inputs.hpp"

namespace plait::cases {

// A tent of coordinates good to 1e-7 / voxel_edge, below 2e-6, for up to 40 vertices in a voxel.
Case grid_density_case() {
    Case result = {PLAIT_STAGE_grid_density,
                   {},
                   {{"grid_density", 4e-5}},
                   {"h", "slot_hash", "frame", "seed", "tent", "diffuse_rule", "diffuse_ratio",
                    "diffuse_factor", "diffuse_floor", "position.w"}};
    for (const GridHair& hair : make_grid_hair())
        for (uint32_t width : {1u, 16u, 64u}) { // work-items that share a voxel's slots
            Setup setup = hair.setup();
            setup.name += ", width " + std::to_string(width);
            setup.items = hair.voxels();
            setup.width = width;
            setup.buffers = {uints(filled_slots(hair)), float4s(hair.position),
                             unwritten_floats(hair.voxels())};
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
