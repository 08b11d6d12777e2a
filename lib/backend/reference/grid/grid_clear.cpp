// grid_clear: fill the words of a grid buffer: slots with PLAIT_SLOT_EMPTY, sums with 0.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void grid_clear(uint32_t item_count, const plait_grid_clear_params& params,
                const grid_clear_args& args) {
    for (size_t word = 0; word < item_count; ++word)
        args.words[word] = params.value;
}

} // namespace plait::reference
