#include "commands.hpp"
#include "common/json_reader.hpp"
#include "references/table.hpp"
#include "run/cost.hpp"
#include "scene/scene.hpp"
#include <cmath>
#include <cstdlib>

namespace lab {

void add_device_options(CLI::App& command, DeviceOptions& options) {
    command.add_option("--device", options.device,
                       "part of a device's or platform's name [the best]");
    command.add_option("--backend", options.backend, "opencl or reference [the best]");
    command.add_option_function<std::string>("--tables", set_table_folder,
                                             "folder of the reference tables [tests/data]");
}

void add_choice(CLI::App& command, Choice& choice) {
    command.add_option("--models", choice.models, "only these models and baselines")
        ->delimiter(',');
    command.add_option("--out", choice.out, "folder of what is found; a run goes on from there")
        ->capture_default_str();
    command.add_flag("--fresh", choice.fresh, "measure again what is there");
}

void add_scenes(CLI::App& command, Choice& choice) {
    command.add_option("--scenes", choice.scenes, "only of these scenes, say rod_fall,curls")
        ->delimiter(',');
}

void add_print(CLI::App& command, Print& print) {
    auto* json = command.add_flag("--json", print.json, "print JSON instead of tables");
    command.add_flag("--csv", print.csv, "print CSV instead of tables")->excludes(json);
}

void add_cost_options(CLI::App& command, CostOptions& costs) {
    command.add_option("--cost-vertices", costs.vertices, "vertices timed, at least")
        ->capture_default_str();
    command.add_option("--cost-runs", costs.runs, "steps timed; three, where they are long")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
}

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

void override_one(Json& overrides, const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw CLI::ValidationError("--set", "\"" + text + "\" is not KEY=VALUE");
    set_path(overrides, text.substr(0, equals), parsed(text.substr(equals + 1)));
}

} // namespace

void add_overrides(CLI::App& command, Json& overrides) {
    command
        .add_option_function<std::vector<std::string>>(
            "--set",
            [&overrides](const std::vector<std::string>& all) {
                for (const std::string& one : all)
                    override_one(overrides, one);
            },
            "KEY=VALUE of the scene, say material.gamma=50; may be repeated")
        ->take_all();
}

} // namespace lab
