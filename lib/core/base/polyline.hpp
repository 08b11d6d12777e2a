// Arc length along a strand of float[3] vertices. Lengths are summed in double.
#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>
#include <vector>

namespace plait {

using Point = std::array<float, 3>;
using Points = std::pmr::vector<Point>;

double distance(const Point& a, const Point& b);

// Fills `arc` with the arc length from the root at every vertex; returns the whole length, m.
double measure(const Points& strand, std::pmr::vector<double>& arc);

// The point at arc length `s` of a strand measured into `arc`.
Point point_at(const Points& strand, const std::pmr::vector<double>& arc, double s);

// `count` vertices at equal arc lengths; root and tip stay where they are.
void resample(Points& strand, size_t count, std::pmr::memory_resource* memory);

} // namespace plait
