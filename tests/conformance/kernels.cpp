// Every stage of stages.def has a kernel with exactly the arguments declared there, on each device.
#include "support.hpp"

#include "backend/opencl/arguments.hpp"
#include "backend/opencl/build.hpp"
#include "backend/opencl/source.hpp"

namespace plait::opencl {
namespace {

class Kernels : public OnDevice {};
INSTANTIATE_TEST_SUITE_P(Devices, Kernels, ::testing::ValuesIn(device_indices()), test_name);

TEST(Stages, all_have_embedded_source) {
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage) {
        const char* name = plait_stage_describe(static_cast<plait_stage>(stage))->name;
        EXPECT_FALSE(stage_text(name).empty()) << "cl/" << name << ".cl";
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
        const std::string name = std::string("cl/") + info.name + ".cl";
        const auto built = build_stage(programs, candidate, info,
                                       {name, std::string(stage_text(info.name))}, Log{});
        EXPECT_TRUE(built.ok()) << built.error().message;
    }
}

} // namespace
} // namespace plait::opencl
