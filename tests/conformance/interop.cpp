// The public API of interop: plait on the caller's queue, its fields as the caller's cl_mem.
#include "owned.hpp"
#include "support.hpp"

#include <plait/plait_opencl.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <tuple>

namespace plait::opencl {
namespace {

constexpr uint32_t vertices = 8;

OwnGroom two_strands() {
    std::vector<float> positions;
    for (uint32_t vertex = 0; vertex < 2 * vertices; ++vertex)
        positions.insert(positions.end(), {vertex < vertices ? 0.0f : 0.01f,
                                           -0.01f * static_cast<float>(vertex % vertices), 0.0f});
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {positions.data(), 2 * vertices, 0};
    desc.vertices_per_strand = vertices;
    plait_groom* groom = nullptr;
    EXPECT_EQ(plait_groom_create(&desc, nullptr, &groom), PLAIT_OK) << plait_last_error();
    return OwnGroom(groom);
}

OwnSim make_sim(plait_context* context) {
    const OwnGroom groom = two_strands();
    plait_sim_desc desc = plait_sim_desc_defaults();
    desc.model = PLAIT_MODEL_TRESSFX; // its stages are the soonest compiled
    plait_sim* sim = nullptr;
    EXPECT_EQ(plait_sim_create(context, groom.get(), &desc, &sim), PLAIT_OK) << plait_last_error();
    return OwnSim(sim);
}

class Interop : public OnDevice {
  protected:
    void SetUp() override {
        device_ = find_devices().usable[GetParam()].device;
        cl_int code = CL_SUCCESS;
        context_ = Context(clCreateContext(nullptr, 1, &device_, nullptr, nullptr, &code));
        ASSERT_EQ(code, CL_SUCCESS);
        queue_ = Queue(clCreateCommandQueue(context_.get(), device_, 0, &code));
        ASSERT_EQ(code, CL_SUCCESS);
    }

    OwnContext adopt() {
        const plait_opencl_handles handles{context_.get(), device_, queue_.get()};
        plait_context* context = nullptr;
        EXPECT_EQ(plait_opencl_context_create(&handles, nullptr, &context), PLAIT_OK)
            << plait_last_error();
        return OwnContext(context);
    }

    cl_device_id device_ = nullptr;
    Context context_;
    Queue queue_;
};
INSTANTIATE_TEST_SUITE_P(Devices, Interop, ::testing::ValuesIn(device_indices()), test_name);

TEST_P(Interop, works_on_the_callers_queue) {
    const OwnContext context = adopt();
    cl_command_queue queue = nullptr;
    ASSERT_EQ(plait_opencl_context_get_queue(context.get(), &queue), PLAIT_OK);
    EXPECT_EQ(queue, queue_.get());
}

TEST_P(Interop, lends_what_read_gives) {
    const OwnContext context = adopt();
    const OwnSim sim = make_sim(context.get());
    ASSERT_EQ(plait_sim_step(sim.get(), 0.1), PLAIT_OK) << plait_last_error();

    // No plait_sim_wait: the queue's order is enough.
    cl_mem memory = nullptr;
    ASSERT_EQ(plait_opencl_sim_get_field(sim.get(), PLAIT_FIELD_POSITION, &memory), PLAIT_OK);
    std::vector<float> borrowed(size_t{4} * 2 * vertices), read(borrowed.size());
    size_t size = read.size() * sizeof(float);
    ASSERT_EQ(clEnqueueReadBuffer(queue_.get(), memory, CL_TRUE, 0, size, borrowed.data(), 0,
                                  nullptr, nullptr),
              CL_SUCCESS);
    ASSERT_EQ(plait_sim_read(sim.get(), PLAIT_FIELD_POSITION, read.data(), &size), PLAIT_OK);
    EXPECT_EQ(borrowed, read);
    EXPECT_NE(read[4 * (vertices - 1) + 1], -0.01f * (vertices - 1)) << "the tip has not moved";
}

std::vector<float> floats_of(cl_command_queue queue, cl_mem memory, size_t offset, size_t count) {
    std::vector<float> values(count);
    EXPECT_EQ(clEnqueueReadBuffer(queue, memory, CL_TRUE, offset, count * sizeof(float),
                                  values.data(), 0, nullptr, nullptr),
              CL_SUCCESS);
    return values;
}

TEST_P(Interop, copies_into_the_callers_buffer) {
    const OwnContext context = adopt();
    const OwnSim sim = make_sim(context.get());
    ASSERT_EQ(plait_sim_step(sim.get(), 0.1), PLAIT_OK) << plait_last_error();
    constexpr size_t count = size_t{4} * 2 * vertices, bytes = count * sizeof(float);
    cl_int code = CL_SUCCESS;
    const Memory own(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, bytes + 64, nullptr, &code));
    ASSERT_EQ(code, CL_SUCCESS);
    for (const auto& [field, at, floats] :
         {std::tuple(PLAIT_FIELD_POSITION, size_t{64}, count),
          std::tuple(PLAIT_FIELD_BOUNDS, size_t{16}, size_t{8})}) {
        ASSERT_EQ(plait_opencl_sim_copy_field(sim.get(), field, own.get(), at), PLAIT_OK)
            << plait_last_error();
        std::vector<float> read(floats);
        size_t size = floats * sizeof(float);
        ASSERT_EQ(plait_sim_read(sim.get(), field, read.data(), &size), PLAIT_OK);
        EXPECT_EQ(floats_of(queue_.get(), own.get(), at, floats), read);
    }

    EXPECT_EQ(plait_opencl_sim_copy_field(sim.get(), PLAIT_FIELD_POSITION, own.get(), 65),
              PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("do not fit"), std::string::npos);
    EXPECT_EQ(plait_opencl_sim_copy_field(sim.get(), PLAIT_FIELD_VELOCITY, own.get(), 0),
              PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(plait_opencl_sim_copy_field(sim.get(), PLAIT_FIELD_GRID_DENSITY, own.get(), 0),
              PLAIT_INVALID_STATE);
}

// Every kernel runs once over nothing: none may look at a buffer before it looks at item_count.
TEST_P(Interop, prepares_every_kernel) {
    const OwnContext context = adopt();
    auto desc = plait_prepare_desc_defaults();
    desc.models = 1u << PLAIT_MODEL_TRESSFX | 1u << PLAIT_MODEL_ARTICULATED;
    desc.features = PLAIT_FEATURE_ALL;
    desc.vertices_per_strand = vertices;
    EXPECT_EQ(plait_context_prepare(context.get(), &desc), PLAIT_OK) << plait_last_error();
}

TEST_P(Interop, waits_for_what_was_flushed) {
    const OwnContext context = adopt();
    const OwnSim sim = make_sim(context.get());
    ASSERT_EQ(plait_sim_step(sim.get(), 0.1), PLAIT_OK) << plait_last_error();
    cl_event made = nullptr;
    ASSERT_EQ(clEnqueueMarkerWithWaitList(queue_.get(), 0, nullptr, &made), CL_SUCCESS);
    const Event step_ended(made);
    ASSERT_EQ(clFlush(queue_.get()), CL_SUCCESS);

    ASSERT_EQ(plait_sim_wait(sim.get()), PLAIT_OK) << plait_last_error();
    cl_int status = CL_QUEUED;
    ASSERT_EQ(clGetEventInfo(step_ended.get(), CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status,
                             &status, nullptr),
              CL_SUCCESS);
    EXPECT_EQ(status, CL_COMPLETE);
}

// Nothing after it runs before it opens: by itself after a minute, else a call that waits would
// wait for ever.
class Gate {
  public:
    Gate(cl_context context, cl_command_queue queue) {
        cl_int code = CL_SUCCESS;
        event_ = Event(clCreateUserEvent(context, &code));
        EXPECT_EQ(code, CL_SUCCESS);
        cl_event event = event_.get();
        EXPECT_EQ(clEnqueueBarrierWithWaitList(queue, 1, &event, nullptr), CL_SUCCESS);
        EXPECT_EQ(clFlush(queue), CL_SUCCESS);
        opener_ = std::thread([this] {
            for (int i = 0; i < 6000 && !opened_; ++i)
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            if (!opened_.exchange(true)) {
                late_ = true;
                clSetUserEventStatus(event_.get(), CL_COMPLETE);
            }
        });
    }
    ~Gate() { open(); }

    // True: nobody had waited for it.
    bool open() {
        if (!opened_.exchange(true))
            clSetUserEventStatus(event_.get(), CL_COMPLETE);
        if (opener_.joinable())
            opener_.join();
        return !late_;
    }

  private:
    Event event_;
    std::atomic<bool> opened_ = false, late_ = false;
    std::thread opener_;
};

// What moves may be moved while the device has done nothing of the step before.
TEST_P(Interop, steps_while_the_device_is_held_up) {
    const OwnContext context = adopt();
    const OwnSim sim = make_sim(context.get());
    plait_collider_desc desc = plait_collider_desc_defaults();
    desc.friction = 0;
    desc.capsule.a[0] = desc.capsule.b[0] = 0.5f;
    desc.capsule.radius_a = desc.capsule.radius_b = 0.1f;
    plait_collider_id collider{};
    ASSERT_EQ(plait_collider_create(sim.get(), &desc, &collider), PLAIT_OK) << plait_last_error();
    ASSERT_EQ(plait_sim_wait(sim.get()), PLAIT_OK) << plait_last_error();

    Gate gate(context_.get(), queue_.get());
    for (int frame = 1; frame <= 20; ++frame) {
        const float x = 0.001f * static_cast<float>(frame);
        std::vector<plait_pose> own = {{{0, 0, 0, 1}, {x, 0, 0}}, {{0, 0, 0, 1}, {0, x, 0}}};
        plait_roots roots = plait_roots_defaults();
        roots.root_poses = {own.data(), own.size(), 0};
        ASSERT_EQ(plait_sim_set_roots(sim.get(), &roots), PLAIT_OK) << plait_last_error();
        own.assign(2, plait_pose{{0, 0, 0, 1}, {99, 99, 99}}); // the caller's array is free again
        const plait_pose pose = {{0, 0, 0, 1}, {-x, 0, 0}};
        ASSERT_EQ(plait_collider_set_pose(sim.get(), collider, &pose), PLAIT_OK);
        ASSERT_EQ(plait_sim_step(sim.get(), 1.0 / 60), PLAIT_OK) << plait_last_error();
    }
    EXPECT_TRUE(gate.open()) << "a call waited for the device";

    std::vector<float> position(size_t{4} * 2 * vertices);
    size_t size = position.size() * sizeof(float);
    ASSERT_EQ(plait_sim_read(sim.get(), PLAIT_FIELD_POSITION, position.data(), &size), PLAIT_OK);
    EXPECT_NEAR(position[0], 0.02f, 1e-6f); // each upload came in its turn
    EXPECT_NEAR(position[size_t{4} * vertices + 1], 0.02f, 1e-6f);
}

TEST_P(Interop, says_which_fields_are_off_or_not_lent) {
    const OwnContext context = adopt();
    const OwnSim sim = make_sim(context.get());
    cl_mem memory = nullptr;
    EXPECT_EQ(plait_opencl_sim_get_field(sim.get(), PLAIT_FIELD_GRID_DENSITY, &memory),
              PLAIT_INVALID_STATE);
    EXPECT_EQ(plait_opencl_sim_get_field(sim.get(), PLAIT_FIELD_VELOCITY, &memory),
              PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(memory, nullptr);
}

TEST(InteropElsewhere, is_unsupported) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = "reference";
    plait_context* made = nullptr;
    ASSERT_EQ(plait_context_create(&desc, &made), PLAIT_OK) << plait_last_error();
    const OwnContext context(made);
    cl_command_queue queue = nullptr;
    EXPECT_EQ(plait_opencl_context_get_queue(context.get(), &queue), PLAIT_UNSUPPORTED);
}

} // namespace
} // namespace plait::opencl
