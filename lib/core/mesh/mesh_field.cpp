#include "core/mesh/mesh_field.hpp"

#include "base/format.hpp"
#include "core/mesh/mesh_distance.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double least_band = 0.01; // m
constexpr double band_cells = 2;    // or so many edges

// Grid around a mesh, without values.
void lay_grid(const Mesh& mesh, const MeshFieldRules& rules, MeshField& field) {
    double longest = 0;
    for (size_t k = 0; k < 3; ++k)
        longest =
            std::max(longest, double(mesh.shape.bounds_max[k]) - double(mesh.shape.bounds_min[k]));
    // the longest side has `cells`, band and thickness on both ends among them
    const auto pad_of = [&](double edge) {
        return std::max(band_cells * edge, least_band) + (rules.two_sided ? edge : 0);
    };
    double edge = longest / rules.cells;
    for (int k = 0; k < 8; ++k) // pad_of() grows no faster than a fifth of this
        edge = (longest + 2 * pad_of(edge)) / rules.cells;
    field.edge = static_cast<float>(edge);
    edge = double(field.edge);
    const double pad = pad_of(edge);
    field.band = static_cast<float>(std::max(band_cells * edge, least_band));
    for (size_t k = 0; k < 3; ++k) {
        const double low = double(mesh.shape.bounds_min[k]),
                     high = double(mesh.shape.bounds_max[k]);
        const double cells = std::ceil((high - low + 2 * pad) / edge - 1e-6);
        field.nodes[k] = static_cast<uint32_t>(std::max(cells, 1.0)) + 1;
        field.origin[k] = static_cast<float>(0.5 * (low + high - cells * edge));
    }
}

// One row of nodes along x. From a node outside that is farther than the band no node on the row
// within the difference is nearer than it: they need no search.
void bake_row(const MeshDistance& distance, const MeshFieldRules& rules, size_t y, size_t z,
              MeshField& field) {
    const double band = double(field.band), edge = double(field.edge);
    float* const row = field.value.data() + (z * field.nodes[1] + y) * field.nodes[0];
    uint32_t hint = 0;
    for (size_t x = 0; x < field.nodes[0];) {
        const auto at = field.place(x, y, z);
        const MeshNearest nearest = distance.nearest({at[0], at[1], at[2]}, hint);
        const double value = rules.two_sided ? nearest.distance - edge : nearest.signed_distance();
        hint = nearest.triangle;
        row[x++] = static_cast<float>(value);
        for (double left = value - edge; left >= band && x < field.nodes[0]; left -= edge)
            row[x++] = static_cast<float>(left);
    }
}

} // namespace

Status check_sides(const Mesh& mesh) {
    const MeshShape& shape = mesh.shape;
    if (shape.open_edges > 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the mesh has %llu open edges, the first between the vertices %u and "
                            "%u: it has no inside; close it, or set two_sided",
                            static_cast<unsigned long long>(shape.open_edges), shape.first_open[0],
                            shape.first_open[1])};
    if (shape.unsided_edges > 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the mesh has %llu edges of more than two triangles or without sides, "
                            "the first between the vertices %u and %u; set two_sided",
                            static_cast<unsigned long long>(shape.unsided_edges),
                            shape.first_unsided[0], shape.first_unsided[1])};
    return {};
}

std::array<double, 3> MeshField::place(size_t x, size_t y, size_t z) const {
    const size_t index[3] = {x, y, z};
    std::array<double, 3> p{};
    for (size_t k = 0; k < 3; ++k)
        p[k] = double(origin[k]) + double(edge) * double(index[k]);
    return p;
}

Status bake_field(const Mesh& mesh, const MeshFieldRules& rules, MeshField& field) {
    if (!rules.two_sided)
        PLAIT_TRY(check_sides(mesh));
    lay_grid(mesh, rules, field);
    field.value.resize(field.count());
    const MeshDistance distance(mesh.surface, field.value.get_allocator().resource());
    for (size_t z = 0; z < field.nodes[2]; ++z)
        for (size_t y = 0; y < field.nodes[1]; ++y)
            bake_row(distance, rules, y, z, field);
    return {};
}

double sample_field(const MeshField& field, const std::array<double, 3>& x) {
    double share[3], outside = 0;
    size_t first[3];
    for (size_t k = 0; k < 3; ++k) {
        const double at = (x[k] - double(field.origin[k])) / double(field.edge);
        const double in = std::clamp(at, 0.0, double(field.nodes[k] - 1));
        outside += (at - in) * (at - in);
        first[k] = std::min(static_cast<size_t>(in), size_t{field.nodes[k]} - 2);
        share[k] = in - double(first[k]);
    }
    if (outside > 0)
        return double(field.band) + double(field.edge) * std::sqrt(outside);
    double sum = 0;
    for (size_t corner = 0; corner < 8; ++corner) {
        double weight = 1;
        size_t at[3];
        for (size_t k = 0; k < 3; ++k) {
            const size_t upper = corner >> k & 1;
            weight *= upper ? share[k] : 1 - share[k];
            at[k] = first[k] + upper;
        }
        sum +=
            weight * double(field.value[(at[2] * field.nodes[1] + at[1]) * field.nodes[0] + at[0]]);
    }
    return sum;
}

} // namespace plait
