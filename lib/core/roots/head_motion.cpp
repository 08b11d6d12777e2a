#include "core/roots/head_motion.hpp"

#include <cmath>

namespace plait {

void HeadMotion::put(const plait_pose& from, const plait_pose& to) {
    known_ = Known::as_put;
    put_from_ = from;
    put_to_ = to;
    told_ = waited_ = knows_velocity_ = false;
}

void HeadMotion::reset(bool stands, const plait_pose& head) {
    known_ = stands ? Known::as_put : Known::nothing;
    put_from_ = put_to_ = head;
    told_ = waited_ = false;
    begun_ = begun_ == Begun::time ? Begun::no : begun_;
}

void HeadMotion::give() {
    begin(Begun::time);
    known_ = Known::all;
}

HeadMotion::SetOff HeadMotion::set_off(bool goes_on) {
    const bool put = is(Known::as_put);
    const bool waits = !told_ && !waited_;
    const SetOff how{waits, put && waited_ && goes_on, put && !waits && !waited_};
    waited_ = waits;
    known_ = waits ? known_ : Known::all;
    return how;
}

double HeadMotion::faster(const std::array<double, 3>& velocity) {
    double square = 0;
    for (size_t i = 0; i < 3; ++i)
        square += (velocity[i] - velocity_[i]) * (velocity[i] - velocity_[i]);
    velocity_ = velocity;
    return std::exchange(knows_velocity_, true) ? std::sqrt(square) : 0.0;
}

void HeadMotion::rescale(double ratio) {
    for (plait_pose* pose : {&put_from_, &put_to_})
        plait::rescale(*pose, ratio);
}

HeadMotion::State HeadMotion::state() const {
    return {put_from_, put_to_,    static_cast<uint32_t>(known_), told_,
            waited_,   first_aim_, static_cast<uint32_t>(begun_)};
}

void HeadMotion::restore(const State& state) {
    put_from_ = state.put_from;
    put_to_ = state.put_to;
    known_ = static_cast<Known>(state.known);
    told_ = state.told != 0;
    waited_ = state.waited != 0;
    first_aim_ = state.first_aim != 0;
    begun_ = static_cast<Begun>(state.begun);
}

} // namespace plait
