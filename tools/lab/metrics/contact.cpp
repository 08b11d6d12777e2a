// Metrics of strands on colliders.
#include "input.hpp"
#include "references/table.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

Value tip_travel(const MetricInput& in) {
    const double end = std::min(in.measure.to, in.recording.frames.back().time);
    const auto a = positions_at(in.recording, in.measure.strand, in.measure.from);
    const auto b = positions_at(in.recording, in.measure.strand, end);
    return {(b.back() - a.back()).norm() / in.length(), ""};
}

Value tip_speed(const MetricInput& in) {
    const double end = std::min(in.measure.to, in.recording.frames.back().time);
    return {tip_travel(in).value / (end - in.measure.from), ""};
}

// Of the tip along its way, over what was expected, less 1.
Value acceleration(const MetricInput& in) {
    std::vector<Vec3> tip;
    in.each([&](const Frame& frame) { tip.push_back(in.x(frame).back()); });
    if (tip.size() < 3 || !in.measure.expect || *in.measure.expect == 0)
        return none("needs three frames and what to expect");
    const size_t last = tip.size() - 1;
    const Vec3 gained = (tip[last] - tip[last - 1]) - (tip[1] - tip[0]); // m per frame
    const double rate = in.scene.rate, frames = static_cast<double>(last - 1);
    const double measured = gained.dot((tip[last] - tip[0]).normalized()) * rate * rate / frames;
    return {measured / *in.measure.expect - 1, ""};
}

namespace {

// How far the root had come, in lengths, when the tip first slid across its way faster than it
// comes, for a tenth of a second. One that never slides has come as far as the root comes at all.
struct Slip {
    double strain = 0;
    bool slipped = false;
};

Slip first_slip(const MetricInput& in) {
    const auto& frames = in.recording.frames;
    const auto window = static_cast<size_t>(std::lround(0.1 * in.scene.rate));
    const auto come = [&](const Frame& frame) {
        return (in.x(frame)[0] - in.x(frames[0])[0]).norm() / in.length();
    };
    for (size_t k = window; k < frames.size(); ++k) {
        if (!in.counts(frames[k]))
            continue;
        const Vec3 root = in.x(frames[k])[0] - in.x(frames[k - window])[0];
        const Vec3 tip = in.x(frames[k]).back() - in.x(frames[k - window]).back();
        const Vec3 way = root.normalized();
        if ((tip - way * way.dot(tip)).norm() >= root.norm())
            return {come(frames[k - window]), true};
    }
    return {come(frames.back()), false};
}

} // namespace

Value slip_travel(const MetricInput& in) {
    const Slip slip = first_slip(in);
    return slip.slipped ? Value{slip.strain, ""} : none("never slips");
}

// Over the table's, less 1. Of what never slips it is at least what is said.
Value slip_strain(const MetricInput& in) {
    if (!in.reference() || in.reference()->table.empty())
        return none("needs a reference table");
    const auto rows = select(*in.reference());
    if (rows.size() != 1)
        return none(std::to_string(rows.size()) + " rows of the table fit `where`, not one");
    const Slip slip = first_slip(in);
    const double over = slip.strain / rows[0].back() - 1;
    if (!slip.slipped && over <= 0)
        return none("never slips, but its root stops before it should");
    return {over, slip.slipped ? "" : "never slips: the number is where the root stops"};
}

namespace {

Vec3 end_of(const float* p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// Inside the hull of two spheres: depth below its surface, m.
double depth_in_capsule(const plait_collider_desc& shape, const Pose& pose, const Vec3& x) {
    const Vec3 a = pose * end_of(shape.capsule.a), b = pose * end_of(shape.capsule.b);
    const double ra = static_cast<double>(shape.capsule.radius_a),
                 rb = static_cast<double>(shape.capsule.radius_b);
    double deepest = -1e9;
    constexpr int samples = 200; // a cone's foot has a closed form; a fine search needs no cases
    for (int k = 0; k <= samples; ++k) {
        const double s = static_cast<double>(k) / samples;
        deepest = std::max(deepest, ra + s * (rb - ra) - (x - a - s * (b - a)).norm());
        if ((b - a).isZero())
            break;
    }
    return deepest;
}

// Of a rounded box: the nearest face's plane inside the box without its rounding.
double depth_in_box(const plait_collider_desc& shape, const Vec3& x) {
    const float* q = shape.box.orientation;
    const Eigen::Quaterniond turn{double(q[3]), double(q[0]), double(q[1]), double(q[2])};
    const Vec3 offset = turn.normalized().conjugate() * (x - end_of(shape.box.centre));
    const Vec3 beyond = offset.cwiseAbs() - end_of(shape.box.half_extents);
    const double most = beyond.maxCoeff();
    return double(shape.box.rounding) - (most > 0 ? beyond.cwiseMax(0).norm() : most);
}

double depth_in(const plait_collider_desc& shape, const Pose& pose, const Vec3& x) {
    const Vec3 own = pose.q.conjugate() * (x - pose.t);
    switch (shape.kind) {
    case PLAIT_COLLIDER_KIND_PLANE:
        return end_of(shape.plane.normal).normalized().dot(end_of(shape.plane.point) - own);
    case PLAIT_COLLIDER_KIND_BOX:
        return depth_in_box(shape, own);
    default:
        return depth_in_capsule(shape, pose, x);
    }
}

// How far its surface is from its middle where that is nearest, and its middle; of what hair can be
// behind.
double thickness(const plait_collider_desc& shape) {
    if (shape.kind == PLAIT_COLLIDER_KIND_BOX)
        return end_of(shape.box.half_extents).minCoeff() + double(shape.box.rounding);
    return double(shape.capsule.radius_a);
}

Vec3 middle_of(const plait_collider_desc& shape) {
    return shape.kind == PLAIT_COLLIDER_KIND_CAPSULE
               ? Vec3(0.5 * (end_of(shape.capsule.a) + end_of(shape.capsule.b)))
               : end_of(shape.box.centre);
}

// Deepest of the edges below the collider's surface, m.
double cut(const SceneCollider& collider, double time, const std::vector<Vec3>& x) {
    const Pose pose = collider.motion.at(time);
    constexpr int on_edge = 16;
    double worst = -1e9;
    for (size_t i = 1; i < x.size(); ++i)
        for (int k = 1; k <= on_edge; ++k)
            worst = std::max(
                worst, depth_in(collider.shape, pose, x[i - 1] + (x[i] - x[i - 1]) * k / on_edge));
    return worst;
}

} // namespace

Value penetration(const MetricInput& in) {
    if (in.scene.colliders.empty())
        return none("needs colliders");
    double worst = 0;
    in.each([&](const Frame& frame) {
        for (const SceneCollider& collider : in.scene.colliders) {
            const Pose pose = collider.motion.at(frame.time);
            for (size_t i = 1; i < in.x(frame).size(); ++i)
                worst = std::max(worst, depth_in(collider.shape, pose, in.x(frame)[i]));
        }
    });
    return {worst / in.length(), ""};
}

// Deepest vertex of any strand in any collider, m; the roots, which are where they are, aside.
Value depth(const MetricInput& in) {
    if (in.scene.colliders.empty())
        return none("needs colliders");
    double worst = 0;
    in.each([&](const Frame& frame) {
        for (const SceneCollider& collider : in.scene.colliders) {
            const Pose pose = collider.motion.at(frame.time);
            for (const auto& x : frame.x)
                for (size_t i = 1; i < x.size(); ++i)
                    worst = std::max(worst, depth_in(collider.shape, pose, x[i]));
        }
    });
    return {worst, ""};
}

// Share of the strands whose tip is not ahead of the collider that came upon them, or that cut it
// deeper than a quarter of its radius, when all is over. (On its way nobody can tell: in strides of
// several radii hair that slides around goes straight through from frame to frame, too.)
Value passed_through(const MetricInput& in) {
    if (in.scene.colliders.empty())
        return none("needs colliders");
    const SceneCollider& collider = in.scene.colliders.front();
    const Frame& last = in.recording.frames.back();
    if (collider.shape.kind == PLAIT_COLLIDER_KIND_PLANE)
        return none("needs a first collider that hair can be behind");
    const Pose from = collider.motion.at(0), to = collider.motion.at(last.time);
    const Vec3 centre = middle_of(collider.shape);
    const Vec3 way = to * centre - from * centre;
    if (way.isZero())
        return none("needs a collider that goes somewhere");
    const double radius = thickness(collider.shape);
    size_t passed = 0;
    for (const auto& x : last.x)
        passed +=
            (x.back() - to * centre).dot(way) <= 0 || cut(collider, last.time, x) > 0.25 * radius;
    return {static_cast<double>(passed) / static_cast<double>(last.x.size()), ""};
}

} // namespace lab
