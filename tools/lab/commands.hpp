// The commands of plait-lab. Each is a file: it declares its options and runs them.
#pragma once

#include "choice.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace lab {

// What the chosen command does, once the command line is read.
using Command = std::function<Exit()>;

void add_run(CLI::App& app, Command& chosen);
void add_accuracy(CLI::App& app, Command& chosen);
void add_chart(CLI::App& app, Command& chosen);
void add_features(CLI::App& app, Command& chosen);
void add_all(CLI::App& app, Command& chosen);
void add_follows(CLI::App& app, Command& chosen);
void add_levels(CLI::App& app, Command& chosen);
void add_grid(CLI::App& app, Command& chosen);
void add_stability(CLI::App& app, Command& chosen);
void add_volume(CLI::App& app, Command& chosen);

// Options that several commands have.
struct DeviceOptions {
    std::string device, backend, tables;
};
void add_device_options(CLI::App& command, DeviceOptions& options);

void add_choice(CLI::App& command, Choice& choice); // but the scenes
void add_scenes(CLI::App& command, Choice& choice);

// Printed instead of tables for people, if either.
struct Print {
    bool json = false, csv = false;
};
void add_print(CLI::App& command, Print& print);

// A command that measures a table: what is to be run, on which device, printed how.
template <typename Run> struct TableCommand {
    Run run;
    DeviceOptions device;
    Print print;

    Run on_device() const {
        Run chosen = run;
        chosen.device = device.device;
        chosen.backend = device.backend;
        return chosen;
    }
};
template <typename Run> void add_table_options(CLI::App& app, TableCommand<Run>& command) {
    add_choice(app, command.run);
    add_scenes(app, command.run);
    add_print(app, command.print);
    add_device_options(app, command.device);
}

struct CostOptions;
void add_cost_options(CLI::App& command, CostOptions& costs);

// "key=value" into an object that overrides a scene; the value is JSON, a number, or a word.
void add_overrides(CLI::App& command, Json& overrides);

} // namespace lab
