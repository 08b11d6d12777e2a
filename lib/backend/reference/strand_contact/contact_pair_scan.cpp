// contact_pair_scan: sums of the counts of all cells before.
#include "backend/reference/strand_contact/pair.hpp"

namespace plait::reference {

void contact_pair_scan(uint32_t item_count, const plait_contact_pair_scan_params& params,
                       const contact_pair_scan_args& args) {
    if (item_count == 0)
        return;
    const size_t cells = size_t{params.edge_count} * params.edge_count * params.edge_count;
    uint32_t sum = 0;
    for (size_t cell = 0; cell < cells; ++cell) {
        args.cell_end[cell] = sum;
        sum += args.cell_count[cell];
    }
}

} // namespace plait::reference
