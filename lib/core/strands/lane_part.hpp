// Strands of equal settings and of one class of length, in the model articulated: the buffers they are in and
// the stages they take. A sim whose strands are all solved alike and about as long has one part; else
// it has one for each settings in use and class (length_classes.hpp), each with its strands side by
// side, so that no lane is spent on a strand that is solved otherwise, and no row on one far longer.
// Which strand is in which lane is the part's own; a list tells the stages.
#pragma once

#include "core/base/cube.hpp"
#include "core/groom/rest_density.hpp"
#include "core/strands/material.hpp"
#include "core/strands/model.hpp"

#include <algorithm>
#include <vector>

namespace plait {

// What every part of a sim is made from.
struct LaneSource {
    explicit LaneSource(const ModelInput& input);

    Layout layout; // of the whole sim
    uint32_t tile;
    double step; // s, the fixed one
    plait_sag_free sag_free;
    std::array<float, 3> gravity; // in which a sag-free groom is in balance
    PartNeeds needs;
    std::pmr::memory_resource* memory;
    RestStrands strands; // for when the material changes
    StrandMaterialsPtr materials;
    GridCube cube; // of the inter-hair grid, where the caller has none

    // Nothing where there is no volume.
    RestGrid rest_grid_of(const Params& params) const;
    // Measures `rest` where it is of another grid.
    void measure_rest(const RestGrid& grid);
    RestGrid rest_grid;
    RestDensity rest;
};

class LanePart;

// Where a strand is: in which part, and there in which lane.
struct LanePlace {
    const LanePart* part;
    uint32_t lane;
};

class LanePart {
  public:
    using Members = std::pmr::vector<uint32_t>;

    // `row`: V of the lanes. `members`: the strand of each lane, none longer.
    LanePart(const LaneSource& source, const Settings& settings, uint32_t row, Members members);

    const Settings& settings() const { return settings_; }
    const Members& members() const { return members_; }
    // Only strands before this one are stepped: members lie so that these are the first lanes.
    void step_first(uint32_t strands) { stepped_ = members_before(strands); }
    uint32_t members_before(uint32_t strand) const;
    void wake(Schedule& schedule, const StepInput& at, const Waking& waking) const;

    // Makes the buffers that do not depend on parameters.
    Status open(Device& device);
    // Makes what `params` need and is not there yet, aside: swap() takes it, or gives it back.
    Status prepare(Device& device, const Params& params);
    void swap() noexcept;
    void discard(); // what swap() would take
    // Makes what source.needs ask for and is not there, and gives back what nothing needs any more.
    Status open_doors(Device& device);
    void close_doors();

    // `mean_length`: m, of all strands of the sim.
    Part part(const StepInput& at, float mean_length) const;
    void substep(Schedule& schedule, const StepInput& at, const Part& part, const Doors& doors);
    void publish(Schedule& schedule, const StepInput& at, const Buffer* tangent) const;
    void adopt(Schedule& schedule, const StepInput& at, Changed by) const;
    void reset(Schedule& schedule, const StepInput& at);
    void teleport(Schedule& schedule, const StepInput& at, const Buffer& pose);
    void set_off(Schedule& schedule, const StepInput& at, const Buffer& before, const Buffer& was,
                 const Buffer& next, float jump) const;
    void carry(Schedule& schedule, const plait_pose& motion) const;

    // Instead of prepare, for a part that takes its strands from others (lane_switch.cpp): copies
    // their state. `from`: [guides]. Leaves the others as they are.
    Status take_over(Device& device, Schedule& schedule, const StepInput& at,
                     std::span<const LanePlace> from);

    const SagReport& sag() const { return fill_.sag; }
    void add_dynamic(std::pmr::vector<LaneBuffer>& to) const;
    LaneBuffer pressure() const { return {&volume_.pressure, 3, stepped_lanes()}; }
    LaneBuffer normal_force() const { return {&normal_force_, 1, stepped_lanes()}; }
    Status clear_normal_force(Device& device) const;
    Status begin_history(Device& device, const Params& then) const;
    uint64_t device_bytes() const;

  private:
    // What parameters decide.
    struct Fill {
        explicit Fill(std::pmr::memory_resource* memory)
            : of{std::pmr::vector<Material>(memory), {}} {}
        Materials of;
        RestLoad load;
        SagReport sag;
        Buffer material, rest, start; // start: where a sag-free strand starts
        Buffer wet;                   // material as wetness scales it, where strands may be wet
        Buffer groom;                 // stiffness of springs to the groom, where there are any
    };
    // BDF2's step before.
    struct History {
        Buffer x, v;
    };
    // With volume.
    struct Pressed {
        RestGrid grid;
        Buffer share, pressure;
    };
    // Strands on their way from one part here: pairs of lane there, lane here.
    struct Moves {
        Buffer list;
        uint32_t count;
    };

    Status make(Device& device, Buffer& to, size_t components, const char* name) const;
    Materials materials() const;
    RestLoad load() const;
    Status make_fill(Device& device, Fill& fill, const Members& members, const Materials& materials,
                     const RestLoad& load, bool grooms) const;
    Status make_wet(Device& device, Fill& fill) const;
    // That strands are stepped with.
    const Buffer& material() const { return fill_.wet ? fill_.wet : fill_.material; }
    Status prepare_history(Device& device, const Params& params);
    Status fill_history(Device& device, const History& history) const;
    Status prepare_volume(Device& device, const Params& params);
    Status make_pressed(Device& device, Pressed& to, const RestGrid& grid) const;
    bool keeps_fill() const;
    bool takes_history_of(const LanePart& other) const;
    template <typename Place> Result<Moves> list_moves(Device& device, const Place& place) const;
    void move(Schedule& schedule, const Moves& moves, uint32_t components, const Buffer& from,
              const Buffer& to) const;
    Status fill_anew(Device& device);
    Status move_from(Device& device, Schedule& schedule, const StepInput& at, const LanePart& other,
                     std::span<const LanePlace> from);
    void fit(Schedule& schedule, const StepInput& at, const Moves& moves,
             const LanePart& other) const;
    // The strand of a lane; those that fill up the last tile repeat the last strand.
    uint32_t member(size_t lane) const { return members_[std::min(lane, members_.size() - 1)]; }
    LaneLayout stepped_lanes() const { return {stepped_, lanes_.row, lanes_.tile}; }
    plait_lane_state_params state_params() const {
        return {lanes_.row, lanes_.tile, source_.layout.row, history_.x ? 1u : 0u};
    }

    const LaneSource& source_;
    Settings settings_;
    Members members_;
    LaneLayout lanes_;
    uint32_t stepped_; // of the members, the first
    Fill fill_, next_fill_;
    bool has_next_fill_ = false, has_next_history_ = false, has_next_volume_ = false;
    Buffer x_, v_, q_, q_before_;
    Buffer normal_force_;                   // of contact in the last substep, N
    Buffer push_, spring_, plane_, hollow_; // doors
    History history_, next_history_;
    Pressed volume_, next_volume_;
    Buffer lane_strand_; // uint [lanes of whole tiles]
};

} // namespace plait
