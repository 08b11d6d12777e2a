#include "surface_nets.hpp"

namespace plait_generator {
namespace {

constexpr uint32_t none = ~0u;

class Nets {
  public:
    Nets(const std::function<double(Vec3)>& distance, const Grid& grid)
        : size_(grid.corners), places_(size_[0] * size_[1] * size_[2]), values_(places_.size()),
          cells_(places_.size(), none) {
        for_each_corner([&](Corner c) {
            places_[index(c)] = grid.place(c[0], c[1], c[2]);
            values_[index(c)] = distance(place(c));
        });
    }

    Surface make() {
        for_each_corner([&](Corner c) { add_point(c); });
        for_each_corner([&](Corner c) {
            for (size_t axis = 0; axis < 3; ++axis)
                add_quad(c, axis);
        });
        return std::move(surface_);
    }

  private:
    using Corner = std::array<size_t, 3>;

    template <typename Function> void for_each_corner(Function function) const {
        for (size_t z = 0; z < size_[2]; ++z)
            for (size_t y = 0; y < size_[1]; ++y)
                for (size_t x = 0; x < size_[0]; ++x)
                    function(Corner{x, y, z});
    }

    size_t index(Corner c) const { return c[0] + size_[0] * (c[1] + size_[1] * c[2]); }
    Vec3 place(Corner c) const { return places_[index(c)]; }
    double value(Corner c) const { return values_[index(c)]; }
    bool last(Corner c, size_t axis) const { return c[axis] + 1 == size_[axis]; }

    // The cell whose lowest corner is c, if the surface crosses it.
    void add_point(Corner c) {
        if (last(c, 0) || last(c, 1) || last(c, 2))
            return;
        Vec3 sum;
        int crossings = 0;
        for (size_t axis = 0; axis < 3; ++axis)
            for (size_t side = 0; side < 4; ++side) {
                Corner from = c;
                from[(axis + 1) % 3] += side & 1;
                from[(axis + 2) % 3] += side >> 1;
                Corner to = from;
                ++to[axis];
                const double a = value(from), b = value(to);
                if ((a < 0) == (b < 0))
                    continue;
                sum += mix(place(from), place(to), a / (a - b));
                ++crossings;
            }
        if (crossings == 0)
            return;
        cells_[index(c)] = static_cast<uint32_t>(surface_.points.size());
        surface_.points.push_back(sum * (1.0 / crossings));
    }

    // The four cells around the edge from c along `axis`, if the surface crosses that edge.
    void add_quad(Corner c, size_t axis) {
        const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (last(c, axis) || last(c, u) || last(c, v) || c[u] == 0 || c[v] == 0)
            return;
        Corner next = c;
        ++next[axis];
        const bool leaving = value(c) < 0;
        if (leaving == (value(next) < 0))
            return;
        std::array<uint32_t, 4> quad;
        for (size_t i = 0; i < 4; ++i) {
            Corner cell = c;
            cell[u] -= i == 0 || i == 3;
            cell[v] -= i < 2;
            quad[i] = cells_[index(cell)];
        }
        if (!leaving)
            std::swap(quad[1], quad[3]);
        split(quad);
    }

    // Along the shorter diagonal, which keeps triangles well shaped.
    void split(const std::array<uint32_t, 4>& q) {
        const auto gap = [&](size_t i, size_t j) {
            return length(surface_.points[q[i]] - surface_.points[q[j]]);
        };
        const size_t s = gap(0, 2) <= gap(1, 3) ? 0 : 1;
        const auto corner = [&](size_t i) { return q[(s + i) % 4]; };
        surface_.triangles.insert(surface_.triangles.end(), {corner(0), corner(1), corner(2),
                                                             corner(0), corner(2), corner(3)});
    }

    Corner size_;
    std::vector<Vec3> places_;    // [corners]
    std::vector<double> values_;  // [corners]
    std::vector<uint32_t> cells_; // point of the cell above each corner, or none
    Surface surface_;
};

} // namespace

Surface surface_nets(const std::function<double(Vec3)>& distance, const Grid& grid) {
    return Nets(distance, grid).make();
}

} // namespace plait_generator
