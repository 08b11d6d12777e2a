// plait-lab grid: what lies between strands.
#include "../commands.hpp"
#include "grid.hpp"

#include <cstdio>

namespace lab {

namespace {

struct Options {
    DeviceOptions device;
    CostOptions costs;
    std::string out = "out/lab";
};

Exit run(const Options& options) {
    Contexts contexts(options.device.backend, options.device.device);
    const grid::GridRun done = grid::run_grid(contexts, options.out, options.costs);
    std::fputs(grid::rows_text(done.rows).c_str(), stdout);
    std::printf("\n%s\n", done.figure.title.c_str());
    for (const Dot& dot : front_of(done.figure))
        std::printf("  %-24s %10.3g %10.4g ms\n", dot.name.c_str(), dot.error, dot.cost);
    for (const std::string& file : done.files)
        std::printf("wrote %s\n", file.c_str());
    return Exit::ok;
}

} // namespace

void add_grid(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("grid", "the grid between strands: its sums, its slots, their cost");
    command->add_option("--out", options->out, "folder of the figure")->capture_default_str();
    add_cost_options(*command, options->costs);
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
