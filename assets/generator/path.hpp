// Polylines on their way to being strands.
#pragma once

#include "field.hpp"
#include "vec.hpp"

#include <vector>

namespace plait_generator {

using Path = std::vector<Vec3>; // root first, at least two points

double path_length(const Path& path);

// Direction of the path at its point i, from its neighbours.
Vec3 tangent(const Path& path, size_t i);

// `count` points, the first and last those of `path`, equally far apart along it. Each round then
// brings the straight segments between them closer to equal lengths.
Path resample(const Path& path, size_t count, int rounds = 0);

// Vectors perpendicular to the path, each carried from the one before without twist, starting near
// `first`.
std::vector<Vec3> untwisted_normals(const Path& path, Vec3 first);

struct Helix {
    double radius, pitch; // m
    double phase;         // turns
    double handedness;    // 1 right-handed, -1 left-handed
    double onset;         // m along the axis over which the radius grows from zero
};

// The helix around an axis whose points lie much closer than a turn.
Path wind(const Path& axis, const Helix& helix);

// The cubic through a and b that leaves a along a_way and reaches b along b_way; t in [0, 1].
Vec3 hermite(Vec3 a, Vec3 a_way, Vec3 b, Vec3 b_way, double t);

// Out of the head: point i to at least `clearance`, reached gradually over the first `onset`
// metres.
void push_out(Path& path, const Field& field, double clearance, double onset);

} // namespace plait_generator
