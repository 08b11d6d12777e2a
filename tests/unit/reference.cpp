// What the reference backend promises beside its arithmetic: it says what is wrong with a dispatch,
// survives the end of memory, and keeps float64 between dispatches. Its arithmetic is checked by
// tests/conformance/stages.
#include "backend/builtin.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <new>
#include <string>
#include <vector>

namespace {

struct Counter {
    int left = 1000; // allocations that still succeed
    long held = 0;   // bytes not yet released
};

void* count_allocate(size_t size, size_t alignment, void* user) {
    auto& counter = *static_cast<Counter*>(user);
    if (counter.left-- <= 0)
        return nullptr;
    counter.held += static_cast<long>(size);
    return ::operator new(size, std::align_val_t(alignment), std::nothrow);
}

void count_release(void* memory, size_t size, size_t alignment, void* user) {
    static_cast<Counter*>(user)->held -= static_cast<long>(size);
    ::operator delete(memory, std::align_val_t(alignment));
}

class Reference : public testing::Test {
  protected:
    Reference() {
        plait_open_info info = {};
        info.struct_size = sizeof info;
        info.profile = 1;
        info.allocator = {count_allocate, count_release, &counter};
        char error[200] = "";
        EXPECT_EQ(backend.open(&info, &device, error, sizeof error), PLAIT_OK) << error;
    }
    ~Reference() override {
        for (plait_buffer* buffer : buffers)
            api.buffer_destroy(device, buffer);
        api.destroy(device);
        EXPECT_EQ(counter.held, 0);
    }

    plait_buffer* make(plait_element element, size_t count, const void* contents = nullptr) {
        const plait_buffer_desc desc = {element, count, "some"};
        plait_buffer* buffer = nullptr;
        EXPECT_EQ(api.buffer_create(device, &desc, &buffer), PLAIT_OK);
        if (contents) {
            EXPECT_EQ(api.buffer_write(device, buffer, 0, count, contents), PLAIT_OK);
        }
        buffers.push_back(buffer);
        return buffer;
    }

    template <typename P>
    plait_result submit(plait_stage stage, uint32_t items, const P& params,
                        std::vector<plait_buffer*> list, uint32_t width = 1) {
        const plait_dispatch dispatch = {
            stage,       items, width, &params, sizeof params, static_cast<uint32_t>(list.size()),
            list.data(), 0};
        return api.submit(device, &dispatch, 1);
    }

    // The submit is refused and the sentence contains every one of `parts`.
    void refused(plait_result result, const std::vector<std::string>& parts) {
        EXPECT_EQ(result, PLAIT_INVALID_ARGUMENT);
        const std::string said = api.last_error(device);
        for (const std::string& part : parts)
            EXPECT_NE(said.find(part), std::string::npos) << said << " lacks " << part;
    }

    const plait_backend_api& backend = *plait::reference_backend();
    const plait_device_api& api = *backend.device;
    Counter counter;
    plait_device* device = nullptr;
    std::vector<plait_buffer*> buffers;
};

TEST_F(Reference, IsTheLastChoice) {
    EXPECT_GE(backend.score(), 0);
    EXPECT_LT(backend.score(), 100); // an OpenCL device's
    size_t count = 0;
    EXPECT_EQ(backend.enumerate(nullptr, &count), PLAIT_OK);
    EXPECT_EQ(count, 1u);
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage)
        EXPECT_TRUE(api.supports(device, static_cast<plait_stage>(stage)));
    EXPECT_FALSE(api.supports(device, PLAIT_STAGE_COUNT));
}

TEST_F(Reference, HasOneDevice) {
    plait_open_info info = {};
    info.struct_size = sizeof info;
    info.device_index = 1;
    plait_device* other = nullptr;
    char error[200] = "";
    EXPECT_EQ(backend.open(&info, &other, error, sizeof error), PLAIT_NOT_FOUND);
    EXPECT_NE(std::string(error).find("device 1"), std::string::npos) << error;
}

TEST_F(Reference, GivesBackWhatWasWritten) {
    const std::array<float, 8> values = {0, -1, 1e-40f, 3.4e38f, 0.1f, 5, 6, 7};
    plait_buffer* buffer = make(PLAIT_ELEMENT_FLOAT4, 2, values.data());
    std::array<float, 4> second = {};
    EXPECT_EQ(api.buffer_read(device, buffer, 1, 1, second.data()), PLAIT_OK);
    EXPECT_EQ(second, (std::array<float, 4>{0.1f, 5, 6, 7}));
    refused(api.buffer_read(device, buffer, 1, 2, second.data()), {"'some'", "1..3 of 2"});
    refused(api.buffer_write(device, buffer, 3, 0, second.data()), {"'some'", "of 2"});
}

TEST_F(Reference, UnwrittenContentsShow) {
    float value = 0;
    EXPECT_EQ(api.buffer_read(device, make(PLAIT_ELEMENT_FLOAT, 1), 0, 1, &value), PLAIT_OK);
    EXPECT_TRUE(std::isnan(value));
}

TEST_F(Reference, SaysWhatIsWrongWithADispatch) {
    const plait_clamp_params params = {4, 1};
    plait_buffer* eight = make(PLAIT_ELEMENT_FLOAT4, 8);
    plait_buffer* seven = make(PLAIT_ELEMENT_FLOAT4, 7);
    plait_buffer* words = make(PLAIT_ELEMENT_UINT, 8);
    const auto stage = PLAIT_STAGE_clamp;
    EXPECT_EQ(submit(stage, 8, params, {eight, eight}), PLAIT_OK);
    refused(submit(stage, 8, params, {eight, seven}), {"clamp", "position", "'some'", "7", "8"});
    refused(submit(stage, 8, params, {eight, words}), {"clamp", "position", "uint", "float4"});
    refused(submit(stage, 8, params, {eight, nullptr}), {"clamp", "position is null"});
    refused(submit(stage, 8, params, {eight}), {"clamp", "position", "1 buffers"});
    refused(submit(stage, 8, params, {eight, eight, eight}), {"clamp", "3 buffers"});
    refused(submit(stage, 8, params, {eight, eight}, 4), {"clamp", "item_width is 4"});
    refused(submit(stage, 8, plait_clamp_params{257, 1}, {eight, eight}),
            {"clamp", "vertex_stride is 257", "2..256"});
    refused(submit(stage, 8, plait_layout_params{4}, {eight, eight}), {"clamp", "params of 4"});
    refused(submit(PLAIT_STAGE_COUNT, 8, params, {eight, eight}), {"does not exist"});
}

TEST_F(Reference, ChecksWhatTheDataSay) {
    const uint32_t count = 5, guide = 3;
    plait_buffer* counts = make(PLAIT_ELEMENT_UINT, 1, &count);
    plait_buffer* rows = make(PLAIT_ELEMENT_FLOAT4, 8);
    refused(submit(PLAIT_STAGE_tangents, 4, plait_tangents_params{4, 0}, {counts, rows, rows}),
            {"tangents", "vertex_count[0] is 5", "2..4"});
    refused(submit(PLAIT_STAGE_tressfx_follow, 4, plait_tressfx_follow_params{4, 1, 0, 0},
                   {rows, rows, counts, make(PLAIT_ELEMENT_UINT, 1, &guide), rows, rows}),
            {"tressfx_follow", "follow_guide[0] is 3"});
    const uint32_t guides[] = {0, 0, 7, 0};
    refused(submit(PLAIT_STAGE_follow_turns, 1, plait_follow_turns_params{4, 1, 1},
                   {nullptr, rows, rows, make(PLAIT_ELEMENT_UINT, 4, guides), rows,
                    make(PLAIT_ELEMENT_FLOAT, 16), make(PLAIT_ELEMENT_FLOAT, 16), rows},
                   4),
            {"follow_turns", "follow_guides[2] is 7", "1 guides"});
    plait_grid_params grid = {};
    grid.vertex_stride = 2;
    grid.edge_count = grid.capacity = 1;
    grid.voxel_edge = grid.h = 1;
    const uint32_t vertex = 8;
    refused(submit(PLAIT_STAGE_grid_density, 1, grid,
                   {make(PLAIT_ELEMENT_UINT, 1, &vertex), rows, make(PLAIT_ELEMENT_FLOAT, 1)}),
            {"grid_density", "position", "element 8 of 8"});
}

TEST_F(Reference, SurvivesTheEndOfMemory) {
    counter.left = 0;
    const plait_buffer_desc desc = {PLAIT_ELEMENT_FLOAT, 100, "big"};
    plait_buffer* buffer = nullptr;
    EXPECT_EQ(api.buffer_create(device, &desc, &buffer), PLAIT_OUT_OF_MEMORY);
    EXPECT_EQ(buffer, nullptr);
    EXPECT_NE(std::string(api.last_error(device)).find("'big'"), std::string::npos);
    counter.left = 1; // the object, but not its elements
    EXPECT_EQ(api.buffer_create(device, &desc, &buffer), PLAIT_OUT_OF_MEMORY);
    counter.left = 1000;
    const plait_buffer_desc endless = {PLAIT_ELEMENT_FLOAT4, SIZE_MAX / 16, "endless"};
    EXPECT_NE(api.buffer_create(device, &endless, &buffer), PLAIT_OK);
    make(PLAIT_ELEMENT_FLOAT, 100);
}

// 1024 steps of 2^-24 m beside 1 m, half of what float32 can tell apart there.
TEST_F(Reference, KeepsFloat64BetweenDispatches) {
    const std::array<float, 8> start = {1, 0, 0, 1, 1, 0, 0, 1};
    std::array<float, 8> before = start;
    before[0] = before[4] = 1 - 0x1p-24f;
    const uint32_t count = 2;
    plait_buffer* rest = make(PLAIT_ELEMENT_FLOAT4, 2, start.data());
    plait_buffer* x = make(PLAIT_ELEMENT_FLOAT4, 2, start.data());
    plait_buffer* prev = make(PLAIT_ELEMENT_FLOAT4, 2, before.data());
    plait_buffer* prev2 = make(PLAIT_ELEMENT_FLOAT4, 2, before.data());
    plait_buffer* counts = make(PLAIT_ELEMENT_UINT, 1, &count);
    plait_buffer* pose = make(PLAIT_ELEMENT_FLOAT4, 2, start.data());
    const plait_integrate_params params = {2, 1, 0, 0, 0, {0, 0, 0}, 0};
    plait_buffer* const acceleration = nullptr;
    for (int step = 0; step < 1024; ++step)
        ASSERT_EQ(submit(PLAIT_STAGE_integrate, 2, params,
                         {rest, counts, pose, acceleration, x, prev, prev2}),
                  PLAIT_OK);
    std::array<float, 8> end = {};
    EXPECT_EQ(api.buffer_read(device, x, 0, 2, end.data()), PLAIT_OK);
    EXPECT_EQ(end[0], 1 + 0x1p-14f);
}

TEST_F(Reference, CountsAndTimesStages) {
    const plait_clamp_params params = {2, 1};
    plait_buffer* rows = make(PLAIT_ELEMENT_FLOAT4, 2000);
    EXPECT_EQ(submit(PLAIT_STAGE_clamp, 2000, params, {rows, rows}), PLAIT_OK);
    std::array<plait_stage_cost, PLAIT_STAGE_COUNT> costs = {};
    EXPECT_EQ(api.stage_costs(device, costs.data(), 1), PLAIT_OK);
    EXPECT_EQ(costs[PLAIT_STAGE_clamp].calls, 1u);
    EXPECT_GT(costs[PLAIT_STAGE_clamp].seconds, 0);
    EXPECT_EQ(costs[PLAIT_STAGE_tressfx_wind].calls, 0u);
    EXPECT_EQ(api.stage_costs(device, costs.data(), 0), PLAIT_OK);
    EXPECT_EQ(costs[PLAIT_STAGE_clamp].calls, 0u);
}

} // namespace
