// Source: Ma, Bae & Choi 2012 (shrinking ball).
#include "core/mesh/mesh_balls.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

struct Corners {
    Vec3 a, b, c;

    Vec3 across() const { return (b - a).cross(c - a); }
};

Corners corners_of(const TriangleSet& surface, size_t triangle) {
    const auto at = [&](size_t k) -> Vec3 {
        const MeshPoint& p = surface.positions[surface.triangles[triangle][k]];
        return Vec3(double(p[0]), double(p[1]), double(p[2]));
    };
    return {at(0), at(1), at(2)};
}

// A ball behind the point shrinks until no other point is inside.
void measure_ball(Sample& own, const Samples& samples, double size) {
    own.radius = size;
    for (int i = 0; i < 30; ++i) {
        own.middle = own.x - own.radius * own.outward;
        const auto nearest = std::ranges::min_element(
            samples, {}, [&](const Sample& other) { return (other.x - own.middle).squaredNorm(); });
        const Vec3 way = own.x - nearest->x;
        const double depth = 2 * own.outward.dot(way);
        if ((nearest->x - own.middle).norm() >= own.radius * (1 - 1e-3) || depth <= 0)
            return;
        own.radius = way.squaredNorm() / depth;
    }
    own.middle = own.x - own.radius * own.outward;
}

} // namespace

// Where in a triangle: the R2 sequence of Roberts 2018, folded.
Samples spread(const TriangleSet& surface, size_t number, std::pmr::memory_resource* memory) {
    std::pmr::vector<double> area(memory); // of all triangles so far
    double sum = 0;
    for (size_t i = 0; i < surface.triangles.size(); ++i)
        area.push_back(sum += 0.5 * corners_of(surface, i).across().norm());
    Samples samples(memory);
    for (size_t i = 0; i < number; ++i) {
        const double at = (double(i) + 0.5) / double(number) * sum;
        const auto triangle = std::ranges::lower_bound(area, at) - area.begin();
        const Corners corners = corners_of(surface, static_cast<size_t>(triangle));
        double u = std::fmod(double(i + 1) * 0.7548776662466927, 1);
        double v = std::fmod(double(i + 1) * 0.5698402909980532, 1);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const Vec3 x = corners.a + u * (corners.b - corners.a) + v * (corners.c - corners.a);
        samples.push_back({x, corners.across().normalized(), x, 0});
    }
    return samples;
}

void measure_balls(Samples& samples, double size) {
    for (Sample& sample : samples)
        measure_ball(sample, samples, size);
}

} // namespace plait
