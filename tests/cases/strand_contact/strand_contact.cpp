#include "lane_inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

constexpr size_t components = PLAIT_LANE_PLANE_COMPONENTS;

// Of each segment up to four others, and how far they stay apart.
void add_pairs(Setup& setup, const Hair& hair, Random& random) {
    std::vector<uint32_t> pairs;
    std::vector<float> offsets;
    for (uint32_t vertex = 0; vertex < hair.vertices(); ++vertex) {
        const uint32_t kept = random.below(PLAIT_PAIR_COUNT + 1);
        for (uint32_t k = 0; k < PLAIT_PAIR_COUNT; ++k) {
            const uint32_t strand = random.below(hair.size.strands);
            const uint32_t first =
                strand * hair.size.stride + random.below(hair.vertex_count[strand] - 1);
            const bool other = k < kept && first / hair.size.stride != vertex / hair.size.stride;
            pairs.push_back(other ? first : PLAIT_PAIR_NONE);
            offsets.push_back(static_cast<float>(random.uniform(0.02, 0.6)));
        }
    }
    setup.buffers.push_back(uints(pairs));
    setup.buffers.push_back(floats(offsets));
}

// Some near, some far, some none, in the first half of a strand.
std::vector<float> mesh_planes(const LaneHair& lanes, Random& random) {
    const Hair& hair = lanes.hair;
    std::vector<float> rows(components * hair.vertices(), 0.3f);
    for (uint32_t s = 0; s < hair.size.strands; ++s) {
        float* strand = &rows[components * s * hair.size.stride];
        const uint32_t last = hair.vertex_count[s] / 2;
        strand[PLAIT_LANE_PLANE_LAST] = static_cast<float>(last);
        for (uint32_t i = 1; i <= last; ++i) {
            float* plane = strand + components * i;
            const Point normal = random.direction();
            for (size_t k = 0; k < 3; ++k) {
                plane[k] = i % 3 == 2 ? 0 : static_cast<float>(normal[k]);
                plane[3 + k] = lanes.x[3 * (size_t{s} * hair.size.stride + i) + k] +
                               static_cast<float>(random.uniform(-0.3, 0.3));
            }
            plane[PLAIT_LANE_PLANE_HEIGHT] = static_cast<float>(random.uniform(-0.4, 0.3));
        }
    }
    return rows;
}

Setup contact_setup(const Size& size, uint32_t meshes) {
    const LaneHair lanes = make_lane_hair(size, 81);
    Random random(82 + size.stride);
    Setup setup;
    setup.name = name_of(size) + (meshes ? ", meshes" : "");
    setup.items = size.strands;
    setup.width = size.stride;
    setup.buffers = {null_array(),
                     uints(lanes.hair.vertex_count),
                     float4s(lanes.hair.rest),
                     float4s(lanes.hair.pose),
                     float4s(lanes.hair.position),
                     float4s(lanes.hair.position_prev)};
    add_pairs(setup, lanes.hair, random);
    setup.buffers.push_back(lane_floats(lanes.x, 3));
    setup.buffers.push_back(lane_floats(mesh_planes(lanes, random), components));
    return setup.with(plait_strand_contact_params{size.stride, 1, size.stride, meshes, 0.4f});
}

// The same lanes where strands have rows of `more` vertices more, and segments other numbers.
Setup longer(const Setup& plain, uint32_t more) {
    Setup setup = in_longer_rows(plain, PLAIT_STAGE_strand_contact, more);
    const uint32_t row = plain.width + more;
    std::vector<uint32_t> pairs(size_t{PLAIT_PAIR_COUNT} * plain.items * row, PLAIT_PAIR_NONE);
    std::vector<float> offsets(pairs.size(), 0);
    for (size_t i = 0; i < plain.buffers[6].words.size(); ++i) {
        const size_t width = size_t{PLAIT_PAIR_COUNT} * plain.width;
        const size_t to = i / width * PLAIT_PAIR_COUNT * row + i % width;
        const uint32_t other = plain.buffers[6].words[i];
        if (other != PLAIT_PAIR_NONE)
            pairs[to] = other / plain.width * row + other % plain.width;
        offsets[to] = plain.buffers[7].floats[i];
    }
    setup.buffers[6] = uints(pairs);
    setup.buffers[7] = floats(offsets);
    return setup;
}

} // namespace

// Normals of segments that are a few centimetres apart, within metres of the origin.
Case strand_contact_case() {
    Case result = {PLAIT_STAGE_strand_contact,
                   {},
                   {{"lane_plane", 5e-5}},
                   {"position.w", "position_prev.w", "lane_plane.start", "lane_plane.friction"}};
    for (const Size& size : sizes())
        for (const uint32_t meshes : {0u, 1u})
            if (size.strands > 1)
                result.setups.push_back(contact_setup(size, meshes));
    result.setups.push_back(contact_setup({4000, 16}, 1)); // some meet both just as deep
    result.setups.push_back(longer(result.setups[3], 2));
    return result;
}

} // namespace plait::cases
