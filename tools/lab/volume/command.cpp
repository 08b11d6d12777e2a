// plait-lab volume: ways of keeping hair's volume, side by side.
#include "commands.hpp"
#include "volume.hpp"

#include "common/file.hpp"

#include <cstdio>

namespace lab {

namespace {

using namespace volume;

struct Options {
    DeviceOptions device;
    VolumeOptions run;
    bool csv = false;
};

Exit run(const Options& options) {
    Contexts contexts(options.device.backend, options.device.device);
    const auto rows = measure_volume(contexts, options.run);
    std::fputs((options.csv ? volume_csv(rows) : volume_text(rows)).c_str(), stdout);
    const std::string path = options.run.out + "/volume";
    make_folder(options.run.out);
    write_text(volume_csv(rows), path + ".csv");
    write_text(volume_curves(rows), path + "_curves.csv");
    draw_volume(rows, options.run);
    return Exit::ok;
}

} // namespace

void add_volume(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "volume",
        "limp hair on a ball: what different methods keep of its volume, and what it costs");
    command
        ->add_option("--model", options->run.model,
                     "model or baseline that the hair is simulated by")
        ->capture_default_str()
        ->check(CLI::IsMember({"articulated", "chain", "cosserat", "rod"}));
    command->add_option("--strands", options->run.strands, "hairs")
        ->capture_default_str()
        ->check(CLI::Range(2u, 100000u));
    command->add_option("--seconds", options->run.seconds, "of hair left to itself")
        ->capture_default_str()
        ->check(CLI::Range(0.05, 600.0));
    command->add_option("--methods", options->run.methods, "some of them, by name; none beside")
        ->delimiter(',');
    command->add_option("--out", options->run.out, "folder for volume.csv and the figure")
        ->capture_default_str();
    command->add_flag("--csv", options->csv, "print CSV");
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
