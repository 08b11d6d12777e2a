// A strand model: which stages one substep takes, over which buffers.
#pragma once

#include "core/base/lane_layout.hpp"
#include "core/base/pose.hpp"
#include "core/base/schedule.hpp"
#include "core/groom/materials.hpp"
#include "core/mesh/bending_meshes.hpp"
#include "core/mesh/mesh_colliders.hpp"
#include "core/strand_contact/pairs.hpp"
#include "core/strands/sag_report.hpp"
#include "core/strands/settings.hpp"
#include "core/strands/state.hpp"
#include "core/wind/wind_step.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace plait {

// What a model reads when it writes down a substep.
struct Substep {
    const Layout& layout;
    const State& state;
    const plait_sim_params& params;
    const Buffer& colliders;
    uint32_t collider_count;
    uint32_t collider_first; // in `colliders`, of this substep
    uint32_t mesh_count;     // after those; 0: `meshes` is null
    const MeshBuffers* meshes;
    uint32_t bending_count; // after those; 0: `bending` is null
    const BendingBuffers* bending;
    const PairBuffers* pairs; // null: strands do not meet each other
    double step;              // s, the fixed one
    uint32_t substeps;        // of it; what steps are strands that take so many
    float h;                  // s, its length
    std::array<float, 3> air; // m/s: the wind, and what the head takes along
    float share;              // of the fixed step, at the substep's end
    std::optional<WindStep> wind;
};

// State in the lane layout.
struct LaneBuffer {
    const Buffer* buffer = nullptr;
    uint32_t components = 0;
    LaneLayout layout{};
    bool blended = false; // quaternions between two turns: as short as the turns are apart
};

// Strands that lie together.
struct PartShape {
    Settings settings;
    uint32_t strands;
    uint32_t row; // V of their lanes
};

// The inter-hair grid for strands over lanes.
struct LaneGrid {
    plait_grid_params params;
    const Buffer &sums, &outside, &density, &velocity;
};

// The same for volume, which has the grid's velocity and, per node, what pressure does.
struct LaneVolume {
    plait_grid_params params;
    const Buffer &sums, &outside, &pull;
    bool moves; // velocities change, too
    // Of strands, or null; `soaked`: the sums are of it, in place of the density at rest.
    const Buffer* wetness = nullptr;
    bool soaked = false;
};

class Model {
  public:
    virtual ~Model() = default;

    // Vertices from the root on that follow it and nothing else.
    virtual uint32_t pinned_vertices() const = 0;
    // Reads where vertices were two substeps ago, state.position_prev2.
    virtual bool keeps_two_steps() const { return false; }

    // Makes what `params` need and is not there yet, and fills what depends on them: aside, so that
    // the model stays as it is until swap() takes it. swap() again gives it back; discard() drops
    // what swap() would take.
    virtual Status prepare(Device&, const plait_sim_params&) { return {}; }
    // The same for the settings of every guide strand.
    virtual Status prepare_settings(Device&, Schedule&, const Substep&, std::span<const Settings>) {
        return Error{PLAIT_INTERNAL, "strands of this model do not switch"};
    }
    // Other materials of single strands, which prepare() looks at; exchanged, to be given back.
    virtual void exchange(StrandMaterialsPtr&) noexcept {}
    // Likewise the gravity in which a sag-free groom is in balance.
    virtual void exchange(std::array<float, 3>&) noexcept {}
    virtual void swap() noexcept {}
    virtual void discard() {}
    // Makes, or gives back, what substeps with wind need. Fails without an effect.
    virtual Status open_wind(Device&) { return Error{PLAIT_INTERNAL, "this model takes no wind"}; }
    virtual void close_wind() {}

    // The same of what wet strands need; where it fails close_wetness() gives back what there is.
    virtual Status open_wetness(Device&) {
        return Error{PLAIT_INTERNAL, "strands of this model do not get wet"};
    }
    virtual void close_wetness() {}
    // Appends what scales material by state.wetness_held.
    virtual void soak(Schedule&, const Substep&) const {}

    // Makes, or frees, what the planes of meshes and of other strands need; all or nothing.
    virtual Status keep_planes(Device&, bool) { return {}; }

    // Appends what takes state.acceleration, where there is one, to where the model reads it.
    virtual void accelerate(Schedule&, const Substep&) const {}
    // Appends the stages of one substep, of the strands that take as many; `state.pose` is already
    // that of its end.
    virtual void substep(Schedule& schedule, const Substep& at) = 0;
    // Appends what puts the model's own state into position and its history, at the end of a step;
    // and, if `tangent` is not null, what is shown beside positions: tangents and padding.
    virtual void publish(Schedule&, const Substep&, const Buffer* /*tangent*/ = nullptr) const {}
    // Appends what takes them back after something else changed them.
    virtual void adopt(Schedule&, const Substep&) const {}
    // Has velocities of its own, which the inter-hair step can read and brake where they are kept.
    virtual bool has_lanes() const { return false; }
    virtual void splat(Schedule&, const Substep&, const LaneGrid&) const {}
    virtual void diffuse(Schedule&, const Substep&, const LaneGrid&) const {}
    virtual void splat_volume(Schedule&, const Substep&, const LaneVolume&) const {}
    virtual void gather_volume(Schedule&, const Substep&, const LaneVolume&) const {}
    // Appends putting every vertex at its rest position under state.pose.
    virtual void reset(Schedule& schedule, const Substep& at) = 0;
    // Appends carrying the state from state.pose to `pose`.
    virtual void teleport(Schedule& schedule, const Substep& at, const Buffer& pose) = 0;
    // Appends giving strands the motion of a substep from state.pose to `next` in place of that from
    // `before` to `was`, turned as from there to state.pose, unless they differ by less than `jump`, m/s.
    virtual void set_off(Schedule& schedule, const Substep& at, const Buffer& before,
                         const Buffer& was, const Buffer& next, float jump) = 0;
    // Appends the motion p -> q*p + t of all of the state.
    virtual void carry(Schedule& schedule, const Substep& at, const plait_pose& motion) = 0;

    // How the rest shape was found, where it was looked for.
    virtual SagReport sag() const { return {}; }

    // The settings of every guide strand, where strands have some of their own.
    virtual void read_settings(std::span<Settings>) const {}
    // Adds the parts in which strands of these settings lie, in the order of add_dynamic().
    virtual void list_parts(std::span<const Settings>, std::pmr::vector<PartShape>&) const {}
    // Adds the model's own buffers that carry state from step to step.
    virtual void add_dynamic(std::pmr::vector<LaneBuffer>&) const {}
    // The same of what carried pressure does; without volume the buffers are none.
    virtual void add_pressure(std::pmr::vector<LaneBuffer>&) const {}
    virtual uint64_t device_bytes() const { return 0; }
};

// What a model is made of besides parameters.
struct ModelInput {
    const Layout& layout;
    const Groom& groom;
    std::span<const float> stiffness; // scale of each guide's, or empty
    StrandMaterialsPtr materials;
    uint32_t tile; // strands per tile of the lane layout
    double step;   // s, the fixed one
    plait_sag_free sag_free;
    std::array<float, 3> gravity; // m/s^2, in which a sag-free groom is in balance
    bool accelerates;             // state.acceleration is there
    bool pins;                    // state.pin is there
    std::pmr::memory_resource* memory;
};

// `settings`: of every strand.
Result<std::unique_ptr<Model>> make_model(const Settings& settings, const ModelInput& input);

std::unique_ptr<Model> make_tressfx_model(const Layout& layout); // models/tressfx.cpp
std::unique_ptr<Model> make_lane_model(const Settings&,
                                       const ModelInput& input); // models/lanes.cpp

} // namespace plait
