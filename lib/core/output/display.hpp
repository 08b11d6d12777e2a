// What is shown: positions between two steps (if asked for), follow strands, tangents.
#pragma once

#include "core/follows/detail.hpp"
#include "core/follows/follow_turns.hpp"
#include "core/levels/sim_levels.hpp"
#include "core/roots/roots.hpp"
#include "core/strands/model.hpp"
#include "core/strands/state.hpp"

#include <cstdint>
#include <memory_resource>

namespace plait {

// Either so many beside each guide, or those of a map.
struct FollowRules {
    uint32_t per_guide = 0;
    float radius = 0; // m
    uint64_t seed = 0;
    const FollowMap* map = nullptr;
    FollowTurns::Rules turns{0, 1, {}}; // with a map
};

struct DisplayRules {
    bool interpolates = false;
    bool keeps_last_frame = false;
    bool levels = false;
};

// Where the model has written those of guides, with their positions, only follows are left.
enum class Tangents { of_all, of_follows };

class Display {
  public:
    static Result<Display> create(Device& device, const Groom& groom, const Layout& layout,
                                  const FollowRules& follows, const DisplayRules& rules,
                                  std::pmr::memory_resource* memory);

    bool interpolates() const { return static_cast<bool>(pose_now_); }
    // From now on it does: what was shown stays the buffer that is shown, and the state gets one of its
    // own. Fails without an effect.
    Status interpolate(Device& device, Schedule& schedule, const Layout& layout, State& state);
    // From now on what is shown has a size of its own, at first that of the groom: what was shown stays
    // the buffer that is, and what is computed gets one of its own. Fails without an effect.
    Status open_scale(Device& device, Schedule& schedule, const Layout& layout, State& state);
    bool has_scale() const { return static_cast<bool>(scaled_); }
    float scale = 1; // of what is shown next; 1 where it has no size of its own
    // The stages that this takes later, in any buffers.
    void append_interpolation(Schedule& schedule, const Layout& layout, const State& state) const;
    // What keeps the present step as the one before the last.
    void append_step_before(Schedule& schedule, const Layout& layout, const State& state) const;
    // What keeps what is shown of the first so many strands as the frame before, if that is asked for.
    void append_frame_before(Schedule& schedule, const Layout& layout, uint32_t strands,
                             const State& state) const;
    // Where that is kept: with levels, what puts `rows` there as they would have been shown now.
    void append_coming(Schedule& schedule, const StepInput& at, const Roots& roots, float remainder,
                       const LevelRows& rows, const SimLevels& levels) const;
    // What fills position and tangent; `remainder`: share of a step since the last one.
    // Colliders are where they are at the end of `at`. `levels`: null without.
    void append(Schedule& schedule, const StepInput& at, const Roots& roots, float remainder,
                Tangents tangents, const SimLevels* levels) const;
    // With levels: what places `rows`, without detail, as the last step has left them, in what is shown, or
    // where they are shown, in `to`; and turns follows out of bodies.
    void append_step(Schedule& schedule, const StepInput& at, const SimLevels& levels,
                     const LevelRows& rows) const;
    void append_rows(Schedule& schedule, const StepInput& at, const Roots& roots, float remainder,
                     const LevelRows& rows, const SimLevels* levels, const Buffer& to) const;
    void append_detail(Schedule& schedule, const StepInput& at, const LevelRows& rows) const;
    void append_out(Schedule& schedule, const StepInput& at, const LevelRows& rows,
                    const Buffer& position) const;
    // Those that append() places. `levels`: null without.
    LevelRows rows_of(const Layout& layout, const SimLevels* levels) const;
    // With which rows are placed where they are shown.
    const Buffer& pose(const State& state) const { return interpolates() ? pose_now_ : state.pose; }
    const Buffer& before_scale(const State& state) const { return position(state); }
    const FollowTurns& turns() const { return turns_; }
    // Follow strands are kept out of colliders.
    bool meets_colliders(const Params& params) const {
        return (turns_ || levels_) && params.follow_contact != 0;
    }

    // Of the follows, from the next time on that they are shown. Waits. INVALID_STATE: there are none.
    Result<Detail> make_detail(Device& device, const Layout& layout, const State& state,
                               const plait_detail_desc& desc, std::span<const uint32_t> centres,
                               std::pmr::memory_resource* memory) const;
    // Makes, or frees, what draws wet follows to their guides; nothing without follows.
    Status keep_wetness(Device& device, const Layout& layout, const State& state, bool keep,
                        std::pmr::memory_resource* memory);
    void exchange(Detail& detail) { std::swap(detail_, detail); }

    const Buffer& shown(const State& state) const {
        return has_scale() ? scaled_ : position(state);
    }
    const Buffer& tangent() const { return tangent_; }
    const Buffer& follow_guide() const { return follow_guide_; } // none without follows
    const Buffer& last_frame() const { return last_frame_; }     // none unless it is kept
    const Buffer& kept() const { return position_local_; }
    uint64_t device_bytes() const;

  private:
    // The same at the groom's size.
    const Buffer& position(const State& state) const {
        return position_out_ ? position_out_ : state.position;
    }
    void append_guides(Schedule& schedule, const Layout& layout, const State& state,
                       const Buffer& to) const;
    Status make_between(Device& device, const Layout& layout);
    Status make_follows(Device& device, const Groom& groom, const Layout& layout,
                        const FollowRules& rules, std::pmr::memory_resource* memory);
    Status make_turns(Device& device, const Groom& groom, const Layout& layout,
                      const FollowRules& rules, std::pmr::memory_resource* memory);

    Result<std::pmr::vector<float>> rest_of_all(Device& device, const Layout& layout,
                                                const State& state,
                                                std::span<const uint32_t> guides,
                                                std::pmr::memory_resource* memory) const;

    Buffer tangent_;       // float4 [strands*V]
    Buffer follow_guide_;  // uint [follows]
    Buffer follow_offset_; // float4 [follows]; none with a map
    FollowTurns turns_;    // with a map only
    Detail detail_;        // where it is set only
    Detail wet_;           // where strands may be wet only
    Buffer last_frame_;    // float4 [strands*V]
    Buffer scaled_;        // float4 [strands*V], from the first scale on
    bool levels_ = false;
    Buffer position_out_; // float4 [strands*V]; with interpolation or levels only
    // With interpolation only.
    Buffer position_local_; // float4 [guides*V]: the step before the last, in its root frames
    Buffer pose_now_;       // float4 [2*guides]
};

} // namespace plait
