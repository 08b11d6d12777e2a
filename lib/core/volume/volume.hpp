// Volume: a one-sided pressure on the nodes of the inter-hair grid, carried from step to step.
#pragma once

#include "core/base/schedule.hpp"
#include "core/grid/mesh_solid.hpp"
#include "core/strands/model.hpp"

namespace plait {

// Where the grid is and what it already holds.
struct VolumeGrid {
    plait_grid_params params;
    float step; // s, the fixed one
    const Buffer &sums, &outside, &density, &velocity;
    const Buffer* wetness; // of strands, or null
};

class Volume {
  public:
    // None where `params` want none.
    static Result<Volume> create(Device& device, const Params& params);
    bool fits(const Params& params) const {
        return params.volume.on ? edge_count_ == params.grid.edge_count : !*this;
    }
    explicit operator bool() const { return bool(potential_); }

    // Appends the pressure that would hold hair as it lies: a step that fell, and enough sweeps.
    void append_start(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                      const StepInput& at) const;
    // Appends what a fixed step ends with; carry() after it.
    void append_step(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                     const StepInput& at) const;
    void carry() noexcept;

    // Whether potential() goes on from the step before; else the next step begins with a start.
    bool carries = false;
    const Buffer& potential() const { return potential_; } // float [nv^3*2]
    uint64_t device_bytes() const;
    // Makes, or frees, what wet strands need; nothing without volume.
    Status keep_wetness(Device& device, bool keep);

  private:
    void splat(Schedule& schedule, const VolumeGrid& grid, const Model& model,
               const StepInput& at) const;
    // `soaked`: `rest` gets the mean wetness.
    void splat_into(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                    const StepInput& at, bool soaked, const Buffer& rest) const;
    bool coheres_wet(const VolumeGrid& grid, const StepInput& at) const {
        return grid.wetness && wetness_ && at.params.wetness.cohesion > 0;
    }
    // `before`: null where nothing is carried.
    void solve(Schedule& schedule, const VolumeGrid& grid, const StepInput& at,
               const Buffer* before, const Buffer& potential, uint32_t sweeps) const;
    // `moves`: velocities change, too.
    void gather(Schedule& schedule, const VolumeGrid& grid, const Model& model, const StepInput& at,
                bool moves) const;

    uint32_t edge_count_ = 0;
    Buffer potential_, next_; // float [nv^3*2]: p over density, density; last step, this one
    Buffer wetness_;          // float [nv^3], where strands may be wet
    Buffer pressure_, rest_, solid_, link_, node_, pull_;
    MeshSolid meshes_; // which `solid_` takes over
};

} // namespace plait
