// The inter-hair step: its grid's buffers and the stages it takes, once per fixed step.
#pragma once

#include "core/base/cube.hpp"
#include "core/base/schedule.hpp"
#include "core/strands/model.hpp"
#include "core/strands/state.hpp"

#include <array>

namespace plait {

class StrandGrid {
  public:
    // Buffers for `params`; none if the step is off.
    static Result<StrandGrid> create(Device& device, const Params& params);
    // For append_density() alone, with exact sums.
    static Result<StrandGrid> create_density(Device& device, uint32_t edge_count);
    bool fits(const Params& params) const;

    // Work-items that share a voxel's slots. On a CPU, whose work-items have lanes, those of a group
    // take turns: one alone is faster than a sum in parts.
    static uint32_t group_width(const plait_device_info& device, uint32_t capacity);

    struct Step {
        Layout layout; // of strands that are stepped
        const State& state;
        const Params& params;
        const GridCube& cube;
        const plait_pose& head; // at the end of the step
        float h;                // s, of a substep: the histories span one
        uint64_t frame;
        uint64_t seed;
        const plait_device_info& device;
    };
    // On positions and their history.
    void append(Schedule& schedule, const Step& step) const;
    // The same with exact sums in two calls, between which the caller may add to sums().
    void append_sums(Schedule& schedule, const Step& step) const;
    void append_brake(Schedule& schedule, const Step& step) const;
    // The same on the model's lanes, with exact sums; the caller publishes them afterwards.
    void append_over_lanes(Schedule& schedule, const Step& step, const Model& model,
                           const StepInput& at) const;
    // append_sums() and append_brake() over lanes: each vertex is rounded by itself, whoever else is there.
    void append_sums_over_lanes(Schedule& schedule, const Step& step, const Model& model,
                                const StepInput& at) const;
    void append_brake_over_lanes(Schedule& schedule, const Step& step, const Model& model,
                                 const StepInput& at) const;
    // The hair alone, with exact sums: density and velocity, of which `grid` says where. `lanes`: where
    // they are read, else positions are.
    void append_density(Schedule& schedule, const plait_grid_params& grid, const Model* lanes,
                        const StepInput& at) const;
    bool is_on() const { return mode_ != GridKind::off; }
    bool is_exact() const { return mode_ == GridKind::exact; }

    const Buffer& sums() const { return sums_; }
    const Buffer& density() const { return density_; }
    const Buffer& velocity() const { return velocity_; }
    const Buffer& outside() const { return outside_; } // uint [1]
    uint64_t device_bytes() const;

  private:
    static Result<StrandGrid> make_buffers(Device& device, GridKind mode, uint32_t edge_count,
                                           uint32_t capacity);
    void append_slots(Schedule& schedule, const Step& step, const plait_grid_params& params) const;
    void splat_positions(Schedule& schedule, const Layout& layout, const State& state,
                         const plait_grid_params& params) const;
    void resolve(Schedule& schedule, const plait_grid_params& params) const;
    void brake(Schedule& schedule, const Step& step, const plait_grid_params& params) const;
    void splat(Schedule& schedule, const Model& lanes, const plait_grid_params& grid,
               const StepInput& at, bool each) const;
    void diffuse(Schedule& schedule, const Model& lanes, const plait_grid_params& grid,
                 const StepInput& at) const;

    GridKind mode_ = GridKind::off;
    uint32_t edge_count_ = 0;
    uint32_t capacity_ = 0;
    Buffer slots_;    // uint [nv^3*C], slots
    Buffer sums_;     // uint [nv^3*10], exact
    Buffer density_;  // float [nv^3]
    Buffer velocity_; // float4 [nv^3]
    Buffer outside_;  // uint [1]
};

// Where the grid is and how fine, for the grid stages.
plait_grid_params grid_params(const StrandGrid::Step& step);

} // namespace plait
