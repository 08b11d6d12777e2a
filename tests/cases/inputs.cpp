#include "inputs.hpp"

#include <algorithm>
#include <cmath>

namespace plait::cases {
namespace {

void put(std::vector<float>& to, const Point& p, double w) {
    for (double value : {p[0], p[1], p[2], w})
        to.push_back(static_cast<float>(value));
}

Point near(Random& random, const Point& p, double distance) {
    const Point d = random.direction();
    const double step = random.uniform(0, distance);
    return {p[0] + step * d[0], p[1] + step * d[1], p[2] + step * d[2]};
}

// A random walk: bends at every vertex, stays within a metre even with 256 of them.
std::vector<Point> rest_strand(Random& random, uint32_t count) {
    std::vector<Point> points = {
        {random.uniform(-.3, .3), random.uniform(-.3, .3), random.uniform(-.3, .3)}};
    Point d = random.direction();
    while (points.size() < count) {
        d = near(random, d, 0.9);
        const double length = std::hypot(d[0], d[1], d[2]);
        for (double& x : d)
            x /= length;
        const Point& p = points.back();
        const double s = segment_length * random.uniform(0.7, 1.3);
        points.push_back({p[0] + s * d[0], p[1] + s * d[1], p[2] + s * d[2]});
    }
    return points;
}

struct Placement {
    std::array<double, 4> q;
    Point t;

    Point apply(const Point& p) const {
        const Point r = rotate(q, p);
        return {r[0] + t[0], r[1] + t[1], r[2] + t[2]};
    }
    void store(std::vector<float>& pose) const {
        for (double value : q)
            pose.push_back(static_cast<float>(value));
        put(pose, t, 0);
    }
};

Placement random_placement(Random& random) {
    return {random.rotation(),
            {random.uniform(-.2, .2), random.uniform(-.2, .2), random.uniform(-.2, .2)}};
}

void add_row(Hair& hair, Random& random, const std::vector<Point>& rest, const Placement& pose) {
    const size_t count = rest.size();
    for (size_t i = 0; i < hair.size.stride; ++i) {
        if (i >= count) { // padding
            for (auto* row :
                 {&hair.rest, &hair.position, &hair.position_prev, &hair.position_prev2})
                for (int lane = 0; lane < 4; ++lane)
                    row->push_back((*row)[row->size() - 4]);
            hair.rest_length.push_back(0);
            continue;
        }
        const double w = i < 2 || random.below(16) == 0 ? 0 : random.uniform(0.5, 2);
        const Point position = near(random, pose.apply(rest[i]), 0.2 * segment_length);
        const Point previous = near(random, position, 0.4 * segment_length);
        put(hair.rest, rest[i], 0);
        put(hair.position, position, w);
        put(hair.position_prev, previous, w);
        put(hair.position_prev2, near(random, previous, 0.4 * segment_length), w);
        const bool last = i + 1 == count;
        hair.rest_length.push_back(
            last ? 0
                 : static_cast<float>(std::hypot(rest[i + 1][0] - rest[i][0],
                                                 rest[i + 1][1] - rest[i][1],
                                                 rest[i + 1][2] - rest[i][2])));
    }
}

} // namespace

std::array<double, 3> Random::direction() {
    const double z = uniform(-1, 1), angle = uniform(0, 6.283185307179586);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

std::array<double, 4> Random::rotation() {
    const auto axis = direction();
    const double half = uniform(0.3, 1.5);
    return {axis[0] * std::sin(half), axis[1] * std::sin(half), axis[2] * std::sin(half),
            std::cos(half)};
}

// p + 2 w (u x p) + 2 u x (u x p)
Point rotate(const std::array<double, 4>& q, const Point& p) {
    const auto cross = [](const Point& a, const Point& b) {
        return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0]};
    };
    const Point u = {q[0], q[1], q[2]};
    const Point c = cross(u, p), cc = cross(u, c);
    Point result = p;
    for (size_t k = 0; k < 3; ++k)
        result[k] += 2 * (q[3] * c[k] + cc[k]);
    return result;
}

const std::vector<Size>& sizes() {
    static const std::vector<Size> list = {{67, 16}, {1, 2},  {7, 3},   {67, 5},
                                           {7, 31},  {5, 64}, {3, 100}, {2, 256}};
    return list;
}

std::string name_of(const Size& size) {
    return std::to_string(size.strands) + " x " + std::to_string(size.stride);
}

const std::vector<std::string>& unread_of_colliders() {
    static const std::vector<std::string> list = {"collider.begin.a.radius"};
    return list;
}

std::vector<float> accelerations(const Size& size, double most) {
    Random random(size.strands * 31 + size.stride);
    std::vector<float> values;
    for (uint32_t i = 0; i < size.strands * size.stride; ++i) {
        const Point way = random.direction();
        const double strength = random.uniform(0.2, 1) * most;
        put(values, {strength * way[0], strength * way[1], strength * way[2]}, 0);
    }
    return values;
}

std::vector<float> pin_rows(const Size& size, uint32_t seed) {
    Random random(seed * 6151 + size.strands * 31 + size.stride);
    std::vector<float> values;
    for (uint32_t i = 0; i < size.strands * size.stride; ++i) {
        const Point at = random.direction();
        const double stiffness = random.uniform(0.05, 2);
        const uint32_t kind = (i + seed % 2) % 5; // of neighbours, and of the same one before
        put(values, at, kind == 0 ? 0 : kind < 3 ? stiffness : -stiffness);
    }
    return values;
}

Hair make_hair(const Size& size, uint32_t seed) {
    Random random(seed * 7919 + size.strands * 257 + size.stride);
    Hair hair;
    hair.size = size;
    for (uint32_t s = 0; s < size.strands; ++s) {
        const uint32_t shortest = std::min(size.stride, 2u);
        const uint32_t count =
            s % 3 == 1 ? shortest + random.below(size.stride - shortest + 1) : size.stride;
        hair.vertex_count.push_back(count);
        const Placement pose = random_placement(random);
        add_row(hair, random, rest_strand(random, count), pose);
        pose.store(hair.pose);
        random_placement(random).store(hair.pose_other);
    }
    return hair;
}

} // namespace plait::cases
