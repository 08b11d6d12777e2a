#include "inputs.hpp"

namespace plait::cases {

// Away from what decides: 1e-3 of what is left, and a move of 0.02.
Case wetness_case() {
    Case result = {PLAIT_STAGE_wetness, {}, {{"strand_wetness", 1e-7}, {"wetness_held", 1e-7}}};
    constexpr float left = 0.7f;
    for (const uint32_t strands : {1u, 2u, 7u, 33u, 300u}) {
        Random random(strands);
        std::vector<float> given, held;
        for (uint32_t i = 0; i < strands; ++i) {
            given.push_back(i % 5 == 3 ? 1e-3f : static_cast<float>(random.uniform(0.1, 1)));
            // by more than a move, and by so little less that a hundredth of what is held is one
            const float off = i % 3 == 0 ? 0.05f : 0.0185f;
            held.push_back(i % 5 == 3 ? 0.01f : left * given[i] + off);
        }
        Setup setup;
        setup.name = std::to_string(strands) + " strands";
        setup.items = strands;
        setup.buffers = {floats(given), unwritten_floats(strands), floats(held)};
        result.setups.push_back(setup.with(plait_wetness_params{left}));
    }
    return result;
}

} // namespace plait::cases
