// plait-bench [options] [Google Benchmark's options]: measures.
// plait-bench compare OLD.json NEW.json: says what has changed.
#include "bench.hpp"
#include "compare.hpp"
#include "device.hpp"
#include "json_files.hpp"
#include "page.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string_view>

namespace bench {
namespace {

constexpr char usage[] =
    "plait-bench [options] [Google Benchmark's options]\n"
    "  --strands=N     strands of the rows of features, 10 to 1000000 (10000)\n"
    "  --vertices=V    vertices per strand of the rows of the thesis's table, 2 to 256 (32)\n"
    "  --write=FOLDER  write bench-<device>.md there\n"
    "  --csv=FOLDER    write bench-<device>.csv there\n"
    "  --json=FOLDER   write bench-<device>.json there, for compare\n"
    "  --local-memory=0,16384,...  instead of the rows: the solve over strands while each\n"
    "                  work-group holds so many bytes of local memory that it does not use\n"
    "plait-bench compare OLD.json NEW.json [--least=PERCENT]\n"
    "  prints every row of both runs, and which became faster or slower: where no repetition\n"
    "  of one run is within the other's, and the medians are PERCENT (5) apart at least. That\n"
    "  takes three repetitions or more: --benchmark_repetitions=5\n"
    "The rest goes to Google Benchmark, such as --benchmark_filter=feature/wind, --help.\n";

uint32_t number(std::string_view argument, std::string_view value, uint32_t low, uint32_t high) {
    uint32_t parsed = 0;
    const auto end = std::from_chars(value.data(), value.data() + value.size(), parsed);
    if (end.ec != std::errc() || end.ptr != value.data() + value.size() || parsed < low ||
        parsed > high)
        throw std::runtime_error(std::string(argument) + ": not a number from " +
                                 std::to_string(low) + " to " + std::to_string(high));
    return parsed;
}

// Whether a device has so much, it says itself.
std::vector<uint32_t> numbers(std::string_view argument, std::string_view values) {
    std::vector<uint32_t> list;
    while (true) {
        const size_t end = std::min(values.find(','), values.size());
        list.push_back(number(argument, values.substr(0, end), 0, 1u << 30));
        if (end == values.size())
            return list;
        values.remove_prefix(end + 1);
    }
}

// Takes plait-bench's own options out of the arguments.
Options take_options(int& argc, char** argv) {
    Options options;
    const auto ours = [&](std::string_view argument) {
        const std::string_view value =
            argument.substr(std::min(argument.find('=') + 1, argument.size()));
        if (argument.starts_with("--strands="))
            options.strands = number(argument, value, 10, 1000000);
        else if (argument.starts_with("--vertices="))
            options.vertices = number(argument, value, 2, PLAIT_MAX_VERTICES);
        else if (argument.starts_with("--write="))
            options.write = value;
        else if (argument.starts_with("--csv="))
            options.csv = value;
        else if (argument.starts_with("--json="))
            options.json = value;
        else if (argument.starts_with("--local-memory="))
            options.local_memory = numbers(argument, value);
        else
            return false;
        return true;
    };
    argc = static_cast<int>(std::remove_if(argv + 1, argv + argc, ours) - argv);
    argv[argc] = nullptr;
    return options;
}

int run(int argc, char** argv) {
    if (std::any_of(argv + 1, argv + argc,
                    [](std::string_view argument) { return argument == "--help"; }))
        std::fputs(usage, stdout);
    Results results;
    results.options = take_options(argc, argv);
    getloadavg(&results.options.load, 1);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::AddCustomContext("size", "features of " + std::to_string(results.options.strands) +
                                            " strands, the thesis's table of " +
                                            std::to_string(results.options.vertices) + " vertices");
    const auto devices = opencl_devices();
    for (uint32_t index = 0; index < devices.size(); ++index) {
        results.devices[index].device = devices[index];
        std::printf("device:%u is %s (%s), driver %s\n", index, devices[index].name,
                    devices[index].platform, devices[index].driver);
        benchmark::AddCustomContext("device:" + std::to_string(index),
                                    std::string(devices[index].name) + "; " +
                                        devices[index].platform);
        benchmark::AddCustomContext("driver:" + std::to_string(index), devices[index].driver);
        register_ceilings(index, results);
        register_steps(index, results);
        register_characters(index, results);
        register_features(index, results);
        register_levels(index, results);
    }
    if (!results.options.local_memory.empty()) {
        sweep_local_memory(results);
        return 0;
    }
    if (results.options.json.empty()) {
        benchmark::RunSpecifiedBenchmarks();
    } else {
        JsonFiles reporter(results);
        benchmark::RunSpecifiedBenchmarks(&reporter);
    }
    write_pages(results);
    std::fputs(results.failures.c_str(), stderr);
    return results.failures.empty() ? 0 : 1;
}

} // namespace
} // namespace bench

int main(int argc, char** argv) {
    try {
        if (argc > 1 && std::string_view(argv[1]) == "compare")
            return bench::compare_command({argv + 2, argv + argc}, std::cout);
        return bench::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "plait-bench: %s\n", error.what());
        return 1;
    }
}
