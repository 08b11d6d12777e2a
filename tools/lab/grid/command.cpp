// plait-lab grid: what lies between strands.
#include "command.hpp"
#include "grid.hpp"

#include <cstdio>

namespace lab {

using namespace grid;

namespace {

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
Exit run_slots(const Command<GridOptions>& command) {
    SlotOptions slots = command.run.slots;
    check_slots(slots);
    if (!command.run.positions.empty())
        slots.positions = read_positions(command.run.positions, slots.edge_count);
    Contexts contexts(command.device.backend, command.device.device);
    Device device(contexts.device());
    std::fputs(rows_text(slot_rows(device, slots)).c_str(), stdout);
    return Exit::ok;
}

} // namespace

Exit run(const Command<grid::GridOptions>& command) {
    const GridOptions& options = command.run;
    if (!options.positions.empty() || options.slots != SlotOptions{})
        return run_slots(command);
    Contexts contexts(command.device.backend, command.device.device);
    const GridRun done = run_grid(contexts, options.out, options.costs);
    std::fputs(rows_text(done.rows).c_str(), stdout);
    std::printf("\n%s\n", done.figure.title.c_str());
    for (const Dot& dot : front_of(done.figure))
        std::printf("  %-24s %10.3g %10.4g ms\n", dot.name.c_str(), dot.error, dot.cost);
    for (const std::string& file : done.files)
        std::printf("wrote %s\n", file.c_str());
    return Exit::ok;
}

} // namespace lab
