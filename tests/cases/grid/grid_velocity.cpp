#include "grid/grid_inputs.hpp"

namespace plait::cases {

// Velocities are differences of float32 positions of about 1 m over 1/60 s: good to 1e-5 m/s, and
// the sums are divided by densities from 0.1 up.
Case grid_velocity_case() {
    Case result = {PLAIT_STAGE_grid_velocity,
                   {},
                   {{"grid_velocity", 4e-4}},
                   {"slot_hash", "frame", "seed", "tent", "diffuse_rule", "diffuse_ratio",
                    "diffuse_factor", "diffuse_floor", "position.w"}};
    for (const GridHair& hair : make_grid_hair())
        for (uint32_t width : {1u, 16u, 64u}) {
            Setup setup = hair.setup();
            setup.name += ", width " + std::to_string(width);
            setup.items = hair.voxels();
            setup.width = width;
            setup.buffers = {uints(filled_slots(hair)), float4s(hair.position),
                             float4s(hair.position_prev), floats(make_grid_field(hair).density),
                             unwritten_float4s(hair.voxels())};
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
