// What a sim may have beside its strands, over a step without it: the grid between strands, volume in
// its place, and wind. Long hair on a head that turns to and fro.
#include "bench.hpp"
#include "sim.hpp"

namespace bench {
namespace {

constexpr uint32_t settling = 30; // frames before those that count

plait::SimDesc desc_of(plait_model model, Extra extra) {
    plait::SimDesc desc;
    desc.model = model;
    desc.volume.on = extra == Extra::volume_16 || extra == Extra::volume_32;
    desc.grid.on = desc.volume.on || extra == Extra::grid;
    if (desc.volume.on)
        desc.grid.edge_count = extra == Extra::volume_16 ? 16 : 32;
    return desc;
}

void set_wind(plait_sim* sim, Extra extra) {
    if (extra < Extra::wind)
        return;
    plait_wind_desc wind = plait_wind_desc_defaults();
    wind.velocity[0] = 3;
    wind.shelter = extra == Extra::wind ? 0 : 1;
    wind.turbulence = extra == Extra::eddies ? 1 : 0;
    check(plait_sim_set_wind(sim, &wind));
}

double seconds_of_frame(plait_sim* sim, uint32_t number) {
    const auto start = std::chrono::steady_clock::now();
    plait_roots roots = plait_roots_defaults();
    roots.head = turned_head(number);
    check(plait_sim_set_roots(sim, &roots));
    check(plait_sim_step(sim, 1.0 / 60 + 1e-9));
    check(plait_sim_wait(sim));
    return seconds_since(start);
}

// Seconds of a frame.
double measure(benchmark::State& state, const plait_device_info& device, plait_model model,
               Extra extra) {
    const Context context = make_context(device);
    const Groom groom = long_hair(extra_strands);
    const Sim sim = make_sim(context.get(), groom.get(), desc_of(model, extra));
    set_wind(sim.get(), extra);
    uint32_t number = 0;
    while (number < settling)
        seconds_of_frame(sim.get(), number++);
    double total = 0;
    for ([[maybe_unused]] auto _ : state) {
        const double seconds = seconds_of_frame(sim.get(), number++);
        state.SetIterationTime(seconds);
        total += seconds;
    }
    return total / static_cast<double>(state.iterations());
}

} // namespace

void register_extras(uint32_t index, Results& results) {
    for (const NamedModel& named : models)
        for (size_t extra = 0; extra < std::size(extra_names); ++extra) {
            if (named.model == PLAIT_MODEL_TRESSFX) // has neither volume nor such wind
                continue;
            register_row("device:" + std::to_string(index) + "/extra/" + named.name + "/" +
                             extra_names[extra],
                         results, [index, &named, extra, &results](benchmark::State& state) {
                             DeviceResults& device = results.devices[index];
                             device.extra_seconds[{named.name, extra}] = measure(
                                 state, device.device, named.model, static_cast<Extra>(extra));
                         });
        }
}

} // namespace bench
