// What strands are made of.
#pragma once

#include "base/result.hpp"

#include <memory>
#include <memory_resource>
#include <vector>

namespace plait {

struct StrandMaterials {
    std::pmr::vector<plait_material> table; // one at least
    std::pmr::vector<uint32_t> of;          // [guides], into the table; empty: all are of the first
};
using StrandMaterialsPtr = std::shared_ptr<const StrandMaterials>; // never null

plait_material default_material();

// INVALID_ARGUMENT names list, index, value and range.
Status check_material(const plait_material& material);
Status check_materials(const StrandMaterials& materials, size_t guides);

} // namespace plait
