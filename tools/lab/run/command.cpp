// plait-lab run: one scene, one method, everything about it.
#include "commands.hpp"
#include "report.hpp"

#include "common/json_reader.hpp"
#include "common/progress.hpp"

#include <iostream>

namespace lab {

namespace {

struct RunOptions {
    std::string scene;
    Json overrides = Json::object();
    DeviceOptions device;
    bool json = false, cost = true;
    CostOptions costs;
};

Exit run(const RunOptions& options) {
    const Scene scene = read_scene(options.scene, options.overrides);
    const std::string device = options.device.device.empty() ? scene.device : options.device.device;
    const std::string backend =
        options.device.backend.empty() ? scene.backend : options.device.backend;
    Contexts contexts(backend, device), profiled(backend, device, true);
    const Method method = method_of(scene);
    Progress progress("running", 1000);
    const Recording recording = record(contexts, scene, method, [&](double share) {
        progress.update(static_cast<uint32_t>(1000 * share));
    });
    if (recording.frames.empty())
        throw Failure("interrupted before the first frame: there is nothing to measure", ended());
    RunReport report{
        scene, method, contexts.device(), recording, measure_all(scene, method, recording), {}};
    if (options.cost && !interrupted())
        report.cost = measure_cost(contexts, profiled, scene, method, options.costs);
    if (options.json)
        std::cout << to_json(report).dump(2) << '\n';
    else
        print_report(report);
    return Exit::ok;
}

// An option that is a key of the scene.
template <typename T>
void add_key(CLI::App& command, Json& keys, const char* key, const char* help) {
    command.add_option_function<T>(
        std::string("--") + key, [&keys, key](const T& value) { keys[key] = value; }, help);
}

} // namespace

void add_run(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "run one scene and measure it");
    command->add_option("scene", options->scene, "scene file; see tools/lab/docs/lab.md")
        ->required();
    add_key<std::string>(*command, options->overrides, "model",
                         ("tressfx, articulated, chain, cosserat, rod, ... [" +
                          default_model().label + ", the library's]")
                             .c_str());
    add_key<uint64_t>(*command, options->overrides, "substeps", "per step");
    add_key<uint64_t>(*command, options->overrides, "iterations", "of the solver, per substep");
    add_key<uint64_t>(*command, options->overrides, "bdf2", "0: backward Euler, 1: BDF2");
    add_overrides(*command, options->overrides);
    add_device_options(*command, options->device);
    command->add_flag("--json", options->json, "print JSON instead of tables");
    command->add_flag("!--no-cost", options->cost, "do not measure what it costs");
    add_cost_options(*command, options->costs);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
