// The path of the roots: where the head and every root are between calls and inside a fixed step.
//
// Two paths are kept. The call's path leads from where the roots were when the call of
// plait_sim_step began (`at_`) to where they shall be at its end (`target_`). The step's path leads
// from the sample at the end of the fixed step before (`from_`) to the sample at the end of this
// one (`to_`), on the parabola through the one before both (`before_`). The stage `roots` gives the
// second to the substeps, and takes the samples of the first when roots have poses of their own.
#pragma once

#include "backend/device.hpp"
#include "core/base/layout.hpp"
#include "core/base/pose.hpp"
#include "core/base/schedule.hpp"

#include <algorithm>
#include <array>
#include <memory_resource>
#include <vector>

namespace plait {

class Roots {
  public:
    Roots(const Layout& layout, std::pmr::memory_resource* memory)
        : layout_(layout), memory_(memory) {}

    // Sets the target of the next call. `own`: [guides] poses applied before the head, or empty; in
    // metres, of which `scale` are one of the groom's, as `head` has them already.
    Status aim(Device& device, const plait_pose& head, std::span<const plait_pose> own,
               float scale);
    // The same with poses that the caller fills on the device, in between: float4 [2*guides]. `given`: a
    // hash of all that they come from; 0: nobody knows.
    Result<const Buffer*> target_poses(Device& device);
    void aim_at_target_poses(const plait_pose& head, uint64_t given);

    // Moves the step's path on: it ends at share `end` of the call. append_path() is due.
    void advance(double end);
    // What fills that end where roots have poses of their own.
    void append_path(Schedule& schedule) const;
    // Poses at share `alpha` of the step's path.
    void append_poses(Schedule& schedule, float alpha, const Buffer& pose) const;
    // The call is over: the roots are at their target.
    void arrive();
    // Poses where the roots are between calls.
    void append_poses_now(Schedule& schedule, const Buffer& pose) const;
    // The head at share `share` of the step before, and poses where it is `head` and what roots have of
    // their own is as at the step's begin.
    plait_pose before(double share) const { return interpolate(before_.head, from_.head, share); }
    // As if the head had been there at the begin of the step before.
    void come_from(const plait_pose& head) { before_.head = head; }
    void append_poses_of(Schedule& schedule, const plait_pose& head, const Buffer& pose) const;
    // On the straight path between poses of all roots; a share below 0 lies before it.
    void append_between(Schedule& schedule, const Buffer& from, const Buffer& to, float share,
                        const Buffer& pose) const;
    // No path: the step begins and ends where the roots are now.
    void stop(Schedule& schedule) { jump(schedule, 0); }
    // The same, at share `end` of the call, but that the head has come there as it moved before.
    void jump(Schedule& schedule, double end);
    // The head has not moved before, as far as anybody knows.
    void forget() { from_.head = to_.head; }
    // The step's path is straight, whatever was before it.
    void straighten() { samples_ = std::min(samples_, 1u); }
    // The step's path so far, as it lies in a frame that moves by `motion`.
    void carry(const plait_pose& motion);

    // All but the target is in units of which there are `ratio` times as many. What roots have of their
    // own stays as it lies around its middle, which goes as the head does. Waits where they have some.
    Result<HeadWays> rescale(Device& device, double ratio);
    // Fills `pose` with where roots are after the step, if they go on as since `share` of its path.
    // Waits as before.
    Status fill_next(Device& device, double share, const Buffer& pose) const;

    // How far the step's path takes the point `p` (m, at rest) of the head.
    std::array<float, 3> head_moves(const float p[3]) const;
    // The same for the call's path.
    std::array<float, 3> call_moves(const float p[3]) const;
    // Head at the begin and at the end of the last fixed step.
    const plait_pose& step_begin() const { return from_.head; }
    const plait_pose& step_head() const { return to_.head; }
    // At the end of the last call.
    const plait_pose& call_head() const { return at_.head; }

    // The state as saved: each one's head, whether its roots have poses of their own, and the
    // buffer that holds them.
    struct Poses {
        plait_pose head = identity_pose;
        bool own = false; // false: the buffer, if there is one, holds identities
        Buffer poses;     // float4 [2*guides]
        // Hash of what the poses come from; 0: not known. Not saved.
        uint64_t given = 0;

        // As far as the host can tell.
        bool is_at(const Poses& other) const {
            return own == other.own && (!own || (given != 0 && given == other.given)) &&
                   same_pose(head, other.head);
        }
    };
    std::array<const Poses*, 5> all_poses() const {
        return {&at_, &target_, &from_, &to_, &before_};
    }
    std::array<Poses*, 5> all_poses() { return {&at_, &target_, &from_, &to_, &before_}; }
    // Ends of steps, up to 2, since the path began anew; with 2 it bends.
    uint32_t samples() const { return samples_; }
    // In this step, as far as the host can tell.
    bool stands() const { return from_.is_at(to_); }
    // Since the last step ended, as far as the host can tell.
    bool left_step() const { return !to_.is_at(at_); }
    // In this step and the one before.
    bool rest() const { return before_.is_at(from_) && from_.is_at(to_); }
    // In this step, beside the head's.
    bool have_own() const { return from_.own || to_.own; }
    bool bends() const { return samples_ == 2; }
    void restore_samples(uint32_t samples) { samples_ = samples; }
    Status make_buffers(Device& device);  // with identities; nothing if they are there
    Status clear_buffers(Device& device); // to identities
    bool aimed = false;                   // target_ is not where the roots are
    bool moves() const {                  // as far as the host can tell
        return aimed && !target_.is_at(at_);
    }

  private:
    void add(Schedule& schedule, const Poses* before, const Poses& from, const Poses& to,
             float alpha, const Buffer& pose) const;
    using OwnPoses = std::pmr::vector<plait_pose>; // [guides]; or empty: identities
    Result<OwnPoses> read_own(Device& device, const Poses& poses) const;
    const Poses& goal() const { return aimed ? target_ : at_; }

    Layout layout_;
    std::pmr::memory_resource* memory_;
    float end_ = 0;     // of the step's path, in the call
    bool fill_ = false; // the poses at its end, on the device, are not those yet
    uint32_t samples_ = 0;
    Poses at_, target_, before_, from_, to_;
};

} // namespace plait
