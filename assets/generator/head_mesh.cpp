// The mannequin as triangles, denser where the face has detail.
#include "head_mesh.hpp"

#include "head_shape.hpp"
#include "surface_nets.hpp"

namespace plait_generator {
namespace {

// Planes from the first to the last stop, spaced by `spacing` at each stop and evenly graded
// between.
struct Stop {
    double at, spacing; // m
};

std::vector<double> planes(const std::vector<Stop>& stops, double scale) {
    std::vector<double> at{stops.front().at};
    for (size_t i = 0; at.back() < stops.back().at;) {
        while (at.back() >= stops[i + 1].at)
            ++i;
        const double t = (at.back() - stops[i].at) / (stops[i + 1].at - stops[i].at);
        at.push_back(at.back() + scale * mix(stops[i].spacing, stops[i + 1].spacing, t));
    }
    return at;
}

std::vector<double> mirrored(const std::vector<double>& right) {
    std::vector<double> both;
    for (size_t i = right.size(); i-- > 1;)
        both.push_back(-right[i]);
    both.insert(both.end(), right.begin(), right.end());
    return both;
}

// The grid fits the head and widens downwards to hold the shoulders.
Grid bust_grid(double scale) {
    const auto xs = mirrored(planes({{0, 0.0028}, {0.04, 0.0036}, {0.10, 0.0054}}, scale));
    const auto ys = planes({{-0.440, 0.013},
                            {-0.200, 0.012},
                            {-0.105, 0.0045},
                            {-0.080, 0.0030},
                            {0.010, 0.0026},
                            {0.050, 0.0062},
                            {0.150, 0.0075}},
                           scale);
    const auto zs =
        planes({{-0.13, 0.0075}, {0.00, 0.0070}, {0.06, 0.0046}, {0.14, 0.0030}}, scale);
    const auto place = [=](size_t i, size_t j, size_t k) {
        const double wide = 1 + 1.3 * smoothstep(-0.11, -0.26, ys[j]);
        const double deep = 1 + 0.3 * smoothstep(-0.11, -0.26, ys[j]);
        return Vec3{xs[i] * wide, ys[j], zs[k] * deep};
    };
    return {{xs.size(), ys.size(), zs.size()}, place};
}

void append(std::vector<float>& values, Vec3 v) {
    for (const double value : {v.x, v.y, v.z})
        values.push_back(static_cast<float>(value));
}

double spacing_of(unsigned detail) {
    return 2.6 / std::clamp(detail, 1u, 4u);
}

// Heights, m.
constexpr double head_begin = -0.125, neck_end = -0.105, neck_begin = -0.170, torso_end = -0.150;

// m: a point of a cell that the skin crosses is no farther from it.
constexpr double most_moved = 0.004;

// What of the mannequin lies where `beyond` is negative.
HeadMesh make_part(const std::function<double(Vec3)>& beyond, unsigned detail) {
    const Surface surface =
        surface_nets([&](Vec3 p) { return std::max(head_distance(p), beyond(p)); },
                     bust_grid(spacing_of(detail)));
    HeadMesh mesh;
    mesh.triangles = surface.triangles;
    for (const Vec3 point : surface.points) {
        const bool on_cut = std::abs(head_distance(point)) > most_moved;
        const Vec3 p = on_cut ? point : to_distance(point, 0);
        append(mesh.positions, beyond(p) < 0 ? p : point);
    }
    return mesh;
}

} // namespace

HeadMesh make_head(unsigned detail) {
    return make_head_of(spacing_of(detail));
}

HeadParts make_head_parts(unsigned detail) {
    return {make_part([](Vec3 p) { return head_begin - p.y; }, detail),
            make_part([](Vec3 p) { return std::max(neck_begin - p.y, p.y - neck_end); }, detail),
            make_part([](Vec3 p) { return p.y - torso_end; }, detail)};
}

HeadMesh make_head_of(double spacing) {
    const Surface surface =
        surface_nets([](Vec3 p) { return head_distance(p); }, bust_grid(spacing));
    HeadMesh mesh;
    mesh.triangles = surface.triangles;
    for (const Vec3 point : surface.points) {
        const Vec3 p = to_distance(point, 0);
        append(mesh.positions, p);
        append(mesh.normals, head_normal(p));
    }
    return mesh;
}

} // namespace plait_generator
