// clip_points record FILE...: records the same clip in each file, and prints it, a line of coordinates for each frame.
// clip_points read FILE: loads a groom and prints the number of vertices of each strand, then coordinates, then diameters.
#include <plait/plait.hpp>
#include <plait/plait_recorder.h>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace {

constexpr size_t strands = 40, vertices = 12;
constexpr int frames = 8;

plait::Groom make_groom() {
    std::vector<float> positions;
    for (size_t s = 0; s < strands; ++s)
        for (size_t v = 0; v < vertices; ++v) {
            const float along = 0.02f * static_cast<float>(v), phase = static_cast<float>(s);
            positions.insert(positions.end(), {0.01f * static_cast<float>(s) + along,
                                               1.6f + 0.004f * std::sin(30 * along + phase),
                                               0.004f * std::cos(30 * along + phase)});
        }
    auto desc = plait_groom_desc_defaults();
    desc.positions = plait::view(positions, 3);
    desc.vertices_per_strand = vertices;
    return plait::Groom(desc);
}

void record(int count, char** files) {
    auto context_desc = plait_context_desc_defaults();
    context_desc.backend = "reference";
    const plait::Context context(context_desc);
    plait::Sim sim(context, make_groom());
    const std::vector<float> widths(strands, 8e-5f);
    auto desc = plait_recorder_desc_defaults();
    desc.widths = plait::view(widths);
    desc.velocities = 1;
    std::vector<plait_recorder*> recorders(static_cast<size_t>(count));
    for (size_t i = 0; i < recorders.size(); ++i)
        plait::check(plait_recorder_create(files[i], &desc, &recorders[i]));
    for (int frame = 0; frame < frames; ++frame) {
        for (plait_recorder* recorder : recorders)
            plait::check(plait_recorder_add(recorder, sim, frame / 24.0));
        const auto positions = sim.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < positions.size(); ++i)
            if (i % 4 != 3)
                std::printf("%.9g ", static_cast<double>(positions[i]));
        std::printf("\n");
        sim.step(1.0 / 24);
    }
    for (plait_recorder* recorder : recorders) {
        plait::check(plait_recorder_close(recorder));
        plait_recorder_destroy(recorder);
    }
}

void read(const char* file) {
    const plait::Groom groom = plait::Groom::load(file);
    for (const uint32_t count : groom.read<uint32_t>(PLAIT_GROOM_FIELD_VERTEX_COUNTS))
        std::printf("%u ", count);
    for (const auto field : {PLAIT_GROOM_FIELD_POSITIONS, PLAIT_GROOM_FIELD_THICKNESS}) {
        std::printf("\n");
        for (const float value : groom.read<float>(field))
            std::printf("%.9g ", static_cast<double>(value));
    }
    std::printf("\n");
}

} // namespace

int main(int count, char** words) {
    try {
        if (count >= 3 && std::strcmp(words[1], "record") == 0)
            record(count - 2, words + 2);
        else if (count == 3 && std::strcmp(words[1], "read") == 0)
            read(words[2]);
        else
            return 2;
    } catch (const plait::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
