#include "grid_inputs.hpp"

#include <cmath>
#include <cstdio>

namespace plait::cases {
namespace {

double sum_of(const std::vector<uint32_t>& words, size_t voxel, size_t which) {
    const size_t first = voxel * PLAIT_SUM_STRIDE + 2 * which;
    const auto sum =
        static_cast<int64_t>(static_cast<uint64_t>(words[first + 1]) << 32 | words[first]);
    const double scale = which == 0   ? PLAIT_SUM_DENSITY_SCALE
                         : which == 4 ? PLAIT_SUM_ENERGY_SCALE
                                      : PLAIT_SUM_MOMENTUM_SCALE;
    return static_cast<double>(sum) / scale;
}

// Per vertex a weight is good to 2e-6 and a velocity below 2 m/s to 1e-5 m/s; up to 100 vertices.
constexpr std::array<double, PLAIT_SUM_COUNT> tolerance = {4e-5, 4e-4, 4e-4, 4e-4, 8e-4};

std::string compare_sums(const Setup&, const Outputs& expected, const Outputs& got) {
    const auto& want = expected[3].words;
    for (size_t voxel = 0; voxel < want.size() / PLAIT_SUM_STRIDE; ++voxel)
        for (size_t which = 0; which < PLAIT_SUM_COUNT; ++which) {
            const double a = sum_of(got[3].words, voxel, which), b = sum_of(want, voxel, which);
            if (std::abs(a - b) > tolerance[which]) {
                char text[120];
                std::snprintf(text, sizeof text, "grid_sum of voxel %zu, sum %zu is %.9g, not %.9g",
                              voxel, which, a, b);
                return text;
            }
        }
    return "";
}

} // namespace

Case grid_splat_case() {
    Case result = {PLAIT_STAGE_grid_splat,
                   {},
                   {},
                   {"slot_hash", "frame", "seed", "diffuse_rule", "diffuse_ratio", "diffuse_factor",
                    "diffuse_floor", "position.w"},
                   {{"grid_sum", compare_sums}}};
    for (GridHair hair : make_grid_hair())
        for (uint32_t tent : {PLAIT_TENT_VOXEL, PLAIT_TENT_TRILINEAR}) {
            hair.params.tent = tent;
            Setup setup = hair.setup();
            setup.name += tent == PLAIT_TENT_VOXEL ? ", voxel" : ", trilinear";
            setup.items = hair.size.strands;
            const size_t words = size_t{hair.voxels()} * PLAIT_SUM_STRIDE;
            setup.buffers = {uints(hair.vertex_count), float4s(hair.position),
                             float4s(hair.position_prev), uints(std::vector<uint32_t>(words, 0)),
                             uints({7})};
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
