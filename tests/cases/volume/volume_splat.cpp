#include "lane_inputs.hpp"
#include "volume/volume_inputs.hpp"

#include <array>
#include <cmath>

namespace plait::cases {
namespace {

// [vertices][2]: hair that a vertex stands for, and how dense it was.
std::vector<float> shares(const GridHair& hair) {
    Random random(hair.size.stride);
    std::vector<float> values;
    for (uint32_t vertex = 0; vertex < hair.vertices(); ++vertex) {
        values.push_back(static_cast<float>(random.uniform(.5, 1.5)));
        values.push_back(static_cast<float>(random.uniform(1, 4)));
    }
    return values;
}

std::vector<float> wetness_of(uint32_t strands) {
    Random random(strands + 3);
    std::vector<float> values;
    for (uint32_t strand = 0; strand < strands; ++strand)
        values.push_back(static_cast<float>(random.uniform(.3, 1)));
    return values;
}

double sum_of(const Array& array, size_t voxel, size_t which) {
    const auto* words = &array.words[voxel * PLAIT_SUM_STRIDE + 2 * which];
    return double(static_cast<int64_t>(static_cast<uint64_t>(words[1]) << 32 | words[0]));
}

// As compare_sums(); the fifth is of densities, to 2^-17 of a vertex each.
std::string compare(const Setup&, const Outputs& expected, const Outputs& got) {
    constexpr std::array<double, PLAIT_SUM_COUNT> tolerance = {6e-5, 6e-4, 6e-4, 6e-4, 2e-3};
    for (size_t voxel = 0; voxel < expected[6].words.size() / PLAIT_SUM_STRIDE; ++voxel)
        for (size_t which = 0; which < PLAIT_SUM_COUNT; ++which) {
            const double scale = which == 0   ? double(PLAIT_SUM_DENSITY_SCALE)
                                 : which == 4 ? double(PLAIT_SUM_REST_SCALE)
                                              : double(PLAIT_SUM_MOMENTUM_SCALE);
            const double a = sum_of(got[6], voxel, which), b = sum_of(expected[6], voxel, which);
            if (std::abs(a - b) > tolerance[which] * scale)
                return "grid_sum of voxel " + std::to_string(voxel) + ", sum " +
                       std::to_string(which) + " is " + std::to_string(a / scale) + ", not " +
                       std::to_string(b / scale);
        }
    return "";
}

} // namespace

Case volume_splat_case() {
    Case result = {PLAIT_STAGE_volume_splat, {}, {}, {"moves", "history"}, {{"grid_sum", compare}}};
    std::vector<GridHair> hairs = make_grid_hair();
    hairs.push_back(make_much_grid_hair());
    for (const GridHair& hair : hairs) {
        const LaneGridHair lanes = over_lanes(hair);
        Setup setup = hair.setup().with(volume_params_of(lanes.params));
        setup.items = hair.size.strands;
        setup.width = hair.size.stride;
        setup.buffers = {null_array(),
                         uints(hair.vertex_count),
                         floats(wetness_of(hair.size.strands)),
                         lane_floats(shares(hair), PLAIT_LANE_SHARE_COMPONENTS),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.v, 3),
                         uints(std::vector<uint32_t>(size_t{hair.voxels()} * PLAIT_SUM_STRIDE, 0)),
                         uints({7})};
        result.setups.push_back(setup);
        for (const uint32_t soaked : {0u, 1u}) {
            plait_lane_volume_params wet = setup.params_as<plait_lane_volume_params>();
            wet.wet = 1;
            wet.soaked = soaked;
            Setup of_wet = setup;
            of_wet.name += soaked ? ", wetness" : ", wet";
            result.setups.push_back(of_wet.with(wet));
        }
        if (hair.size.strands < 3)
            continue;
        setup.name += ", reordered";
        setup.items -= 1;
        setup.buffers[0] = uints(other_order(hair.size.strands, hair.size.strands - 1));
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
