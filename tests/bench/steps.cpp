// The whole step without and with the inter-hair step, over the number of strands: the two columns
// of table 5.1 of Ugurca 2015, by its own hash and rule, and two more for slots and exact sums as
// they are by default.
#include "bench.hpp"
#include "inputs.hpp"

#include <memory>
#include <stdexcept>

namespace bench {
namespace {

constexpr uint32_t strand_counts[] = {1000, 3000, 10000, 30000, 100000};

struct Column {
    Interhair interhair;
    plait_interhair value;
    plait_slot_hash hash;
    plait_diffuse_rule rule;
    const char* name;
};
constexpr Column columns[] = {
    {Interhair::off, PLAIT_INTERHAIR_OFF, PLAIT_HASH_PCG, PLAIT_DIFFUSE_RULE_FLOORED, "original"},
    {Interhair::thesis, PLAIT_INTERHAIR_SLOTS, PLAIT_HASH_THESIS, PLAIT_DIFFUSE_RULE_THESIS,
     "thesis"},
    {Interhair::slots, PLAIT_INTERHAIR_SLOTS, PLAIT_HASH_PCG, PLAIT_DIFFUSE_RULE_FLOORED, "slots"},
    {Interhair::exact, PLAIT_INTERHAIR_EXACT, PLAIT_HASH_PCG, PLAIT_DIFFUSE_RULE_FLOORED, "exact"}};

void check(plait_result result) {
    if (result != PLAIT_OK)
        throw std::runtime_error(plait_last_error());
}

template <auto destroy> struct Destroy {
    template <typename Object> void operator()(Object* object) const { destroy(object); }
};
using Context = std::unique_ptr<plait_context, Destroy<plait_context_destroy>>;
using Groom = std::unique_ptr<plait_groom, Destroy<plait_groom_destroy>>;
using Sim = std::unique_ptr<plait_sim, Destroy<plait_sim_destroy>>;

Context make_context(const plait_device_info& device) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = "opencl";
    desc.device = device.name;
    plait_context* context = nullptr;
    check(plait_context_create(&desc, &context));
    return Context(context);
}

Groom make_groom(const Shape& shape) {
    const auto roots = root_positions(shape.strands);
    std::vector<float> positions;
    for (uint32_t strand = 0; strand < shape.strands; ++strand)
        for (uint32_t vertex = 0; vertex < shape.vertices; ++vertex) {
            const float along =
                strand_length * static_cast<float>(vertex) / static_cast<float>(shape.vertices - 1);
            const float* root = &roots[3 * size_t{strand}];
            positions.insert(positions.end(), {root[0], root[1] - along, root[2]});
        }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {positions.data(), shape.total(), 0};
    desc.vertices_per_strand = shape.vertices;
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, nullptr, &groom));
    return Groom(groom);
}

// The settings of TressFX's own demonstration hair (pipeline's "mohawk").
Sim make_sim(plait_context* context, plait_groom* groom, const Column& column) {
    plait_sim_desc desc = plait_sim_desc_defaults();
    desc.params.damping = 0.068f;
    desc.params.local_stiffness = 0.908f;
    desc.params.local_iterations = 3;
    desc.params.global_stiffness = 0.408f;
    desc.params.global_range = 0.308f;
    desc.params.length_iterations = 3;
    desc.params.interhair = column.value;
    desc.params.slot_hash = column.hash;
    desc.params.diffuse_rule = column.rule;
    plait_sim* sim = nullptr;
    check(plait_sim_create(context, groom, &desc, &sim));
    return Sim(sim);
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

void measure(benchmark::State& state, uint32_t index, uint32_t strands, const Column& column,
             Results& results) {
    const Shape shape{strands, results.options.vertices};
    const Context context = make_context(results.devices[index].device);
    const Groom groom = make_groom(shape);
    const Sim sim = make_sim(context.get(), groom.get(), column);
    uint32_t number = 0;
    frame(sim.get(), number++); // compiles
    double total = 0;
    for ([[maybe_unused]] auto _ : state) {
        const double seconds = frame(sim.get(), number++);
        state.SetIterationTime(seconds);
        total += seconds;
    }
    const double seconds = total / static_cast<double>(state.iterations());
    results.devices[index].step_seconds[{strands, column.interhair}] = seconds;
    state.counters["steps/s"] = 1 / seconds;
    state.counters["ns/vertex"] = 1e9 * seconds / static_cast<double>(shape.total());
}

} // namespace

void register_steps(uint32_t device, Results& results) {
    for (const uint32_t strands : strand_counts)
        for (const Column& column : columns) {
            const std::string name = "device:" + std::to_string(device) +
                                     "/step/strands:" + std::to_string(strands) + "/" + column.name;
            register_row(name, results,
                         [device, strands, &column, &results](benchmark::State& state) {
                             measure(state, device, strands, column, results);
                         });
        }
}

} // namespace bench
