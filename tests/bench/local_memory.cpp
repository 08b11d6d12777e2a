// The solve over strands while each work-group holds local memory that it does not use: the more, the
// fewer strands a GPU has at a time, and the more of its caches each has for private memory.
#include "bench.hpp"
#include "sim.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace bench {
namespace {

constexpr uint32_t settling = 30; // frames before those that count
constexpr int rounds = 15;

// Hair whose solve was built so, or why it was not.
struct Column {
    uint32_t bytes;
    Context context;
    std::optional<Character> character;
    std::string refused;
};

// Seconds of the solve in a frame.
double frame(Character& character) {
    character.aim();
    check(plait_sim_step(character.sim(), 1.0 / 60 + 1e-9));
    return take_stage_sums(character.sim())["articulated"].seconds;
}

Column open_column(const plait_device_info& device, plait_groom* groom, uint32_t bytes) {
    // The kernel as it is, but that cl/base/idle_local.clh finds how much to hold.
    const std::string text = "#define PLAIT_IDLE_LOCAL " + std::to_string(bytes) +
                             "\n#include \"strands/articulated.cl\"\n";
    const plait_stage_source source{"articulated", text.c_str(), "idle_local.cl"};
    Column column{bytes, {}, {}, ""};
    if (bytes % 4 != 0 || bytes > device.local_memory_bytes) { // which drivers end a program for
        column.refused = "not a multiple of 4 up to the device's local memory, " +
                         std::to_string(device.local_memory_bytes);
        return column;
    }
    try {
        const std::span<const plait_stage_source> sources(&source, bytes > 0 ? 1 : 0);
        column.context = make_context(device, {.profile = true, .sources = sources});
        column.character.emplace(column.context.get(), groom, plait::SimDesc(),
                                 Bodies{Shape::capsules});
        frame(*column.character); // builds for this many vertices
    } catch (const std::exception& error) {
        column.refused = error.what();
        column.character.reset();
    }
    return column;
}

// Median nanoseconds per vertex, 0 where a column was refused. Amounts take turns, so that what disturbs
// one disturbs all; each goes through the same frames.
std::vector<double> measure(std::vector<Column>& columns, uint32_t strands) {
    std::vector<std::vector<double>> seconds(columns.size());
    for (uint32_t round = 0; round < settling + rounds; ++round)
        for (size_t i = 0; i < columns.size(); ++i) {
            const double one = columns[i].character ? frame(*columns[i].character) : 0;
            if (round >= settling)
                seconds[i].push_back(one);
        }
    std::vector<double> row;
    for (std::vector<double>& times : seconds) {
        std::ranges::nth_element(times, times.begin() + rounds / 2);
        row.push_back(1e9 * times[rounds / 2] / (static_cast<double>(strands) * model_vertices));
    }
    return row;
}

void sweep(const plait_device_info& info, const Options& options) {
    const Groom groom = long_hair(options.strands);
    std::vector<Column> columns;
    for (const uint32_t bytes : options.local_memory)
        columns.push_back(open_column(info, groom.get(), bytes));
    std::printf("\n%s (%s): ns per vertex and frame of articulated, %u strands of %u vertices with "
                "14 capsules, %u a work-item, by bytes of idle local memory a work-group\n\n|",
                info.name, info.platform, options.strands, model_vertices, info.lanes);
    for (const Column& column : columns)
        std::printf(" %u |", column.bytes);
    std::printf("\n|");
    for (size_t i = 0; i < columns.size(); ++i)
        std::printf("---:|");
    std::printf("\n|");
    for (const double ns : measure(columns, options.strands))
        ns > 0 ? std::printf(" %.3f |", ns) : std::printf(" |");
    std::printf("\n");
    for (const Column& column : columns)
        if (!column.character)
            std::printf("%u: %s\n", column.bytes, column.refused.c_str());
}

} // namespace

void sweep_local_memory(const Results& results) {
    for (const auto& [index, device] : results.devices)
        sweep(device.device, results.options);
}

} // namespace bench
