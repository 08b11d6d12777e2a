// Where the model articulated keeps a strand: [tile][V][components][strands of a tile], so that a device
// reads as many strands at once as it has lanes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plait {

struct LaneLayout {
    uint32_t strands;
    uint32_t row;  // V
    uint32_t tile; // strands per tile

    // Of whole tiles, the last one filled up.
    size_t padded_strands() const { return (size_t{strands} + tile - 1) / tile * tile; }
    size_t rows() const { return padded_strands() * row; }
    size_t index(size_t strand, size_t vertex, size_t component, size_t components) const {
        return ((strand / tile * row + vertex) * components + component) * tile + strand % tile;
    }
};

// Calls visit(index in the lane layout, index in [strand][V][components]) for every element of the
// strands there are.
template <typename Visit>
void for_each_lane_element(const LaneLayout& layout, uint32_t components, const Visit& visit) {
    size_t plain = 0;
    for (size_t strand = 0; strand < layout.strands; ++strand)
        for (size_t vertex = 0; vertex < layout.row; ++vertex)
            for (size_t component = 0; component < components; ++component)
                visit(layout.index(strand, vertex, component, components), plain++);
}

} // namespace plait
