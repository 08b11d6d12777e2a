#include "pair_inputs.hpp"

namespace plait::cases {

// No segment has its middle so near a wall between cells that rounding decides.
Case pair_count_case() {
    Case result = {PLAIT_STAGE_pair_count, {}, {}, {"diameter", "room", "steps", "position.w"}};
    for (const PairHair& hair : make_pair_hair()) {
        Setup setup = hair.setup();
        setup.buffers = {uints(hair.hair.vertex_count), float4s(hair.hair.position),
                         uints(std::vector<uint32_t>(hair.cells(), 3))};
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
