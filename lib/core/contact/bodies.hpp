// The colliders of a substep, in one buffer: first those that are no meshes, then meshes of form FIELD,
// then meshes of form NEAREST, and what meshes have beside their rows.
#pragma once

#include "core/base/part.hpp"

namespace plait {

struct MeshBuffers;
struct BendingBuffers;

struct Bodies {
    ColliderRows solids;
    ColliderRows fields;
    ColliderRows nearest;
    const MeshBuffers* field_buffers;      // null: there are none
    const BendingBuffers* nearest_buffers; // null: there are none
};

} // namespace plait
