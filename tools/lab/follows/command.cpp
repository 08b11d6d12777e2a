// plait-lab follows: hair of which some is simulated, against all of it.
#include "commands.hpp"
#include "follows.hpp"

#include "common/file.hpp"

#include <cstdio>

namespace lab {

namespace {

using namespace follows;

struct Options {
    DeviceOptions device;
    FollowOptions run;
    bool csv = false;
};

Exit run(const Options& options) {
    Contexts contexts(options.device.backend, options.device.device);
    const auto rows = measure_follows(contexts, options.run);
    std::fputs((options.csv ? follows_csv(rows) : follows_text(rows)).c_str(), stdout);
    const std::string path = options.run.out + "/follows";
    make_folder(options.run.out);
    write_text(follows_csv(rows), path + ".csv");
    write_text(follows_curves(rows), path + "_curves.csv");
    draw_follows(rows, options.run);
    return Exit::ok;
}

} // namespace

void add_follows(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "follows", "hair that follows some guides, against all of it simulated: cost and shape");
    command->add_option("--style", options->run.style, "long, curly or short")
        ->capture_default_str();
    command->add_option("--strands", options->run.strands, "hairs")
        ->capture_default_str()
        ->check(CLI::Range(2u, 1000000u));
    command->add_option("--guides", options->run.guides, "of these so many are simulated")
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--lesson", options->run.lesson,
                     "seconds of a head that shakes, which weights are learnt from; 0: none are")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 600.0));
    command->add_option("--seconds", options->run.seconds, "of a head that turns and nods")
        ->capture_default_str()
        ->check(CLI::Range(0.05, 600.0));
    command->add_option("--out", options->run.out, "folder for follows.csv and the figure")
        ->capture_default_str();
    command->add_flag("--csv", options->csv, "print CSV");
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
