// Sums of the grid in a work-group's local memory: when, and that they are those of the grid itself.
#include "backend/opencl/group_sums.hpp"
#include "backend/opencl/source.hpp"

#include "stage_device.hpp"

#include <array>
#include <random>
#include <utility>

namespace plait::test {
namespace {

using opencl::group_sums;

plait_device_info device_of(uint32_t lanes, uint64_t local_bytes) {
    plait_device_info info{};
    info.lanes = lanes;
    info.local_memory_bytes = local_bytes;
    return info;
}

template <typename Params>
uint32_t words_of(plait_stage stage, uint32_t edge, uint64_t local_bytes) {
    Params params{};
    params.edge_count = edge;
    const plait_dispatch dispatch{stage, 1, 16, &params, sizeof params, 0, nullptr, 0};
    return group_sums(dispatch, device_of(1, local_bytes));
}

TEST(GroupSums, are_of_grids_that_fit_half_of_the_local_memory) {
    const auto words = words_of<plait_grid_params>;
    EXPECT_EQ(words(PLAIT_STAGE_grid_splat, 8, 65536), 5120u);
    EXPECT_EQ(words(PLAIT_STAGE_grid_splat, 9, 65536), 7290u);
    EXPECT_EQ(words(PLAIT_STAGE_grid_splat, 9, 49152), 0u);
    EXPECT_EQ(words(PLAIT_STAGE_grid_splat, 8, 40960), 5120u); // 20 KiB, twice
    EXPECT_EQ(words(PLAIT_STAGE_grid_splat, 8, 40959), 0u);
    EXPECT_EQ(words(PLAIT_STAGE_grid_splat, 10, 1 << 20), 0u); // 40,000 B: more than is given away
    EXPECT_EQ(words(PLAIT_STAGE_grid_splat, 0xffffffffu, 65536), 0u);
    EXPECT_EQ(words_of<plait_lane_grid_params>(PLAIT_STAGE_lane_splat, 3, 65536), 270u);
    EXPECT_EQ(words_of<plait_lane_volume_params>(PLAIT_STAGE_volume_splat, 3, 65536), 270u);
}

TEST(GroupSums, are_of_no_other_stage_and_of_no_cpu) {
    plait_grid_params params{};
    params.edge_count = 8;
    plait_dispatch dispatch{PLAIT_STAGE_grid_splat, 1, 1, &params, sizeof params, 0, nullptr, 0};
    EXPECT_EQ(group_sums(dispatch, device_of(16, 65536)), 0u);
    EXPECT_EQ(group_sums(dispatch, device_of(1, 65536)), 5120u);
    dispatch.params = nullptr; // the usual grid, to prepare for
    EXPECT_EQ(group_sums(dispatch, device_of(1, 65536)), 5120u);
    dispatch.stage = PLAIT_STAGE_grid_resolve;
    EXPECT_EQ(group_sums(dispatch, device_of(1, 65536)), 0u);
}

constexpr uint32_t tile = 32, strands = 300, vertices = 7; // groups of 128, and part of one

std::vector<DeviceName> opencl_devices() {
    std::vector<DeviceName> names = every_device();
    std::erase_if(
        names, [](const DeviceName& name) { return std::string(name.backend->name) != "opencl"; });
    return names;
}

// The stage's kernel as the caller's own, whose sums are the grid's own.
std::string text_of(plait_stage stage) {
    return std::string(opencl::stage_text(plait_stage_describe(stage)->name));
}

std::vector<float> random_floats(size_t count, float most, uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> range(-most, most);
    std::vector<float> values(count);
    for (float& value : values)
        value = range(engine);
    return values;
}

// Hair in a cube of 1 m edge, of which a part lies outside; twice on one device.
class OnDevice : public ::testing::TestWithParam<DeviceName> {
  protected:
    // The last is the greatest up to 8 that the device has sums for; 32 KiB, the least that OpenCL 1.2 asks
    // of a GPU, are enough for 7.
    template <typename Params> std::array<uint32_t, 3> edges(plait_stage stage) {
        plait_open_info one_lane{};
        one_lane.lanes = 1;
        const plait_device_info info = StageDevice(GetParam(), one_lane).describe();
        const bool has = words_of<Params>(stage, 8, info.local_memory_bytes) > 0;
        return {1, 3, has ? 8u : 7u};
    }
    // Sums and the vertices outside, by plait's own kernel and by the same as the caller's.
    template <typename Params, typename Buffers>
    void expect_same(plait_stage stage, const Params& params, uint32_t width, Buffers buffers) {
        const std::string text = text_of(stage), name = plait_stage_describe(stage)->name;
        const plait_stage_source source{name.c_str(), text.c_str(), "own.cl"};
        plait_open_info one_lane{};
        one_lane.lanes = 1;
        plait_open_info own = one_lane;
        own.stage_sources = &source;
        own.stage_source_count = 1;
        std::vector<std::vector<uint32_t>> results;
        for (const plait_open_info& info : {one_lane, own}) {
            StageDevice device(GetParam(), info);
            const plait_dispatch dispatch{stage,         strands, width,   &params,
                                          sizeof params, 0,       nullptr, 0};
            const uint32_t words =
                params.edge_count * params.edge_count * params.edge_count * PLAIT_SUM_STRIDE;
            ASSERT_EQ(group_sums(dispatch, device.describe()), words) << "a device of too little";
            const auto list = buffers(device);
            const auto sums = device.uints(words), outside = device.uints(1);
            sums->write(std::vector<uint32_t>(words, 0x80000001u)); // carries
            outside->write(std::vector<uint32_t>{0});
            std::vector<const StageBuffer*> arguments;
            for (const auto& buffer : list)
                arguments.push_back(buffer.get());
            arguments.insert(arguments.end(), {sums.get(), outside.get()});
            device.run(stage, strands, params, arguments, width);
            results.push_back(sums->template read<uint32_t>());
            results.back().push_back(outside->template read<uint32_t>()[0]);
        }
        ASSERT_EQ(results.size(), 2u);
        EXPECT_EQ(results[0], results[1]);
        EXPECT_GT(results[0].back(), 0u);
        EXPECT_LT(results[0].back(), strands * vertices);
    }
};
INSTANTIATE_TEST_SUITE_P(GroupSums, OnDevice, ::testing::ValuesIn(opencl_devices()),
                         device_test_name);

template <typename Params> Params grid_of(uint32_t edge) {
    Params params{};
    params.vertex_stride = vertices;
    params.edge_count = edge;
    params.voxel_edge = 1.0f / static_cast<float>(edge);
    params.q[3] = 1;
    for (size_t c = 0; c < 3; ++c)
        params.t[c] = -0.5f;
    return params;
}

using List = std::vector<std::unique_ptr<StageBuffer>>;

std::unique_ptr<StageBuffer> floats_on(StageDevice& device, size_t count, float most,
                                       uint32_t seed) {
    auto buffer = device.floats(count);
    buffer->write(random_floats(count, most, seed));
    return buffer;
}

std::unique_ptr<StageBuffer> counts_on(StageDevice& device) {
    auto buffer = device.uints(strands);
    buffer->write(std::vector<uint32_t>(strands, vertices));
    return buffer;
}

constexpr size_t rows = (strands + tile - 1) / tile * tile * vertices;

TEST_P(OnDevice, of_vertices_are_those_of_the_grid) {
    const auto buffers = [](StageDevice& device) {
        List list;
        list.push_back(counts_on(device));
        for (const uint32_t seed : {1u, 2u}) {
            list.push_back(device.float4s(size_t{strands} * vertices));
            const auto values = random_floats(size_t{strands} * vertices * 4, 0.55f, seed);
            std::vector<Float4> points(values.size() / 4);
            for (size_t i = 0; i < values.size(); ++i)
                points[i / 4][i % 4] = values[i];
            list.back()->write(points);
        }
        return list;
    };
    for (const uint32_t edge : edges<plait_grid_params>(PLAIT_STAGE_grid_splat))
        for (const uint32_t tent : {PLAIT_TENT_VOXEL, PLAIT_TENT_TRILINEAR}) {
            auto params = grid_of<plait_grid_params>(edge);
            params.tent = tent;
            params.h = 1.0f / 60;
            expect_same(PLAIT_STAGE_grid_splat, params, 1, buffers);
        }
}

TEST_P(OnDevice, of_lanes_are_those_of_the_grid) {
    const auto buffers = [](StageDevice& device) {
        List list;
        list.push_back(nullptr);
        list.push_back(counts_on(device));
        list.push_back(floats_on(device, rows * 3, 0.3f, 3));
        list.push_back(floats_on(device, rows * 3, 2, 4));
        return list;
    };
    for (const uint32_t edge : edges<plait_lane_grid_params>(PLAIT_STAGE_lane_splat))
        for (const uint32_t tent : {PLAIT_TENT_VOXEL, PLAIT_TENT_TRILINEAR}) {
            auto params = grid_of<plait_lane_grid_params>(edge);
            params.tile = tile;
            params.tent = tent;
            expect_same(PLAIT_STAGE_lane_splat, params, vertices, buffers);
        }
}

TEST_P(OnDevice, of_volume_are_those_of_the_grid) {
    const auto buffers = [](StageDevice& device) {
        List list;
        list.push_back(nullptr);
        list.push_back(counts_on(device));
        list.push_back(nullptr);
        list.push_back(floats_on(device, rows * PLAIT_LANE_SHARE_COMPONENTS, 1, 5));
        list.push_back(floats_on(device, rows * 3, 0.3f, 6));
        list.push_back(floats_on(device, rows * 3, 2, 7));
        return list;
    };
    for (const uint32_t edge : edges<plait_lane_volume_params>(PLAIT_STAGE_volume_splat)) {
        auto params = grid_of<plait_lane_volume_params>(edge);
        params.tile = tile;
        expect_same(PLAIT_STAGE_volume_splat, params, vertices, buffers);
    }
}

} // namespace
} // namespace plait::test
