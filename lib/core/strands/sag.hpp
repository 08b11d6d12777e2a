// Sag-free start: the rest shape under which a strand as groomed is in equilibrium with gravity.
#pragma once

#include "core/strands/rest_strand.hpp"
#include "core/strands/sag_report.hpp"

#include <plait/plait.h>

namespace plait {

// Changes lengths, unless `strand` is inextensible, and rest rotations of `strand`, and with
// PLAIT_SAG_FREE_STIFFEN the stiffness of joints that could not hold it.
SagReport remove_sag(RestStrand& strand, const Vec3& gravity, plait_sag_free mode);

} // namespace plait
