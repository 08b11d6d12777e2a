#include "volume/volume_inputs.hpp"

namespace plait::cases {

// Densities of a twentieth and velocities of 0.6 m/s: what is wanted is up to a hundred.
Case volume_faces_case() {
    Case result = {PLAIT_STAGE_volume_faces,
                   {},
                   {{"volume_link", 2e-5}, {"volume_node", 1e-4}, {"volume_pressure", 1e-6}},
                   {"grid_velocity.rms"}};
    result.flags.push_back("volume_solid.inside");
    for (const uint32_t edge_count : volume_sizes())
        for (const uint32_t carried : {0u, 1u}) {
            const VolumeNodes nodes = make_volume_nodes(edge_count);
            plait_volume_params params{};
            params.edge_count = edge_count;
            params.voxel_edge = 0.02f;
            params.h = 1.0f / 60;
            params.fall[0] = 0.2f;
            params.fall[1] = -0.3f;
            params.fall[2] = 0.1f;
            params.share = 0.9f;
            params.slack = 0.05f;
            params.onset = 0.1f;
            params.recovery = 0.2f;
            params.most_recovery = 0.05f;
            params.cohesion = 0.6f;
            params.wet_cohesion = 0.4f;
            params.carried = carried;
            params.wet = edge_count % 2;
            Setup setup;
            setup.name = nodes.name() + (carried ? ", carried" : "");
            setup.items = nodes.count();
            setup.buffers = {floats(nodes.density),
                             float4s(nodes.velocity),
                             floats(nodes.rest),
                             floats(nodes.wetness),
                             float4s(nodes.solid),
                             floats(nodes.potential),
                             unwritten_float4s(nodes.count()),
                             unwritten_float4s(nodes.count()),
                             unwritten_floats(nodes.count())};
            result.setups.push_back(setup.with(params));
        }
    return result;
}

} // namespace plait::cases
