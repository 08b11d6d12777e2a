// Every stage of stages.def has inputs to be measured with.
#include "inputs.hpp"

#include <gtest/gtest.h>

#include <string>

namespace bench {
namespace {

TEST(BenchInputs, AreThereForEveryStage) {
    const Shape shape{40, 8, 16};
    for (int i = 0; i < PLAIT_STAGE_COUNT; ++i) {
        const auto stage = static_cast<plait_stage>(i);
        const plait_stage_info& info = *plait_stage_describe(stage);
        EXPECT_EQ(typical_params(stage, shape).size(), info.params_size) << info.name;
        EXPECT_GT(item_count(stage, shape), 0u) << info.name;
        EXPECT_GT(traffic(info, shape), 0u) << info.name; // throws where a buffer has none
    }
}

} // namespace
} // namespace bench
