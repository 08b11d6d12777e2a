// kernel_texts DIRECTORY: writes every stage's kernel there as the library hands it to a driver,
// and list.txt, a line for each program: stage, lanes, vertices per strand, kernel and the options.
#include "backend/opencl/build.hpp"
#include "backend/opencl/source.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace plait::opencl {
namespace {

// One that is usual and one that no power of two divides; a GPU's width and a CPU's.
constexpr uint32_t vertex_counts[] = {usual_vertices, 21};
constexpr uint32_t lane_counts[] = {1, 16};

// Stages whose work-groups may add up sums in local memory: a program more, `<stage>-8`, for a grid of 8
// voxels each way.
constexpr uint32_t grid_sums = 8 * 8 * 8 * PLAIT_SUM_STRIDE;

// Does the text depend on them? What does not is compiled once.
bool mentions(const Source& source, const char* name) {
    return source.text.find(name) != source.text.npos;
}

void list_programs(std::ofstream& list, const plait_stage_info& stage, const Source& source) {
    for (const uint32_t lanes : lane_counts)
        for (const uint32_t vertices : vertex_counts) {
            const bool over_lanes = stage.space == PLAIT_SPACE_LANES;
            const bool same_lanes =
                !over_lanes && !mentions(source, "PLAIT_DEVICE_LANES") && lanes != lane_counts[0];
            const bool usual = over_lanes || vertices == usual_vertices;
            if (same_lanes || !usual)
                continue;
            Candidate candidate{};
            (void)set_lanes(candidate.info, lanes);
            list << stage.name << ' ' << lanes << ' ' << vertices << ' ' << stage.kernel << ' '
                 << build_options(candidate, stage.space, {.vertices = vertices}) << '\n';
        }
}

void list_sums(std::ofstream& list, const std::string& program, const plait_stage_info& stage) {
    Candidate candidate{};
    (void)set_lanes(candidate.info, 1);
    list << program << " 1 " << usual_vertices << ' ' << stage.kernel << ' '
         << build_options(candidate, stage.space,
                          {.vertices = usual_vertices, .group_sums = grid_sums})
         << '\n';
}

int write_all(const std::filesystem::path& directory) {
    std::filesystem::create_directories(directory);
    std::ofstream list(directory / "list.txt");
    for (int index = 0; index < PLAIT_STAGE_COUNT; ++index) {
        const plait_stage_info& stage = *plait_stage_describe(static_cast<plait_stage>(index));
        const auto source = flatten(stage_file(stage.name), stage_text(stage.name));
        if (!source.ok()) {
            std::fprintf(stderr, "%s\n", source.error().message.c_str());
            return 1;
        }
        std::ofstream(directory / (std::string(stage.name) + ".cl")) << source->text;
        list_programs(list, stage, *source);
        if (mentions(*source, "PLAIT_GROUP_SUMS")) {
            const std::string program = std::string(stage.name) + "-8";
            std::ofstream(directory / (program + ".cl")) << source->text;
            list_sums(list, program, stage);
        }
    }
    return list.flush() ? 0 : 1;
}

} // namespace
} // namespace plait::opencl

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: %s DIRECTORY\n", arguments[0]);
        return 2;
    }
    return plait::opencl::write_all(arguments[1]);
}
