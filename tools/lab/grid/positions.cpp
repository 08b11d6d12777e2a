#include "grid.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace lab::grid {

namespace {

// Three numbers, with commas or without; anything else is none.
bool read_point(std::string line, Vec3& point) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream stream(line);
    std::string rest;
    for (double& c : point)
        if (!(stream >> c) || !std::isfinite(c))
            return false;
    return !(stream >> rest);
}

} // namespace

std::vector<Vec3> read_positions(const std::string& file, uint32_t edge_count) {
    constexpr size_t most = 1000000;
    std::ifstream stream(file);
    if (!stream)
        throw Failure(file + ": cannot be opened");
    std::vector<Vec3> points;
    size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        const size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos || line[first] == '#')
            continue;
        Vec3 point;
        if (!read_point(line, point))
            throw Failure(file + ":" + std::to_string(number) + ": \"" + line.substr(0, 80) +
                          "\" is not x, y, z");
        points.push_back(point);
        if (points.size() > most)
            throw Failure(file + ":" + std::to_string(number) + ": has more than " +
                          std::to_string(most) + " points");
    }
    if (points.empty())
        throw Failure(file + ": has no points");
    Vec3 low = points[0], high = points[0];
    for (const Vec3& point : points) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    const double n = edge_count, edge = std::max((high - low).maxCoeff(), 1e-9) / n;
    for (Vec3& point : points)
        point = ((point - low) / edge).cwiseMax(1e-3).cwiseMin(n - 1e-3);
    return points;
}

} // namespace lab::grid
