// Recording, through the public headers.
#include "support.hpp"

#include <plait/plait_formats.h>
#include <plait/plait_recorder.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>

namespace {

namespace fs = std::filesystem;

class Recorders : public testing::Test {
  protected:
    Recorders()
        : folder_(fs::temp_directory_path() /
                  ("plait-recorder-" + std::to_string(std::random_device{}()))),
          context_(make_context("reference")) {
        fs::create_directory(folder_);
    }
    ~Recorders() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    size_t entries() const {
        const fs::directory_iterator all(folder_);
        return static_cast<size_t>(std::distance(begin(all), end(all)));
    }
    plait::Sim make_sim(uint32_t follows = 0) const {
        plait::SimDesc desc;
        desc.follows_per_guide = follows;
        return plait::Sim(context_, make_groom({curl({0, 0, 0}, 5), curl({0, 0.1f, 0}, 8)}), desc);
    }

    fs::path folder_;
    plait::Context context_;
};

struct Destroy {
    void operator()(plait_recorder* recorder) const { plait_recorder_destroy(recorder); }
};
using Recorder = std::unique_ptr<plait_recorder, Destroy>;

Recorder record(const std::string& path,
                const plait_recorder_desc& desc = plait_recorder_desc_defaults()) {
    plait_recorder* recorder = nullptr;
    plait::check(plait_recorder_create(path.c_str(), &desc, &recorder));
    return Recorder(recorder);
}

plait::Groom load(const std::string& path, plait_axes axes = PLAIT_AXES_Y_UP, float scale = 1) {
    auto options = plait_import_options_defaults();
    options.axes = axes;
    options.scale = scale;
    return plait::Groom::load(path, options);
}

std::string notes_of(const plait_groom* groom) {
    size_t size = 0;
    plait::check(plait_groom_read_notes(groom, nullptr, &size));
    std::string notes(size, '\0');
    plait::check(plait_groom_read_notes(groom, notes.data(), &size));
    EXPECT_EQ(notes.back(), '\0');
    notes.pop_back();
    return notes;
}

std::string text_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// The vertices that strands have, of rows that are as long as the longest.
std::vector<float> shown(const plait::Sim& sim, size_t strands) {
    const auto rows = sim.read(PLAIT_FIELD_POSITION);
    const auto counts = sim.read<uint32_t>(PLAIT_FIELD_VERTEX_COUNT);
    std::vector<float> positions;
    for (size_t s = 0; s < strands; ++s)
        for (size_t v = 0; v < counts[s]; ++v)
            for (size_t k = 0; k < 3; ++k)
                positions.push_back(rows[4 * (8 * s + v) + k]);
    return positions;
}

TEST_F(Recorders, TheFirstFrameIsWhatIsShownToTheBit) {
    for (const char* name : {"a.abc", "a.usda"})
        for (const auto strands : {PLAIT_RECORDER_STRANDS_SHOWN, PLAIT_RECORDER_STRANDS_GUIDES}) {
            const auto sim = make_sim(2);
            auto desc = plait_recorder_desc_defaults();
            desc.strands = strands;
            desc.velocities = 1;
            const std::vector<float> width{7e-5f};
            desc.widths = plait::view(width);
            const Recorder recorder = record(path(name), desc);
            plait::Sim moving = make_sim(2);
            moving.step(0.1);
            const size_t count = strands == PLAIT_RECORDER_STRANDS_GUIDES ? 2 : 6;
            const auto positions = shown(moving, count);
            for (int frame = 0; frame < 3; ++frame) {
                plait::check(plait_recorder_add(recorder.get(), moving, 2 + frame / 24.0));
                moving.step(0.1);
            }
            plait::check(plait_recorder_close(recorder.get()));
            const auto groom = load(path(name));
            EXPECT_EQ(groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS), positions) << name;
            EXPECT_EQ(groom.read<float>(PLAIT_GROOM_FIELD_THICKNESS),
                      std::vector<float>(count, 7e-5f));
            EXPECT_NE(notes_of(groom).find("at their first sample"), std::string::npos);
        }
    EXPECT_EQ(entries(), 2u);
}

TEST_F(Recorders, VelocitiesAreThoseBetweenFrames) {
    auto desc = plait_recorder_desc_defaults();
    desc.velocities = 1;
    desc.strands = PLAIT_RECORDER_STRANDS_GUIDES;
    plait::Sim sim = make_sim();
    const Recorder recorder = record(path("v.usda"), desc);
    for (int frame = 0; frame < 3; ++frame) { // 1 m/s, then 2 m/s along x
        const float x = frame == 2 ? 0.3f : 0.1f * static_cast<float>(frame);
        sim.teleport(head_at({x, 0, 0}));
        plait::check(plait_recorder_add(recorder.get(), sim, 0.1 * frame));
    }
    plait::check(plait_recorder_close(recorder.get()));
    const std::string text = text_of(path("v.usda"));
    const std::string velocities = text.substr(text.find("velocities.timeSamples"));
    size_t at = 0;
    for (const double expected : {1.0, 1.5, 2.0}) {
        at = velocities.find(": [(", at) + 4;
        EXPECT_NEAR(std::atof(&velocities[at]), expected, 1e-3);
    }
    EXPECT_NE(text.find("2.4000000000000004: [("), std::string::npos) << "times are in frames";
}

TEST_F(Recorders, AxesAndScaleAreTheReverseOfImport) {
    const auto sim = make_sim();
    const auto positions = shown(sim, 2);
    for (const auto axes : {PLAIT_AXES_Y_UP, PLAIT_AXES_Z_UP, PLAIT_AXES_Y_UP_LEFT_HANDED,
                            PLAIT_AXES_Z_UP_LEFT_HANDED}) {
        auto desc = plait_recorder_desc_defaults();
        desc.axes = axes;
        desc.scale = 128;
        plait::Sim still = make_sim();
        const Recorder recorder = record(path("axes.abc"), desc);
        plait::check(plait_recorder_add(recorder.get(), still, 0));
        plait::check(plait_recorder_close(recorder.get()));
        EXPECT_EQ(load(path("axes.abc"), axes, 1.0f / 128).read<float>(PLAIT_GROOM_FIELD_POSITIONS),
                  positions);
    }
    auto desc = plait_recorder_desc_defaults();
    desc.axes = PLAIT_AXES_Z_UP;
    desc.scale = 128;
    plait::Sim still = make_sim();
    const Recorder recorder = record(path("axes.usda"), desc);
    plait::check(plait_recorder_add(recorder.get(), still, 0));
    plait::check(plait_recorder_close(recorder.get()));
    EXPECT_EQ(load(path("axes.usda")).read<float>(PLAIT_GROOM_FIELD_POSITIONS), positions)
        << "which says both itself";
}

TEST_F(Recorders, PositionsThatWereKeptAreRecordedAsTheSimIs) {
    auto desc = plait_recorder_desc_defaults();
    desc.velocities = 1;
    desc.axes = PLAIT_AXES_Z_UP;
    desc.scale = 100;
    for (const char* end : {".abc", ".usda"}) {
        plait::Sim sim = make_sim(2);
        const auto counts = sim.read<uint32_t>(PLAIT_FIELD_VERTEX_COUNT);
        const Recorder of_sim = record(path("sim") + end, desc);
        const Recorder of_kept = record(path("kept") + end, desc);
        for (int frame = 0; frame < 4; ++frame) {
            sim.step(0.1);
            const auto kept = shown(sim, counts.size());
            const plait_view count{counts.data(), counts.size(), 0};
            const plait_view positions{kept.data(), kept.size() / 3, 0};
            plait::check(plait_recorder_add(of_sim.get(), sim, frame / 24.0));
            plait::check(
                plait_recorder_add_positions(of_kept.get(), &count, &positions, frame / 24.0));
        }
        plait::check(plait_recorder_close(of_sim.get()));
        plait::check(plait_recorder_close(of_kept.get()));
        EXPECT_EQ(text_of(path("sim") + end), text_of(path("kept") + end));
    }
}

TEST_F(Recorders, PositionsOfAnotherShapeAreRefused) {
    const Recorder recorder = record(path("a.abc"));
    const std::vector<float> positions(3 * 9, 0.5f);
    const auto add = [&](const std::vector<uint32_t>& counts, size_t vertices) {
        const plait_view count{counts.data(), counts.size(), 0};
        const plait_view given{positions.data(), vertices, 0};
        static double time = 0;
        return plait_recorder_add_positions(recorder.get(), &count, &given, ++time);
    };
    const auto refused = [&](const std::vector<uint32_t>& counts, size_t vertices,
                             const char* text) {
        expect_failure(add(counts, vertices), PLAIT_INVALID_ARGUMENT, text);
    };
    refused({4, 1}, 5, "vertex_counts[1] is 1, range is [2, 256]");
    refused({257}, 9, "vertex_counts[0] is 257, range is [2, 256]");
    refused({}, 0, "positions.count is 0, the 0 strands");
    refused({4, 5}, 8, "positions.count is 8, the 2 strands of vertex_counts have 9 vertices");
    plait::check(add({4, 5}, 9));
    refused({4, 3, 2}, 9, "vertex_counts has 3 strands, the recording 2");
    refused({5, 4}, 9, "strand 0: vertex_counts has 5 vertices, the recording 4");
    plait::check(add({4, 5}, 9));
    plait::check(plait_recorder_close(recorder.get()));
}

TEST_F(Recorders, AbandonedLeavesWhatWasThere) {
    std::ofstream(path("a.abc")) << "before";
    plait::Sim sim = make_sim();
    {
        const Recorder recorder = record(path("a.abc"));
        plait::check(plait_recorder_add(recorder.get(), sim, 0));
    }
    EXPECT_EQ(text_of(path("a.abc")), "before");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Recorders, WrongCallsAreRefusedWithReasons) {
    plait::Sim sim = make_sim();
    const Recorder recorder = record(path("a.abc"));
    expect_failure(plait_recorder_close(recorder.get()), PLAIT_INVALID_STATE, "has no frame yet");
    expect_failure(plait_recorder_add(recorder.get(), sim, NAN), PLAIT_INVALID_ARGUMENT,
                   "range is finite");
    plait::check(plait_recorder_add(recorder.get(), sim, 1));
    expect_failure(plait_recorder_add(recorder.get(), sim, 1), PLAIT_INVALID_ARGUMENT,
                   "time is 1, range is above that of the frame before, 1 s");
    plait::Sim more = make_sim(1);
    expect_failure(plait_recorder_add(recorder.get(), more, 2), PLAIT_INVALID_ARGUMENT,
                   "sim has 4 strands, the recording 2");
    plait::Sim other(context_, make_groom({curl({0, 0, 0}, 8), curl({0, 0.1f, 0}, 8)}));
    expect_failure(plait_recorder_add(recorder.get(), other, 2), PLAIT_INVALID_ARGUMENT,
                   "strand 0: sim has 8 vertices, the recording 5");
    plait::check(plait_recorder_close(recorder.get()));
    expect_failure(plait_recorder_close(recorder.get()), PLAIT_INVALID_STATE, "it is closed");
    expect_failure(plait_recorder_add(recorder.get(), sim, 3), PLAIT_INVALID_STATE, "it is closed");
    expect_failure(plait_recorder_add(nullptr, sim, 3), PLAIT_INVALID_ARGUMENT, "recorder is NULL");
    expect_failure(plait_recorder_add(recorder.get(), nullptr, 3), PLAIT_INVALID_ARGUMENT,
                   "sim is NULL");
    plait_recorder_destroy(nullptr);
}

TEST_F(Recorders, DescsAreCheckedFieldByField) {
    plait_recorder* out = nullptr;
    const auto refused = [&](const char* name, auto change, plait_result code, const char* text) {
        auto desc = plait_recorder_desc_defaults();
        change(desc);
        expect_failure(plait_recorder_create(path(name).c_str(), &desc, &out), code, text);
        EXPECT_EQ(out, nullptr);
    };
    const auto nothing = [](plait_recorder_desc&) {};
    const float wide = 2;
    refused("a.xyz", nothing, PLAIT_UNSUPPORTED, "known are .abc, .usda");
    refused("none/a.abc", nothing, PLAIT_NOT_FOUND, "cannot make a file beside it");
    refused(
        "a.abc", [](auto& d) { d.scale = 0; }, PLAIT_INVALID_ARGUMENT, "desc->scale is 0");
    refused(
        "a.abc", [](auto& d) { d.velocities = 2; }, PLAIT_INVALID_ARGUMENT,
        "desc->velocities is 2, range is [0, 1]");
    refused(
        "a.abc", [](auto& d) { d.frames_per_second = 0; }, PLAIT_INVALID_ARGUMENT,
        "desc->frames_per_second is 0");
    refused(
        "a.abc", [](auto& d) { d.axes = static_cast<plait_axes>(4); }, PLAIT_INVALID_ARGUMENT,
        "desc->axes is 4");
    refused(
        "a.abc", [](auto& d) { d.strands = static_cast<plait_recorder_strands>(2); },
        PLAIT_INVALID_ARGUMENT, "desc->strands is 2");
    refused(
        "a.abc",
        [&](auto& d) {
            d.widths = {&wide, 1, 0};
        },
        PLAIT_INVALID_ARGUMENT, "desc->widths[0] is 2, range is [0, 1] m");
    refused(
        "a.usda", [](auto& d) { d.axes = PLAIT_AXES_Z_UP_LEFT_HANDED; }, PLAIT_UNSUPPORTED,
        "axes are left-handed");
    expect_failure(plait_recorder_create(nullptr, nullptr, &out), PLAIT_INVALID_ARGUMENT,
                   "path is NULL");
    EXPECT_EQ(entries(), 0u);
    plait::Sim sim = make_sim();
    auto desc = plait_recorder_desc_defaults();
    const std::vector<float> widths(3, 1e-4f);
    desc.widths = plait::view(widths);
    const Recorder recorder = record(path("a.abc"), desc);
    expect_failure(
        plait_recorder_add(recorder.get(), sim, 0), PLAIT_INVALID_ARGUMENT,
        "widths of the recorder are 3; allowed are 0, 1 or one for each of the 2 strands or");
}

TEST_F(Recorders, EachVertexMayHaveItsOwnWidth) {
    plait::Sim sim = make_sim();
    const auto counts = sim.read<uint32_t>(PLAIT_FIELD_VERTEX_COUNT);
    std::vector<float> widths, means; // tapered; a groom has one for each strand, the mean
    for (const uint32_t count : counts) {
        for (uint32_t v = 0; v < count; ++v)
            widths.push_back(1e-4f * static_cast<float>(count - v));
        means.push_back(5e-5f * static_cast<float>(count + 1));
    }
    auto desc = plait_recorder_desc_defaults();
    desc.widths = plait::view(widths);
    for (const char* name : {"w.abc", "w.usda"}) {
        const Recorder recorder = record(path(name), desc);
        plait::check(plait_recorder_add(recorder.get(), sim, 0));
        plait::check(plait_recorder_close(recorder.get()));
        const auto found = load(path(name)).read<float>(PLAIT_GROOM_FIELD_THICKNESS);
        ASSERT_EQ(found.size(), means.size());
        for (size_t s = 0; s < means.size(); ++s)
            EXPECT_NEAR(found[s], means[s], 1e-9f) << name;
    }
    std::string list = text_of(path("w.usda"));
    list = list.substr(list.find("widths = ["));
    list = list.substr(0, list.find(']'));
    EXPECT_FLOAT_EQ(std::stof(list.substr(list.rfind(',') + 1)), 1e-4f) << "the tip's is last";
}

TEST_F(Recorders, GuidesOfAFileAreLoadedApart) {
    const std::string file = PLAIT_SOURCE_DIR "/tests/fuzz/corpus/alembic/unreal";
    fs::copy_file(file, path("unreal.abc"));
    size_t strands[3];
    for (int part = 0; part < 3; ++part) {
        plait_groom* handle = nullptr;
        plait::check(plait_groom_load_part(path("unreal.abc").c_str(),
                                           static_cast<plait_strand_part>(part), nullptr, &handle));
        auto info = plait_groom_info_defaults();
        plait::check(plait_groom_describe(handle, &info));
        strands[part] = info.strands;
        EXPECT_NE(notes_of(handle).find("2 of its 4 curves are guides"), std::string::npos);
        plait_groom_destroy(handle);
    }
    EXPECT_EQ(strands[0], 4u);
    EXPECT_EQ(strands[1], 2u);
    EXPECT_EQ(strands[2], 2u);
    plait_groom* none = nullptr;
    expect_failure(plait_groom_load_part("a.tfx", PLAIT_STRAND_PART_GUIDES, nullptr, &none),
                   PLAIT_UNSUPPORTED, "does not tell guides from other strands");
    expect_failure(
        plait_groom_load_part("a.abc", static_cast<plait_strand_part>(3), nullptr, &none),
        PLAIT_INVALID_ARGUMENT, "part is 3, range is [0, 2]");
    EXPECT_EQ(notes_of(make_groom(tuft(1, 4))), "");
}

} // namespace
