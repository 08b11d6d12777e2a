// Hair that crosses other hair, in a crowd, and the cells its segments are in.
#pragma once

#include "inputs.hpp"

namespace plait::cases {

struct PairHair {
    Hair hair; // position moved to a crowd; position_prev as it moves in a substep
    plait_pair_params params;

    uint32_t vertices() const { return hair.vertices(); }
    uint32_t cells() const { return params.edge_count * params.edge_count * params.edge_count; }
    Setup setup() const; // name, items and parameters
};

// Around the origin and far from it; in cells that repeat within the hair, and not.
std::vector<PairHair> make_pair_hair();

// By definition: the cell of the segment that begins at a vertex, for those that begin one.
struct SegmentCell {
    uint32_t segment, cell;
};
std::vector<SegmentCell> segment_cells(const PairHair& hair);

// cell_count, cell_end before contact_pair_fill, cell_end and cell_segment after it.
struct PairCells {
    std::vector<uint32_t> count, begin, end, segments;
};
PairCells make_pair_cells(const PairHair& hair);

// By definition: cell_line of segments in this order.
std::vector<float> make_pair_lines(const PairHair& hair, const std::vector<uint32_t>& segments);

// By definition: cell_moves.
std::vector<uint32_t> make_pair_moves(const PairHair& hair);

// m, of two segments of float4 positions.
double segment_distance(const std::vector<float>& positions, uint32_t one, uint32_t other);

} // namespace plait::cases
