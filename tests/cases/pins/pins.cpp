#include "inputs.hpp"

namespace plait::cases {

// Also of pins that were free before, or in another frame: those have no way.
Case pins_case() {
    Case result = {PLAIT_STAGE_pins, {}, {{"pin_to", 1e-6}}, {}};
    result.flags = {"pin_at.w"};
    for (const Size& size : sizes()) {
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands * size.stride;
        const std::vector<float> before = pin_rows(size, 51), after = pin_rows(size, 52);
        setup.buffers = {float4s(before), float4s(after),
                         float4s(std::vector<float>(after.size(), 9))};
        result.setups.push_back(setup.with(plait_pins_params{size.stride, 0.3f, 0.8f, 1.5f}));
    }
    return result;
}

} // namespace plait::cases
