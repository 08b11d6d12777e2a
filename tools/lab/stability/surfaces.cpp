// Axes of the stability sweep: boxes that tumble through hair, floors that rise over it, and hair
// pressed between the two.
#include "axes.hpp"
#include "common/collider_reader.hpp"

#include <algorithm>
#include <cmath>

namespace lab::stability {

namespace {

constexpr double middle = 0.5 * length; // of the strand, along x from its root

// About an axis that is none of the box's, so that faces, edges and corners meet the hair.
plait_pose turned(const Point& at, double angle) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Point(2, 1, 3).normalized()));
    plait_pose pose = pose_at(at.x());
    const double xyzw[] = {q.x(), q.y(), q.z(), q.w()};
    for (int c = 0; c < 4; ++c)
        pose.q[c] = static_cast<float>(xyzw[c]);
    pose.t[1] = static_cast<float>(at.y());
    pose.t[2] = static_cast<float>(at.z());
    return pose;
}

plait_collider_desc box_of(double half_extent, double rounding, double friction) {
    plait_collider_desc box = common::smooth_collider();
    box.kind = PLAIT_COLLIDER_KIND_BOX;
    for (float& half : box.box.half_extents)
        half = static_cast<float>(half_extent);
    box.box.rounding = static_cast<float>(rounding);
    box.friction = static_cast<float>(friction);
    return box;
}

// s: then all that moves has come to rest, and energy counts.
constexpr double moves_for = 2;

// How far what goes `most` m at `speed` has come.
double way_at(double time, double speed, double most) {
    return std::min(speed * std::min(time, moves_for), most);
}

// A cube of 8 cm rounded by 1 cm goes up through the middle of the strand, a turn every 20 cm, and
// stays beyond it; the slowest stays under it.
TrialCollider tumbling(double speed, double friction) {
    const double begins = -std::min(1.1, 0.05 + moves_for * speed);
    return {box_of(0.04, 0.01, friction), [speed, begins](double t) {
                const double way = way_at(t, speed, 2);
                return turned(Point(0.3 * length, begins + way, 0), 2 * pi * way / 0.2);
            }};
}

// A floor that rises to `height` above the roots, from up to half a metre under it, and leans by 20
// degrees.
TrialCollider floor_to(double height, double speed, double friction) {
    TrialCollider collider{common::smooth_collider(), {}};
    collider.shape.kind = PLAIT_COLLIDER_KIND_PLANE;
    const Point up(std::sin(pi / 9), std::cos(pi / 9), 0);
    for (int c = 0; c < 3; ++c)
        collider.shape.plane.normal[c] = static_cast<float>(up[c]);
    collider.shape.friction = static_cast<float>(friction);
    const double rise = std::min(0.5, moves_for * speed);
    collider.pose = [height, speed, rise](double t) {
        plait_pose pose = pose_at(0);
        pose.t[1] = static_cast<float>(height - rise + way_at(t, speed, rise));
        return pose;
    };
    return collider;
}

void add(Points& points, const char* axis, double value, const std::vector<TrialCollider>& with,
         double speed) {
    points.push_back({axis, axis_text(value), [with, speed](const Subject& subject) {
                          Trial trial = base_trial(subject);
                          trial.colliders = with;
                          for (TrialStrand& strand : trial.strands)
                              strand.root_speed += speed;
                          return trial;
                      }});
}

// A corner of the box goes faster than its centre: by 2 pi 0.08 / 0.2.
constexpr double corner = 3.5;

void add_boxes(Points& points) {
    for (const double speed : {0.1, 1.0, 10.0, 100.0})
        add(points, "box speed (m/s)", speed, {tumbling(speed, 0.5)}, corner * speed);
    for (const double friction : {0.0, 0.3, 1.0, 10.0})
        add(points, "friction of a box", friction, {tumbling(1, friction)}, corner);
}

// In a cube of 20 cm: the strand's middle at its face, ..., at its centre, ..., at the other.
void add_embedded(Points& points) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const double depth = 0.1 * (1 - 2 * share);
        const TrialCollider box{box_of(0.09, 0.01, 0.3),
                                [depth](double) { return turned(Point(middle, -depth, 0), 0.4); }};
        add(points, "start embedded in a box", share, {box}, 0.1 * 60); // out of it in a step
    }
}

void add_floors(Points& points) {
    for (const double speed : {0.1, 1.0, 10.0, 100.0})
        add(points, "floor that rises (m/s)", speed, {floor_to(-0.1, speed, 0.5)}, speed);
    // its roots are under it then
    for (const double height : {-0.05, 0.0, 0.05, 0.2})
        add(points, "floor over the roots (m)", height, {floor_to(height, 1, 0.5)}, 1);
}

// A box lowered onto hair that lies on a floor, mm of room between the two.
void add_presses(Points& points) {
    for (const double room : {10.0, 0.0, -10.0}) {
        const double ends = -0.1 + 0.05 + 1e-3 * room;
        TrialCollider ground = floor_to(-0.1, 1e3, 0.5);
        ground.shape.plane.normal[0] = 0;
        ground.shape.plane.normal[1] = 1;
        const TrialCollider press{box_of(0.04, 0.01, 0.5), [ends](double t) {
                                      return turned(Point(middle, std::max(0.3 - 0.5 * t, ends), 0),
                                                    0);
                                  }};
        add(points, "box on a floor (mm of room)", room, {ground, press}, 0.5);
    }
}

} // namespace

void add_surfaces(Points& points) {
    add_boxes(points);
    add_embedded(points);
    add_floors(points);
    add_presses(points);
}

} // namespace lab::stability
