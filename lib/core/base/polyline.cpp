#include "core/base/polyline.hpp"

#include <algorithm>
#include <cmath>

namespace plait {

double distance(const Point& a, const Point& b) {
    return std::hypot(double(b[0]) - a[0], double(b[1]) - a[1], double(b[2]) - a[2]);
}

double measure(const Points& strand, std::pmr::vector<double>& arc) {
    arc.assign(strand.size(), 0.0);
    for (size_t i = 1; i < strand.size(); ++i)
        arc[i] = arc[i - 1] + distance(strand[i - 1], strand[i]);
    return arc.back();
}

Point point_at(const Points& strand, const std::pmr::vector<double>& arc, double s) {
    const auto after = std::upper_bound(arc.begin(), arc.end(), s);
    if (after == arc.end())
        return strand.back();
    const size_t i = static_cast<size_t>(std::max<std::ptrdiff_t>(after - arc.begin(), 1)) - 1;
    const double share = std::clamp((s - arc[i]) / (arc[i + 1] - arc[i]), 0.0, 1.0);
    Point point;
    for (size_t axis = 0; axis < 3; ++axis)
        point[axis] = static_cast<float>(strand[i][axis] +
                                         share * (double(strand[i + 1][axis]) - strand[i][axis]));
    return point;
}

void resample(Points& strand, size_t count, std::pmr::memory_resource* memory) {
    std::pmr::vector<double> arc(memory);
    const double length = measure(strand, arc);
    Points result(memory);
    result.reserve(count);
    for (size_t i = 0; i + 1 < count; ++i)
        result.push_back(point_at(strand, arc, length * double(i) / double(count - 1)));
    result.push_back(strand.back());
    strand.swap(result);
}

} // namespace plait
