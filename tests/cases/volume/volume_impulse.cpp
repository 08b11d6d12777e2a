#include "volume/volume_inputs.hpp"

#include <cmath>

namespace plait::cases {

namespace {

// Of a node the change of velocity, m/s, with a share, and the acceleration, m/s^2.
std::string compare(const Setup&, const Outputs& expected, const Outputs& got) {
    const std::vector<float>&a = got[5].floats, &b = expected[5].floats;
    for (size_t i = 0; i < b.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= (i / 4 % 2 ? 3e-4f : 1e-5f)))
            return "volume_pull[" + std::to_string(i / 4) + "] is off by " +
                   std::to_string(a[i] - b[i]);
    return "";
}

} // namespace

// Up to 500 m/s^2 on nodes that share faces of a fifth of a vertex.
Case volume_impulse_case() {
    Case result = {PLAIT_STAGE_volume_impulse,
                   {},
                   {{"volume_potential", 1e-5}},
                   {"grid_velocity.rms"},
                   {{"volume_pull", compare}}};
    for (const uint32_t edge_count : volume_sizes()) {
        const VolumeNodes nodes = make_volume_nodes(edge_count);
        Setup setup;
        setup.name = nodes.name();
        setup.items = nodes.count();
        setup.buffers = {floats(nodes.density),
                         float4s(nodes.velocity),
                         float4s(nodes.link),
                         floats(nodes.pressure),
                         unwritten_floats(2 * nodes.count()),
                         unwritten_float4s(2 * nodes.count())};
        result.setups.push_back(
            setup.with(plait_volume_impulse_params{edge_count, 0.02f, 1.0f / 60, 15}));
    }
    return result;
}

} // namespace plait::cases
