// One groom moving on one context: the schedule of a call, and the state it moves.
#pragma once

#include "backend/launches.hpp"
#include "core/base/clock.hpp"
#include "core/base/frame.hpp"
#include "core/contact/colliders.hpp"
#include "core/grid/strand_grid.hpp"
#include "core/mesh/bending_meshes.hpp"
#include "core/mesh/mesh_colliders.hpp"
#include "core/params/param_table.hpp"
#include "core/pins/pins.hpp"
#include "core/roots/head_motion.hpp"
#include "core/roots/root_binding.hpp"
#include "core/roots/roots.hpp"
#include "core/roots/roots_input.hpp"
#include "core/sim/moments.hpp"
#include "core/sim/reduce.hpp"
#include "core/sim/sim_parts.hpp"
#include "core/strand_contact/pairs.hpp"
#include "core/volume/volume.hpp"
#include "core/wetness/wetness.hpp"

#include <plait/plait_profile.h>

#include <memory>
#include <optional>

namespace plait {

class MeshDistance;

// snapshot/
enum class BlockKind : uint32_t;
struct Saved;
struct SavedRoots;
class SnapshotWriter;

class Sim {
  public:
    Sim(Context& context, SimParts parts);
    Sim(const Sim&) = delete;
    Sim& operator=(const Sim&) = delete;
    ~Sim();

    // Fills what is shown before the first step, and waits for it: else the first step would.
    // UNSUPPORTED if the backend lacks a stage.
    Status start();

    Status reset();
    // Features are turned on and off, too. INVALID_STATE: the model has not one of them.
    Status set_params(const Params& params);
    const Params& params() const { return params_; }
    // INVALID_STATE: strands of this model have no material.
    Status set_materials(StrandMaterialsPtr materials);
    const StrandMaterials& materials() const { return *materials_; }
    Status find_balance();
    plait_model model() const { return desc_.model; }
    size_t guides() const { return layout_.guides; }
    uint32_t substeps() const { return desc_.substeps; }
    // The settings of every guide strand, checked; the same as they have costs nothing.
    Status set_settings(std::span<const Settings> settings);
    SettingsList settings() const;
    // The sim's own.
    Settings own_settings() const { return {desc_.substeps}; }
    // Null: roots are free again. `places`: [guides], or empty.
    Status bind_roots(const Mesh* mesh, std::span<plait_root_place> places);
    Status set_roots(const RootsInput& input);
    Status teleport(const RootsInput& input);
    // Null: none. What fails changes nothing.
    Status set_frame(const plait_frame_desc* desc);
    // Null: none. INVALID_STATE: the model takes none. What fails changes nothing.
    Status set_wind(const plait_wind_desc* desc);
    // sim_reduce.cpp. Null: none. INVALID_ARGUMENT, INVALID_STATE: parts meet elsewhere than in a grid that
    // they share. What fails changes nothing.
    Status set_reduce(plait_reduce_fn add, void* user);
    bool is_part() const { return bool(reduce_); }
    // Null: none. INVALID_STATE: there are no follows. What fails changes nothing.
    Status set_detail(const plait_detail_desc* desc, std::span<const uint32_t> centres);
    // From the next step on. INVALID_STATE: there are no levels.
    Status set_level(const plait_level_choice& choice);
    Result<plait_level_state> level_state() const;
    bool describe_levels(DirectedHair& out) const; // for the director; false: there are none
    // The next step has nothing to do. stir(): it has, as something may have changed.
    bool is_asleep() const;
    void stir();
    void set_rest(float speed); // m/s, of a sim with levels, as plait_level_choice has it
    Status step(double dt);     // then, once no steps overlap:
    Status ask_for_probes();
    Status wait() { return device().wait(); }

    // sim_bodies.cpp: each is done in all sims that share them, and creating and destroying in all or none.
    Result<plait_collider_id> create_collider(const plait_collider_desc& desc);
    Status set_collider_pose(plait_collider_id id, const plait_pose& pose);
    Status place_collider(plait_collider_id id, const plait_pose& pose);
    Status set_collider_shape(plait_collider_id id, const plait_collider_desc& desc);
    const Colliders& colliders() const { return colliders_; }
    Result<plait_collider_id> create_mesh_collider(const Mesh& mesh,
                                                   const plait_collider_mesh_desc& desc);
    Result<plait_collider_id> create_hull_collider(const Mesh& mesh,
                                                   const plait_collider_hull_desc& desc);
    Status set_collider_positions(plait_collider_id id, std::span<const float> positions);
    // The same on the device: `count` vertices, whose floats the caller puts into what this gives,
    // `words` from one to the next, before it has them taken.
    Result<const Buffer*> room_for_positions(plait_collider_id id, size_t count, size_t words);
    Status take_positions(plait_collider_id id, uint32_t words);
    Result<const Buffer*> room_for_root_positions(size_t count, size_t words);
    Status take_root_positions(const plait_pose& head, uint32_t words);
    Status destroy_collider(plait_collider_id id);
    // Null: with none from now on.
    Status share_colliders(Sim* with);

    // fields.cpp
    Result<size_t> field_bytes(plait_field field) const;
    Status read(plait_field field, void* dst);
    Result<uint64_t> read_later(plait_field field, void* dst); // the fence that it lies before
    Result<uint64_t> fence() { return device().fence(); }
    Result<bool> fence_reached(uint64_t fence, bool wait) {
        return device().fence_reached(fence, wait);
    }
    // What field_buffer() gives, or for BOUNDS reckoned into a buffer now.
    Result<const Buffer*> filled_field(plait_field field);
    Status write(plait_field field, const void* src);
    Status set_pins(std::span<const plait_pin> pins); // all of them; INVALID_STATE: pins is off
    Result<const Buffer*> field_buffer(plait_field field) const; // INVALID_STATE: the field is off

    // describe.cpp
    plait_sim_info describe() const; // from the host alone

    // stats.cpp
    Status measure(plait_sim_measures& out);
    size_t stage_time_count() const;
    Status stage_times(std::span<plait_stage_time> dst, bool reset);
    Status harvest();              // takes the device's times and launches so far as this sim's
    Result<size_t> launch_count(); // that are kept; waits. INVALID_STATE without profiling
    const plait_stage_launch& launch(size_t i) const { return launches_[i]; } // the oldest is 0
    void forget_launches(size_t count) { launches_.forget(count); }

    // snapshot.cpp
    size_t snapshot_size();
    Status save(std::span<unsigned char> dst); // [snapshot_size()]
    Status restore(std::span<const unsigned char> src);
    Result<uint64_t> hash();

    Context& context() { return context_; }

  private:
    Device& device() const { return context_.device; }
    float substep_length() const { return length_of(desc_.substeps); }
    float length_of(uint32_t substeps) const {
        return static_cast<float>(clock_.step() / substeps);
    }

    Status submit();
    struct Measured;
    Status take_measured(Measured& out) const;
    Status begin_measuring();
    // Those that take one number of substeps take all of them before those that take another: what
    // strands know of each other's motion within a fixed step (strand_contact) is then that old.
    template <typename Visit> Status for_each_group(const Visit& visit) const {
        uint32_t first = 0;
        for (const uint32_t substeps : substeps_) {
            PLAIT_TRY(visit(Group{substeps, first}));
            first += substeps;
        }
        return {};
    }
    StepInput at(const Group& group, uint32_t substep) const;
    StepInput at(const Group& group, uint32_t substep, const Bodies& bodies) const;
    Bodies bodies(const Buffer& rows, uint32_t substep) const; // of all substeps that `rows` are of
    std::array<float, 3> air() const;                          // m/s, in this fixed step
    std::array<float, 3> head_velocity() const;                // m/s, of its middle, in the same
    StepInput present() const {                                // between steps
        return at({desc_.substeps, 0}, desc_.substeps - 1);
    }

    // sim_step.cpp
    using Phase = void (Sim::*)(const At&); // appends what it does at a moment, if anything
    static const Phase phases[];
    void append_phases(const At& at);
    void append_roots(const At& at);
    void append_meshes(const At& at);
    void append_pins(const At& at);
    void append_wetness(const At& at);
    void append_air(const At& at);
    void append_accelerations(const At& at);
    void append_pairs(const At& at);
    void append_solve(const At& at);
    Doors fill_doors(const StepInput& at, const Part& part);
    void append_volume(const At& at);
    void append_grid_over_lanes(const At& at);
    void append_publish(const At& at);
    void append_grid(const At& at);
    void append_display(const At& at);
    // The last substep of some strands: colliders are there at the end of the step.
    StepInput first_group() const { return at({substeps_.front(), 0}, substeps_.front() - 1); }
    StepInput at_shown() const;
    Status fixed_step(const Tick& tick, uint32_t step);
    void append_carried(double end, double part);
    void append_set_off();
    plait_pose unfelt_then() const;
    bool drove(const plait_pose& was, const plait_pose& now, const plait_pose& driven) const;
    void append_reframed();
    bool goes_on_as_put() const;
    Status skip(double end);
    bool ends_between_steps(double dt) const;
    void warn_of_jump(double dt);
    void append_dry_step();
    bool model_shows_guides() const;
    void append_shown(Tangents tangents = Tangents::of_all);
    // sim_levels.cpp
    // Of strands that are stepped.
    Layout stepped() const {
        return {levels_ ? levels_->stepped() : layout_.guides, 0, layout_.row};
    }
    bool is_rigid() const { return levels_ && levels_->is_rigid(); }
    Status append_coming(double dt);
    Status keep_level_before();
    Status pass_levels(double s);
    Status doze(double dt);
    Status switch_level();
    void append_level_stages();
    void append_dry_step_of_finest();
    void append_level_reset();
    Status submit_with_probes();
    StrandGrid::Step grid_step(const plait_pose& head) const;
    GridCube cube() const;
    Status check_reduces(const Params& params, bool sheltered) const;
    Result<float> mean_length_with(plait_reduce_fn add, void* user) const;
    Status reduce_sums(uint32_t step, uint32_t steps);
    VolumeGrid volume_grid(const plait_pose& head) const;
    bool grid_is_over_lanes() const;
    bool hair_is_over_lanes() const;

    Status show_at_once();
    // sim_scale.cpp
    Result<float> scale_of(const RootsInput& input);
    Status open_scale(float scale);
    Status rescale(float scale);
    plait_pose in_units(const plait_pose& pose) const { return plait::in_units(pose, scale_); }
    Status aim(const RootsInput& input);
    Status aimed();
    Status place();
    Status place_head();
    void append_placed();
    Status make_poses(Buffer& to, const char* name);
    Status make_poses_before(std::pmr::vector<Buffer>& to, size_t count);
    void append_no_motion();
    void append_motion_of_substeps(const Buffer& first, std::span<const uint32_t> known);
    void append_last_motion();
    Status forget_sides_of_left(const plait_pose& before, const plait_pose& after);
    Status place_colliders();
    Status check_stages(); // and builds them
    Status check_schedule();
    Status prepare_calls();
    void add_stats();
    void add_bounds();
    Status make_bounds();
    Status check_settings(std::span<const Settings> settings) const;
    using MeshDistanceOf = std::function<double(const std::array<double, 3>&)>;
    Result<std::pmr::vector<float>> clearance_of(const MeshDistanceOf& distance,
                                                 ClearanceRules rules, const plait_pose& pose);
    Status measure(MeshColliders::Entry& entry, const plait_pose& pose);
    Status measure(BendingMeshes::Entry& entry, const MeshDistance& distance,
                   const plait_pose& pose);
    Result<uint32_t> bending_slot(plait_collider_id id) const;
    // sim_bodies.cpp
    struct MeshSets { // those of one form, or of both
        std::optional<MeshColliders::Set> fields;
        std::optional<BendingMeshes::Set> nearest;
    };
    void swap(MeshSets& sets);
    struct Change;
    struct Changes;
    template <typename Visit> Status for_each_sharer(const Visit& visit);
    template <typename Make> Result<plait_collider_id> create_in_all(const Make& make);
    Result<plait_collider_id> create_field(const Mesh& mesh, const plait_collider_mesh_desc& desc);
    Result<plait_collider_id> create_bending(const Mesh& mesh,
                                             const plait_collider_mesh_desc& desc);
    Status open_planes(bool of_sheets);
    Status check_meets_meshes(const Sim& asked) const;
    // shared_bodies.cpp
    bool shares_with(const Sim& other) const;
    void leave();
    Status take_bodies(Sim& from);
    Result<MeshSets> measure_meshes_of(Sim& from);
    Status take_same_bodies(Sim& from);
    // Whether colliders are those of this sim; meshes then have its geometry.
    bool are_bodies(std::span<const Colliders::Slot> slots, const Colliders::FacesOf& faces,
                    MeshColliders::Entries& fields, BendingMeshes::Entries& nearest) const;
    Result<const Buffer*> room_for(size_t count, size_t words);
    Status take_meshes(MeshColliders::Entries&& meshes, BendingMeshes::Entries&& bending);
    // Of features as they are.
    PartNeeds part_needs() const;
    Status take_substeps(const std::pmr::vector<uint32_t>& substeps);
    Result<uint64_t> accelerations_ignored() const;
    uint64_t device_bytes() const;
    std::string warning() const;       // plait_sim_info.warning
    const char* no_accelerate() const; // why no kernel of the caller's accelerates; "": one does
    // To the log: `warning()` unless it is `said`.
    void log_warning(const std::string& said) const;
    // Once, in the first step after: of what was set and nothing reads. Features are on by then or
    // are not meant.
    void log_ignored();
    Status read_velocity(std::span<float> dst);
    Status write_velocity(const float* src);
    Status write_places(const Buffer& to, const float* src);
    Status take_seen(const float* src, std::span<std::array<float, 4>> now,
                     std::span<unsigned char> moved);
    Status write_positions(const float* src);
    Status write_acceleration(std::span<const float> src);
    Status write_pins(std::span<const float> src);
    Status check_takes_pins() const;
    Status open_pins();
    Status write_wetness(std::span<const float> src);
    Status open_wetness(); // of all that needs it, or of nothing
    void close_wetness();
    void dry();
    struct Run; // snapshot/snapshot_format.hpp
    std::pmr::vector<Run> list_runs(const Saved& saved);
    std::pmr::vector<Run> saved_runs(const Saved& saved, std::span<const Settings> strands);
    Saved saved_now();
    Status write_snapshot(SnapshotWriter& to);
    Status write_bodies(SnapshotWriter& to);
    Status write_bending(SnapshotWriter& to, size_t index);
    Status save_run(const Run& run, unsigned char* out);
    using BlockBytes = std::array<std::span<const unsigned char>, 13>; // by BlockKind
    Status check_fits(const Saved& saved) const;
    Status check_levels(const Saved& saved) const;
    Result<SettingsList> saved_settings(std::span<const unsigned char> from) const;
    Status check_run(const Run& run, const unsigned char* from, float scale) const;
    Status check_runs(std::span<const Run> list, const BlockBytes& from, float scale) const;
    Status restore_roots(const SavedRoots& saved);
    Status restore_run(const Run& run, const unsigned char* from);
    Status restore_runs(std::span<const Run> list, BlockBytes from);

    Context& context_;
    Layout layout_;
    plait_sim_desc desc_;
    Params params_;
    StrandMaterialsPtr materials_;
    std::string size_warning_;
    HairSizes hair_;
    NamedParams said_; // of which log_ignored() has spoken
    std::string groom_warning_;
    uint64_t groom_; // its fingerprint: snapshots are of one groom
    GridCube cube_;
    float longest_segment_; // m
    StrandLengths lengths_;
    Skin skin_;
    RootBinding binding_;
    std::unique_ptr<Model> model_;
    State state_;
    StrandGrid grid_;
    Reduce reduce_;
    Volume volume_; // where it is on, over the grid's sums
    Pairs pairs_;
    Display display_;
    std::unique_ptr<SimLevels> levels_; // null: without
    HeadMotion motion_;
    bool said_jump_ = false;
    float scale_ = 1;          // m, one of the groom's units
    bool resized_ = false;     // and another than what is shown has
    bool said_uneven_ = false; // of bones
    Roots roots_;
    Frame frame_;
    Sim* sharer_ = this; // the next of those that share its colliders, in a ring
    Colliders colliders_;
    MeshColliders meshes_; // of those colliders that are, by form
    BendingMeshes bending_;
    std::pmr::vector<uint32_t> substeps_; // that strands take, each number once
    Clock clock_;
    Schedule schedule_;
    Wind wind_;
    Wetness wetness_;    // where state_.wetness is there
    Buffer taken_;       // float, from the first vertices on that are taken on the device
    PinTable pin_table_; // filled by the first set_pins
    Buffer pose_spare_, pose_next_; // float4 [2*guides]
    // How hair has the head's motion, from a substep before to when it was placed; float4 [2*guides].
    Buffer pose_was_;
    std::pmr::vector<Buffer> pose_before_; // [substeps_]
    Buffer strand_stats_;                  // float4 [guides], from the first measurement on
    Buffer boxes_, box_; // float4 [2*runs], [2], from the first time on that bounds are asked for
    bool dozes_ = false; // as in the step before
    uint64_t told_ = 0;  // hash of where the roots were sent, since something else may have changed
    bool probed_ = false;     // probes were taken that have not been asked for
    uint64_t read_fence_ = 0; // before which the last read lies that did not wait; 0: none
    std::array<plait_stage_cost, PLAIT_STAGE_COUNT> costs_{};
    Launches launches_;
};

} // namespace plait
