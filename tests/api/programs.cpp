// When kernels are built, who shares them, and where they are kept.
#include "faulty.hpp"
#include "support.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace {

// What the log says of each stage's program: "built", "loaded", "shared".
struct Log {
    std::vector<std::string> lines;

    static void add(plait_log_level, const char* text, void* user) {
        static_cast<Log*>(user)->lines.emplace_back(text);
    }
    size_t count(const std::string& part) const {
        return static_cast<size_t>(
            std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
                return line.find(part) != std::string::npos;
            }));
    }
    size_t programs() const {
        return count(": built, ") + count(": loaded, ") + count(": shared, ");
    }
};

// `backend` outlives what it returns.
plait_context_desc logging(const char* backend, Log& log) {
    auto desc = plait_context_desc_defaults();
    desc.backend = backend;
    desc.log = Log::add;
    desc.log_user = &log;
    return desc;
}

class Programs : public OnBackend {};
ON_EVERY_BACKEND(Programs);

TEST_P(Programs, AllThatASimRunsIsThereOnceItIs) {
    Log log;
    plait::Context own(logging(GetParam().c_str(), log));
    for (const plait_model model : {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED}) {
        plait::SimDesc desc;
        desc.model = model;
        desc.follows_per_guide = 1;
        desc.interpolate_output = 1;
        desc.keep_last_frame = 1;
        desc.grid.on = true;
        plait::Sim sim(own, make_groom(tuft(3, 7)), desc);
        const size_t before = log.programs();
        sim.set_roots(head_at({0.01f, 0, 0}));
        run(sim, 3);
        sim.measure();
        sim.teleport(head_at({1, 0, 0}));
        sim.reset();
        sim.read(PLAIT_FIELD_BOUNDS);
        EXPECT_EQ(log.programs(), before) << log.lines.back();
    }
}

// Drivers compile again when a kernel is first enqueued, so each is before a step wants it: also
// what a switch of settings takes, which only the calls that want it know of.
TEST(Programs, NothingIsEnqueuedThatWasNotPrepared) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_ARTICULATED;
    desc.follows_per_guide = 1;
    desc.keep_last_frame = 1;
    plait::Sim sim(context, make_groom(tuft(3, 7)), desc);
    const auto done = [&](const char* what) {
        for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage)
            EXPECT_LE(faults.submitted[stage], faults.prepared[stage])
                << what << ": " << plait_stage_describe(static_cast<plait_stage>(stage))->name;
    };
    run(sim, 2);
    sim.teleport(head_at({1, 0, 0}));
    sim.reset();
    sim.measure();
    sim.read(PLAIT_FIELD_BOUNDS);
    done("calls of a sim");
    for (const uint32_t substeps : {2u, 1u}) {
        take_substeps(sim, {substeps, substeps, 4});
        done("the switch itself");
        run(sim, 1);
        done("the step after it");
    }
    auto params = plait_sim_params_defaults();
    params.groom = 0.5f;
    ASSERT_EQ(plait_sim_set_params(sim, &params), PLAIT_OK) << plait_last_error();
    auto grid = plait_grid_desc_defaults();
    grid.form = PLAIT_GRID_FORM_SLOTS;
    sim.set_grid(&grid);
    run(sim, 1);
    done("other parameters");
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    ASSERT_EQ(plait_sim_write(sim, PLAIT_FIELD_POSITION, x.data(), 3 * 7 * 4 * sizeof(float)),
              PLAIT_OK)
        << plait_last_error();
    run(sim, 1);
    done("written positions");
}

#ifdef PLAIT_TEST_OPENCL
TEST(Programs, ContextsOfADeviceShareThem) {
    Log first_log, second_log;
    plait::Context first(logging("opencl", first_log));
    plait::Context second(logging("opencl", second_log));
    const plait::Sim one(first, make_groom(tuft(3, 7)));
    const plait::Sim two(second, make_groom(tuft(3, 7)));
    EXPECT_EQ(second_log.count(": built, "), 0u);
    EXPECT_EQ(second_log.count(": shared, "), second_log.programs());
    EXPECT_GT(second_log.programs(), 3u);
}

class ProgramFolder : public testing::Test {
  protected:
    void SetUp() override { TearDown(); }
    void TearDown() override {
        std::filesystem::remove_all(std::filesystem::path(path_).parent_path());
    }

    // A sim's positions after some steps, on a context that nobody else's programs are in.
    std::vector<float> positions(Log& log) {
        auto desc = logging("opencl", log);
        desc.program_folder = path_.c_str();
        plait::Context context(desc);
        plait::Sim sim(context, make_groom(tuft(3, 7)));
        run(sim, 3);
        return sim.read(PLAIT_FIELD_POSITION);
    }
    size_t files() const {
        return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(path_),
                                                 std::filesystem::directory_iterator()));
    }

    // Each test's own: they may run side by side.
    std::string path_ = testing::TempDir() + "plait_programs_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name() + "/new";
};

TEST_F(ProgramFolder, KeepsWhatWasBuiltForTheNext) {
    Log built, loaded;
    const auto expected = positions(built);
    EXPECT_EQ(built.count(": loaded, "), 0u);
    EXPECT_EQ(files(), built.count(": built, ")) << "a file each, and none left aside";
    EXPECT_EQ(positions(loaded), expected);
    EXPECT_EQ(loaded.count(": built, "), 0u);
    EXPECT_EQ(loaded.count(": loaded, "), files());
    EXPECT_EQ(loaded.programs(), built.programs());
}

TEST_F(ProgramFolder, WhatIsDamagedIsBuiltAnewAndReplaced) {
    Log built, damaged, healed;
    const auto expected = positions(built);
    size_t kind = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
        const auto size = std::filesystem::file_size(entry);
        if (kind++ % 2 == 0) {
            std::filesystem::resize_file(entry, size * (kind % 5) / 5); // cut, one to nothing
        } else {
            std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
            file.seekp(static_cast<std::streamoff>(size - 20));
            file.write("damaged", 7);
        }
    }
    EXPECT_EQ(positions(damaged), expected);
    EXPECT_EQ(damaged.count(": loaded, "), 0u);
    EXPECT_EQ(damaged.count("damaged, or of another program"), files());
    EXPECT_EQ(positions(healed), expected);
    EXPECT_EQ(healed.count(": built, "), 0u);
}

TEST_F(ProgramFolder, ThatCannotBeMadeIsRefusedByName) {
    std::filesystem::create_directories(std::filesystem::path(path_).parent_path());
    std::ofstream(path_) << "a file";
    auto desc = plait_context_desc_defaults();
    desc.backend = "opencl";
    desc.program_folder = path_.c_str();
    plait_context* made = nullptr;
    EXPECT_EQ(plait_context_create(&desc, &made), PLAIT_IO);
    EXPECT_NE(std::string(plait_last_error()).find(path_), std::string::npos) << plait_last_error();
}
#endif

} // namespace
