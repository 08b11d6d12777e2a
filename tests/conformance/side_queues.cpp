// Sequences that overlap: each in its order, behind what came before them and before what follows.
#include "support.hpp"

#include <plait/plait_opencl.h>

namespace plait::opencl {
namespace {

int flushes = 0;

cl_int CL_API_CALL counted_flush(cl_command_queue queue) {
    ++flushes;
    return clFlush(queue);
}

constexpr uint32_t words = 200000; // of each sequence; a fill takes longer than its enqueueing
constexpr uint32_t sequences = 40;

class Overlapping : public OnDevice {
  protected:
    void open(const OpenOptions& options = {}) {
        auto opened = open_device(GetParam(), options);
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        device = std::move(*opened);
        for (uint32_t i = 0; i < sequences; ++i) {
            auto buffer = device->create({PLAIT_ELEMENT_UINT, words, "words"});
            ASSERT_TRUE(buffer.ok()) << buffer.error().message;
            buffers.push_back(std::move(*buffer));
        }
    }

    // The first `count` words become `value`.
    void fill(uint32_t buffer, uint32_t count, uint32_t value) {
        const plait_grid_clear_params params{value};
        plait_buffer* const list[] = {reinterpret_cast<plait_buffer*>(buffers[buffer].get())};
        const plait_dispatch dispatch{PLAIT_STAGE_grid_clear, count, 1,    &params,
                                      sizeof params,          1,     list, 0};
        const Status status = device->submit({&dispatch, 1});
        EXPECT_TRUE(status.ok()) << status.error().message;
    }
    void expect_ok(const Status& status) { EXPECT_TRUE(status.ok()) << status.error().message; }

    // Buffer i: words[0] uploaded as i, then i + 100 up to half of them, the rest as it was.
    void overlap() {
        for (uint32_t i = 0; i < sequences; ++i) {
            expect_ok(device->overlap(i == 0 ? PLAIT_OVERLAP_BEGIN : PLAIT_OVERLAP_NEXT));
            const uint32_t fills = i + 2 < sequences ? 5 : 500; // others have long ended by then
            for (uint32_t value = 0; value < fills; ++value)
                fill(i, words / 2, value);
            fill(i, words / 2, i + 100);
            expect_ok(device->upload(*buffers[i], 0, 1, &i));
        }
        expect_ok(device->overlap(PLAIT_OVERLAP_END));
    }
    void expect_overlapped(const std::vector<uint32_t>& read, uint32_t i, uint32_t rest) {
        EXPECT_EQ(read[0], i);
        EXPECT_EQ(std::ranges::count(read, i + 100), words / 2 - 1) << i;
        EXPECT_EQ(std::ranges::count(read, rest), words / 2) << i;
    }
    std::vector<uint32_t> read(uint32_t i) {
        std::vector<uint32_t> list(words);
        expect_ok(device->read(*buffers[i], 0, words, list.data()));
        return list;
    }

    std::unique_ptr<Device> device;
    std::vector<std::unique_ptr<Buffer>> buffers;
};
INSTANTIATE_TEST_SUITE_P(Devices, Overlapping, ::testing::ValuesIn(device_indices()), test_name);

TEST_P(Overlapping, keep_their_order_and_that_of_what_is_around_them) {
    open();
    for (uint32_t round = 0; round < 5; ++round) {
        for (uint32_t i = 0; i < sequences; ++i)
            fill(i, words, 7000 + round);
        overlap();
        for (uint32_t i = 0; i < sequences; ++i)
            expect_overlapped(read(i), i, 7000 + round);
    }
    EXPECT_GE(device->side_queues().size(), size_t{SideQueues::least});
    EXPECT_LE(device->side_queues().size(), size_t{SideQueues::most});
}

TEST_P(Overlapping, are_over_when_a_later_command_begins) {
    open();
    overlap();
    for (uint32_t i = 0; i < sequences; ++i)
        fill(i, words, i + 1);
    for (uint32_t i = 0; i < sequences; ++i)
        EXPECT_EQ(std::ranges::count(read(i), i + 1), words) << i;
}

// One for each queue, not for each list; one before, for the marker that they wait for, and one
// after.
TEST_P(Overlapping, are_flushed_together) {
    open({.calls = {.flush = counted_flush}});
    flushes = 0;
    overlap();
    EXPECT_EQ(flushes, static_cast<int>(device->side_queues().size()) + 2);
    expect_ok(device->wait());
}

TEST_P(Overlapping, take_no_queue_that_they_do_not_need) {
    open();
    fill(0, words, 1);
    EXPECT_EQ(device->side_queues().size(), 0u);
    expect_ok(device->overlap(PLAIT_OVERLAP_BEGIN));
    fill(0, words, 2);
    expect_ok(device->overlap(PLAIT_OVERLAP_END));
    EXPECT_EQ(device->side_queues().size(), 1u);
    EXPECT_EQ(std::ranges::count(read(0), 2u), words);
}

// The caller's next command on the caller's own queue is behind all of them.
TEST_P(Overlapping, end_on_an_adopted_queue) {
    cl_device_id id = find_devices().usable[GetParam()].device;
    cl_int code = CL_SUCCESS;
    const Context context(clCreateContext(nullptr, 1, &id, nullptr, nullptr, &code));
    const Queue queue(clCreateCommandQueue(context.get(), id, 0, &code));
    ASSERT_TRUE(queue);
    const plait_opencl_handles handles{context.get(), id, queue.get()};
    open({.native = &handles});
    for (uint32_t i = 0; i < sequences; ++i)
        fill(i, words, 7000);
    overlap();
    for (uint32_t i = 0; i < sequences; ++i) {
        std::vector<uint32_t> list(words);
        ASSERT_EQ(clEnqueueReadBuffer(queue.get(), buffers[i]->memory.get(), CL_TRUE, 0, 4 * words,
                                      list.data(), 0, nullptr, nullptr),
                  CL_SUCCESS);
        expect_overlapped(list, i, 7000);
    }
}

cl_int CL_API_CALL no_room(cl_command_queue, cl_kernel, cl_uint, const size_t*, const size_t*,
                           const size_t*, cl_uint, const cl_event*, cl_event*) {
    return CL_MEM_OBJECT_ALLOCATION_FAILURE;
}

TEST_P(Overlapping, end_after_a_failure) {
    open({.calls = {.enqueue_kernel = no_room}});
    expect_ok(device->overlap(PLAIT_OVERLAP_BEGIN));
    const uint32_t five = 5;
    expect_ok(device->upload(*buffers[0], 0, 1, &five));
    plait_grid_clear_params params{1};
    plait_buffer* const list[] = {reinterpret_cast<plait_buffer*>(buffers[0].get())};
    const plait_dispatch dispatch{PLAIT_STAGE_grid_clear, words, 1,    &params,
                                  sizeof params,          1,     list, 0};
    EXPECT_EQ(device->submit({&dispatch, 1}).error().code, PLAIT_OUT_OF_MEMORY);
    expect_ok(device->overlap(PLAIT_OVERLAP_END));
    EXPECT_EQ(read(0)[0], 5u);
    EXPECT_FALSE(device->side_queues().open());
}

} // namespace
} // namespace plait::opencl
