// Sizes of a sim's rows: [strands][V], guides first, then follows.
#pragma once

#include <cstdint>

namespace plait {

struct Layout {
    uint32_t guides = 0;
    uint32_t follows = 0;
    uint32_t row = 0; // V: vertices per strand row

    uint32_t strands() const { return guides + follows; }
    uint32_t guide_vertices() const { return guides * row; }
    uint32_t vertices() const { return strands() * row; }
};

} // namespace plait
