// The whole step over the number of strands. Of tressfx without and with the inter-hair step: the
// two columns of table 5.1 of Ugurca 2015, by its own hash and rule, and two more for slots and
// exact sums as they are by default. Of both models as they are by default, without.
#include "bench.hpp"
#include "sim.hpp"

#include <cmath>
#include <numbers>

namespace bench {
namespace {

constexpr uint32_t strand_counts[] = {1000, 3000, 10000, 30000, 100000};

struct Column {
    Interhair interhair;
    bool grid;
    plait_grid_form form;
    plait_slot_hash_rule hash;
    plait_diffuse_rule rule;
    const char* name;
};
constexpr Column columns[] = {{Interhair::off, false, PLAIT_GRID_FORM_EXACT,
                               PLAIT_SLOT_HASH_RULE_PCG, PLAIT_DIFFUSE_RULE_FLOORED, "original"},
                              {Interhair::thesis, true, PLAIT_GRID_FORM_SLOTS,
                               PLAIT_SLOT_HASH_RULE_THESIS, PLAIT_DIFFUSE_RULE_THESIS, "thesis"},
                              {Interhair::slots, true, PLAIT_GRID_FORM_SLOTS,
                               PLAIT_SLOT_HASH_RULE_PCG, PLAIT_DIFFUSE_RULE_FLOORED, "slots"},
                              {Interhair::exact, true, PLAIT_GRID_FORM_EXACT,
                               PLAIT_SLOT_HASH_RULE_PCG, PLAIT_DIFFUSE_RULE_FLOORED, "exact"}};

// Strands of 0.25 m that hang from roots spread evenly over the upper half of a ball (a Fibonacci lattice).
Groom make_groom(uint32_t strands, uint32_t vertices) {
    constexpr float length = 0.25f, ball_radius = 0.1f; // m
    const float golden = std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
    std::vector<float> positions;
    for (uint32_t strand = 0; strand < strands; ++strand) {
        const float height = (static_cast<float>(strand) + 0.5f) / static_cast<float>(strands);
        const float radius = std::sqrt(1 - height * height);
        const float angle = golden * static_cast<float>(strand);
        for (uint32_t vertex = 0; vertex < vertices; ++vertex) {
            const float along =
                length * static_cast<float>(vertex) / static_cast<float>(vertices - 1);
            positions.insert(positions.end(),
                             {ball_radius * radius * std::cos(angle), ball_radius * height - along,
                              ball_radius * radius * std::sin(angle)});
        }
    }
    return groom_of(positions, vertices);
}

// The settings of TressFX's own demonstration hair (pipeline's "mohawk").
plait::SimDesc desc_of(const Column& column) {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_TRESSFX;
    desc.tressfx.damping = 0.068f;
    desc.tressfx.local_stiffness = 0.908f;
    desc.tressfx.local_iterations = 3;
    desc.tressfx.global_stiffness = 0.408f;
    desc.tressfx.global_range = 0.308f;
    desc.tressfx.length_iterations = 3;
    desc.grid.on = column.grid;
    desc.grid.form = column.form;
    desc.grid.slot_hash = column.hash;
    desc.grid.diffuse_rule = column.rule;
    return desc;
}

plait::SimDesc desc_of(plait_model model) {
    plait::SimDesc desc;
    desc.model = model;
    return desc;
}

// One frame of a head that turns to and fro.
double frame(plait_sim* sim, uint32_t number) {
    plait_roots roots = plait_roots_defaults();
    roots.head.t[0] = number % 2 ? 0.005f : 0.0f;
    const auto start = std::chrono::steady_clock::now();
    check(plait_sim_set_roots(sim, &roots));
    check(plait_sim_step(sim, 1.0 / 60 + 1e-9));
    check(plait_sim_wait(sim));
    return seconds_since(start);
}

// Seconds of a step.
double measure(benchmark::State& state, const plait_device_info& device, uint32_t strands,
               uint32_t vertices, const plait::SimDesc& desc) {
    const Context context = make_context(device);
    const Groom groom = make_groom(strands, vertices);
    const Sim sim = make_sim(context.get(), groom.get(), desc);
    uint32_t number = 0;
    frame(sim.get(), number++); // compiles
    double total = 0;
    for ([[maybe_unused]] auto _ : state) {
        const double seconds = frame(sim.get(), number++);
        state.SetIterationTime(seconds);
        total += seconds;
    }
    const double seconds = total / static_cast<double>(state.iterations());
    state.counters["steps/s"] = 1 / seconds;
    state.counters["ns/vertex"] = 1e9 * seconds / (static_cast<double>(strands) * vertices);
    return seconds;
}

} // namespace

void register_steps(uint32_t index, Results& results) {
    const std::string on = "device:" + std::to_string(index);
    for (const uint32_t strands : strand_counts) {
        const std::string of = "/strands:" + std::to_string(strands) + "/";
        for (const Column& column : columns)
            register_row(on + "/step" + of + column.name, results,
                         [index, strands, &column, &results](benchmark::State& state) {
                             DeviceResults& device = results.devices[index];
                             device.step_seconds[{strands, column.interhair}] =
                                 measure(state, device.device, strands, results.options.vertices,
                                         desc_of(column));
                         });
        for (const NamedModel& named : models)
            register_row(on + "/model" + of + named.name, results,
                         [index, strands, &named, &results](benchmark::State& state) {
                             DeviceResults& device = results.devices[index];
                             device.model_seconds[{strands, named.name}] =
                                 measure(state, device.device, strands, model_vertices,
                                         desc_of(named.model));
                         });
    }
}

} // namespace bench
