#include "strand_contact/pair_inputs.hpp"

namespace plait::cases {

Case contact_pair_scan_case() {
    Case result = {PLAIT_STAGE_contact_pair_scan, {}, {}};
    for (const PairHair& hair : make_pair_hair())
        // One that takes all of the largest grid's would be more turns than llvmpipe allows.
        for (const uint32_t width : {hair.cells() > 30000 ? 16u : 1u, 24u}) {
            Setup setup = hair.setup();
            setup.name += ", " + std::to_string(width) + " work-items";
            setup.items = 1;
            setup.width = width;
            setup.buffers = {uints(make_pair_cells(hair).count),
                             uints(std::vector<uint32_t>(hair.cells(), 9))};
            result.setups.push_back(
                setup.with(plait_contact_pair_scan_params{hair.params.edge_count}));
        }
    return result;
}

} // namespace plait::cases
