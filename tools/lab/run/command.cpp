// plait-lab run: one scene, one method, everything about it.
#include "command.hpp"
#include "report.hpp"

#include "common/json_reader.hpp"
#include "common/progress.hpp"

#include <cmath>
#include <cstdlib>

namespace lab {

namespace {

// JSON, or a number as C writes it (.5, which JSON does not allow), or a word.
Json parsed(const std::string& text) {
    const Json value = Json::parse(text, nullptr, false);
    if (!value.is_discarded())
        return value;
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    const bool whole = end != text.c_str() && *end == 0;
    return whole && std::isfinite(number) ? Json(number) : Json(text);
}

Json overrides_of(const RunOptions& options) {
    Json overrides = Json::object();
    for (const auto& [key, value] : options.overrides)
        set_path(overrides, key, parsed(value));
    return overrides;
}

} // namespace

Exit run(const Command<RunOptions>& command) {
    const RunOptions& options = command.run;
    const Scene scene = read_scene(options.scene, overrides_of(options));
    const std::string device = command.device.device.empty() ? scene.device : command.device.device;
    const std::string backend =
        command.device.backend.empty() ? scene.backend : command.device.backend;
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
    if (command.print.json)
        print_json(report);
    else
        print_report(report);
    return Exit::ok;
}

} // namespace lab
