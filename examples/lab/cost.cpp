#include "cost.hpp"

#include <algorithm>
#include <chrono>

namespace lab {

namespace {

constexpr uint32_t warm_up = 3;

uint32_t copies_for(const Scene& scene, uint64_t vertices) {
    uint64_t one = 0;
    for (const Strand& strand : scene.strands)
        one += strand.segments + 1;
    return static_cast<uint32_t>((vertices + one - 1) / one);
}

double seconds_of_kernels(plait_sim* sim) {
    size_t count = 0;
    check(plait_sim_stage_times(sim, nullptr, &count, 0));
    std::vector<plait_stage_time> stages(count);
    check(plait_sim_stage_times(sim, stages.data(), &count, 1));
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
        sum += stages[i].seconds;
    return sum;
}

// On a context that keeps the device's time, which costs a few percent: not for the wall.
double kernel_seconds(Contexts& profiled, const Scene& scene, const Method& method,
                      uint32_t copies) {
    constexpr uint32_t steps = 5;
    Stage stage(profiled.of(*method.model), scene, method, copies);
    for (uint32_t k = 1; k <= warm_up + steps; ++k) {
        if (k == warm_up + 1)
            seconds_of_kernels(stage.sim());
        stage.step_to(k / scene.rate);
        stage.wait();
    }
    return seconds_of_kernels(stage.sim()) / steps;
}

} // namespace

double Cost::ns_per_vertex() const {
    return 1e9 * wall / static_cast<double>(vertices);
}

double Cost::ms_per_frame() const {
    return 1e3 * wall / static_cast<double>(vertices) * 1e6 / (step * 60);
}

double Cost::strands_at_60_hz(uint32_t vertices_per_strand) const {
    return 1e3 / 60 / ms_per_frame() * 1e6 / vertices_per_strand;
}

Cost measure_cost(Contexts& contexts, Contexts& profiled, const Scene& scene, const Method& method,
                  const CostOptions& options) {
    const uint32_t copies = copies_for(scene, options.vertices);
    Stage stage(contexts.of(*method.model), scene, method, copies);
    Cost cost{stage.vertices(), options.runs, 0, 0, 1 / scene.rate};
    std::vector<double> times;
    for (uint32_t k = 1; k <= warm_up + options.runs; ++k) {
        const auto start = std::chrono::steady_clock::now();
        stage.step_to(k / scene.rate);
        stage.wait();
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (k > warm_up)
            times.push_back(spent.count());
    }
    const auto middle = times.begin() + static_cast<ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    cost.wall = *middle;
    if (options.kernel)
        cost.kernel = kernel_seconds(profiled, scene, method, copies);
    return cost;
}

} // namespace lab
