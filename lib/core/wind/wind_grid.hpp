// The air of a sim with wind at the nodes of a grid around the groom: its eddies and, where hair and
// colliders give shelter, what is left of the wind behind them.
#pragma once

#include "core/base/cube.hpp"
#include "core/base/pose.hpp"
#include "core/base/schedule.hpp"
#include "core/grid/mesh_solid.hpp"
#include "core/grid/strand_grid.hpp"

#include <array>

namespace plait {

// Where strands are at the begin of a fixed step.
struct HairNow {
    const Model* lanes;  // null: positions are read
    const StepInput& at; // whose colliders are met
};

class WindGrid {
  public:
    static constexpr uint32_t nodes = 16; // per edge

    // Work-items that shelter the grid: one for each node of a plane, or as many as there may be.
    static uint32_t group_width(const plait_device_info& device);
    // Buffers for what is asked for; for nothing, none.
    static Result<WindGrid> create(Device& device, bool eddies, bool sheltered);

    bool is_sheltered() const { return sheltered_; }
    const Buffer* velocity() const { return velocity_ ? &velocity_ : nullptr; }
    uint64_t device_bytes() const {
        return velocity_.bytes() + extinction_.bytes() + depth_.bytes() + hair_.device_bytes() +
               meshes_.device_bytes();
    }

    // Puts the grid around the groom, whose head is at `head`.
    void place(const GridCube& cube, const plait_pose& head);
    const plait_pose& corner() const { return corner_; } // its orientation and corner in the world
    float voxel_edge() const { return voxel_edge_; }     // m

    // A stream of air through the hair.
    struct Stream {
        std::array<float, 3> velocity; // m/s, in the world
        std::array<float, 3> still;    // m/s, of the head: what moves as it does is in no wind
        float extinction;              // 1/m, of one vertex per m^3
    };
    // Appends what is left of it.
    void append_shelter(Schedule& schedule, const HairNow& hair, const Stream& stream) const;

  private:
    plait_grid_params hair_params(const StepInput& at) const;
    void append_obstacle(Schedule& schedule, const StepInput& at, float extinction) const;

    bool eddies_ = false, sheltered_ = false;
    uint32_t width_ = 1; // of the group that shelters it
    plait_pose corner_ = identity_pose;
    float voxel_edge_ = 1;
    StrandGrid hair_;   // its density and velocity here; brakes nothing
    MeshSolid meshes_;  // that stop the wind
    Buffer velocity_;   // float4 [nodes^3]: m/s, in the world; w: share of the wind
    Buffer extinction_; // float [nodes^3], 1/m
    Buffer depth_;      // float [nodes^3]
};

} // namespace plait
