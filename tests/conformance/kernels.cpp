// Every stage of stages.def has a kernel with exactly the arguments declared there, on each device.
#include "support.hpp"

#include "backend/opencl/arguments.hpp"
#include "backend/opencl/build.hpp"
#include "backend/opencl/program_text.hpp"
#include "backend/opencl/source.hpp"

#include <array>

namespace plait::opencl {
namespace {

class Kernels : public OnDevice {};
INSTANTIATE_TEST_SUITE_P(Devices, Kernels, ::testing::ValuesIn(device_indices()), test_name);

TEST(Stages, all_have_embedded_source) {
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage) {
        const char* name = plait_stage_describe(static_cast<plait_stage>(stage))->name;
        EXPECT_FALSE(stage_text(name).empty()) << name;
    }
}

TEST_P(Kernels, build_with_the_arguments_of_the_table) {
    const Candidate candidate = find_devices().usable[GetParam()];
    cl_int code = CL_SUCCESS;
    Programs programs{
        Context(clCreateContext(nullptr, 1, &candidate.device, nullptr, nullptr, &code))};
    ASSERT_EQ(code, CL_SUCCESS);
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage) {
        const plait_stage_info& info = *plait_stage_describe(static_cast<plait_stage>(stage));
        const auto built = build_stage(programs, candidate, info, program_text(info.stage), Log{});
        EXPECT_TRUE(built.ok()) << built.error().message;
    }
}

// What one work-item of the kernel `probe` of a program of its own leaves in its two results.
std::array<cl_uint, 2> probed(const Candidate& candidate, const char* text, cl_uint given) {
    cl_int code = CL_SUCCESS;
    const Context context(clCreateContext(nullptr, 1, &candidate.device, nullptr, nullptr, &code));
    const Queue queue(clCreateCommandQueue(context.get(), candidate.device, 0, &code));
    const Program program(clCreateProgramWithSource(context.get(), 1, &text, nullptr, &code));
    EXPECT_EQ(clBuildProgram(program.get(), 1, &candidate.device, "", nullptr, nullptr),
              CL_SUCCESS);
    const Kernel kernel(clCreateKernel(program.get(), "probe", &code));
    const Memory left(clCreateBuffer(context.get(), CL_MEM_READ_WRITE, 8, nullptr, &code));
    cl_mem buffer = left.get();
    EXPECT_EQ(clSetKernelArg(kernel.get(), 0, sizeof given, &given), CL_SUCCESS);
    EXPECT_EQ(clSetKernelArg(kernel.get(), 1, sizeof buffer, &buffer), CL_SUCCESS);
    const size_t one = 1;
    EXPECT_EQ(clEnqueueNDRangeKernel(queue.get(), kernel.get(), 1, nullptr, &one, &one, 0, nullptr,
                                     nullptr),
              CL_SUCCESS);
    std::array<cl_uint, 2> result = {};
    EXPECT_EQ(clEnqueueReadBuffer(queue.get(), left.get(), CL_TRUE, 0, sizeof result, result.data(),
                                  0, nullptr, nullptr),
              CL_SUCCESS);
    return result;
}

bool is_llvmpipe(const Candidate& candidate) {
    return std::string_view(candidate.info.name).starts_with("llvmpipe");
}
bool is_of_debian_12(const Candidate& candidate) {
    return std::string_view(candidate.info.driver).starts_with("22.3");
}

// A pseudo-random sequence, whose end no compiler finds without going there.
constexpr const char* turning = R"(
    __kernel void probe(uint turns, __global uint* left) {
        uint state = 1u;
        for (uint turn = 0u; turn < turns; ++turn) {
            state = state * 1664525u + 1013904223u;
            left[0] = turn + 1u;
            left[1] = state;
        }
    })";

// A known deviation: llvmpipe ends the loops of a work-item after so many turns, and says nothing.
TEST_P(Kernels, turn_their_loops_to_the_end) {
    constexpr cl_uint most_of_llvmpipe = 65535;
    const Candidate candidate = find_devices().usable[GetParam()];
    EXPECT_EQ(probed(candidate, turning, 60000)[0], 60000u);
    const cl_uint done = probed(candidate, turning, 80000)[0];
    if (!is_llvmpipe(candidate))
        EXPECT_EQ(done, 80000u);
    else if (is_of_debian_12(candidate))
        EXPECT_EQ(done, most_of_llvmpipe);
    else
        EXPECT_TRUE(done == most_of_llvmpipe || done == 80000u) << done;
}

// `of` is a copy, which the function may change.
constexpr const char* changing = R"(
    typedef struct { uint first, second, third; } three;
    three more(three of) {
        of.first += 1u;
        return of;
    }
    __kernel void probe(uint given, __global uint* left) {
        three a = {given, 2u, 3u};
        const three b = more(a);
        left[0] = a.first;
        left[1] = b.first;
    })";

// A known deviation: for rusticl of Mesa 22.3 it is the caller's own. No function of ours changes a
// structure that it is given by value; the cases of the stages find one that does.
TEST_P(Kernels, pass_structures_by_value) {
    const Candidate candidate = find_devices().usable[GetParam()];
    const auto [callers, callees] = probed(candidate, changing, 7);
    EXPECT_EQ(callees, 8u);
    if (!is_llvmpipe(candidate))
        EXPECT_EQ(callers, 7u);
    else if (is_of_debian_12(candidate))
        EXPECT_EQ(callers, 8u);
    else
        EXPECT_TRUE(callers == 7u || callers == 8u) << callers;
}

} // namespace
} // namespace plait::opencl
