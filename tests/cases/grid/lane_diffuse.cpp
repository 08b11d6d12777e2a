#include "grid/grid_inputs.hpp"

namespace plait::cases {

// Velocities below 2 m/s, turned into the grid and back. Whether a component is braked is a jump,
// as in grid_diffuse.
Case lane_diffuse_case() {
    Case result = {PLAIT_STAGE_lane_diffuse, {}, {{"lane_v", 1e-6}, {"lane_v_before", 1e-6}}};
    result.unread = {"each"};
    result.flags.push_back("grid_density"); // whether there is any hair
    for (GridHair hair : make_grid_hair())
        for (uint32_t tent : {PLAIT_TENT_TRILINEAR, PLAIT_TENT_VOXEL})
            for (uint32_t rule : {PLAIT_DIFFUSE_FLOORED, PLAIT_DIFFUSE_THESIS}) {
                hair.params.tent = tent;
                hair.params.diffuse_rule = rule;
                const GridField field = make_grid_field(hair);
                LaneGridHair lanes = over_lanes(hair);
                lanes.params.history = rule == PLAIT_DIFFUSE_FLOORED ? 1 : 0;
                Setup setup = hair.setup().with(lanes.params);
                setup.name += tent == PLAIT_TENT_VOXEL ? ", voxel" : ", trilinear";
                setup.name += rule == PLAIT_DIFFUSE_THESIS ? ", thesis" : ", floored";
                setup.items = hair.size.strands;
                setup.width = hair.size.stride;
                setup.buffers = {null_array(),
                                 uints(hair.vertex_count),
                                 lane_floats(lanes.x, 3),
                                 floats(field.density),
                                 float4s(field.velocity),
                                 lane_floats(lanes.v, 3),
                                 lane_floats(lanes.v_before, 3)};
                result.setups.push_back(setup);
            }
    return result;
}

} // namespace plait::cases
