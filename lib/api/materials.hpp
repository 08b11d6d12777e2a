// Materials as they are given.
#pragma once

#include "core/groom/materials.hpp"

namespace plait::api {

// The default one where nothing is given; `strand_material`: of each of `guides`, or empty.
Result<StrandMaterialsPtr> read_materials(const plait_material* list, size_t count,
                                          const plait_view& strand_material, size_t guides,
                                          std::pmr::memory_resource* memory);

} // namespace plait::api
