#include "mesh/field_inputs.hpp"

#include <cmath>

namespace plait::cases {
namespace {

constexpr uint32_t nodes_along[3] = {13, 12, 11};
constexpr double cell = 0.013; // m

} // namespace

void FieldMeshes::add(Random& random) {
    const double radius = random.uniform(0.03, 0.05), bulge = random.uniform(0.002, 0.004);
    nodes.insert(nodes.end(), {nodes_along[0], nodes_along[1], nodes_along[2],
                               static_cast<uint32_t>(values.size())});
    const Point first = {-6.3 * cell, -5.4 * cell, -5.2 * cell};
    append_floats(grid, {first[0], first[1], first[2], cell});
    for (uint32_t z = 0; z < nodes_along[2]; ++z)
        for (uint32_t y = 0; y < nodes_along[1]; ++y)
            for (uint32_t x = 0; x < nodes_along[0]; ++x) {
                const Point p = {first[0] + cell * x, first[1] + cell * y, first[2] + cell * z};
                append_floats(values, {std::hypot(p[0], p[1], p[2]) - radius +
                                       bulge * std::sin(30 * p[0]) * std::cos(40 * p[1])});
            }
}

} // namespace plait::cases
