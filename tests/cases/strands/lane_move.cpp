#include "lane_inputs.hpp"

namespace plait::cases {
namespace {

// Half the strands leave their lane for one counted from the other end.
std::vector<uint32_t> moves(uint32_t strands) {
    std::vector<uint32_t> list;
    const uint32_t count = (strands + 1) / 2;
    const auto from = other_order(strands, count);
    for (uint32_t i = 0; i < count; ++i) {
        list.push_back(from[i]);
        list.push_back(i);
    }
    return list;
}

} // namespace

Case lane_move_case() {
    Case result = {PLAIT_STAGE_lane_move, {}, {}, {"lane_to"}}; // written or kept
    for (const Size& size : sizes()) {
        const LaneHair here = make_lane_hair(size, 39), there = make_lane_hair(size, 40);
        const auto add = [&](const char* what, uint32_t components, const std::vector<float>& from,
                             const std::vector<float>& to) {
            Setup setup;
            setup.name = name_of(size) + ", " + what;
            setup.buffers = {uints(moves(size.strands)), lane_floats(from, components),
                             lane_floats(to, components)};
            setup.items = static_cast<uint32_t>(setup.buffers[0].words.size() / 2);
            result.setups.push_back(setup.with(plait_lane_move_params{size.stride, 1, components}));
        };
        add("positions", 3, here.x, there.x);
        add("orientations", 4, here.q, there.q);
        add("material", PLAIT_LANE_MATERIAL_COMPONENTS, here.material, there.material);
    }
    return result;
}

} // namespace plait::cases
