#include "volume_inputs.hpp"

namespace plait::cases {

// Up to 500 m/s^2 on nodes that share faces of a fifth of a vertex.
Case volume_impulse_case() {
    Case result = {PLAIT_STAGE_volume_impulse, {}, {{"volume_pull", 3e-4}}, {"grid_velocity.rms"}};
    for (const uint32_t edge_count : volume_sizes())
        for (const uint32_t carried : {0u, 1u}) {
            const VolumeNodes nodes = make_volume_nodes(edge_count);
            Setup setup;
            setup.name = nodes.name() + (carried ? ", carried" : "");
            setup.items = nodes.count();
            setup.buffers = {float4s(nodes.velocity), float4s(nodes.link), floats(nodes.before),
                             floats(nodes.pressure), unwritten_float4s(2 * nodes.count())};
            result.setups.push_back(setup.with(
                plait_volume_impulse_params{edge_count, 0.02f, 1.0f / 60, carried, 0.3f}));
        }
    return result;
}

} // namespace plait::cases
