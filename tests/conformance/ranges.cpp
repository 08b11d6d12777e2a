// How items become work-items, without a device.
#include "backend/opencl/range.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace plait::opencl {
namespace {

constexpr GroupLimits generous{1024, 1024, 32768};

WorkRange spread(plait_stage stage, uint32_t count, uint32_t width,
                 const GroupLimits& limits = generous) {
    const plait_dispatch dispatch{stage, count, width, nullptr, 0, 0, nullptr, 0};
    auto range = work_range(*plait_stage_describe(stage), dispatch, limits);
    EXPECT_TRUE(range.ok()) << range.error().message;
    return *range;
}

void expect_range(const WorkRange& range, size_t global, size_t local) {
    EXPECT_EQ(range.global, global);
    EXPECT_EQ(range.local, local);
}

TEST(Ranges, items_are_work_items_in_whole_groups) {
    expect_range(spread(PLAIT_STAGE_guide_turns, 65, 1, {1024, 32, 32768}), 96, 32);
    expect_range(spread(PLAIT_STAGE_tangents, 65, 1, {1, 1, 32768}), 65, 1);
}

TEST(Ranges, vertices_fill_large_groups_where_a_group_is_no_loop) {
    expect_range(spread(PLAIT_STAGE_tangents, 65, 1, {1024, 1024, 32768, 1}), 256, 256);
    expect_range(spread(PLAIT_STAGE_tangents, 65, 1, {1024, 128, 32768, 1}), 128, 128);
    expect_range(spread(PLAIT_STAGE_tangents, 65, 1, {1024, 1024, 32768, 16}), 128, 64);
    expect_range(spread(PLAIT_STAGE_grid_splat, 65, 1, {1024, 1024, 32768, 1}), 128, 64);
}

// What they add is cleared and handed on once a group.
TEST(Ranges, strands_that_sum_in_local_memory_fill_larger_groups) {
    const GroupLimits sums{1024, 1024, 65536, 1, 32, false, true};
    expect_range(spread(PLAIT_STAGE_grid_splat, 129, 1, sums), 256, 128);
    expect_range(spread(PLAIT_STAGE_lane_splat, 129, 16, sums), 256, 128);
    expect_range(spread(PLAIT_STAGE_lane_splat, 129, 16, {1024, 64, 65536, 1, 32, false, true}),
                 192, 64);
}

TEST(Ranges, short_strands_share_a_group) {
    expect_range(spread(PLAIT_STAGE_length, 5, 16), 128, 64); // 4 strands a group
    expect_range(spread(PLAIT_STAGE_length, 5, 24), 144, 48); // 2 strands a group
    expect_range(spread(PLAIT_STAGE_length, 5, 64), 320, 64);
    expect_range(spread(PLAIT_STAGE_length, 5, 256), 1280, 256);
}

TEST(Ranges, a_long_strand_may_exceed_the_kernels_advice) {
    const GroupLimits advised{1024, 32, 32768, 1, 1, true};
    expect_range(spread(PLAIT_STAGE_length, 5, 256, advised), 1280, 256);
    expect_range(spread(PLAIT_STAGE_length, 5, 16, advised), 96, 32);
}

TEST(Ranges, one_driver_gives_advice_for_a_limit) {
    const auto advises = [](const char* platform, const char* driver) {
        plait_device_info info{};
        std::snprintf(info.platform, sizeof info.platform, "%s", platform);
        std::snprintf(info.driver, sizeof info.driver, "%s", driver);
        return gives_advice_for_limit(info);
    };
    EXPECT_TRUE(advises("rusticl", "22.3.6"));
    EXPECT_FALSE(advises("rusticl", "25.0.7"));
    EXPECT_FALSE(advises("Portable Computing Language", "3.1"));
}

TEST(Ranges, a_strand_that_fits_no_group_is_refused) {
    const plait_dispatch dispatch{PLAIT_STAGE_length, 5, 256, nullptr, 0, 0, nullptr, 0};
    const auto& stage = *plait_stage_describe(PLAIT_STAGE_length);
    for (const GroupLimits& limits : {GroupLimits{128, 128, 32768}, GroupLimits{256, 256, 2048},
                                      GroupLimits{256, 128, 32768}}) {
        const auto range = work_range(stage, dispatch, limits);
        ASSERT_FALSE(range.ok());
        EXPECT_EQ(range.error().code, PLAIT_UNSUPPORTED);
        EXPECT_EQ(range.error().message, "stage length: strands of 256 vertices need work-groups "
                                         "of 256 work-items; the device allows 128");
    }
}

TEST(Ranges, a_voxel_takes_what_the_device_allows) {
    expect_range(spread(PLAIT_STAGE_grid_density, 512, 64), 512 * 64, 64);
    expect_range(spread(PLAIT_STAGE_grid_density, 512, 64, {1024, 32, 32768}), 512 * 32, 32);
    expect_range(spread(PLAIT_STAGE_grid_velocity, 8, 64, {1024, 64, 256}), 8 * 16, 16);
}

// Eight strands per work-item; one strand each, in tiles of 32 that fill groups of 64.
TEST(Ranges, lanes_cover_whole_tiles) {
    const plait_stage_info& stage = *plait_stage_describe(PLAIT_STAGE_articulated);
    plait_dispatch dispatch{};
    dispatch.stage = PLAIT_STAGE_articulated;
    dispatch.item_count = 67;
    dispatch.item_width = 16;
    const auto wide = work_range(stage, dispatch, {4096, 4096, 1 << 16, 8, 8});
    ASSERT_TRUE(wide.ok());
    EXPECT_EQ((*wide).global, 9u);
    EXPECT_EQ((*wide).local, 1u);
    const auto narrow = work_range(stage, dispatch, {1024, 1024, 1 << 16, 1, 32});
    ASSERT_TRUE(narrow.ok());
    EXPECT_EQ((*narrow).global, 128u);
    EXPECT_EQ((*narrow).local, 64u);
}

} // namespace
} // namespace plait::opencl
