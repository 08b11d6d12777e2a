// plait-lab levels: levels of detail, error over cost.
#include "commands.hpp"
#include "levels.hpp"

#include "common/file.hpp"

#include <cstdio>

namespace lab {

namespace {

using namespace levels;

struct Options {
    DeviceOptions device;
    LevelsOptions run;
    bool csv = false;
};

Exit run(const Options& options) {
    Contexts contexts(options.device.backend, options.device.device);
    const auto rows = measure_levels(contexts, options.run);
    std::fputs((options.csv ? levels_csv(rows) : levels_text(rows)).c_str(), stdout);
    make_folder(options.run.out);
    write_text(levels_csv(rows), options.run.out + "/levels.csv");
    draw_levels(rows, options.run);
    return Exit::ok;
}

} // namespace

void add_levels(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "levels", "levels of detail: what each costs, and how far its hair is from the truth");
    command->add_option("--styles", options->run.styles, "of long, curly and short")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--strands", options->run.strands, "hairs")
        ->capture_default_str()
        ->check(CLI::Range(64u, 1000000u));
    command->add_option("--seconds", options->run.seconds, "of each motion")
        ->capture_default_str()
        ->check(CLI::Range(0.05, 600.0));
    command->add_option("--out", options->run.out, "folder for levels.csv and the figure")
        ->capture_default_str();
    command->add_flag("--csv", options->csv, "print CSV");
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
