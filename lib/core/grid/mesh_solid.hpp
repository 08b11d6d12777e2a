// Marks grid nodes inside mesh colliders. Used by volume and wind.
#pragma once

#include "core/base/schedule.hpp"
#include "core/contact/bodies.hpp"

namespace plait {

// Its nodes are the centres of its voxels.
struct NodeGridPlace {
    uint32_t edge_count;
    float voxel_edge; // m
    float q[4], t[4]; // orientation, and the corner in the world
};

class MeshSolid {
  public:
    static Result<MeshSolid> create(Device& device, uint32_t edge_count);

    // Appends what finds them, at the end of a substep of `h` s: float4 [edge_count^3], velocity along the
    // grid's axes, m/s, and 1 inside. Null, and nothing appended, where no mesh has an inside.
    const Buffer* append(Schedule& schedule, const NodeGridPlace& grid, const Bodies& bodies,
                         float h) const;
    uint64_t device_bytes() const { return solid_.bytes() + passed_.bytes() + met_.bytes(); }

  private:
    void append_bending(Schedule& schedule, const NodeGridPlace& grid, const Bodies& bodies,
                        float h, uint32_t mesh, bool others) const;

    Buffer solid_;
    Buffer passed_; // uint [edge_count^3/32], bits
    Buffer met_;    // uint [edge_count^3]
};

} // namespace plait
