#include "motion.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

namespace {

constexpr double for_ever = 1e9; // s

double radians(double degrees) {
    return degrees * pi / 180;
}

Pose turned(const Vec3& axis, double degrees) {
    return {Quat(Eigen::AngleAxisd(radians(degrees), axis)), Vec3::Zero()};
}

// From nothing at t = 0; frequency in Hz, phase in degrees.
double swayed(double frequency, double phase, double t) {
    return std::sin(2 * pi * frequency * t + radians(phase)) - std::sin(radians(phase));
}

Pose pose_of(const Sine& s, double time) {
    const double t = std::clamp(time, s.from, s.to) - s.from;
    return {Quat::Identity(), s.direction * s.amplitude * swayed(s.frequency, s.phase, t)};
}

Pose pose_of(const Accelerate& a, double time) {
    const double pushed = std::clamp(time, a.from, a.to) - a.from;
    const double coasted = std::max(0.0, time - a.to);
    return {Quat::Identity(), a.direction * a.acceleration * pushed * (0.5 * pushed + coasted)};
}

Pose pose_of(const Move& m, double time) {
    return {Quat::Identity(), m.velocity * (std::clamp(time, m.from, m.to) - m.from)};
}

Pose pose_of(const Turn& turn, double time) {
    const double t = std::clamp(time, turn.from, turn.to) - turn.from;
    const double share =
        turn.frequency > 0 ? swayed(turn.frequency, turn.phase, t) : t / (turn.to - turn.from);
    return turned(turn.axis, turn.degrees * share);
}

Pose pose_of(const Place& place, double) {
    return {Quat::Identity(), place.offset};
}

Pose pose_of(const Teleport& jump, double time) {
    if (time < jump.time)
        return {};
    Pose pose = turned(jump.axis, jump.degrees);
    pose.t = jump.offset;
    return pose;
}

Pose pose_of(const Keyframe& key) {
    const double angle = key.rotation.norm();
    Pose pose = angle > 0 ? turned(key.rotation / angle, angle) : Pose{};
    pose.t = key.position;
    return pose;
}

Pose pose_of(const Keyframes& frames, double time) {
    const auto& keys = frames.keys;
    const auto after = std::find_if(keys.begin(), keys.end(),
                                    [&](const Keyframe& key) { return key.time > time; });
    if (after == keys.begin() || after == keys.end())
        return pose_of(after == keys.end() ? keys.back() : keys.front());
    const Pose a = pose_of(*std::prev(after)), b = pose_of(*after);
    const double share = (time - std::prev(after)->time) / (after->time - std::prev(after)->time);
    return {a.q.slerp(share, b.q), a.t + share * (b.t - a.t)};
}

Vec3 read_vector(JsonReader& in, const char* key, const Vec3& otherwise, bool unit) {
    std::array<float, 3> v{};
    if (!in.numbers(key, v, -1e9, 1e9))
        return otherwise;
    const Vec3 vector(static_cast<double>(v[0]), static_cast<double>(v[1]),
                      static_cast<double>(v[2]));
    if (unit && !(vector.norm() > 0))
        in.fail(key, "is [0,0,0], which has no direction");
    return unit ? vector.normalized() : vector;
}

struct Span {
    double from = 0, to = for_ever;
};
Span read_span(JsonReader& in, double time_unit) {
    Span span;
    in.number("from", span.from, 0, 1e6);
    in.number("to", span.to, span.from, for_ever);
    span.from *= time_unit;
    if (span.to < for_ever)
        span.to *= time_unit;
    return span;
}

Term read_sine(JsonReader& in, double time_unit) {
    Sine sine{};
    sine.direction = read_vector(in, "direction", Vec3::UnitX(), true);
    sine.frequency = 1;
    in.number("frequency", sine.frequency, 1e-6, 1e6);
    sine.frequency /= time_unit;
    double amplitude = 0, in_g = 0;
    const bool has_amplitude = in.number("amplitude", amplitude, -1e6, 1e6);
    const bool has_g = in.number("acceleration_g", in_g, -1e6, 1e6);
    if (has_amplitude == has_g)
        in.fail(has_g ? "amplitude" : "acceleration_g",
                has_g ? "is given beside acceleration_g: one of the two"
                      : "is missing: its peak in g, or amplitude in m");
    const double omega = 2 * pi * sine.frequency;
    sine.amplitude = has_g ? in_g * standard_gravity / (omega * omega) : amplitude;
    in.number("phase", sine.phase, -360, 360);
    const Span span = read_span(in, time_unit);
    sine.from = span.from;
    sine.to = span.to;
    return sine;
}

Term read_accelerate(JsonReader& in, double time_unit) {
    Accelerate term{};
    term.direction = read_vector(in, "direction", Vec3::UnitX(), true);
    double in_g = 0;
    if (in.number("acceleration_g", in_g, -1e6, 1e6))
        term.acceleration = in_g * standard_gravity;
    else if (!in.number("acceleration", term.acceleration, -1e7, 1e7))
        in.fail("acceleration_g", "is missing: in g, or acceleration in m/s^2");
    const Span span = read_span(in, time_unit);
    term.from = span.from;
    term.to = span.to;
    return term;
}

Term read_turn(JsonReader& in, double time_unit) {
    Turn term{};
    term.axis = read_vector(in, "axis", Vec3::UnitY(), true);
    if (!in.number("degrees", term.degrees, -1e6, 1e6))
        in.fail("degrees", "is missing: how far it turns");
    in.number("frequency", term.frequency, 0, 1e6);
    term.frequency /= time_unit;
    in.number("phase", term.phase, -360, 360);
    const Span span = read_span(in, time_unit);
    term.from = span.from;
    term.to = span.to;
    if (term.frequency == 0 && !(term.to < for_ever && term.to > term.from))
        in.fail("to", "is missing: when the turn ends; or frequency, for one that swings");
    return term;
}

Term read_teleport(JsonReader& in, double time_unit) {
    Teleport term{};
    in.number("time", term.time, 0, 1e6);
    term.time *= time_unit;
    term.offset = read_vector(in, "offset", Vec3::Zero(), false);
    term.axis = read_vector(in, "axis", Vec3::UnitY(), true);
    in.number("degrees", term.degrees, -1e6, 1e6);
    term.announced = true;
    in.flag("announced", term.announced);
    return term;
}

Term read_keyframes(JsonReader& in, double time_unit) {
    Keyframes frames;
    const Json* list = in.value("keys");
    if (!list || !list->is_array() || list->empty())
        in.fail("keys", "is missing or no list of { time, position, rotation }");
    for (size_t i = 0; i < list->size(); ++i) {
        JsonReader key = in.element(*list, i, "keys");
        Keyframe frame{};
        const double least = frames.keys.empty() ? 0 : frames.keys.back().time / time_unit;
        if (!key.number("time", frame.time, least, 1e6))
            key.fail("time", "is missing");
        frame.time *= time_unit;
        frame.position = read_vector(key, "position", Vec3::Zero(), false);
        frame.rotation = read_vector(key, "rotation", Vec3::Zero(), false);
        key.finish();
        frames.keys.push_back(frame);
    }
    return frames;
}

Term read_term(JsonReader in, double time_unit) {
    static constexpr std::array names{"sine",  "accelerate", "move",     "turn",
                                      "place", "teleport",   "keyframes"};
    int kind = -1;
    if (!in.choice("type", kind, names))
        in.fail("type", "is missing: sine, accelerate, move, turn, place, teleport or keyframes");
    Term term;
    switch (kind) {
    case 0:
        term = read_sine(in, time_unit);
        break;
    case 1:
        term = read_accelerate(in, time_unit);
        break;
    case 2: {
        const Vec3 velocity = read_vector(in, "velocity", Vec3::Zero(), false);
        const Span span = read_span(in, time_unit);
        term = Move{velocity, span.from, span.to};
        break;
    }
    case 3:
        term = read_turn(in, time_unit);
        break;
    case 4:
        term = Place{read_vector(in, "offset", Vec3::Zero(), false)};
        break;
    case 5:
        term = read_teleport(in, time_unit);
        break;
    default:
        term = read_keyframes(in, time_unit);
    }
    in.finish();
    return term;
}

} // namespace

Pose operator*(const Pose& a, const Pose& b) {
    return {a.q * b.q, a * b.t};
}

plait_pose to_plait(const Pose& pose) {
    plait_pose out;
    for (int i = 0; i < 4; ++i)
        out.q[i] = static_cast<float>(pose.q.coeffs()[i]);
    for (int i = 0; i < 3; ++i)
        out.t[i] = static_cast<float>(pose.t[i]);
    return out;
}

// Turns first, in order; then all the ways add up.
Pose Motion::at(double time) const {
    Pose sum;
    for (const Term& term : terms) {
        const Pose one = std::visit([&](const auto& t) { return pose_of(t, time); }, term);
        sum.q = one.q * sum.q;
        sum.t += one.t;
    }
    sum.q.normalize();
    return sum;
}

bool Motion::teleports(double from, double to) const {
    return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
        const auto* jump = std::get_if<Teleport>(&term);
        return jump && jump->announced && jump->time > from && jump->time <= to;
    });
}

Motion read_motion(const JsonReader& top, const Json& value, const char* key, double time_unit) {
    if (!value.is_array())
        top.fail(key, "is " + value.dump() + ", not a list of terms that add up");
    Motion motion;
    for (size_t i = 0; i < value.size(); ++i)
        motion.terms.push_back(read_term(top.element(value, i, key), time_unit));
    return motion;
}

} // namespace lab
