// plait-lab: scenes with known answers, run by models and baselines and measured.
#include "commands.hpp"

#include "common/devices.hpp"
#include "common/progress.hpp"

#include <cstdio>

namespace lab {

namespace {

constexpr const char* footer =
    "Scenes are JSON: assets/lab has some, tools/lab/docs/lab.md says how to write one.\n"
    "Exit codes: 0 done, whatever was measured; 1 the input is at fault, 2 the device is,\n"
    "130 Ctrl-C ended it early.";

// A command that was interrupted has done what it could.
Exit exit_after(Exit command) {
    return command == Exit::ok ? ended() : command;
}

int main_of(int argc, char** argv) {
    CLI::App app("Measures models and baselines on scenes with known answers.", "plait-lab");
    Command chosen;
    bool list_devices = false;
    app.footer(footer);
    app.add_flag("--list-devices", list_devices, "list the devices and stop");
    app.require_subcommand(0, 1);
    add_run(app, chosen);
    add_accuracy(app, chosen);
    add_chart(app, chosen);
    add_features(app, chosen);
    add_follows(app, chosen);
    add_levels(app, chosen);
    add_all(app, chosen);
    add_grid(app, chosen);
    add_stability(app, chosen);
    add_volume(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(Exit::user_error);
    }
    watch_for_interrupt();
    if (list_devices)
        print_devices();
    else if (chosen)
        return static_cast<int>(exit_after(chosen()));
    else
        std::fputs(app.help().c_str(), stdout);
    return 0;
}

} // namespace

} // namespace lab

int main(int argc, char** argv) {
    try {
        return lab::main_of(argc, argv);
    } catch (const lab::Failure& failure) {
        std::fprintf(stderr, "plait-lab: %s\n", failure.what());
        return static_cast<int>(failure.exit);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "plait-lab: %s\n", failure.what());
        return 1;
    }
}
