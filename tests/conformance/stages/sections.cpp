// What is round and twists as it bends costs nothing: a strand that shares its work-item with
// others whose section is not round has the bits that it has among round ones.
#include "closed_forms.hpp"
#include "lane_inputs.hpp"

namespace plait::conformance {

using namespace cases;

namespace {

constexpr size_t material_at = 3; // in the setups of lane_setup()

// Every other strand round, or all.
Setup strands(bool all_round, const plait_lane_params& params) {
    const Size size{67, 16};
    LaneHair lanes = make_lane_hair(size, 11);
    const size_t row = size_t{size.stride} * PLAIT_LANE_MATERIAL_COMPONENTS;
    for (size_t k = 0; k < lanes.material.size(); k += PLAIT_LANE_MATERIAL_COMPONENTS)
        if (all_round || k / row % 2 == 0)
            lanes.material[k + PLAIT_LANE_TWIST] = lanes.material[k + PLAIT_LANE_CROSS] = 0;
    return lane_setup(size, lanes, params, true);
}

void round_strands_keep_their_bits(Bench& bench, plait_stage stage) {
    for (const uint32_t bdf2 : {0u, 1u}) {
        const plait_lane_params params = lane_params({67, 16}, 2, bdf2);
        const Setup mixed = strands(false, params), all_round = strands(true, params);
        const Outputs among_others =
            bench.run(stage, mixed.items, mixed.width, params, mixed.buffers);
        const Outputs alone =
            bench.run(stage, all_round.items, all_round.width, params, all_round.buffers);
        ASSERT_EQ(among_others.size(), alone.size());
        size_t differ = 0;
        for (size_t b = 0; b < alone.size(); ++b) {
            if (b == material_at)
                continue;
            const std::vector<float>&a = among_others[b].floats, &expected = alone[b].floats;
            ASSERT_EQ(a.size(), expected.size());
            const size_t width = a.size() / mixed.items;
            for (size_t i = 0; i < a.size() && width > 0; ++i)
                if (i / width % 2 == 0)
                    EXPECT_EQ(a[i], expected[i]) << "buffer " << b << ", " << i;
                else
                    differ += a[i] != expected[i];
        }
        EXPECT_GT(differ, 1000u) << "the others' sections do nothing";
    }
}

void articulated_has_the_bits_of_round_strands(Bench& bench) {
    round_strands_keep_their_bits(bench, PLAIT_STAGE_articulated);
}

} // namespace

const std::vector<ClosedForm>& section_closed_forms() {
    static const std::vector<ClosedForm> list = {
        PLAIT_CLOSED_FORM(articulated_has_the_bits_of_round_strands),
    };
    return list;
}

} // namespace plait::conformance
