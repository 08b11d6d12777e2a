// Materials of single strands, in place of what the parameters say.
#pragma once

#include "base/result.hpp"

#include <memory>
#include <memory_resource>
#include <vector>

namespace plait {

struct StrandMaterials {
    std::pmr::vector<plait_material> table;
    std::pmr::vector<uint32_t> of; // [guides], into the table, or PLAIT_MATERIAL_OF_PARAMS
};
using StrandMaterialsPtr = std::shared_ptr<const StrandMaterials>; // none: all of the parameters

plait_material default_material();

// An empty `of` becomes that of one material for all. INVALID_ARGUMENT names list, index, value and
// range.
Status check_materials(StrandMaterials& materials, size_t guides);

} // namespace plait
