#include "lane_inputs.hpp"

namespace plait::cases {
namespace {

constexpr size_t components = PLAIT_LANE_MATERIAL_COMPONENTS;

float& last_of(std::vector<float>& material, size_t strand, size_t stride, size_t component) {
    return material[((strand + 1) * stride - 1) * components + component];
}

} // namespace

// Every third strand is scaled by what it has already, and keeps rows that nothing else would write;
// every fourth has joints as limp as may be.
Case lane_wetness_case() {
    Case result = {PLAIT_STAGE_lane_wetness, {}, {{"lane_material", 1e-7}}, {}};
    result.flags = {"lane_dry.weighed"};
    for (const char* written :
         {"length", "stretch", "drag", "bend", "friction", "mass", "twist", "cross"})
        result.unread.push_back(std::string("lane_material.") + written);
    for (const Size& size : sizes()) {
        LaneHair lanes = make_lane_hair(size, 71);
        // of one size, so that a hundredth of each shows
        for (size_t i = 0; i < lanes.material.size(); ++i) {
            const bool last = i / components % size.stride + 1 == size.stride;
            const size_t component = i % components;
            if (component == PLAIT_LANE_MASS ||
                (!last && component != PLAIT_LANE_LENGTH && component != PLAIT_LANE_STRETCH))
                lanes.material[i] *= 1e4f;
        }
        std::vector<float> material(lanes.material.size(), 0.25f), held;
        Random random(size.strands);
        for (size_t s = 0; s < size.strands; ++s) {
            held.push_back(static_cast<float>(random.uniform(0.3, 1)));
            last_of(material, s, size.stride, PLAIT_LANE_WETNESS) = s % 3 == 2 ? held[s] : 0.1f;
            last_of(lanes.material, s, size.stride, PLAIT_LANE_WEIGHED) = s % 2 ? 1.0f : 0.0f;
            for (size_t i = s % 4 == 3 ? s * size.stride : (s + 1) * size.stride;
                 i + 1 < (s + 1) * size.stride; ++i) {
                const float* row = &lanes.material[i * components];
                lanes.material[i * components + PLAIT_LANE_BEND] = 1e-5f * row[PLAIT_LANE_STRETCH] *
                                                                   row[PLAIT_LANE_LENGTH] *
                                                                   row[PLAIT_LANE_LENGTH];
            }
        }
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {null_array(), floats(held), lane_floats(lanes.material, components),
                         lane_floats(material, components)};
        result.setups.push_back(setup.with(plait_lane_wetness_params{size.stride, 1}));
        setup.name += ", reordered";
        setup.buffers[0] = uints(other_order(size.strands, size.strands));
        result.setups.push_back(setup.with(plait_lane_wetness_params{size.stride, 1}));
    }
    return result;
}

} // namespace plait::cases
