// plait-lab grid: what lies between strands.
#include "commands.hpp"
#include "grid.hpp"

#include <cstdio>

namespace lab {

namespace {

using namespace grid;

struct Options {
    DeviceOptions device;
    CostOptions costs;
    std::string out = "out/lab";
    SlotOptions slots;
    std::string positions;

    bool chosen() const { return !positions.empty() || slots != SlotOptions{}; }
};

// What is on the command line may ask for more than there is room for.
void check_slots(const SlotOptions& slots) {
    constexpr uint64_t most = uint64_t{1} << 26;
    const uint64_t n = slots.edge_count, all = n * n * n * slots.capacity;
    if (all > most)
        throw Failure("--edge-count " + std::to_string(n) + " and --capacity " +
                      std::to_string(slots.capacity) + " make " + std::to_string(all) +
                      " slots, more than " + std::to_string(most));
}

// Of what is asked for alone: row 24.
Exit run_slots(Options options) {
    check_slots(options.slots);
    if (!options.positions.empty())
        options.slots.positions = read_positions(options.positions, options.slots.edge_count);
    Contexts contexts(options.device.backend, options.device.device);
    Device device(contexts.device());
    std::fputs(rows_text(slot_rows(device, options.slots)).c_str(), stdout);
    return Exit::ok;
}

Exit run(const Options& options) {
    if (options.chosen())
        return run_slots(options);
    Contexts contexts(options.device.backend, options.device.device);
    const GridRun done = run_grid(contexts, options.out, options.costs);
    std::fputs(rows_text(done.rows).c_str(), stdout);
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
    auto* counts = command
                       ->add_option("--counts", options->slots.counts,
                                    "row 24 alone: numbers of vertices [C/4, C, 4 C]")
                       ->delimiter(',')
                       ->check(CLI::Range(1u, 1000000u));
    command->add_option("--capacity", options->slots.capacity, "... C, slots of a voxel")
        ->capture_default_str()
        ->check(CLI::Range(1u, 65536u));
    command->add_option("--edge-count", options->slots.edge_count, "... voxels along an edge")
        ->capture_default_str()
        ->check(CLI::Range(1u, 64u));
    command
        ->add_option("--positions", options->positions,
                     "... file of the vertices, \"x, y, z\" a line [drawn evenly]")
        ->excludes(counts);
    add_cost_options(*command, options->costs);
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
