// What a device gives at the most: bytes through its memory, and multiply-adds. Measured beside the
// rows that are held against them, by kernels in the place of a stage that has the arguments.
#include "bench.hpp"
#include "device.hpp"

#include <plait/params.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace bench {
namespace {

// `last_frame` reads one array of float4 and writes another.
constexpr plait_stage stage = PLAIT_STAGE_last_frame;

// 64 MiB each: beyond most caches, and no trouble to any device.
constexpr uint32_t copied = 4u << 20;

// Eight chains of multiply-adds in a work-item, so that none waits for another's end, as wide as
// the device's registers.
constexpr uint32_t chains = 8, rounds = 4096;

uint32_t items_of(const plait_device_info& device) { // milliseconds of them
    return device.type == PLAIT_DEVICE_TYPE_GPU ? 1u << 20 : 1u << 14;
}

constexpr char multiply_add_source[] = R"(
#include "plait/params.h"
#define EACH(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#define BEGIN(i) REAL c##i = x + i;
#define MULTIPLY_ADD(i) c##i = mad(c##i, a, b);
#define SUM(i) sum += c##i;

__kernel void plait_last_frame(uint item_count, plait_last_frame_params params,
                               __global const float4* position,
                               __global float4* position_last_frame) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const float4 p = position[item];
    const REAL x = SPREAD(p), a = (REAL)(p.x), b = (REAL)(p.y);
    EACH(BEGIN)
    for (uint i = 0; i < ROUNDS; ++i) {
        EACH(MULTIPLY_ADD)
    }
    REAL sum = 0;
    EACH(SUM)
    position_last_frame[item] = GATHER(sum);
}
)";

// The kernel for registers of so many floats, each of which matters to what it writes.
std::string multiply_add_kernel(uint32_t lanes) {
    struct Width {
        uint32_t lanes;
        const char *real, *spread, *gather;
    };
    constexpr Width widths[] = {{1, "float", "p.x", "(float4)(v)"},
                                {4, "float4", "p", "v"},
                                {8, "float8", "(float8)(p, p + 1)", "(v.lo + v.hi)"},
                                {16, "float16", "(float16)(p, p + 1, p + 2, p + 3)",
                                 "(v.lo.lo + v.lo.hi + v.hi.lo + v.hi.hi)"}};
    const auto width = std::ranges::find(widths, lanes, &Width::lanes);
    if (width == std::end(widths))
        throw std::runtime_error("the device has " + std::to_string(lanes) + " lanes");
    std::string text = "#define REAL ";
    text.append(width->real).append("\n#define SPREAD(p) ").append(width->spread);
    text.append("\n#define GATHER(v) ").append(width->gather);
    return text.append("\n#define ROUNDS ")
        .append(std::to_string(rounds))
        .append(multiply_add_source);
}

// A stage of two arrays, ready to run again and again.
class Pair {
  public:
    Pair(uint32_t index, uint32_t count, std::span<const plait_stage_source> sources)
        : device_(index, sources), count_(count) {
        const std::vector<uint32_t> words(size_t{4} * count, std::bit_cast<uint32_t>(0.5f));
        for (auto& buffer : buffers_)
            buffer = device_.make(PLAIT_ELEMENT_FLOAT4, "ceiling", words);
        run(); // compiles
    }

    // Seconds.
    double run() {
        const plait_last_frame_params params{2, 0}; // the kernel does not look at rows
        plait_buffer* const handles[] = {buffers_[0].get(), buffers_[1].get()};
        const plait_dispatch dispatch{stage, count_, 1, &params, sizeof params, 2, handles, 0};
        const auto start = std::chrono::steady_clock::now();
        device_.submit({&dispatch, 1});
        device_.wait();
        return seconds_since(start);
    }

  private:
    Device device_;
    uint32_t count_;
    std::array<Device::Buffer, 2> buffers_;
};

// `work` of a run, of which `unit` are counted a second.
double measure(benchmark::State& state, Pair pair, double work, const char* unit) {
    double total = 0;
    for ([[maybe_unused]] auto _ : state) {
        const double seconds = pair.run();
        state.SetIterationTime(seconds);
        total += seconds;
    }
    const double rate = work * static_cast<double>(state.iterations()) / total;
    state.counters[unit] = 1e-9 * rate;
    return rate;
}

} // namespace

void register_ceilings(uint32_t index, Results& results) {
    const std::string on = "device:" + std::to_string(index) + "/ceiling/";
    register_row(on + "copy", results, [=, &results](benchmark::State& state) {
        results.devices[index].copy_rate =
            measure(state, Pair(index, copied, {}), 2.0 * 16 * copied, "GB/s");
    });
    register_row(on + "multiply_add", results, [=, &results](benchmark::State& state) {
        DeviceResults& device = results.devices[index];
        const std::string text = multiply_add_kernel(device.device.lanes);
        const plait_stage_source source{"last_frame", text.c_str(), "multiply_add.cl"};
        const uint32_t items = items_of(device.device);
        const double flops = 2.0 * device.device.lanes * chains * rounds * items;
        device.flop_rate = measure(state, Pair(index, items, {&source, 1}), flops, "GFLOP/s");
    });
}

} // namespace bench
