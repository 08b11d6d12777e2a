// Which strands of a groom are stored from tip to root, as far as the others tell.
#pragma once

#include "core/groom/strand_set.hpp"

#include <memory_resource>
#include <vector>

namespace plait {

// Roots lie side by side on a skin, and tips among tips. A strand whose first vertex has the last
// vertices of others around it, and its last vertex their first, is contradicted: likely it is stored
// from tip to root. Ascending; none where roots and tips lie mixed, as in fur that is combed flat.
// `some_are`: that some are stored so is known, and single ones count.
std::pmr::vector<uint32_t> contradicted_roots(const StrandSet& strands,
                                              std::pmr::memory_resource* memory,
                                              bool some_are = false);

// Turns these strands around; their other values stay.
void turn_around(StrandSet& strands, const std::pmr::vector<uint32_t>& which);
void turn_all_around(StrandSet& strands);

} // namespace plait
