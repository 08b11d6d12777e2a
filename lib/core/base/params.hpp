// All that a sim's steps read of what its caller may set between them.
#pragma once

#include <plait/plait.h>

namespace plait {

// What its plait_sim_set_<feature> was given last, or the defaults where it is off.
template <typename Desc> struct Feature : Desc { bool on = false; };

// How the inter-hair grid sums up hair.
enum class GridKind { off, slots, exact };

struct Params : plait_sim_params {
    plait_tressfx_desc tressfx;
    Feature<plait_grid_desc> grid;
    Feature<plait_volume_desc> volume;
    Feature<plait_strand_contact_desc> strand_contact;
    Feature<plait_wetness_desc> wetness;
    Feature<plait_acceleration_desc> acceleration;

    GridKind grid_kind() const {
        if (volume.on || (grid.on && grid.form == PLAIT_GRID_FORM_EXACT))
            return GridKind::exact; // which volume needs, with or without the brake
        return grid.on ? GridKind::slots : GridKind::off;
    }
};

} // namespace plait
