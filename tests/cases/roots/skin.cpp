#include "roots/skin_inputs.hpp"

namespace plait::cases {
namespace {

constexpr uint32_t bones = 5;

// Rotations, one of them scaled unevenly and one mirrored, that move by up to 2 m.
std::vector<float> matrices(Random& random) {
    std::vector<float> rows;
    for (uint32_t bone = 0; bone < bones; ++bone) {
        const auto q = random.rotation();
        const double x = q[0], y = q[1], z = q[2], w = q[3];
        const double turn[3][3] = {
            {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
        const double scale[3] = {1, bone == 3 ? 0.6 : 1, bone == 4 ? -0.8 : 1};
        for (const auto& row : turn) {
            for (int column = 0; column < 3; ++column)
                rows.push_back(static_cast<float>(row[column] * scale[column]));
            rows.push_back(static_cast<float>(random.uniform(-2, 2)));
        }
    }
    return rows;
}

// The first bone outweighs the others, so that no blend is far from a rotation and none is in
// doubt.
Setup make(const Size& size) {
    Random random(size.strands);
    Hair hair = make_hair(size, 12);
    for (float& x : hair.rest) // so far that the blends' stretch of a root shows
        x = static_cast<float>(random.uniform(-2, 2));
    std::vector<uint32_t> indices;
    std::vector<float> weights;
    for (uint32_t strand = 0; strand < size.strands; ++strand) {
        for (uint32_t k = 0; k < 4; ++k)
            indices.push_back((strand + k) % bones);
        const bool one = strand % 3 == 0 && strand % bones != 4;
        for (const float weight : {one ? 1.0f : 0.7f, one ? 0.0f : 0.2f, one ? 0.0f : 0.1f, 0.0f})
            weights.push_back(weight);
    }
    Setup setup;
    setup.name = name_of(size);
    setup.items = size.strands;
    setup.buffers = {float4s(matrices(random)), uints(indices), floats(weights), float4s(hair.rest),
                     unwritten_float4s(size_t{2} * size.strands)};
    return setup.with(plait_layout_params{size.stride});
}

} // namespace

std::string compare_poses(const Setup& setup, const Outputs& expected, const Outputs& got) {
    const std::vector<float>& want = expected[4].floats;
    const std::vector<float>& have = got[4].floats;
    for (uint32_t strand = 0; strand < setup.items; ++strand) {
        double same = 0, other = 0, shift = 0;
        for (size_t i = 8 * size_t{strand}; i < 8 * size_t{strand} + 4; ++i) {
            same = std::max(same, std::abs(double(want[i]) - have[i]));
            other = std::max(other, std::abs(double(want[i]) + have[i]));
            shift = std::max(shift, std::abs(double(want[i + 4]) - have[i + 4]));
        }
        if (!(std::min(same, other) <= 5e-6 && shift <= 2e-5))
            return "pose of strand " + std::to_string(strand) + ": rotation differs by " +
                   std::to_string(std::min(same, other)) + ", translation by " +
                   std::to_string(shift);
    }
    return {};
}

// Eigenvalues of blends this near to rotations lie apart: a rotation is as exact as the matrix.
Case skin_case() {
    Case result = {PLAIT_STAGE_skin, {}, {}, {"rest.w"}, {{"pose", compare_poses}}};
    for (const Size& size : sizes())
        result.setups.push_back(make(size));
    return result;
}

} // namespace plait::cases
