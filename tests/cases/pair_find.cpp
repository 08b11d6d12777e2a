#include "pair_inputs.hpp"

namespace plait::cases {

// Distances of a few millimetres between points within a metre of the origin; at rest, 0.3 m.
Case pair_find_case() {
    Case result = {PLAIT_STAGE_pair_find,
                   {},
                   {{"pair_offset", 1e-6}},
                   {"position.w", "position_prev.w"}};
    for (const PairHair& hair : make_pair_hair()) {
        const PairCells cells = make_pair_cells(hair);
        const size_t pairs = size_t{PLAIT_PAIR_COUNT} * hair.vertices();
        Setup setup = hair.setup();
        setup.buffers = {uints(hair.hair.vertex_count),
                         float4s(hair.hair.rest),
                         float4s(hair.hair.position),
                         float4s(hair.hair.position_prev),
                         uints(cells.end),
                         uints(cells.segments),
                         uints(std::vector<uint32_t>(pairs, 5)),
                         unwritten_floats(pairs),
                         uints({3})};
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
