// Every stage of stages.def has a kernel with exactly the arguments declared there, on each device.
#include "support.hpp"

#include "backend/opencl/arguments.hpp"
#include "backend/opencl/build.hpp"
#include "backend/opencl/program_text.hpp"
#include "backend/opencl/source.hpp"

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

// A pseudo-random sequence, whose end no compiler finds without going there.
constexpr const char* turning = R"(
    __kernel void turn(uint turns, __global uint* done) {
        uint state = 1u;
        for (uint turn = 0u; turn < turns; ++turn) {
            state = state * 1664525u + 1013904223u;
            done[0] = turn + 1u;
            done[1] = state;
        }
    })";

// How many turns of a loop are done of so many.
cl_uint turns_done(const Candidate& candidate, cl_uint turns) {
    cl_int code = CL_SUCCESS;
    const Context context(clCreateContext(nullptr, 1, &candidate.device, nullptr, nullptr, &code));
    const Queue queue(clCreateCommandQueue(context.get(), candidate.device, 0, &code));
    const char* text = turning;
    const Program program(clCreateProgramWithSource(context.get(), 1, &text, nullptr, &code));
    EXPECT_EQ(clBuildProgram(program.get(), 1, &candidate.device, "", nullptr, nullptr),
              CL_SUCCESS);
    const Kernel kernel(clCreateKernel(program.get(), "turn", &code));
    const Memory done(clCreateBuffer(context.get(), CL_MEM_READ_WRITE, 8, nullptr, &code));
    cl_mem buffer = done.get();
    EXPECT_EQ(clSetKernelArg(kernel.get(), 0, sizeof turns, &turns), CL_SUCCESS);
    EXPECT_EQ(clSetKernelArg(kernel.get(), 1, sizeof buffer, &buffer), CL_SUCCESS);
    const size_t one = 1;
    EXPECT_EQ(clEnqueueNDRangeKernel(queue.get(), kernel.get(), 1, nullptr, &one, &one, 0, nullptr,
                                     nullptr),
              CL_SUCCESS);
    cl_uint result[2] = {};
    EXPECT_EQ(clEnqueueReadBuffer(queue.get(), done.get(), CL_TRUE, 0, sizeof result, result, 0,
                                  nullptr, nullptr),
              CL_SUCCESS);
    return result[0];
}

// A known deviation: llvmpipe ends the loops of a work-item after so many turns, and says nothing.
TEST_P(Kernels, turn_their_loops_to_the_end) {
    constexpr cl_uint most_of_llvmpipe = 65535;
    const Candidate candidate = find_devices().usable[GetParam()];
    EXPECT_EQ(turns_done(candidate, 60000), 60000u);
    const cl_uint done = turns_done(candidate, 80000);
    if (!std::string_view(candidate.info.name).starts_with("llvmpipe"))
        EXPECT_EQ(done, 80000u);
    else if (std::string_view(candidate.info.driver).starts_with("22.3"))
        EXPECT_EQ(done, most_of_llvmpipe);
    else
        EXPECT_TRUE(done == most_of_llvmpipe || done == 80000u) << done;
}

} // namespace
} // namespace plait::opencl
