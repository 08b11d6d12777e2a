// One row per stage of stages.def: time and least traffic per vertex, against a copy of as many
// bytes.
#include "bench.hpp"
#include "device.hpp"
#include "inputs.hpp"
#include "rig.hpp"

#include <algorithm>

namespace bench {
namespace {

// `output_keep` has what a copy needs: a buffer to read and one to write, both float4 per vertex.
constexpr char copy_source[] =
    "#include \"plait/params.h\"\n"
    "__kernel void plait_output_keep(uint item_count, plait_layout_params params,\n"
    "                             __global const float4* pose, __global const float4* position,\n"
    "                             __global float4* position_local) {\n"
    "    if (get_global_id(0) < item_count)\n"
    "        position_local[get_global_id(0)] = position[get_global_id(0)];\n"
    "}\n";

// A device whose `output_keep` copies, with buffers such that `bytes` move.
class Copy {
  public:
    Copy(uint32_t index, double bytes)
        : device_(index, {&source_, 1}), rig_(device_, PLAIT_STAGE_output_keep, shape(bytes)) {}

    double run() { return rig_.run(); }

  private:
    static Shape shape(double bytes) {
        constexpr uint32_t row = 2; // vertices
        return {std::max(1u, static_cast<uint32_t>(bytes / (row * 2 * 4 * sizeof(float)))), row};
    }

    plait_stage_source source_{"output_keep", copy_source, "copy.cl"};
    Device device_;
    Rig rig_;
};

void measure(benchmark::State& state, uint32_t index, plait_stage stage, Results& results) {
    const Shape shape{results.options.strands, results.options.vertices,
                      results.devices[index].device.tile};
    Device device(index);
    Rig rig(device, stage, shape);
    StageRow row;
    row.bytes = static_cast<double>(traffic(*plait_stage_describe(stage), shape));
    Copy copy(index, row.bytes);
    for ([[maybe_unused]] auto _ : state) {
        const double seconds = rig.run();
        state.SetIterationTime(seconds);
        row.seconds += seconds;
        row.copy_seconds += copy.run(); // in turn, so that what disturbs one disturbs both
    }
    row.seconds /= static_cast<double>(state.iterations());
    row.copy_seconds /= static_cast<double>(state.iterations());
    results.devices[index].stages[stage] = row;
    const auto vertices = static_cast<double>(shape.total());
    state.counters["ns/vertex"] = 1e9 * row.seconds / vertices;
    state.counters["bytes/vertex"] = row.bytes / vertices;
    state.counters["times copy"] = row.seconds / row.copy_seconds;
}

// Of stages that find planes of meshes: how much of the hair is near. As long strands as models are
// measured with, beside the substep that reads the planes.
constexpr int near_shares[] = {0, 20, 100}; // % of a strand's length that lies on the mesh
constexpr uint32_t near_strands = 10000;

void measure_near(benchmark::State& state, uint32_t index, plait_stage stage, int share,
                  Results& results) {
    const Shape shape{near_strands, model_vertices, results.devices[index].device.tile,
                      static_cast<float>(share) / 100};
    Device device(index);
    Rig rig(device, stage, shape), solve(device, PLAIT_STAGE_articulated, shape);
    double seconds = 0, solve_seconds = 0;
    for ([[maybe_unused]] auto _ : state) {
        const double run = rig.run();
        state.SetIterationTime(run);
        seconds += run;
        solve_seconds += solve.run(); // in turn, so that what disturbs one disturbs both
    }
    state.counters["ns/vertex"] = 1e9 * seconds / static_cast<double>(state.iterations()) /
                                  static_cast<double>(shape.total());
    state.counters["times articulated"] = seconds / solve_seconds;
}

void register_near(uint32_t device, Results& results) {
    for (const plait_stage stage : {PLAIT_STAGE_mesh_field, PLAIT_STAGE_mesh_nearest})
        for (const int share : near_shares)
            register_row("device:" + std::to_string(device) + "/near:" + std::to_string(share) +
                             "/" + plait_stage_describe(stage)->name,
                         results, [=, &results](benchmark::State& state) {
                             measure_near(state, device, stage, share, results);
                         });
}

} // namespace

void register_stages(uint32_t device, Results& results) {
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage) {
        const auto which = static_cast<plait_stage>(stage);
        const std::string name =
            "device:" + std::to_string(device) + "/stage/" + plait_stage_describe(which)->name;
        register_row(name, results, [device, which, &results](benchmark::State& state) {
            measure(state, device, which, results);
        });
    }
    register_near(device, results);
}

} // namespace bench
