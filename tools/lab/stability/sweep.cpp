#include "axes.hpp"
#include "common.hpp"
#include "common/collider_reader.hpp"

#include <cmath>

namespace lab::stability {

namespace {

constexpr double shake_rate = 2 * pi * 2; // rad/s, 2 Hz
constexpr double line_density = 5e-6;     // kg/m
constexpr double jump_at = 0.5;           // s

std::vector<Point> straight(const std::vector<double>& lengths) {
    std::vector<Point> points{Point::Zero()};
    for (const double l : lengths)
        points.push_back(points.back() + Point(l, 0, 0));
    return points;
}

// A turn of 60 degrees a segment, at most one whole turn, climbing along x.
std::vector<Point> curl(const std::vector<double>& lengths) {
    const double turn = std::min(pi / 3, 2 * pi / static_cast<double>(lengths.size()));
    std::vector<Point> points{Point::Zero()};
    double angle = 0;
    for (const double l : lengths) {
        const Point along(0.5, std::sqrt(0.75) * std::cos(angle),
                          std::sqrt(0.75) * std::sin(angle));
        points.push_back(points.back() + l * along);
        angle += turn;
    }
    return points;
}

std::vector<double> even(uint32_t segments) {
    return std::vector<double>(segments, length / segments);
}

// A(1 - cos), which begins and ends (2 s are four periods) at rest; or a jump.
TrialStrand shaken(std::vector<Point> rest, const Shake& shake, double shaking, double step) {
    TrialStrand strand;
    strand.rest = std::move(rest);
    const double amplitude = shake.g * gravity / (shake_rate * shake_rate);
    strand.root = [=](double t) {
        if (shake.jump > 0)
            return pose_at(t > jump_at ? shake.jump * length : 0);
        return pose_at(amplitude * (1 - std::cos(shake_rate * std::min(t, shaking))));
    };
    strand.root_speed = shake.jump > 0 ? shake.jump * length / step : amplitude * shake_rate;
    strand.stir = shake.g;
    return strand;
}

plait::SimDesc desc_of(const Subject& subject, double rate, double gamma) {
    plait::SimDesc desc;
    desc.model = subject.model;
    desc.step = static_cast<float>(1 / rate);
    desc.substeps = subject.substeps;
    plait_sim_params& params = desc.params;
    params.gravity[1] = static_cast<float>(-gravity);
    desc.material.line_density = static_cast<float>(line_density);
    desc.material.bend_stiffness =
        subject.limp ? 0 : static_cast<float>(line_density * gravity * std::pow(length, 3) / gamma);
    params.iterations = subject.iterations;
    desc.tressfx.length_iterations = subject.iterations;
    params.bdf2 = subject.bdf2;
    return desc;
}

// Of the shapes, the straight one last: drag and energy are reckoned from the first strand.
Trial trial_of(const Subject& subject, const Place& place) {
    Trial trial;
    trial.desc = desc_of(subject, place.rate, place.gamma);
    trial.has_energy = subject.model != PLAIT_MODEL_TRESSFX;
    return trial;
}

const Shake usual{"1 g", 1, 0};

void add_substeps(Points& points) {
    for (const uint32_t n : {1u, 2u, 4u, 10u, 30u, 100u, 300u, 1000u})
        points.push_back({"substeps", axis_text(n), [n](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              trial.desc.substeps = n;
                              return trial;
                          }});
}

void add_offsets(Points& points) {
    for (const double away : {1.0, 30.0, 1e3, 1e4, 1e5, 9e5})
        points.push_back({"world offset (m)", axis_text(away), [away](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              trial.offset = Point(away, 0, 0);
                              trial.has_energy &= away < 1e3; // positions are float32
                              return trial;
                          }});
}

void add_drags(Points& points) {
    for (const double drag : {0.0, 1.0, 10.0, 100.0, 1e3, 1e4})
        points.push_back({"drag (1/s)", axis_text(drag), [drag](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              trial.desc.params.drag = static_cast<float>(drag);
                              trial.settle_drag =
                                  drag < 10; // else it is at rest, or slow, by itself
                              return trial;
                          }});
}

// Last segment to first, in geometric progression; masses go with the lengths.
void add_ratios(Points& points) {
    for (const double ratio : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3})
        points.push_back({"segment ratio", axis_text(ratio), [ratio](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              std::vector<double> lengths(16);
                              double sum = 0;
                              for (size_t i = 0; i < lengths.size(); ++i)
                                  sum += lengths[i] = std::pow(ratio, double(i) / 15);
                              for (double& l : lengths)
                                  l *= length / sum;
                              trial.strands[0].rest = straight(lengths);
                              trial.strands[1].rest = curl(lengths);
                              return trial;
                          }});
    points.push_back({"segment ratio", "alternating 100", [](const Subject& subject) {
                          Trial trial = base_trial(subject);
                          std::vector<double> lengths;
                          for (int i = 0; i < 16; ++i)
                              lengths.push_back(length / 8.08 * (i % 2 ? 1 : 0.01));
                          trial.strands[0].rest = straight(lengths);
                          trial.strands[1].rest = curl(lengths);
                          return trial;
                      }});
}

// Tip to root, linear between. `tressfx` has no masses.
void add_densities(Points& points) {
    for (const double ratio : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3})
        points.push_back({"density ratio", axis_text(ratio), [ratio](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              for (int k = 0; k < 4; ++k)
                                  trial.desc.material.density_ramp[k] =
                                      static_cast<float>(1 + (ratio - 1) * k / 3);
                              return trial;
                          }});
}

// The root turns about its own direction for 2 s.
void add_twists(Points& points) {
    for (const double turns : {0.0, 1.0, 5.0, 10.0, 20.0, 40.0})
        points.push_back(
            {"twist (turns in 2 s)", axis_text(turns), [turns](const Subject& subject) {
                 Trial trial = base_trial(subject);
                 for (TrialStrand& strand : trial.strands) {
                     strand.root = [turns](double t) {
                         const double half = pi * turns * std::min(t / 2, 1.0);
                         plait_pose pose = pose_at(0);
                         pose.q[0] = static_cast<float>(std::sin(half));
                         pose.q[3] = static_cast<float>(std::cos(half));
                         return pose;
                     };
                     strand.root_speed = pi * turns * length; // of the curl's outside
                 }
                 return trial;
             }});
}

void add_frames(Points& points) {
    const std::pair<const char*, std::vector<double>> schedules[] = {
        {"16.6/33/8 ms", {1.0 / 60, 1.0 / 30, 1.0 / 120}},
        {"with 0", {1.0 / 60, 0, 1.0 / 60}},
        {"with 1 s", {1.0 / 60, 1.0 / 60, 1.0 / 60, 1.0 / 60, 1.0}},
    };
    for (const auto& [name, frames] : schedules)
        points.push_back({"frames", name, [frames = frames](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              trial.frames = frames;
                              trial.has_energy = false; // a frame is not a step
                              if (frames.back() == 1)
                                  for (TrialStrand& strand : trial.strands) // catches up in 8 steps
                                      strand.root_speed *= 60.0 / 8;
                              return trial;
                          }});
}

// A sphere of 5 cm that crosses the middle of the strand at `speed` and stays beyond it.
TrialCollider crossing(double speed, double friction) {
    TrialCollider collider{common::smooth_collider(), {}};
    collider.shape.capsule.radius_a = collider.shape.capsule.radius_b = 0.05f;
    collider.shape.friction = static_cast<float>(friction);
    collider.pose = [speed](double t) {
        plait_pose pose = pose_at(0.3 * length);
        pose.t[1] = static_cast<float>(std::min(-1.0 + speed * t, 1.0) * 1.0) - 0.1f;
        return pose;
    };
    return collider;
}

void add_colliders(Points& points) {
    for (const double speed : {0.1, 1.0, 10.0, 100.0})
        points.push_back(
            {"collider speed (m/s)", axis_text(speed), [speed](const Subject& subject) {
                 Trial trial = base_trial(subject);
                 trial.colliders = {crossing(speed, 0.5)};
                 for (TrialStrand& strand : trial.strands)
                     strand.root_speed += speed;
                 return trial;
             }});
    for (const double friction : {0.0, 0.3, 1.0, 10.0})
        points.push_back({"friction", axis_text(friction), [friction](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              trial.colliders = {crossing(1, friction)};
                              for (TrialStrand& strand : trial.strands)
                                  strand.root_speed += 1;
                              return trial;
                          }});
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
        points.push_back({"start embedded", axis_text(share), [share](const Subject& subject) {
                              Trial trial = base_trial(subject);
                              TrialCollider sphere = crossing(0, 0.3);
                              sphere.shape.capsule.radius_a = sphere.shape.capsule.radius_b = 0.15f;
                              const double depth = 0.15 * (1 - 2 * share);
                              sphere.pose = [depth](double) {
                                  plait_pose pose = pose_at(0.5 * length);
                                  pose.t[1] = static_cast<float>(-depth);
                                  return pose;
                              };
                              trial.colliders = {sphere};
                              for (TrialStrand& strand : trial.strands)
                                  strand.root_speed += 0.15 * 60; // out of it in a step
                              return trial;
                          }});
}

// A hand on the head (assets/lab/hand.json): a capsule of 3 cm comes at 0.9 m/s, strokes a skull of
// 8.8 cm at 0.36 m/s, `room` above it, and leaves. About the skull's centre.
constexpr double skull = 0.088, hand = 0.03, comes = 0.3, comes_at = 0.9, strokes_at = 0.36;

Point hand_at(double time, double room) {
    const double away = skull + room + hand, from = 0.034; // rad, of where it strokes
    const double arrives = comes / comes_at;
    const double strokes = (pi - 2 * from) * away / strokes_at;
    const double along = std::clamp((time - arrives) / strokes, 0.0, 1.0);
    const double angle = from + (pi - 2 * from) * along;
    const double out = std::clamp(arrives - time, 0.0, arrives) +
                       std::clamp(time - arrives - strokes, 0.0, arrives);
    return (away + comes_at * out) * Point(-std::cos(angle), std::sin(angle), 0);
}

TrialCollider hand_of(double room) {
    TrialCollider collider{common::smooth_collider(), {}};
    collider.shape.capsule.a[2] = -0.06f;
    collider.shape.capsule.b[2] = 0.06f;
    collider.shape.capsule.radius_a = collider.shape.capsule.radius_b = static_cast<float>(hand);
    collider.shape.friction = 0.3f;
    collider.pose = [room](double time) {
        const Point at = hand_at(time, room);
        plait_pose pose = pose_at(at.x());
        pose.t[1] = static_cast<float>(at.y());
        return pose;
    };
    return collider;
}

TrialCollider skull_at_origin() {
    TrialCollider collider{common::smooth_collider(), {}};
    collider.shape.capsule.radius_a = collider.shape.capsule.radius_b = static_cast<float>(skull);
    collider.shape.friction = 0.3f;
    collider.pose = [](double) { return pose_at(0); };
    return collider;
}

// Roots on the skull where the hand goes, hair that leaves it slantwise.
Trial stroked(const Subject& subject) {
    Trial trial = base_trial(subject);
    const std::vector<TrialStrand> shapes = std::move(trial.strands);
    trial.strands.clear();
    for (const double degrees : {-60.0, 0.0, 60.0})
        for (const TrialStrand& shape : shapes) {
            const double angle = degrees * pi / 180;
            const Point normal(std::sin(angle), std::cos(angle), 0);
            const Point aside(0.3 * std::cos(angle), -0.3 * std::sin(angle), 0.6);
            const auto turn = turn_between(Point::UnitX(), normal + aside);
            TrialStrand strand;
            for (const Point& x : shape.rest)
                strand.rest.push_back((skull + 1e-4) * normal + turn * (x - shape.rest[0]));
            strand.root = [](double) { return pose_at(0); };
            strand.root_speed = comes_at;
            strand.stir = 0;
            trial.strands.push_back(strand);
        }
    return trial;
}

void add_hands(Points& points) {
    points.push_back({"hand", "alone", [](const Subject& subject) {
                          Trial trial = stroked(subject);
                          trial.colliders = {hand_of(0.012)};
                          return trial;
                      }});
    for (const double room : {0.012, -0.008})
        points.push_back(
            {"hand on a head (mm of room)", axis_text(1e3 * room), [room](const Subject& subject) {
                 Trial trial = stroked(subject);
                 trial.colliders = {skull_at_origin(), hand_of(room)};
                 return trial;
             }});
}

} // namespace

plait_pose pose_at(double x) {
    return {{0, 0, 0, 1}, {static_cast<float>(x), 0, 0}};
}

std::string axis_text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", value);
    return buffer;
}

Trial base_trial(const Subject& subject, uint32_t segments) {
    const Place place{60, segments, subject.bends() ? 10 : limp};
    Trial trial = trial_of(subject, place);
    for (const auto& rest : {straight(even(segments)), curl(even(segments))})
        trial.strands.push_back(shaken(rest, usual, trial.shake, 1 / place.rate));
    return trial;
}

const std::vector<Shake>& shakes() {
    static const std::vector<Shake> all{
        {"0 g", 0, 0},       {"1 g", 1, 0},      {"10 g", 10, 0},     {"100 g", 100, 0},
        {"1000 g", 1000, 0}, {"jump 1 L", 0, 1}, {"jump 10 L", 0, 10}};
    return all;
}

Trial map_trial(const Subject& subject, const Place& place) {
    Trial trial = trial_of(subject, place);
    const auto lengths = even(place.segments);
    for (const auto& rest : {straight(lengths), curl(lengths)})
        for (const Shake& shake : shakes())
            trial.strands.push_back(shaken(rest, shake, trial.shake, 1 / place.rate));
    return trial;
}

std::vector<Outcome> try_place(const Subject& subject, const Place& place) {
    const auto each = run(subject.context, map_trial(subject, place));
    std::vector<Outcome> outcomes;
    for (size_t i = 0; i < shakes().size(); ++i)
        outcomes.push_back(worst(each[i], each[i + shakes().size()]));
    return outcomes;
}

bool in_envelope(const Place& place, const Shake& shake) {
    return place.rate >= 60 && place.segments <= 64 && place.gamma >= 1 && shake.g <= 10 &&
           shake.jump == 0;
}

std::vector<AxisPoint> axis_points() {
    Points points;
    add_substeps(points);
    add_offsets(points);
    add_drags(points);
    add_ratios(points);
    add_densities(points);
    add_twists(points);
    add_frames(points);
    add_colliders(points);
    add_hands(points);
    add_surfaces(points);
    add_pins(points);
    return points;
}

} // namespace lab::stability
