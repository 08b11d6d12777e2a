#include "command_line.hpp"

#include "accuracy/accuracy.hpp"
#include "chart/chart.hpp"
#include "command.hpp"
#include "features/features.hpp"
#include "follows/follows.hpp"
#include "grid/grid.hpp"
#include "levels/levels.hpp"
#include "page/page.hpp"
#include "references/table.hpp"
#include "run/report.hpp"
#include "stability/search.hpp"
#include "volume/volume.hpp"

#include "common/devices.hpp"

// No other file includes CLI11: a compiler takes ten seconds for it.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <iomanip>
#include <sstream>

namespace lab {

namespace {

constexpr const char* footer =
    "Scenes are JSON: assets/lab has some, tools/lab/docs/lab.md says how to write one.\n"
    "Exit codes: 0 done, whatever was measured; 1 the input is at fault, 2 the device is,\n"
    "130 Ctrl-C ended it early.";

using Chosen = std::function<Exit()>;

// A command whose options are read into `options` and that runs, if it is the one that is asked for.
template <typename Options>
CLI::App* add_command(CLI::App& app, Chosen& chosen, const char* name, const char* help,
                      std::shared_ptr<Command<Options>> options) {
    CLI::App* command = app.add_subcommand(name, help);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
    return command;
}

// ---- options that several commands have -----------------------------------------------------

void add_device(CLI::App* command, DeviceOptions& options) {
    command->add_option("--device", options.device,
                        "part of a device's or platform's name [the best]");
    command->add_option("--backend", options.backend, "opencl or reference [the best]");
    command->add_option_function<std::string>("--tables", set_table_folder,
                                              "folder of the reference tables [tests/data]");
}

void add_out(CLI::App* command, std::string& out, const char* help) {
    command->add_option("--out", out, help)->capture_default_str();
}

void add_seconds(CLI::App* command, double& seconds, const char* help) {
    command->add_option("--seconds", seconds, help)
        ->capture_default_str()
        ->check(CLI::Range(0.05, 600.0));
}

void add_strands(CLI::App* command, uint32_t& strands, uint32_t least, uint32_t most) {
    command->add_option("--strands", strands, "hairs")
        ->capture_default_str()
        ->check(CLI::Range(least, most));
}

void add_choice(CLI::App* command, Choice& choice) {
    command->add_option("--models", choice.models, "only these models and baselines")
        ->delimiter(',');
    add_out(command, choice.out, "folder of what is found; a run goes on from there");
    command->add_flag("--fresh", choice.fresh, "measure again what is there");
}

void add_print(CLI::App* command, Print& print) {
    auto* json = command->add_flag("--json", print.json, "print JSON instead of tables");
    command->add_flag("--csv", print.csv, "print CSV instead of tables")->excludes(json);
}

void add_csv(CLI::App* command, Print& print) {
    command->add_flag("--csv", print.csv, "print CSV");
}

void add_costs(CLI::App* command, CostOptions& costs) {
    command->add_option("--cost-vertices", costs.vertices, "vertices timed, at least")
        ->capture_default_str();
    command->add_option("--cost-runs", costs.runs, "steps timed; three, where they are long")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
}

// Of a command that measures a table.
template <typename Options> void add_table(CLI::App* command, Command<Options>& options) {
    add_choice(command, options.run);
    command->add_option("--scenes", options.run.scenes, "only of these scenes, say rod_fall,curls")
        ->delimiter(',');
    add_print(command, options.print);
    add_device(command, options.device);
}

// ---- the commands ---------------------------------------------------------------------------

// An option that is a key of the scene.
template <typename T>
void add_key(CLI::App* command, RunOptions& options, const char* key, const std::string& help) {
    command->add_option_function<T>(
        std::string("--") + key,
        [&options, key](const T& value) {
            std::ostringstream text;
            if constexpr (std::is_same_v<T, std::string>)
                text << std::quoted(value); // a word, whatever JSON would take it for
            else
                text << value;
            options.overrides.emplace_back(key, text.str());
        },
        help);
}

// "key=value" of the scene.
void add_overrides(CLI::App* command, RunOptions& options) {
    command
        ->add_option_function<std::vector<std::string>>(
            "--set",
            [&options](const std::vector<std::string>& all) {
                for (const std::string& text : all) {
                    const size_t equals = text.find('=');
                    if (equals == std::string::npos || equals == 0)
                        throw CLI::ValidationError("--set", "\"" + text + "\" is not KEY=VALUE");
                    options.overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
                }
            },
            "KEY=VALUE of the scene, say material.gamma=50; may be repeated")
        ->take_all();
}

void add_run(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<RunOptions>>();
    RunOptions& run = options->run;
    auto* command = add_command(app, chosen, "run", "run one scene and measure it", options);
    command->add_option("scene", run.scene, "scene file; see tools/lab/docs/lab.md")->required();
    add_key<std::string>(command, run, "model",
                         "tressfx, articulated, chain, cosserat, rod, ... [" +
                             default_model().label + ", the library's]");
    add_key<int64_t>(command, run, "substeps", "per step");
    add_key<int64_t>(command, run, "iterations", "of the solver, per substep");
    add_key<int64_t>(command, run, "bdf2", "0: backward Euler, 1: BDF2");
    add_overrides(command, run);
    add_device(command, options->device);
    command->add_flag("--json", options->print.json, "print JSON instead of tables");
    command->add_flag("!--no-cost", run.cost, "do not measure what it costs");
    add_costs(command, run.costs);
}

void add_accuracy(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<AccuracyOptions>>();
    AccuracyOptions& run = options->run;
    auto* command =
        add_command(app, chosen, "accuracy", "every row of the accuracy table", options);
    command->add_option("--rows", run.rows, "only these, say 1,4,18")->delimiter(',');
    command->add_option("--table", run.table, "the rows [assets/lab/accuracy.json]");
    command->add_flag("--baselines", run.baselines, "the baselines, too");
    command->add_flag("--all-settings", run.all_settings,
                      "all settings of a model, not only for real time and for quality");
    add_table(command, *options);
}

void add_chart(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<ChartOptions>>();
    ChartOptions& run = options->run;
    auto* command =
        add_command(app, chosen, "chart", "cost against accuracy, drawn by gnuplot", options);
    command->add_option("--families", run.families, "only these figures")->delimiter(',');
    command->add_option("--table", run.table, "the figures [assets/lab/charts.json]");
    add_table(command, *options);
    add_costs(command, run.costs);
}

void add_features(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<FeatureOptions>>();
    FeatureOptions& run = options->run;
    auto* command =
        add_command(app, chosen, "features", "what each feature costs, and does", options);
    command->add_option("--features", run.features, "only these")->delimiter(',');
    command->add_option("--table", run.table, "the features [assets/lab/features.json]");
    add_table(command, *options);
    add_costs(command, run.costs);
}

void add_follows(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<follows::FollowOptions>>();
    follows::FollowOptions& run = options->run;
    auto* command = add_command(
        app, chosen, "follows",
        "hair that follows some guides, against all of it simulated: cost and shape", options);
    command->add_option("--style", run.style, "long, curly or short")->capture_default_str();
    add_strands(command, run.strands, 2, 1000000);
    command->add_option("--guides", run.guides, "of these so many are simulated")
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--lesson", run.lesson,
                     "seconds of a head that shakes, which weights are learnt from; 0: none are")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 600.0));
    add_seconds(command, run.seconds, "of a head that turns and nods");
    add_out(command, run.out, "folder for follows.csv and the figure");
    add_csv(command, options->print);
    add_device(command, options->device);
}

void add_levels(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<levels::LevelsOptions>>();
    levels::LevelsOptions& run = options->run;
    auto* command = add_command(
        app, chosen, "levels",
        "levels of detail: what each costs, and how far its hair is from the truth", options);
    command->add_option("--styles", run.styles, "of long, curly and short")
        ->delimiter(',')
        ->capture_default_str();
    add_strands(command, run.strands, 64, 1000000);
    add_seconds(command, run.seconds, "of each motion");
    command->add_flag(
        "--transfer", run.transfer,
        "run sixteen motions, and say how well a level's error is told in those that it was "
        "not measured in");
    add_out(command, run.out, "folder for levels.csv, transfer.csv and the figure");
    add_csv(command, options->print);
    add_device(command, options->device);
}

void add_all(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<AllOptions>>();
    AllOptions& run = options->run;
    auto* command =
        add_command(app, chosen, "all", "accuracy, chart, features and stability", options);
    add_choice(command, run.choice);
    command->add_option("--write", run.write, "also write a page of results into this folder");
    add_costs(command, run.charts.costs);
    add_device(command, options->device);
}

void add_grid(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<grid::GridOptions>>();
    grid::GridOptions& run = options->run;
    auto* command = add_command(
        app, chosen, "grid", "the grid between strands: its sums, its slots, their cost", options);
    add_out(command, run.out, "folder of the figure");
    auto* counts = command
                       ->add_option("--counts", run.slots.counts,
                                    "row 24 alone: numbers of vertices [C/4, C, 4 C]")
                       ->delimiter(',')
                       ->check(CLI::Range(1u, 1000000u));
    command->add_option("--capacity", run.slots.capacity, "... C, slots of a voxel")
        ->capture_default_str()
        ->check(CLI::Range(1u, 65536u));
    command->add_option("--edge-count", run.slots.edge_count, "... voxels along an edge")
        ->capture_default_str()
        ->check(CLI::Range(1u, 64u));
    command
        ->add_option("--positions", run.positions,
                     "... file of the vertices, \"x, y, z\" a line [drawn evenly]")
        ->excludes(counts);
    add_costs(command, run.costs);
    add_device(command, options->device);
}

void add_stability(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<stability::SweepOptions>>();
    stability::SweepOptions& run = options->run;
    auto* command =
        add_command(app, chosen, "stability", "shake models and baselines till they fail", options);
    command
        ->add_option("--models", run.models,
                     "models and baselines [tressfx,articulated,chain,cosserat,rod]")
        ->delimiter(',');
    command
        ->add_option("--scenes", run.scenes,
                     "of these only: " + CLI::detail::join(stability::scene_names(), ", "))
        ->delimiter(',');
    add_out(command, run.out, "folder of what is found; a run goes on from there");
    add_device(command, options->device);
    command->add_flag("--full", run.full, "all rates, segments, gammas and settings: hours");
    command->add_flag("--fresh", run.fresh, "forget what an earlier run found");
    add_print(command, options->print);
    command->add_flag("!--no-pictures", run.pictures, "do not call gnuplot");
}

void add_volume(CLI::App& app, Chosen& chosen) {
    auto options = std::make_shared<Command<volume::VolumeOptions>>();
    volume::VolumeOptions& run = options->run;
    auto* command = add_command(
        app, chosen, "volume",
        "limp hair on a ball: what different methods keep of its volume, and what it costs",
        options);
    command->add_option("--model", run.model, "model or baseline that the hair is simulated by")
        ->capture_default_str()
        ->check(CLI::IsMember({"articulated", "chain", "cosserat", "rod"}));
    add_strands(command, run.strands, 2, 100000);
    add_seconds(command, run.seconds, "of hair left to itself");
    command->add_option("--methods", run.methods, "some of them, by name; none beside")
        ->delimiter(',');
    add_out(command, run.out, "folder for volume.csv and the figure");
    add_csv(command, options->print);
    add_device(command, options->device);
}

Exit list_devices() {
    print_devices();
    return Exit::ok;
}

} // namespace

Chosen read_command_line(int argc, char** argv) {
    CLI::App app("Measures models and baselines on scenes with known answers.", "plait-lab");
    Chosen chosen;
    bool list = false;
    app.footer(footer);
    app.add_flag("--list-devices", list, "list the devices and stop");
    app.require_subcommand(0, 1);
    for (auto* add : {add_run, add_accuracy, add_chart, add_features, add_follows, add_levels,
                      add_all, add_grid, add_stability, add_volume})
        add(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const Exit exit = app.exit(error) == 0 ? Exit::ok : Exit::user_error;
        return [exit] { return exit; };
    }
    if (list)
        return list_devices;
    if (!chosen) {
        std::fputs(app.help().c_str(), stdout);
        return [] { return Exit::ok; };
    }
    return chosen;
}

} // namespace lab
