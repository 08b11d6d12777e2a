#include "cost.hpp"

#include <plait/plait_profile.h>

#include <algorithm>
#include <chrono>

namespace lab {

namespace {

uint32_t copies_for(const Scene& scene, uint64_t vertices) {
    uint64_t one = 0;
    for (const Strand& strand : scene.strands)
        one += strand.segments + 1;
    one = std::max<uint64_t>(one, 1);
    return static_cast<uint32_t>((vertices + one - 1) / one);
}

double seconds_of_kernels(plait_sim* sim) {
    size_t count = 0;
    check(plait_sim_get_stage_times(sim, nullptr, &count, 0));
    std::vector<plait_stage_time> stages(count);
    check(plait_sim_get_stage_times(sim, stages.data(), &count, 1));
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
        sum += stages[i].seconds;
    return sum;
}

// Steps a stage from its start: a little to warm up, then as the options say.
class Stepper {
  public:
    Stepper(Stage& stage, const Scene& scene) : stage_(stage), scene_(scene) {}

    double step() { // s it took
        const auto start = std::chrono::steady_clock::now();
        stage_.step_to(++steps_ / scene_.rate);
        stage_.wait();
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        return spent.count();
    }
    void warm_up() {
        for (double spent = 0; steps_ < 3 && spent < 0.2;)
            spent += step();
    }
    std::vector<double> time(uint32_t runs, double seconds) {
        std::vector<double> times;
        for (double spent = 0; times.size() < runs && (times.size() < 3 || spent < seconds);) {
            times.push_back(step());
            spent += times.back();
        }
        return times;
    }

  private:
    Stage& stage_;
    const Scene& scene_;
    uint32_t steps_ = 0;
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// On a context that keeps the device's time, which costs a few percent: not for the wall.
double kernel_seconds(Contexts& profiled, const Scene& scene, const Method& method, uint32_t copies,
                      const CostOptions& options) {
    Stage stage(profiled.of(*method.model), scene, method, copies);
    Stepper stepper(stage, scene);
    stepper.step(); // may compile
    stepper.warm_up();
    seconds_of_kernels(stage.sim());
    const auto steps = stepper.time(std::min(options.runs, 5u), 0.25 * options.seconds);
    return seconds_of_kernels(stage.sim()) / static_cast<double>(steps.size());
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
    Stepper stepper(stage, scene);
    Cost cost{stage.vertices(), 0, stepper.step(), 0, 1 / scene.rate};
    if (cost.ms_per_frame() > options.dearest) { // or it was the compiler
        cost.wall = std::min(cost.wall, stepper.step());
        if (cost.ms_per_frame() > options.dearest)
            return cost;
    }
    stepper.warm_up();
    const auto times = stepper.time(options.runs, options.seconds);
    cost.runs = static_cast<uint32_t>(times.size());
    cost.wall = median(times);
    if (options.kernel)
        cost.kernel = kernel_seconds(profiled, scene, method, copies, options);
    return cost;
}

} // namespace lab
