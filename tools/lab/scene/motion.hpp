// How the roots, or a collider, move: a sum of terms, each a formula of time.
#pragma once

#include "common.hpp"

#include <variant>
#include <vector>

namespace lab {

struct Pose {
    Quat q = Quat::Identity();
    Vec3 t = Vec3::Zero();
    Vec3 operator*(const Vec3& p) const { return q * p + t; }
};
Pose operator*(const Pose& a, const Pose& b);
plait_pose to_plait(const Pose& pose);

// t += direction * amplitude (sin(2 pi frequency time + phase) - sin phase), from `from` to `to`
struct Sine {
    Vec3 direction;
    double amplitude, frequency, phase; // m, Hz, degrees
    double from, to;                    // s; held before and after
};
// From rest at `from`, evenly faster until `to`, then at that speed.
struct Accelerate {
    Vec3 direction;
    double acceleration; // m/s^2
    double from, to;
};
struct Move {
    Vec3 velocity; // m/s
    double from, to;
};
struct Turn {
    Vec3 axis;
    double degrees, frequency; // degrees (sin(2 pi frequency time + phase) - sin phase), or once
    double phase;              // over where the frequency is 0; degrees
    double from, to;
};
struct Place {
    Vec3 offset; // m, always
};
struct Teleport {
    double time;
    Vec3 offset;
    Vec3 axis;
    double degrees;
    bool announced; // by plait_sim_teleport
};
struct Keyframe {
    double time;
    Vec3 position;
    Vec3 rotation; // axis times angle, degrees
};
struct Keyframes {
    std::vector<Keyframe> keys; // straight in between, held before and after
};

using Term = std::variant<Sine, Accelerate, Move, Turn, Place, Teleport, Keyframes>;

class Motion {
  public:
    std::vector<Term> terms;

    // `scale` s of simulated time are one unit of the motion's.
    Pose at(double time) const;
    // Whether a teleport that is announced lies in (from, to].
    bool teleports(double from, double to) const;
    bool still() const { return terms.empty(); }
};

// `time_unit`: seconds per unit of time; `g`: what "acceleration_g" counts in, m/s^2.
Motion read_motion(const JsonReader& top, const Json& value, const char* key, double time_unit);

} // namespace lab
