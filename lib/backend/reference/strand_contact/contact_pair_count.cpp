// contact_pair_count: how many segments have their middle in each cell, and how far vertices move.
#include "backend/reference/strand_contact/pair.hpp"

#include <algorithm>
#include <bit>

namespace plait::reference {

void contact_pair_count(uint32_t item_count, const plait_pair_params& params,
                        const contact_pair_count_args& args) {
    for (uint32_t item = 0; item < item_count; ++item)
        if (has_segment(args.vertex_count, item, params.vertex_stride)) {
            const Cell cell = cell_of(params, segment_at(args.position, item).middle());
            ++args.cell_count[number_of(cell, params.edge_count)];
            const Segment moves = moves_of(args.position, args.position_prev, item);
            uint32_t& most = args.cell_moves[block_of(params, cell)];
            for (const Vec3& way : {moves.from, moves.to})
                most = std::max(most, std::bit_cast<uint32_t>(static_cast<float>(way.norm())));
        }
}

} // namespace plait::reference
