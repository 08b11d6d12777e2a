// Points spread evenly over a surface, and finding those near a place.
#pragma once

#include "vec.hpp"

#include <cstdint>
#include <vector>

namespace plait_generator {

// Points hashed by the cell of side `reach` they lie in.
class PointGrid {
  public:
    PointGrid(const std::vector<Vec3>& points, double reach);

    // function(index) for every point in the 27 cells around p: all within `reach` of p and some
    // beyond.
    template <typename Function> void for_each_near(Vec3 p, Function function) const {
        const Cell centre = cell(p);
        for (int64_t z = -1; z <= 1; ++z)
            for (int64_t y = -1; y <= 1; ++y)
                for (int64_t x = -1; x <= 1; ++x)
                    for_each_in({centre.x + x, centre.y + y, centre.z + z}, function);
    }

  private:
    struct Cell {
        int64_t x, y, z;
        bool operator==(const Cell&) const = default;
    };
    Cell cell(Vec3 p) const;
    size_t bucket(Cell cell) const;

    template <typename Function> void for_each_in(Cell wanted, Function function) const {
        const size_t b = bucket(wanted);
        for (uint32_t i = starts_[b]; i < starts_[b + 1]; ++i)
            if (cell(points_[members_[i]]) == wanted)
                function(members_[i]);
    }

    const std::vector<Vec3>& points_;
    double reach_;
    std::vector<uint32_t> starts_;  // [buckets + 1]
    std::vector<uint32_t> members_; // [points], bucket after bucket
};

// Indices, ascending, of `count` of the points, chosen to be far from one another on a surface of
// the given area (m^2): blue noise, in O(n log n).
std::vector<uint32_t> spread_out(const std::vector<Vec3>& points, size_t count, double area);

} // namespace plait_generator
