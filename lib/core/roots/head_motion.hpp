// What is known of the head's motion, of which hair has its part: the last step says it, but for a
// head that was put somewhere and has not been told since where to go.
#pragma once

#include "core/base/pose.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace plait {

class HeadMotion {
  public:
    enum class Known : uint32_t {
        all,      // the next step says it
        as_put,   // how it moved when it was put where it is
        nothing,  // after a reset while it moved
        reframed, // all, but that of the step before hair felt another share than of the next
    };

    // Until it has begun, the first roots say where the hair is. A reset forgets time, but not roots.
    enum class Begun : uint32_t {
        no,
        time,  // has passed, or hair was given a motion
        roots, // were set, or the head was teleported
    };

    // The roots are aimed, and `move` if that is not where they are. An aim at the present place says
    // nothing: a game aims in every frame, in that of a teleport, too. True: it is the first, and says
    // where the head is.
    bool aim(bool move) {
        told_ = has_begun() && move;
        const bool first = !has_begun();
        begin(Begun::roots);
        first_aim_ = first_aim_ || first;
        return first;
    }
    void begin(Begun by) { begun_ = std::max(begun_, by); }
    bool has_begun() const { return begun_ != Begun::no; }
    bool is_told() const { return told_; }
    // Once: bodies are put where they were told to be, as the first aim put the head, and no other came.
    bool puts_bodies() { return std::exchange(first_aim_, false) && !told_; }

    // It moved from `from` to `to` when it was put where it is now.
    void put(const plait_pose& from, const plait_pose& to);
    // Time was dropped, but it has been told where to go.
    void skip() { told_ = true; }
    // Back at the groom, at `head`.
    void reset(bool stands, const plait_pose& head);
    // Hair was given a motion in the world.
    void give();
    // Another share of a frame's motion is felt.
    void reframe() { known_ = known_ == Known::all ? Known::reframed : known_; }

    bool is(Known known) const { return known_ == known; }
    bool is_on_its_way() const { return is(Known::all) || is(Known::reframed); }
    // Where it would be had it moved on as when it was put, after `part` of a step from `now`.
    plait_pose next(const plait_pose& now, double part) const {
        return interpolate(now, carried(now, put_from_, put_to_), part);
    }

    // How hair gets the motion of the step that begins, where the one before does not say it.
    struct SetOff {
        bool waits;     // without an aim: hair has none of the head's motion
        bool goes_on;   // as when it was put
        bool by_itself; // unless it jumps
    };
    // `goes_on`: whether the head does, as far as its path tells.
    SetOff set_off(bool goes_on);
    void end_reframing() { known_ = Known::all; }

    // m/s by which it is faster than in the call before; 0: unknown.
    double faster(const std::array<double, 3>& velocity);

    void rescale(double ratio);

    // What snapshots hold.
    struct State {
        plait_pose put_from = identity_pose, put_to = identity_pose;
        uint32_t known = 0, told = 0, waited = 0, first_aim = 0, begun = 0;
    };
    State state() const;
    void restore(const State& state);

  private:
    Known known_ = Known::as_put;
    plait_pose put_from_ = identity_pose, put_to_ = identity_pose;
    bool told_ = false;   // since then, where the head goes
    bool waited_ = false; // since then, for a step without an aim
    Begun begun_ = Begun::no;
    bool first_aim_ = false; // it has put the head, and no step has been since
    bool knows_velocity_ = false;
    std::array<double, 3> velocity_{}; // m/s, in the last call
};

} // namespace plait
