#include "grid/grid_inputs.hpp"

namespace plait::cases {

// A velocity is (x - x_prev)/h and goes back as x - v h: the rounding of positions of about 1 m.
// Whether a component is braked is a jump; no component of these inputs is within rounding of its
// threshold.
Case grid_diffuse_case() {
    Case result = {
        PLAIT_STAGE_grid_diffuse, {}, {{"position_prev", 2e-6}}, {"slot_hash", "frame", "seed"}};
    result.flags.push_back("grid_density"); // whether there is any hair
    for (GridHair hair : make_grid_hair())
        for (uint32_t tent : {PLAIT_TENT_TRILINEAR, PLAIT_TENT_VOXEL})
            for (uint32_t rule : {PLAIT_DIFFUSE_FLOORED, PLAIT_DIFFUSE_THESIS}) {
                hair.params.tent = tent;
                hair.params.diffuse_rule = rule;
                const GridField field = make_grid_field(hair);
                Setup setup = hair.setup();
                setup.name += tent == PLAIT_TENT_VOXEL ? ", voxel" : ", trilinear";
                setup.name += rule == PLAIT_DIFFUSE_THESIS ? ", thesis" : ", floored";
                setup.items = hair.vertices();
                setup.buffers = {uints(hair.vertex_count), float4s(hair.position),
                                 floats(field.density), float4s(field.velocity),
                                 float4s(hair.position_prev)};
                result.setups.push_back(setup);
            }
    return result;
}

} // namespace plait::cases
