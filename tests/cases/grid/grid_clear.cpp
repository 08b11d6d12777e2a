#include "inputs.hpp"

namespace plait::cases {

Case grid_clear_case() {
    Case result = {PLAIT_STAGE_grid_clear, {}, {}};
    for (uint32_t words : {1u, 67u, 4096u, 5001u})
        for (uint32_t value : {0u, PLAIT_SLOT_EMPTY}) {
            Setup setup;
            setup.name = std::to_string(words) + " words";
            setup.items = words;
            setup.buffers = {uints(std::vector<uint32_t>(words, 12345))};
            result.setups.push_back(setup.with(plait_grid_clear_params{value}));
        }
    return result;
}

} // namespace plait::cases
