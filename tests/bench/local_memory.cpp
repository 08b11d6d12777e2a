// The solves over strands while each work-group holds local memory that it does not use: the more, the
// fewer strands a GPU has at a time, and the more of its caches each has for private memory.
#include "bench.hpp"
#include "rig.hpp"

#include <algorithm>
#include <cstdio>

namespace bench {
namespace {

constexpr plait_stage solves[] = {PLAIT_STAGE_articulated};
constexpr int rounds = 15;

// A device that was opened so, or why it was not.
struct Column {
    uint32_t bytes;
    std::unique_ptr<Device> device;
    std::string refused;
};

std::vector<Column> open_columns(uint32_t index, const std::vector<uint32_t>& list) {
    std::vector<Column> columns;
    for (const uint32_t bytes : list)
        try {
            columns.push_back(
                {bytes,
                 std::make_unique<Device>(index, std::span<const plait_stage_source>{}, bytes),
                 ""});
        } catch (const std::exception& error) {
            columns.push_back({bytes, nullptr, error.what()});
        }
    return columns;
}

// Median nanoseconds per vertex, 0 where a column was refused. Amounts take turns, so that what disturbs
// one disturbs all; each has buffers of its own, that go through the same steps.
std::vector<double> measure(std::vector<Column>& columns, plait_stage stage, const Shape& shape) {
    std::vector<std::unique_ptr<Rig>> rigs;
    for (Column& column : columns)
        rigs.push_back(column.device ? std::make_unique<Rig>(*column.device, stage, shape)
                                     : nullptr);
    std::vector<std::vector<double>> seconds(columns.size());
    for (int round = 0; round < rounds; ++round)
        for (size_t i = 0; i < rigs.size(); ++i)
            seconds[i].push_back(rigs[i] ? rigs[i]->run() : 0);
    std::vector<double> row;
    for (std::vector<double>& times : seconds) {
        std::ranges::nth_element(times, times.begin() + rounds / 2);
        row.push_back(1e9 * times[rounds / 2] / static_cast<double>(shape.total()));
    }
    return row;
}

void sweep(uint32_t index, const plait_device_info& info, const Options& options) {
    const Shape shape{options.strands, options.vertices, info.tile};
    std::printf(
        "\n%s (%s): ns per vertex, %u strands of %u vertices, %u a work-item, by bytes of idle "
        "local memory a work-group\n\n| solve |",
        info.name, info.platform, shape.strands, shape.vertices, info.lanes);
    for (const uint32_t bytes : options.local_memory)
        std::printf(" %u |", bytes);
    std::printf("\n|---|");
    for (size_t i = 0; i < options.local_memory.size(); ++i)
        std::printf("---:|");
    std::vector<Column> columns = open_columns(index, options.local_memory);
    for (const plait_stage stage : solves) {
        std::printf("\n| %s |", plait_stage_describe(stage)->name);
        for (const double ns : measure(columns, stage, shape))
            ns > 0 ? std::printf(" %.3f |", ns) : std::printf(" |");
        std::fflush(stdout);
    }
    std::printf("\n");
    for (const Column& column : columns)
        if (!column.device)
            std::printf("%u: %s\n", column.bytes, column.refused.c_str());
}

} // namespace

void sweep_local_memory(const Results& results) {
    for (const auto& [index, device] : results.devices)
        sweep(index, device.device, results.options);
}

} // namespace bench
