#include "input.hpp"
#include "references/statics.hpp"
#include "references/table.hpp"

#include <cmath>

namespace lab {

namespace {

// The strand's own vertical plane, where it has one: the rest shape in it, and how to get there.

struct Plane {
    Vec3 along, up;
    PlaneRod rod;
};

double plane_angle(const Plane& plane, const Vec3& v) {
    return std::atan2(v.dot(plane.up), v.dot(plane.along));
}

std::string plane_of(const MetricInput& in, Plane& plane) {
    const Material& m = in.scene.material;
    if (!(in.scene.bend_stiffness(in.strand()) > 0) || m.tip_stiffness != 1)
        return "the float64 equilibrium is of strands of one bend stiffness > 0";
    if (!in.scene.motion.still() || !in.scene.colliders.empty())
        return "the float64 equilibrium is of strands that hang freely from a still root";
    const auto& rest = in.recording.rest[in.measure.strand];
    plane.up = -in.down();
    Vec3 along = rest[1] - rest[0];
    along -= plane.up * along.dot(plane.up);
    if (along.norm() < 1e-6 * in.length())
        along = rest.back() - rest.front() - plane.up * (rest.back() - rest.front()).dot(plane.up);
    if (along.norm() < 1e-6 * in.length())
        along = plane.up.unitOrthogonal();
    plane.along = along.normalized();
    const Vec3 normal = plane.along.cross(plane.up);
    for (const Vec3& x : rest)
        if (std::abs((x - rest[0]).dot(normal)) > 1e-4 * in.length())
            return "the float64 equilibrium is of strands in a vertical plane";
    plane.rod = {in.strand().segment_lengths(),
                 plane_angle(plane, rest[1] - rest[0]),
                 0,
                 in.scene.bend_stiffness(in.strand()),
                 stretch_stiffness(in.scene, in.length()),
                 m.line_density,
                 in.scene.gravity.norm(),
                 JointLaw::cosserat};
    if (in.strand().curvature != 0 && rest.size() > 2) {
        const double turn = std::remainder(
            plane_angle(plane, rest[2] - rest[1]) - plane_angle(plane, rest[1] - rest[0]), 2 * pi);
        plane.rod.curvature = std::copysign(in.strand().curvature, turn);
    }
    return in.strand().points.empty() ? "" : "the float64 equilibrium is not of given points";
}

// How far the best N segments can be from the continuum: no solver is asked to be nearer.

} // namespace

Value tip_error(const MetricInput& in) {
    if (!in.reference() || in.reference()->table.empty())
        return none("needs a reference table");
    const auto rows = select(*in.reference());
    if (rows.size() != 1)
        return none(std::to_string(rows.size()) + " rows of the table fit `where`, not one");
    const Vec3 tip = in.last().back() - in.last().front();
    return {(tip - point_of(*in.reference(), rows[0])).norm() / in.length(), ""};
}

Value static_error(const MetricInput& in) {
    Plane plane;
    if (const std::string why = plane_of(in, plane); !why.empty())
        return none(why);
    const auto shape = hanging_shape(plane.rod);
    if (shape.empty())
        return none("the float64 equilibrium does not converge");
    double sum = 0;
    for (size_t i = 1; i < shape.size(); ++i) {
        const Vec3 expected = shape[i].x() * plane.along + shape[i].y() * plane.up;
        sum += (in.last()[i] - in.last()[0] - expected).squaredNorm();
    }
    return {std::sqrt(sum / static_cast<double>(shape.size() - 1)) / in.length(), ""};
}

Value static_tip_error(const MetricInput& in) {
    Plane plane;
    if (const std::string why = plane_of(in, plane); !why.empty())
        return none(why);
    plane.rod.clamp -= 0.5 * plane.rod.curvature * plane.rod.lengths[0]; // of the tangent
    const Eigen::Vector2d tip = elastica_tip(plane.rod);
    const Vec3 expected = tip.x() * plane.along + tip.y() * plane.up;
    return {(in.last().back() - in.last().front() - expected).norm() / in.length(), ""};
}

Value static_floor(const MetricInput& in) {
    Plane plane;
    if (const std::string why = plane_of(in, plane); !why.empty())
        return none(why);
    PlaneRod best = plane.rod;
    best.law = JointLaw::angle;
    best.stretch_stiffness = 0;
    const auto shape = hanging_shape(best);
    plane.rod.clamp -= 0.5 * plane.rod.curvature * plane.rod.lengths[0];
    if (shape.empty())
        return none("the float64 equilibrium does not converge");
    return {(shape.back() - elastica_tip(plane.rod)).norm() / in.length(), ""};
}

Value static_tip_over_floor(const MetricInput& in) {
    const Value tip = static_tip_error(in), floor = static_floor(in);
    return std::isnan(floor.value) ? floor : Value{tip.value / floor.value, tip.note};
}

} // namespace lab
