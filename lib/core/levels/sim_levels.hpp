// Levels in one sim: strands in the levels' order, of which the first so many are stepped; the others
// follow them by the map of the level. Where none are stepped all go with their roots as they were
// shown last.
#pragma once

#include "core/follows/follow_turns.hpp"
#include "core/levels/director.hpp"
#include "core/levels/levels.hpp"
#include "core/levels/swing.hpp"
#include "core/strands/model.hpp"

#include <plait/plait_levels.h>

#include <algorithm>
#include <memory>
#include <memory_resource>
#include <vector>

namespace plait {

plait_level_choice default_level_choice();

// What is shown, and by what.
struct LevelRows {
    Layout layout;                      // strands that are stepped, and of the others those shown
    const FollowTurns* turns = nullptr; // that place the others; null: nothing has to
    float share = 0;                    // of what is lacking since the last switch
    uint32_t blended = 0;               // strands to which something is
};

class SimLevels {
  public:
    // Of a sim whose guides are those of level `top` and whose follows have `map`; `layout` is its own.
    static Result<std::unique_ptr<SimLevels>> create(Device& device, const Levels& levels,
                                                     uint32_t top, const FollowMap& map,
                                                     const Layout& layout,
                                                     const FollowTurns::Rules& rules,
                                                     std::pmr::memory_resource* memory);
    explicit SimLevels(std::pmr::memory_resource* memory)
        : swing(memory), guides_(memory), ends_(memory), turns_(memory) {}

    uint32_t level() const { return level_; }
    uint32_t shown() const { return shown_; } // strands
    uint32_t stepped() const { return guides_[level_]; }
    uint32_t stepped_of(uint32_t level) const { return guides_[level]; }
    bool is_rigid() const { return stepped() == 0; }

    // INVALID_ARGUMENT names the field, its value and its range; then nothing changes.
    Status choose(const plait_level_choice& choice);
    // What the director asks of it, but for substeps and bodies. `scale`: m, one unit of the groom.
    void describe(double scale, DirectedHair& out) const;
    bool is_due() const { return due_; } // what was chosen waits for the end of the next step
    bool changes_level() const { return due_ && next_.level != level_; }
    uint32_t next_stepped() const { return guides_[next_.level]; }
    // Nothing is left to be done but to step hair that is still.
    bool may_sleep() const { return swing.stillness.is_still() && !due_ && blending() == 0; }
    bool wakes() const { return due_ && next_stepped() > stepped(); }
    // Strands that are in view, and once what is due holds.
    uint32_t in_view() const { return std::max(shown_, stepped()); }
    uint32_t next_in_view() const { return std::max(next_.shown, next_stepped()); }
    uint32_t placed =
        0; // strands, when they were shown last: all in view, and more where detail needs them
    void take();         // what is due holds from now on
    void pass(double s); // time
    void end_blend() { blend_ = 0; }
    double blending() const { // s that are left
        return blend_ > since_ ? std::min(blend_ - since_, double(blend_)) : 0;
    }
    // Whether what is shown of guides is not what the last step left.
    bool alters_guides() const { return since_ <= 0 || blending() > 0; }

    // Of so many strands, whatever is shown. `top`: the turns of level `top`.
    LevelRows rows(const FollowTurns& top, uint32_t strands) const;
    // Of level `top`, all strands, nothing lacking.
    LevelRows finest(const FollowTurns& top) const { return {all_, top ? &top : nullptr}; }
    // Another level, for as long as it is looked at; the one before.
    uint32_t exchange_level(uint32_t level) { return std::exchange(level_, level); }
    uint32_t top() const { return top_; }
    // Appends placing all that does not move by itself in `position`, where the rows of guides are.
    // `guides`: their positions, with `pose`.
    void append(Schedule& schedule, const LevelRows& rows, const State& state, const Buffer& pose,
                const Buffer& guides, const Buffer& position) const;

    // Appends keeping, before the last step of a level, where strands are that the next one wakes.
    void append_before(Schedule& schedule, const State& state) const;
    // The same after it.
    void append_after(Schedule& schedule, const State& state) const;
    Waking waking(const Buffer& position) const {
        return {stepped(), next_stepped(), pose_before_, from_, to_, position};
    }
    const Buffer& before() const { return from_; } // float4 [guides*V], of strands that are woken
    // Appends keeping all strands as they are in `position`, for when none are stepped.
    void append_freeze(Schedule& schedule, const Buffer& pose, const Buffer& position) const;
    // Appends keeping what is shown, and would be of what comes into view; and, once the rows of the next
    // level are in its place, what is lacking to them.
    void append_shown(Schedule& schedule, const Buffer& position) const;
    void append_lacking(Schedule& schedule, const Buffer& pose, const Buffer& position) const;

    // As saved.
    struct Kept {
        uint32_t level, shown, blended;
        float blend;  // s
        double since; // s
        // What was chosen and waits for its step; 0 where nothing does.
        uint32_t due, next_level, next_shown;
        float next_blend;
    };
    Kept kept() const;
    bool holds_rows(const Kept& kept) const {
        return guides_[kept.level] == 0 || kept.since < double(kept.blend);
    }
    const Buffer& held() const { return held_; } // where it holds rows
    const Buffer& roots() const { return root_guide_; }
    // INVALID_ARGUMENT: of levels that this sim has not.
    Status check(const Kept& kept) const;
    void restore(const Kept& kept);

    // Appends putting positions where the swing is told from them.
    void append_probes(Schedule& schedule, const State& state, const Buffer& position) const;
    Swing swing;

    double ahead = 0; // s: what is shown is past the last step by so much
    uint64_t device_bytes() const;

  private:
    Status open(Device& device, const FollowMap& map, std::pmr::memory_resource* memory);
    Status check_choice(const plait_level_choice& choice) const;
    uint32_t shown_of(uint32_t asked) const;
    void append_places(Schedule& schedule, const State& state, const Buffer& to) const;
    void append_level(Schedule& schedule, plait_stage stage, uint32_t strands, bool whole,
                      float share, const Buffer& pose, const Buffer& position) const;

    std::pmr::vector<uint32_t> guides_;         // strands that are stepped, of each level
    std::pmr::vector<uint32_t> ends_;           // after which those shown may end
    std::pmr::vector<FollowTurns> turns_;       // of each level; of the first none
    std::array<double, Levels::most> shares_{}; // error over swing, of each level
    double length_ = 0;                         // of a strand, in the mean, units of the groom
    Layout all_;
    uint32_t top_ = 0, level_ = 0, shown_ = 0;
    plait_level_choice next_{};
    bool due_ = false;
    float blend_ = 0;      // s
    double since_ = 0;     // s, from the last switch, as shown, to the last step
    uint32_t blended_ = 0; // strands that have been in view since then
    Buffer root_guide_;    // uint [strands]: whose root each goes with
    // float4 [strands*V], in the frames of roots: where vertices are, if none are stepped; else, while
    // the level blends, what is lacking to them.
    Buffer held_;
    Buffer from_, to_;   // float4 [guides*V]: strands that are woken, before and after a step
    Buffer pose_before_; // float4 [2*guides]: before it
};

} // namespace plait
