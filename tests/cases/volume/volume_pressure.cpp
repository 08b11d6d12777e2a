#include "volume/volume_inputs.hpp"

namespace plait::cases {

Case volume_pressure_case() {
    Case result = {
        PLAIT_STAGE_volume_pressure, {}, {{"volume_pressure", 1e-5}}, {"volume_link.before"}};
    for (const uint32_t edge_count : volume_sizes())
        for (const uint32_t colour : {0u, 1u}) {
            const VolumeNodes nodes = make_volume_nodes(edge_count);
            Setup setup;
            setup.name = nodes.name() + (colour ? ", odd" : ", even");
            setup.items = edge_count * edge_count * ((edge_count + 1) / 2);
            setup.buffers = {float4s(nodes.link), float4s(nodes.node), floats(nodes.pressure)};
            result.setups.push_back(setup.with(plait_volume_sweep_params{edge_count, colour}));
        }
    return result;
}

} // namespace plait::cases
