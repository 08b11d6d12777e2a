// Choosing devices, logs, registering backends; contexts side by side, on one thread and on two.
#include "barrier.hpp"
#include "faulty.hpp"
#include "support.hpp"

#include <cstring>
#include <exception>
#include <thread>

namespace {

TEST(Contexts, ListsDevicesAndWritesOnlyWhatFits) {
    size_t count = 0;
    ASSERT_EQ(plait_devices_list(nullptr, &count), PLAIT_OK);
    ASSERT_GE(count, 1u);
    auto one = plait_device_info_defaults();
    count = 1;
    ASSERT_EQ(plait_devices_list(&one, &count), PLAIT_OK);
    EXPECT_EQ(count, 1u);
    EXPECT_STRNE(one.backend, "");
    EXPECT_EQ(one.struct_size, sizeof one);
}

TEST(Contexts, AnUnknownDeviceIsAnsweredWithThoseThereAre) {
    auto desc = plait_context_desc_defaults();
    desc.device = "no such device";
    plait_context* context = nullptr;
    EXPECT_EQ(plait_context_create(&desc, &context), PLAIT_NOT_FOUND);
    EXPECT_EQ(context, nullptr);
    const std::string text = plait_last_error();
    EXPECT_NE(text.find("no such device"), std::string::npos) << text;
    EXPECT_NE(text.find("reference: "), std::string::npos) << text;
}

TEST(Contexts, DevicesAreFoundByPartOfTheirNameInAnyCase) {
    std::string name;
    for (const auto& info : plait::devices())
        if (std::strcmp(info.backend, "reference") == 0)
            name = info.platform;
    for (char& c : name)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    auto desc = plait_context_desc_defaults();
    desc.device = name.c_str();
    EXPECT_STREQ(plait::Context(desc).describe().backend, "reference");
}

// What opens for `words`, as "backend: platform".
std::string opened_for(const char* words) {
    auto desc = plait_context_desc_defaults();
    desc.device = words;
    plait_context* context = nullptr;
    if (plait_context_create(&desc, &context) != PLAIT_OK)
        return plait_last_error();
    auto info = plait_device_info_defaults();
    plait_context_describe(context, &info);
    plait_context_destroy(context);
    return std::string(info.backend) + ": " + info.platform;
}

// PoCL's devices are "pthread-..." or "cpu-...", and its platform has its long name.
TEST(Contexts, DevicesAreFoundByWordsOfTheirPlatformAndByType) {
    bool pocl = false, cpu = false;
    for (const auto& info : plait::devices()) {
        pocl |= std::strcmp(info.platform, "Portable Computing Language") == 0;
        cpu |= info.type == PLAIT_DEVICE_TYPE_CPU;
    }
    ASSERT_TRUE(cpu) << "the reference is one";
    EXPECT_EQ(opened_for("CPU").find("no device"), std::string::npos) << opened_for("CPU");
    EXPECT_NE(opened_for("cpus").find("no device"), std::string::npos) << opened_for("cpus");
    if (!pocl)
        GTEST_SKIP() << "no PoCL here";
    EXPECT_EQ(opened_for("pocl"), "opencl: Portable Computing Language");
}

TEST(Contexts, TheLogSaysWhichDeviceWasOpenedAndWhyOthersWereNot) {
    std::string log;
    auto desc = plait_context_desc_defaults();
    desc.backend = "faulty"; // the last in line
    desc.log = [](plait_log_level, const char* text, void* user) {
        *static_cast<std::string*>(user) += std::string(text) + "\n";
    };
    desc.log_user = &log;
    faulty();
    const plait::Context context(desc);
    const size_t passed =
        log.find("passed over: backend \"faulty\" was asked for", log.find("reference: "));
    ASSERT_NE(passed, std::string::npos) << log;
    EXPECT_GT(log.find("opened", log.find("faulty: ")), passed) << log;
}

TEST(Contexts, OneLivesUntilItsLastSimIsGone) {
    Faults& faults = faulty();
    const int devices = faults.live_devices;
    auto context = std::make_unique<plait::Context>(make_context("faulty"));
    const auto groom = make_groom(tuft(2, 5));
    auto first = std::make_unique<plait::Sim>(*context, groom);
    auto second = std::make_unique<plait::Sim>(*context, groom);
    plait::Sim alone(make_context("faulty"), groom); // whose context goes at once
    context.reset();
    EXPECT_EQ(faults.live_devices, devices + 2);
    run(*first, 3);
    run(alone, 3);
    EXPECT_EQ(first->hash(), alone.hash());
    first.reset();
    run(*second, 3);
    EXPECT_EQ(second->hash(), alone.hash());
    EXPECT_EQ(faults.live_devices, devices + 2);
    second.reset();
    EXPECT_EQ(faults.live_devices, devices + 1);
}

TEST(Contexts, AFailedSimLeavesItsContextToItsOwner) {
    Faults& faults = faulty();
    const int devices = faults.live_devices;
    {
        const auto context = make_context("faulty");
        plait_sim* sim = nullptr;
        faults.lose_after = 0;
        EXPECT_EQ(plait_sim_create(context, make_groom(tuft(1, 3)), nullptr, &sim),
                  PLAIT_DEVICE_LOST);
        EXPECT_EQ(faults.live_devices, devices + 1);
    }
    EXPECT_EQ(faults.live_devices, devices);
}

class SideBySide : public OnBackend {};
ON_EVERY_BACKEND(SideBySide);

TEST_P(SideBySide, TwoContextsDoNotMeet) {
    const auto groom = make_groom(tuft(3, 6));
    const auto other = make_context(GetParam());
    plait::Sim a(context, groom), b(other, groom), alone(context, groom);
    run(alone, 10);
    for (int i = 0; i < 10; ++i) {
        a.step(frame);
        b.step(frame);
        b.set_roots(head_at({0, 0.01f * static_cast<float>(i), 0}));
    }
    EXPECT_EQ(a.hash(), alone.hash());
    EXPECT_NE(a.hash(), b.hash());
}

constexpr int rounds = 12;

// What one thread does, with a context and a sim of its own: it steps, and now and then fails. Two
// of different `number` differ in model, motion and what they do wrong.
struct Worker {
    int number;
    const std::string& backend;
    const plait::Groom& groom;
    uint64_t hash = 0;
    std::string trouble = {}; // if all was as it should be

    template <typename Meet> void work(const Meet& meet) {
        const auto context = make_context(backend);
        plait::SimDesc desc;
        desc.model = number == 0 ? PLAIT_MODEL_TRESSFX : PLAIT_MODEL_ARTICULATED;
        desc.grid.on = true;
        plait::Sim sim(context, groom, desc);
        for (int i = 0; i < rounds; ++i) {
            const float y = 0.005f * static_cast<float>(i + number);
            sim.set_roots(head_at({0, y, 0}));
            sim.step(frame);
            const int wrong = 1000 * (number + 1) + i;
            if (plait_sim_step(sim, -wrong) == PLAIT_OK)
                trouble = "a step back was taken";
            meet(); // now the other has failed, too
            if (std::string(plait_last_error()).find("-" + std::to_string(wrong)) ==
                std::string::npos)
                trouble = std::string("the other's error: ") + plait_last_error();
            meet();
        }
        hash = sim.hash();
    }
};

TEST_P(SideBySide, TwoThreadsWithAContextEachDoNotMeet) {
    const std::string backend = GetParam();
    const auto groom = make_groom(tuft(9, 8)); // of both threads
    std::vector<Worker> alone = {{0, backend, groom}, {1, backend, groom}}, together = alone;
    for (Worker& worker : alone)
        worker.work([] {});
    Barrier meeting(2);
    std::vector<std::thread> threads;
    for (Worker& worker : together)
        threads.emplace_back([&] {
            try {
                worker.work([&] { meeting.arrive_and_wait(); });
            } catch (const std::exception& failure) {
                worker.trouble = failure.what();
                meeting.arrive_and_drop();
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(alone[i].trouble, "");
        EXPECT_EQ(together[i].trouble, "");
        EXPECT_EQ(together[i].hash, alone[i].hash) << "thread " << i;
    }
    EXPECT_NE(alone[0].hash, alone[1].hash);
}

TEST(Contexts, BackendsAreCheckedWhenTheyRegister) {
    faulty();
    plait_backend_api api = *plait_backend_get(plait_backend_count() - 1);
    const auto refused = [&](const char* word) {
        EXPECT_EQ(plait_backend_register(&api), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(word), std::string::npos)
            << plait_last_error();
    };
    refused("taken");
    api.name = "reference";
    refused("built-in");
    api.name = "";
    refused("name");
    api.name = "fine";
    api.abi = PLAIT_BACKEND_ABI + 1;
    refused("abi");
    api.abi = PLAIT_BACKEND_ABI;
    api.struct_size -= 1;
    refused("struct_size");
    api.struct_size += 1;
    api.open = nullptr;
    refused("open is NULL");
    EXPECT_EQ(plait_backend_get(plait_backend_count()), nullptr);
}

TEST(Contexts, ModulesWithoutAnEntryAreRefused) {
    EXPECT_EQ(plait_backend_load("/nowhere/libbackend.so"), PLAIT_NOT_FOUND);
#ifdef _WIN32
    const char* const other = "kernel32.dll";
#else
    const char* const other = "libm.so.6";
#endif
    EXPECT_EQ(plait_backend_load(other), PLAIT_UNSUPPORTED);
    EXPECT_NE(std::string(plait_last_error()).find("plait_backend_entry_v1"), std::string::npos);
}

TEST(Contexts, TheStageTableDescribesEveryStage) {
    for (int i = 0; i < PLAIT_STAGE_COUNT; ++i) {
        const auto* info = plait_stage_describe(static_cast<plait_stage>(i));
        ASSERT_NE(info, nullptr);
        EXPECT_EQ(info->stage, i);
        EXPECT_EQ(std::string(info->kernel), std::string("plait_") + info->name);
        EXPECT_GT(info->params_size, 0u);
        EXPECT_LE(info->buffer_count, info->arg_count);
    }
    EXPECT_EQ(plait_stage_describe(PLAIT_STAGE_COUNT), nullptr);
    const auto* length = plait_stage_describe(PLAIT_STAGE_length);
    EXPECT_EQ(length->arg_count, 4u);
    EXPECT_EQ(length->buffer_count, 3u);
    EXPECT_EQ(length->space, PLAIT_SPACE_STRAND_GROUP);
}

TEST(Contexts, VersionAndResultsHaveText) {
    static_assert(PLAIT_VERSION_NUMBER == 200, "0.2.0");
    EXPECT_EQ(plait_version(), uint32_t(PLAIT_VERSION_NUMBER));
    EXPECT_STREQ(plait_result_string(PLAIT_OK), "ok");
    EXPECT_STREQ(plait_result_string(static_cast<plait_result>(99)), "not a result of plait");
}

} // namespace
