// What is decided about devices and drivers that are not here.
#include "backend/opencl/arguments.hpp"
#include "backend/opencl/enumerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace plait::opencl {
namespace {

struct Listed {
    std::string name;
    Rank rank;
};

Listed device(const char* name, plait_device_type type, uint32_t units, uint32_t width,
              uint64_t gigabytes, bool unified, uint32_t clock) {
    plait_device_info info{};
    info.type = type;
    info.compute_units = units;
    info.float_width = width;
    info.memory_bytes = gigabytes << 30;
    return {name, rank_of(info, unified, clock)};
}

// As drivers report them. An Iris Xe has 96 units, an RTX 4070 46, and neither number is the
// other's.
TEST(Ranking, discrete_gpus_then_memory_then_the_rest) {
    std::vector<Listed> list{
        device("llvmpipe", PLAIT_DEVICE_TYPE_CPU, 16, 8, 31, true, 0),
        device("Iris Xe", PLAIT_DEVICE_TYPE_GPU, 96, 1, 25, true, 1450),
        device("accelerator", PLAIT_DEVICE_TYPE_OTHER, 512, 16, 64, false, 3000),
        device("Arc A380", PLAIT_DEVICE_TYPE_GPU, 128, 1, 6, false, 2450),
        device("CPU", PLAIT_DEVICE_TYPE_CPU, 16, 8, 31, true, 4700),
        device("RTX 4070", PLAIT_DEVICE_TYPE_GPU, 46, 1, 12, false, 2475),
    };
    std::ranges::stable_sort(list, std::greater(), &Listed::rank);
    std::vector<std::string> names;
    for (const Listed& listed : list)
        names.push_back(listed.name);
    EXPECT_EQ(names, (std::vector<std::string>{"RTX 4070", "Arc A380", "Iris Xe", "accelerator",
                                               "CPU", "llvmpipe"}));
}

TEST(Arguments, a_driver_may_spell_a_type_in_its_own_way) {
    const Argument real{"__global ", "real*", "lane_x"};
    EXPECT_EQ(match(real, real), Match::same);
    for (const char* type : {"float*", "float16*", "floatx16*"})
        EXPECT_EQ(match(real, {"__global ", type, "lane_x"}), Match::spelled) << type;
    for (const char* type : {"uint*", "plait_lane_params", "uint"})
        EXPECT_EQ(match(real, {"__global ", type, "lane_x"}), Match::other) << type;
    EXPECT_EQ(match(real, {"__global const ", "real*", "lane_x"}), Match::other);
    EXPECT_EQ(match(real, {"__global ", "float*", "lane_v"}), Match::other);
}

TEST(Arguments, another_type_of_the_table_is_another_argument) {
    const Argument words{"__global ", "uint*", "words"};
    EXPECT_EQ(match(words, {"__global ", "word*", "words"}), Match::spelled);
    EXPECT_EQ(match(words, {"__global ", "float*", "words"}), Match::other);
    EXPECT_EQ(match(words, {"__global ", "real*", "words"}), Match::other);
    const Argument params{"", "plait_tressfx_wind_params", "params"};
    EXPECT_EQ(match(params, {"", "wind_block", "params"}), Match::spelled);
    EXPECT_EQ(match(params, {"", "plait_grid_params", "params"}), Match::other);
}

} // namespace
} // namespace plait::opencl
