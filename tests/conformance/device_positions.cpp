// Vertices of meshes from the caller's cl_mem: a kernel of the caller's moves a cloth, hair grows on it
// and meets it, and nothing comes to the host.
#include "owned.hpp"
#include "support.hpp"

#include <plait/plait_opencl.h>
#include <plait/plait_profile.h>

#include <cmath>
#include <map>

namespace plait::opencl {
namespace {

constexpr uint32_t cells = 12, side = cells + 1, cloth_vertices = side * side;
constexpr float cell = 0.02f; // m
constexpr uint32_t strands = 6, per_strand = 8;

// A wave runs over the cloth. `words`: floats from one vertex to the next, the first `skip` from the
// buffer's begin. Or, with `ruin`, nothing that is a place.
constexpr char source[] =
    "__kernel void wave(__global float* at, uint words, uint skip, float time,"
    "                   uint ruin) {"
    "    const uint i = get_global_id(0);"
    "    const float x = 0.02f * (i % 13), z = 0.02f * (i / 13);"
    "    __global float* v = at + skip + words * i;"
    "    v[0] = ruin ? NAN : x + 0.002f * native_cos(40 * z + 9 * time);"
    "    v[1] = ruin ? INFINITY : 0.01f * native_sin(30 * x + 12 * time);"
    "    v[2] = ruin ? 1e30f : z;"
    "}";

OwnMesh cloth() {
    std::vector<float> positions;
    std::vector<uint32_t> triangles;
    for (uint32_t i = 0; i < cloth_vertices; ++i)
        for (const float c :
             {cell * static_cast<float>(i % side), 0.0f, cell * static_cast<float>(i / side)})
            positions.push_back(c);
    for (uint32_t i = 0; i < cells * cells; ++i) {
        const uint32_t a = i / cells * side + i % cells;
        for (const uint32_t corner : {a, a + side, a + 1, a + 1, a + side, a + side + 1})
            triangles.push_back(corner);
    }
    plait_mesh_desc desc = plait_mesh_desc_defaults();
    desc.positions = {positions.data(), cloth_vertices, 0};
    desc.triangles = {triangles.data(), triangles.size() / 3, 0};
    plait_mesh* mesh = nullptr;
    EXPECT_EQ(plait_mesh_create(&desc, nullptr, &mesh), PLAIT_OK) << plait_last_error();
    return OwnMesh(mesh);
}

// Strands that grow out of the cloth and fall onto it.
OwnGroom hair() {
    std::vector<float> positions;
    for (uint32_t i = 0; i < strands * per_strand; ++i) {
        const auto s = static_cast<float>(i / per_strand), k = static_cast<float>(i % per_strand);
        positions.insert(positions.end(),
                         {0.03f + 0.013f * k, 0.012f * std::min(k, 1.0f), 0.03f + 0.031f * s});
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {positions.data(), strands * per_strand, 0};
    desc.vertices_per_strand = per_strand;
    plait_groom* groom = nullptr;
    EXPECT_EQ(plait_groom_create(&desc, nullptr, &groom), PLAIT_OK) << plait_last_error();
    return OwnGroom(groom);
}

// A sim whose roots are bound to the cloth, which is a collider, too.
struct OnCloth {
    OwnSim sim;
    plait_collider_id id{};

    explicit OnCloth(plait_context* context) {
        const OwnGroom groom = hair();
        const OwnMesh mesh = cloth();
        plait_sim_desc desc = plait_sim_desc_defaults();
        desc.substeps = 2;
        plait_sim* made = nullptr;
        EXPECT_EQ(plait_sim_create(context, groom.get(), &desc, &made), PLAIT_OK)
            << plait_last_error();
        sim.reset(made);
        EXPECT_EQ(plait_sim_bind_roots(made, mesh.get(), nullptr, 0), PLAIT_OK)
            << plait_last_error();
        plait_collider_mesh_desc collider = plait_collider_mesh_desc_defaults();
        collider.form = PLAIT_MESH_FORM_NEAREST;
        collider.two_sided = 1;
        EXPECT_EQ(plait_collider_create_mesh(made, mesh.get(), &collider, &id), PLAIT_OK)
            << plait_last_error();
    }
    std::vector<float> positions() const {
        std::vector<float> values(size_t{4} * strands * per_strand);
        size_t size = values.size() * sizeof(float);
        EXPECT_EQ(plait_sim_read(sim.get(), PLAIT_FIELD_POSITION, values.data(), &size), PLAIT_OK);
        return values;
    }
    uint64_t hash() const {
        uint64_t value = 0;
        EXPECT_EQ(plait_sim_hash(sim.get(), &value), PLAIT_OK) << plait_last_error();
        return value;
    }
    void step(double dt) const {
        EXPECT_EQ(plait_sim_step(sim.get(), dt), PLAIT_OK) << plait_last_error();
    }
};

class DevicePositions : public OnDevice {
  protected:
    void SetUp() override {
        device_ = find_devices().usable[GetParam()].device;
        cl_int code = CL_SUCCESS;
        context_ = Context(clCreateContext(nullptr, 1, &device_, nullptr, nullptr, &code));
        ASSERT_EQ(code, CL_SUCCESS);
        queue_ = Queue(clCreateCommandQueue(context_.get(), device_, 0, &code));
        ASSERT_EQ(code, CL_SUCCESS);
        const char* text = source;
        program_ = clCreateProgramWithSource(context_.get(), 1, &text, nullptr, &code);
        ASSERT_EQ(clBuildProgram(program_, 1, &device_, "", nullptr, nullptr), CL_SUCCESS);
        kernel_ = clCreateKernel(program_, "wave", &code);
        ASSERT_EQ(code, CL_SUCCESS);
    }
    void TearDown() override {
        clReleaseKernel(kernel_);
        clReleaseProgram(program_);
    }

    OwnContext adopt(uint32_t profile = 0) {
        const plait_opencl_handles handles{context_.get(), device_, queue_.get()};
        plait_context_desc desc = plait_context_desc_defaults();
        desc.profile = profile;
        plait_context* context = nullptr;
        EXPECT_EQ(plait_opencl_context_create(&handles, &desc, &context), PLAIT_OK)
            << plait_last_error();
        return OwnContext(context);
    }
    Memory buffer(size_t bytes) {
        cl_int code = CL_SUCCESS;
        Memory memory(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, bytes, nullptr, &code));
        EXPECT_EQ(code, CL_SUCCESS);
        return memory;
    }
    void wave(const Memory& at, cl_uint words, cl_uint skip, cl_float time, cl_uint ruin) {
        const cl_mem memory = at.get();
        clSetKernelArg(kernel_, 0, sizeof memory, &memory);
        clSetKernelArg(kernel_, 1, sizeof words, &words);
        clSetKernelArg(kernel_, 2, sizeof skip, &skip);
        clSetKernelArg(kernel_, 3, sizeof time, &time);
        clSetKernelArg(kernel_, 4, sizeof ruin, &ruin);
        const size_t items = cloth_vertices;
        EXPECT_EQ(clEnqueueNDRangeKernel(queue_.get(), kernel_, 1, nullptr, &items, nullptr, 0,
                                         nullptr, nullptr),
                  CL_SUCCESS);
    }
    std::vector<float> read(const Memory& at, size_t count) {
        std::vector<float> values(count);
        EXPECT_EQ(clEnqueueReadBuffer(queue_.get(), at.get(), CL_TRUE, 0, count * sizeof(float),
                                      values.data(), 0, nullptr, nullptr),
                  CL_SUCCESS);
        return values;
    }

    cl_device_id device_ = nullptr;
    Context context_;
    Queue queue_;
    cl_program program_ = nullptr;
    cl_kernel kernel_ = nullptr;
};
INSTANTIATE_TEST_SUITE_P(Devices, DevicePositions, ::testing::ValuesIn(device_indices()),
                         test_name);

void set(const OnCloth& on, const plait_opencl_positions& positions) {
    EXPECT_EQ(plait_opencl_collider_set_positions(on.sim.get(), on.id, &positions), PLAIT_OK)
        << plait_last_error();
    EXPECT_EQ(plait_opencl_sim_set_roots(on.sim.get(), nullptr, &positions), PLAIT_OK)
        << plait_last_error();
}

void set(const OnCloth& on, const plait_view& positions) {
    EXPECT_EQ(plait_collider_set_positions(on.sim.get(), on.id, &positions), PLAIT_OK)
        << plait_last_error();
    plait_roots roots = plait_roots_defaults();
    roots.mesh_positions = positions;
    EXPECT_EQ(plait_sim_set_roots(on.sim.get(), &roots), PLAIT_OK) << plait_last_error();
}

// The buffer is ruined as soon as the call returns. Calls of 1.7 steps end within a fixed step.
TEST_P(DevicePositions, do_what_the_same_from_the_host_do_to_the_bit) {
    const OwnContext context = adopt();
    for (const auto& [words, skip] : {std::pair(3u, 0u), std::pair(4u, 8u), std::pair(9u, 5u)}) {
        const OnCloth device(context.get()), host(context.get());
        const std::vector<float> before = device.positions();
        const size_t floats = skip + size_t{words} * cloth_vertices;
        const Memory own = buffer(floats * sizeof(float));
        for (int frame = 1; frame <= 20; ++frame) {
            if (frame % 7 != 0) { // else they stay where they are
                wave(own, words, skip, static_cast<float>(frame) / 60, 0);
                const auto values = read(own, floats);
                set(device, plait_opencl_positions{own.get(), cloth_vertices, skip * sizeof(float),
                                                   words * sizeof(float)});
                wave(own, words, skip, 0, 1);
                set(host, plait_view{&values[skip], cloth_vertices, words * sizeof(float)});
            }
            device.step(1.7 / 60);
            host.step(1.7 / 60);
        }
        EXPECT_EQ(device.positions(), host.positions()) << words << " words";
        EXPECT_EQ(device.hash(), host.hash()) << words << " words";
        float most = 0;
        for (size_t i = 0; i < before.size(); ++i)
            most = std::max(most, std::abs(device.positions()[i] - before[i]));
        EXPECT_GT(most, 5e-3f);
    }
}

// Given once, in all sims that share the cloth.
TEST_P(DevicePositions, are_those_of_all_sims_that_share) {
    const OwnContext context = adopt();
    const OnCloth first(context.get()), second(context.get()), alone(context.get());
    ASSERT_EQ(plait_sim_share_colliders(second.sim.get(), first.sim.get()), PLAIT_OK)
        << plait_last_error();
    const Memory own = buffer(size_t{16} * cloth_vertices);
    const plait_opencl_positions there{own.get(), cloth_vertices, 0, 16};
    for (int frame = 1; frame <= 10; ++frame) {
        wave(own, 4, 0, static_cast<float>(frame) / 60, 0);
        for (const OnCloth* on : {&first, &alone})
            set(*on, there);
        EXPECT_EQ(plait_opencl_sim_set_roots(second.sim.get(), nullptr, &there), PLAIT_OK);
        for (const OnCloth* on : {&first, &second, &alone})
            on->step(1.7 / 60);
    }
    EXPECT_EQ(first.hash(), alone.hash());
    EXPECT_EQ(second.hash(), alone.hash());
}

// Vertices that are put nowhere stay where they are, and so do the roots on them.
TEST_P(DevicePositions, that_are_none_move_nothing) {
    const OwnContext context = adopt();
    const OnCloth ruined(context.get()), still(context.get());
    const Memory own = buffer(size_t{12} * cloth_vertices);
    for (const OnCloth* on : {&ruined, &still}) {
        wave(own, 3, 0, 0.1f, 0);
        set(*on, plait_opencl_positions{own.get(), cloth_vertices, 0, 0});
        for (int frame = 0; frame < 10; ++frame) {
            if (on == &ruined && frame > 0) {
                wave(own, 3, 0, 0, 1);
                set(*on, plait_opencl_positions{own.get(), cloth_vertices, 0, 0});
            }
            on->step(1.0 / 60);
        }
    }
    for (const float value : ruined.positions())
        EXPECT_TRUE(std::isfinite(value));
    EXPECT_EQ(ruined.positions(), still.positions());
}

// A restored sim goes on from vertices that only the device knew.
TEST_P(DevicePositions, are_part_of_snapshots) {
    const OwnContext context = adopt();
    const OnCloth first(context.get()), second(context.get());
    const Memory own = buffer(size_t{16} * cloth_vertices);
    const plait_opencl_positions there{own.get(), cloth_vertices, 0, 16};
    for (int frame = 1; frame <= 5; ++frame) {
        wave(own, 4, 0, static_cast<float>(frame) / 60, 0);
        set(first, there);
        first.step(1.7 / 60);
    }
    wave(own, 4, 0, 0.2f, 0);
    set(first, there); // not reached yet
    size_t size = 0;
    ASSERT_EQ(plait_sim_save(first.sim.get(), nullptr, &size), PLAIT_OK);
    std::vector<unsigned char> bytes(size);
    ASSERT_EQ(plait_sim_save(first.sim.get(), bytes.data(), &size), PLAIT_OK);
    ASSERT_EQ(plait_sim_restore(second.sim.get(), bytes.data(), size), PLAIT_OK)
        << plait_last_error();
    EXPECT_EQ(first.hash(), second.hash());
    first.step(1.7 / 60);
    second.step(1.7 / 60);
    EXPECT_EQ(first.hash(), second.hash());
    for (const OnCloth* on : {&first, &second}) {
        EXPECT_EQ(plait_sim_reset(on->sim.get()), PLAIT_OK);
        on->step(0.1);
    }
    EXPECT_EQ(first.hash(), second.hash());
}

// What one frame takes beside that of a cloth that rests.
TEST_P(DevicePositions, cost_a_few_launches) {
    cl_int code = CL_SUCCESS;
    queue_ = Queue(clCreateCommandQueue(context_.get(), device_, CL_QUEUE_PROFILING_ENABLE, &code));
    ASSERT_EQ(code, CL_SUCCESS);
    const OwnContext context = adopt(1);
    const OnCloth on(context.get());
    const Memory own = buffer(size_t{12} * cloth_vertices);
    on.step(1.0 / 60);
    size_t count = PLAIT_LAUNCHES_KEPT;
    std::vector<plait_launch> list(count, plait_launch_defaults());
    ASSERT_EQ(plait_sim_take_launches(on.sim.get(), list.data(), &count), PLAIT_OK);
    wave(own, 3, 0, 0.1f, 0);
    set(on, plait_opencl_positions{own.get(), cloth_vertices, 0, 0});
    on.step(1.0 / 60);
    count = list.size();
    ASSERT_EQ(plait_sim_take_launches(on.sim.get(), list.data(), &count), PLAIT_OK);
    std::map<std::string, int> runs;
    for (size_t i = 0; i < count; ++i)
        ++runs[list[i].stage];
    EXPECT_EQ(runs["mesh_take"], 2); // of the collider and of the roots
    EXPECT_EQ(runs["skin_mesh"], 1);
    EXPECT_EQ(runs["mesh_advance"], 1);
    EXPECT_EQ(runs["mesh_refit"], 2); // 288 triangles: nodes up to 32, and up to 1,024
    EXPECT_EQ(runs["mesh_nearest"], 2);
}

TEST_P(DevicePositions, that_cannot_be_are_refused) {
    const OwnContext context = adopt();
    const OnCloth on(context.get());
    const uint64_t before = on.hash();
    const Memory own = buffer(size_t{12} * cloth_vertices);
    const auto refused = [&](const plait_opencl_positions& p, const std::string& says) {
        EXPECT_EQ(plait_opencl_collider_set_positions(on.sim.get(), on.id, &p),
                  PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(says), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(plait_opencl_sim_set_roots(on.sim.get(), nullptr, &p), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(says), std::string::npos)
            << plait_last_error();
    };
    refused({nullptr, cloth_vertices, 0, 0}, "positions->buffer is NULL");
    refused({own.get(), cloth_vertices - 1, 0, 0}, "count is 168, the mesh");
    refused({own.get(), 0, 0, 0}, "positions->count is 0");
    refused({own.get(), cloth_vertices, 0, 8}, "positions->stride is 8 bytes");
    refused({own.get(), cloth_vertices, 0, 18}, "positions->stride is 18 bytes");
    refused({own.get(), cloth_vertices, 2, 0}, "positions->offset is 2 bytes");
    refused({own.get(), cloth_vertices, 4, 0}, "has 2028 bytes; 169 places, 12 bytes apart, take "
                                               "2028 from byte 4 on");
    refused({own.get(), cloth_vertices, 0, 16}, "take 2700 from byte 0 on");
    cl_int code = CL_SUCCESS;
    const Context other(clCreateContext(nullptr, 1, &device_, nullptr, nullptr, &code));
    ASSERT_EQ(code, CL_SUCCESS);
    const Memory foreign(clCreateBuffer(other.get(), CL_MEM_READ_WRITE, size_t{12} * cloth_vertices,
                                        nullptr, &code));
    ASSERT_EQ(code, CL_SUCCESS);
    refused({foreign.get(), cloth_vertices, 0, 0}, "is of another cl_context");

    plait_collider_desc capsule = plait_collider_desc_defaults();
    plait_collider_id id{};
    ASSERT_EQ(plait_collider_create(on.sim.get(), &capsule, &id), PLAIT_OK);
    const plait_opencl_positions good{own.get(), cloth_vertices, 0, 0};
    EXPECT_EQ(plait_opencl_collider_set_positions(on.sim.get(), id, &good), PLAIT_INVALID_STATE);
    ASSERT_EQ(plait_collider_destroy(on.sim.get(), id), PLAIT_OK);
    EXPECT_EQ(plait_opencl_collider_set_positions(on.sim.get(), id, &good), PLAIT_NOT_FOUND);
    ASSERT_EQ(plait_sim_bind_roots(on.sim.get(), nullptr, nullptr, 0), PLAIT_OK);
    EXPECT_EQ(plait_opencl_sim_set_roots(on.sim.get(), nullptr, &good), PLAIT_INVALID_ARGUMENT);
    const OnCloth untouched(context.get());
    EXPECT_EQ(untouched.hash(), before);
}

} // namespace
} // namespace plait::opencl
