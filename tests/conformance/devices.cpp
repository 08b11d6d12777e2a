// Memory, lists of stages, costs, adopted queues and failures, on each device.
#include "support.hpp"

#include "backend/builtin.hpp"

#include <plait/plait_opencl.h>

#include <chrono>
#include <string_view>

namespace plait::opencl {
namespace {

class Devices : public OnDevice {
  protected:
    std::unique_ptr<Device> open(const OpenOptions& options = {}) {
        auto device = open_device(GetParam(), options);
        EXPECT_TRUE(device.ok()) << device.error().message;
        return std::move(*device);
    }
};
INSTANTIATE_TEST_SUITE_P(Devices, Devices, ::testing::ValuesIn(device_indices()), test_name);

// A buffer of words and the stage that fills it.
class Words {
  public:
    Words(Device& device, uint32_t count) : device_(device), count_(count) {
        auto buffer = device.create({PLAIT_ELEMENT_UINT, count, "words"});
        EXPECT_TRUE(buffer.ok()) << buffer.error().message;
        buffer_ = std::move(*buffer);
    }

    Status fill(uint32_t value) { return submit(value, count_); }

    Status submit(uint32_t value, uint32_t item_count) {
        const plait_grid_clear_params params{value};
        plait_buffer* const buffers[] = {reinterpret_cast<plait_buffer*>(buffer_.get())};
        const plait_dispatch dispatch{PLAIT_STAGE_grid_clear, item_count, 1,       &params,
                                      sizeof params,          1,          buffers, 0};
        return device_.submit({&dispatch, 1});
    }

    std::vector<uint32_t> read() {
        std::vector<uint32_t> words(count_);
        const Status status = device_.read(*buffer_, 0, count_, words.data());
        EXPECT_TRUE(status.ok()) << status.error().message;
        return words;
    }

    Buffer& buffer() { return *buffer_; }

  private:
    Device& device_;
    uint32_t count_;
    std::unique_ptr<Buffer> buffer_;
};

TEST(Enumeration, finds_a_device_and_says_why_others_are_not_used) {
    const Candidates found = find_devices();
    EXPECT_FALSE(found.usable.empty());
    for (const std::string& reason : found.rejected)
        EXPECT_NE(reason.find(": "), reason.npos) << reason;
}

TEST(Enumeration, writes_no_more_than_asked) {
    plait_device_info info{};
    size_t count = 0;
    ASSERT_EQ(opencl_backend()->enumerate(&info, &count), PLAIT_OK);
    EXPECT_EQ(count, 0u);
    EXPECT_STREQ(info.backend, "");
    ASSERT_EQ(opencl_backend()->enumerate(nullptr, &count), PLAIT_OK);
    EXPECT_EQ(count, find_devices().usable.size());
}

TEST_P(Devices, keep_what_is_written) {
    const auto device = open();
    Words words(*device, 100);
    ASSERT_TRUE(words.fill(5).ok());
    const uint32_t part[] = {1, 2, 3};
    ASSERT_TRUE(device->write(words.buffer(), 97, 3, part).ok());
    const auto read = words.read();
    EXPECT_EQ(read[96], 5u);
    EXPECT_EQ(read[97], 1u);
    EXPECT_EQ(read[99], 3u);
    const Status beyond = device->write(words.buffer(), 98, 3, part);
    EXPECT_EQ(beyond.error().code, PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(beyond.error().message, "write to buffer words: elements 98 to 101 of 100");
}

TEST_P(Devices, leave_items_beyond_the_count_alone) {
    const auto device = open();
    Words words(*device, 200);
    ASSERT_TRUE(words.fill(7).ok());
    ASSERT_TRUE(words.submit(9, 101).ok()); // no multiple of any work-group
    const auto read = words.read();
    EXPECT_EQ(std::ranges::count(read, 9u), 101);
    EXPECT_EQ(std::ranges::count(read, 7u), 99);
    ASSERT_TRUE(words.submit(1, 0).ok());
    EXPECT_EQ(words.read(), read);
}

TEST_P(Devices, count_calls_and_measure_them_when_profiling) {
    const auto timed = open({.profile = true});
    Words words(*timed, 4096);
    const auto start = std::chrono::steady_clock::now();
    for (uint32_t value = 0; value < 5; ++value)
        ASSERT_TRUE(words.fill(value).ok());
    plait_stage_cost costs[PLAIT_STAGE_COUNT] = {};
    ASSERT_TRUE(timed->costs(costs, true).ok());
    EXPECT_EQ(costs[PLAIT_STAGE_grid_clear].calls, 5u);
    // The events of rusticl (Mesa 22.3) carry no times.
    const bool has_times = std::string_view(timed->info().platform) != "rusticl";
    EXPECT_TRUE(!has_times || costs[PLAIT_STAGE_grid_clear].seconds > 0);
    EXPECT_LT(std::chrono::duration<double>(costs[PLAIT_STAGE_grid_clear].seconds),
              std::chrono::steady_clock::now() - start);
    EXPECT_EQ(costs[PLAIT_STAGE_tressfx_wind].calls, 0u);
    ASSERT_TRUE(timed->costs(costs, false).ok());
    EXPECT_EQ(costs[PLAIT_STAGE_grid_clear].calls, 0u);

    const auto plain = open();
    Words others(*plain, 64);
    ASSERT_TRUE(others.fill(1).ok());
    ASSERT_TRUE(plain->costs(costs, false).ok());
    EXPECT_EQ(costs[PLAIT_STAGE_grid_clear].calls, 1u);
    EXPECT_EQ(costs[PLAIT_STAGE_grid_clear].seconds, 0.0);
}

TEST_P(Devices, side_by_side_do_not_meet) {
    const auto one = open(), two = open();
    Words first(*one, 64), second(*two, 64);
    ASSERT_TRUE(first.fill(1).ok());
    ASSERT_TRUE(second.fill(2).ok());
    EXPECT_EQ(std::ranges::count(first.read(), 1u), 64);
    EXPECT_EQ(std::ranges::count(second.read(), 2u), 64);
    EXPECT_NE(one->queue(), two->queue());
}

TEST_P(Devices, refuse_a_dispatch_that_does_not_fit_its_stage) {
    const auto device = open();
    const plait_tangents_params params{32, 0};
    plait_buffer* const none[3] = {};
    plait_dispatch dispatch{PLAIT_STAGE_tangents, 1, 1, &params, sizeof params, 2, none, 0};
    EXPECT_EQ(device->submit({&dispatch, 1}).error().message,
              "stage tangents: 2 buffers, it has 3");
    dispatch.buffer_count = 3;
    dispatch.params_size = 4;
    EXPECT_EQ(device->submit({&dispatch, 1}).error().message,
              "stage tangents: parameters of 4 bytes, plait_tangents_params has 8");
}

// ---- the caller's own context and queue ---------------------------------------------------------

struct Own {
    explicit Own(uint32_t index, cl_command_queue_properties properties = 0) {
        device = find_devices().usable[index].device;
        cl_int code = CL_SUCCESS;
        context = Context(clCreateContext(nullptr, 1, &device, nullptr, nullptr, &code));
        EXPECT_EQ(code, CL_SUCCESS);
        queue = Queue(clCreateCommandQueue(context.get(), device, properties, &code));
    }

    plait_opencl_handles handles() const { return {context.get(), device, queue.get()}; }

    cl_device_id device;
    Context context;
    Queue queue;
};

TEST_P(Devices, work_on_an_adopted_queue_and_lend_their_memory) {
    const Own own(GetParam());
    ASSERT_TRUE(own.queue);
    const plait_opencl_handles handles = own.handles();
    auto device = open({.native = &handles});
    EXPECT_EQ(device->queue(), own.queue.get());
    Words words(*device, 64);
    ASSERT_TRUE(words.fill(3).ok());

    // The caller's own command, on the caller's queue, reads plait's memory after plait's work.
    uint32_t read[64] = {};
    cl_mem borrowed = words.buffer().memory.get();
    ASSERT_EQ(clEnqueueReadBuffer(own.queue.get(), borrowed, CL_TRUE, 0, sizeof read, read, 0,
                                  nullptr, nullptr),
              CL_SUCCESS);
    EXPECT_EQ(std::ranges::count(read, 3u), 64);
}

TEST_P(Devices, let_go_of_adopted_handles) {
    const Own own(GetParam());
    const plait_opencl_handles handles = own.handles();
    const auto references = [&] {
        cl_uint count = 0;
        clGetCommandQueueInfo(own.queue.get(), CL_QUEUE_REFERENCE_COUNT, sizeof count, &count,
                              nullptr);
        return count;
    };
    const cl_uint before = references();
    auto device = open({.native = &handles});
    EXPECT_GT(references(), before);
    device.reset();
    EXPECT_EQ(references(), before);
}

TEST_P(Devices, refuse_handles_that_do_not_belong_together) {
    const Own own(GetParam()), other(GetParam());
    plait_opencl_handles handles = own.handles();
    handles.context = other.context.get();
    const auto mixed = open_device(GetParam(), {.native = &handles});
    ASSERT_FALSE(mixed.ok());
    EXPECT_EQ(mixed.error().code, PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(mixed.error().message, "plait_opencl_handles: the queue belongs to another context");
    handles = {};
    EXPECT_FALSE(open_device(GetParam(), {.native = &handles}).ok());
}

TEST_P(Devices, refuse_an_out_of_order_queue) {
    const Own own(GetParam(), CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
    if (!own.queue)
        return; // the device has no such queues, so none can reach plait
    const plait_opencl_handles handles = own.handles();
    const auto device = open_device(GetParam(), {.native = &handles});
    ASSERT_FALSE(device.ok());
    EXPECT_EQ(device.error().code, PLAIT_INVALID_ARGUMENT);
}

TEST_P(Devices, say_when_an_adopted_queue_cannot_be_timed) {
    const Own own(GetParam());
    const plait_opencl_handles handles = own.handles();
    std::string log;
    const auto device = open({.native = &handles, .profile = true, .log = &log});
    EXPECT_NE(log.find("CL_QUEUE_PROFILING_ENABLE"), log.npos) << log;
    Words words(*device, 64);
    EXPECT_TRUE(words.fill(1).ok());
    plait_stage_cost costs[PLAIT_STAGE_COUNT] = {};
    ASSERT_TRUE(device->costs(costs, false).ok());
    EXPECT_EQ(costs[PLAIT_STAGE_grid_clear].seconds, 0.0);
}

// ---- failures -----------------------------------------------------------------------------------

cl_mem CL_API_CALL no_memory(cl_context, cl_mem_flags, size_t, void*, cl_int* code) {
    *code = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return nullptr;
}

cl_int CL_API_CALL out_of_resources(cl_command_queue) {
    return CL_OUT_OF_RESOURCES;
}

cl_int CL_API_CALL no_room_for_kernel(cl_command_queue, cl_kernel, cl_uint, const size_t*,
                                      const size_t*, const size_t*, cl_uint, const cl_event*,
                                      cl_event*) {
    return CL_MEM_OBJECT_ALLOCATION_FAILURE;
}

TEST_P(Devices, name_the_buffer_that_does_not_fit) {
    const auto device = open({.calls = {.create_buffer = no_memory}});
    const auto buffer = device->create({PLAIT_ELEMENT_FLOAT4, 1000, "position"});
    ASSERT_FALSE(buffer.ok());
    EXPECT_EQ(buffer.error().code, PLAIT_OUT_OF_MEMORY);
    EXPECT_EQ(buffer.error().message,
              "buffer position of 1000 x 16 bytes: CL_MEM_OBJECT_ALLOCATION_FAILURE (-4)");
}

TEST_P(Devices, refuse_a_buffer_larger_than_any_memory) {
    const auto device = open();
    const auto huge = device->create({PLAIT_ELEMENT_FLOAT4, SIZE_MAX / 2, "position"});
    ASSERT_FALSE(huge.ok());
    EXPECT_EQ(huge.error().code, PLAIT_OUT_OF_MEMORY);
    const auto large = device->create({PLAIT_ELEMENT_FLOAT4, size_t{1} << 48, "position"});
    ASSERT_FALSE(large.ok());
    EXPECT_EQ(large.error().code, PLAIT_OUT_OF_MEMORY) << large.error().message;
}

TEST_P(Devices, report_memory_that_runs_out_late) {
    const auto device = open({.calls = {.enqueue_kernel = no_room_for_kernel}});
    Words words(*device, 64);
    const Status status = words.fill(1);
    EXPECT_EQ(status.error().code, PLAIT_OUT_OF_MEMORY);
    EXPECT_NE(status.error().message.find("stage grid_clear"), std::string::npos);
}

TEST_P(Devices, stay_lost) {
    const auto device = open({.calls = {.finish = out_of_resources}});
    auto* handle = reinterpret_cast<plait_device*>(device.get());
    const plait_device_api& api = *opencl_backend()->device;
    plait_buffer* buffer = nullptr;
    const plait_buffer_desc desc{PLAIT_ELEMENT_UINT, 4, "words"};
    ASSERT_EQ(api.buffer_create(handle, &desc, &buffer), PLAIT_OK);
    EXPECT_EQ(api.wait(handle), PLAIT_DEVICE_LOST);
    const std::string reason = api.last_error(handle);
    EXPECT_EQ(reason, "waiting for the device: CL_OUT_OF_RESOURCES (-5)");
    uint32_t word = 0;
    EXPECT_EQ(api.buffer_read(handle, buffer, 0, 1, &word), PLAIT_DEVICE_LOST);
    EXPECT_EQ(api.submit(handle, nullptr, 0), PLAIT_DEVICE_LOST);
    EXPECT_EQ(api.last_error(handle), reason);
    api.buffer_destroy(handle, buffer);
}

// A command that the driver says has failed: an event of our own with a negative status.
cl_int CL_API_CALL fails_later(cl_command_queue queue, cl_kernel, cl_uint, const size_t*,
                               const size_t*, const size_t*, cl_uint, const cl_event*,
                               cl_event* event) {
    cl_context context = nullptr;
    clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof(cl_context), &context, nullptr);
    cl_int code = CL_SUCCESS;
    *event = clCreateUserEvent(context, &code);
    return code == CL_SUCCESS ? clSetUserEventStatus(*event, CL_OUT_OF_RESOURCES) : code;
}

TEST_P(Devices, report_at_wait_what_failed_meanwhile) {
    const auto device = open({.calls = {.enqueue_kernel = fails_later}});
    Words words(*device, 64);
    ASSERT_TRUE(words.fill(1).ok());
    const Status status = device->wait();
    EXPECT_EQ(status.error().code, PLAIT_DEVICE_LOST);
    EXPECT_EQ(status.error().message,
              "stage grid_clear ended with an error: CL_OUT_OF_RESOURCES (-5)");
}

} // namespace
} // namespace plait::opencl
