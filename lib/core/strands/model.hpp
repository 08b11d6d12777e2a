// A model: which stages one substep takes, over which buffers.
#pragma once

#include "core/base/params.hpp"
#include "core/base/part.hpp"
#include "core/base/pose.hpp"
#include "core/base/schedule.hpp"
#include "core/contact/bodies.hpp"
#include "core/groom/materials.hpp"
#include "core/strands/sag_report.hpp"
#include "core/strands/settings.hpp"
#include "core/strands/state.hpp"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace plait {

// What is read by all that write down a substep.
struct StepInput {
    const Layout& layout;
    Layout stepped; // strands that are, of the guides
    const State& state;
    const Params& params;
    Bodies bodies;            // at the substep's end
    double step;              // s, the fixed one
    uint32_t substeps;        // of it; only strands with this number of substeps are stepped
    float h;                  // s, its length
    std::array<float, 3> air; // m/s: what head and frame take along
    float drag;               // 1/s, against that air; 0 in a wind, which drags by itself
    float share;              // of the fixed step, at the substep's end
    bool first;               // of its substeps
};

// Of position and its history: by the step between hairs, which changes velocities a little, or by the
// caller.
enum class Changed { by_grid, places, velocities };

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

// Which buffers beside their state parts have.
struct PartNeeds {
    bool push = false, spring = false, plane = false, hollow = false; // their doors
    bool wet = false; // material that wetness scales
};

// Strands that followed and are stepped from now on, and where they were shown; positions are float4
// [guides*V].
struct Waking {
    uint32_t first, last;      // strands first to last - 1
    const Buffer& pose_before; // at the begin of the fixed step that is over
    const Buffer &from, &to;   // where their guides alone put them, at its begin and end
    const Buffer& position;    // where they begin
};

// Fills the doors of a part for the substep that comes next.
using FillDoors = std::function<Doors(const Part&)>;

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
    virtual Status prepare(Device&, const Params&) { return {}; }
    // The same for the settings of every guide strand.
    virtual Status prepare_settings(Device&, Schedule&, const StepInput&,
                                    std::span<const Settings>) {
        return Error{PLAIT_INTERNAL, "strands of this model do not switch"};
    }
    // Other materials of single strands, which prepare() looks at; exchanged, to be given back.
    virtual void exchange(StrandMaterialsPtr&) noexcept {}
    // Likewise the gravity in which a sag-free groom is in balance.
    virtual void exchange(std::array<float, 3>&) noexcept {}
    virtual void swap() noexcept {}
    virtual void discard() {}
    // m, of the strands of all sims that a groom is shared out to; at first, of this one.
    virtual void take_mean_length(float) {}

    // Makes what parts need and gives back what they no longer do; where it fails it changes nothing.
    virtual Status open(Device&, const PartNeeds&) { return {}; }

    // From now on strands before this one are stepped and known to every other call, and no others: all
    // at first. Their state does not change.
    virtual void step_first(uint32_t /*strands*/) {}
    // Appends filling the state of strands that are not stepped yet; state.pose is that of the end.
    virtual void wake(Schedule&, const StepInput&, const Waking&) const {}

    // Strands over lanes: none where the model keeps them in state.position alone.
    virtual size_t parts() const { return 0; }
    virtual Part part(size_t, const StepInput&) const { std::abort(); }

    // Appends the stages of one substep, of the strands that take as many; `state.pose` is already
    // that of its end.
    virtual void substep(Schedule& schedule, const StepInput& at, const FillDoors& fill) = 0;
    // Appends what puts the model's own state into position and its history, at the end of a step;
    // and, if `tangent` is not null, what is shown beside positions: tangents and padding.
    virtual void publish(Schedule&, const StepInput&, const Buffer* /*tangent*/ = nullptr) const {}
    // Appends what takes them back after something else changed them.
    virtual void adopt(Schedule&, const StepInput&, Changed) const {}
    // Appends putting every vertex at its rest position under state.pose.
    virtual void reset(Schedule& schedule, const StepInput& at) = 0;
    // Appends carrying the state from state.pose to `pose`.
    virtual void teleport(Schedule& schedule, const StepInput& at, const Buffer& pose) = 0;
    // Appends giving strands the motion of a substep from state.pose to `next` in place of that from
    // `before` to `was`, turned as from there to state.pose, unless they differ by less than `jump`, m/s.
    virtual void set_off(Schedule& schedule, const StepInput& at, const Buffer& before,
                         const Buffer& was, const Buffer& next, float jump) = 0;
    // Appends the motion p -> q*p + t of all of the state.
    virtual void carry(Schedule& schedule, const StepInput& at, const plait_pose& motion) = 0;

    // How the rest shape was found, where it was looked for.
    virtual SagReport sag() const { return {}; }

    // The settings of every guide strand, where strands have some of their own.
    virtual void read_settings(std::span<Settings>) const {}
    // Adds the parts in which strands of these settings lie, those that are stepped, in the order of add_dynamic().
    virtual void list_parts(std::span<const Settings>, std::pmr::vector<PartShape>&) const {}
    // Adds the model's own buffers that carry state from step to step.
    virtual void add_dynamic(std::pmr::vector<LaneBuffer>&) const {}
    // The same of what carried pressure does; without volume the buffers are none.
    virtual void add_pressure(std::pmr::vector<LaneBuffer>&) const {}
    // The same of what contact goes on with, and as if nothing had touched.
    virtual void add_normal_force(std::pmr::vector<LaneBuffer>&) const {}
    virtual Status clear_normal_force(Device&) { return {}; }
    // Strands that had no history under the parameters `then` get one, as if they had moved as they do.
    virtual Status begin_history(Device&, const Params& /*then*/) { return {}; }
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
    std::pmr::memory_resource* memory;
    // Strands after which those that are stepped may end, ascending, all of them last; empty: all are.
    std::span<const uint32_t> ends;
};

// `settings`: of every strand.
Result<std::unique_ptr<Model>> make_model(plait_model model, const Settings& settings,
                                          const ModelInput& input);

std::unique_ptr<Model> make_tressfx_model(const Layout& layout); // tressfx/tressfx.cpp
std::unique_ptr<Model> make_lane_model(const Settings&,
                                       const ModelInput& input); // strands/lanes.cpp

} // namespace plait
