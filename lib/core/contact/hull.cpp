#include "core/contact/hull.hpp"

#include "base/format.hpp"
#include "core/mesh/mesh_edges.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace plait {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double largest_half = 1e3; // m, as of a box
constexpr double unit_error = 1e-3;

struct Face {
    Vec3 normal;
    double distance; // m, from the origin of the mesh
};

class Maker {
  public:
    Maker(const Mesh& mesh, double tolerance) : mesh_(mesh) {
        const MeshShape& shape = mesh.shape;
        double square = 0;
        for (size_t k = 0; k < 3; ++k)
            square += std::pow(double(shape.bounds_max[k]) - double(shape.bounds_min[k]), 2);
        allowed_ = tolerance * std::sqrt(square);
        tolerance_ = tolerance;
    }

    Status check_closed() const {
        const MeshShape& shape = mesh_.shape;
        if (shape.open_edges > 0)
            return fault(format("has %llu open edges, the first between the vertices %u and %u: it "
                                "has no inside",
                                static_cast<unsigned long long>(shape.open_edges),
                                shape.first_open[0], shape.first_open[1]));
        if (shape.unsided_edges > 0)
            return fault(format("has %llu edges of more than two triangles or without sides, the "
                                "first between the vertices %u and %u",
                                static_cast<unsigned long long>(shape.unsided_edges),
                                shape.first_unsided[0], shape.first_unsided[1]));
        return {};
    }

    // Of the two heights of an edge's triangles above each other the lesser: that over the narrower one
    // is not known well.
    Status check_edges() const {
        const MeshEdges edges(mesh_.surface.triangles,
                              mesh_.surface.triangles.get_allocator().resource());
        double worst = allowed_;
        std::span<const MeshEdges::Side> at;
        for (size_t e = 0; e < edges.count(); ++e) {
            const auto sides = edges.edge(e);
            const double height =
                std::min(height_over(sides[0], sides[1]), height_over(sides[1], sides[0]));
            if (height > worst) {
                worst = height;
                at = sides;
            }
        }
        if (at.empty())
            return {};
        return fault(format("is not convex: at the edge between the vertices %u and %u the "
                            "triangles %u and %u rise %.3g m above each other, %.3g m are "
                            "allowed (tolerance %g of its size)",
                            at[0].low, at[0].high, at[0].triangle, at[1].triangle, worst, allowed_,
                            tolerance_));
    }

    // Planes of the triangles, the greatest first, but for those that lie in the plane of one before.
    Status find_faces() {
        const auto& triangles = mesh_.surface.triangles;
        std::pmr::vector<uint32_t> order(triangles.size(), triangles.get_allocator());
        std::pmr::vector<double> area(triangles.size(), triangles.get_allocator());
        std::iota(order.begin(), order.end(), 0u);
        for (uint32_t t = 0; t < triangles.size(); ++t)
            area[t] = normal_of(t).norm();
        std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) { return area[a] > area[b]; });
        for (const uint32_t t : order) {
            if (std::ranges::any_of(faces_, [&](const Face& face) { return lies_in(face, t); }))
                continue;
            if (faces_.size() == PLAIT_HULL_FACES_MAX)
                return fault(format("has more than %d faces, which is the most, at a tolerance of "
                                    "%g of its size; a greater one takes more triangles together",
                                    PLAIT_HULL_FACES_MAX, tolerance_));
            const Vec3 normal = normal_of(t).normalized();
            faces_.push_back({normal, normal.dot(corner(t, 0))});
            if (const auto above = farthest_above(faces_.back()); above.height > allowed_)
                return fault(format("is not convex: vertex %u is %.3g m above triangle %u, %.3g m "
                                    "are allowed (tolerance %g of its size)",
                                    above.vertex, above.height, t, allowed_, tolerance_));
        }
        return {};
    }

    // Every face as far out as what it belongs to.
    Status finish(Hull& hull) {
        Vec3 low, high;
        for (int k = 0; k < 3; ++k) {
            low[k] = double(mesh_.shape.bounds_min[static_cast<size_t>(k)]);
            high[k] = double(mesh_.shape.bounds_max[static_cast<size_t>(k)]);
        }
        const Vec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);
        if (half.maxCoeff() > largest_half)
            return fault(
                format("is %g m large, range is (0, %g] m", 2 * half.maxCoeff(), 2 * largest_half));
        hull.faces.clear();
        for (Face& face : faces_) {
            face.distance += std::max(farthest_above(face).height, 0.0);
            const double thick = face.distance + farthest_above({-face.normal, 0}).height;
            if (!(thick > 2 * allowed_))
                return fault(format("is flat: %.3g m thick, more than %.3g m are needed (twice its "
                                    "tolerance, %g of its size)",
                                    thick, 2 * allowed_, tolerance_));
            HullFace packed;
            for (size_t k = 0; k < 3; ++k)
                packed[k] = static_cast<float>(face.normal[static_cast<Eigen::Index>(k)]);
            packed[3] = static_cast<float>(face.distance - face.normal.dot(centre));
            hull.faces.push_back(packed);
        }
        for (size_t k = 0; k < 3; ++k) {
            hull.centre[k] = static_cast<float>(centre[static_cast<Eigen::Index>(k)]);
            hull.half_extents[k] = static_cast<float>(half[static_cast<Eigen::Index>(k)]);
        }
        return {};
    }

  private:
    struct Above {
        uint32_t vertex;
        double height;
    };

    static Error fault(const std::string& what) {
        return {PLAIT_INVALID_ARGUMENT, "the mesh " + what};
    }
    Vec3 place(uint32_t vertex) const {
        const MeshPoint& p = mesh_.surface.positions[vertex];
        return {double(p[0]), double(p[1]), double(p[2])};
    }
    Vec3 corner(uint32_t triangle, size_t k) const {
        return place(mesh_.surface.triangles[triangle][k]);
    }
    Vec3 normal_of(uint32_t t) const { // twice the area long
        return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
    }
    // m, of the corner of `side` that is not on the edge, over the plane of the other's triangle.
    double height_over(const MeshEdges::Side& side, const MeshEdges::Side& other) const {
        const Vec3 normal = normal_of(other.triangle).normalized();
        return normal.dot(corner(side.triangle, (side.corner + 2u) % 3) - place(side.low));
    }
    bool lies_in(const Face& face, uint32_t t) const {
        for (size_t k = 0; k < 3; ++k)
            if (std::abs(face.normal.dot(corner(t, k)) - face.distance) > allowed_)
                return false;
        return face.normal.dot(normal_of(t)) > 0;
    }
    // Vertices of no triangle are not read.
    Above farthest_above(const Face& face) const {
        Above most{0, -std::numeric_limits<double>::infinity()};
        for (const Triangle& triangle : mesh_.surface.triangles)
            for (const uint32_t vertex : triangle)
                if (const double height = face.normal.dot(place(vertex)) - face.distance;
                    height > most.height)
                    most = {vertex, height};
        return most;
    }

    const Mesh& mesh_;
    double allowed_, tolerance_; // m; of the size
    std::vector<Face> faces_;
};

// What is no face yet.
void add_box(Hull& hull) {
    for (size_t axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            HullFace face{};
            face[axis] = side;
            face[3] = hull.half_extents[axis];
            if (std::ranges::none_of(hull.faces, [&](const HullFace& f) {
                    return side * f[axis] > 1 - 1e-6f; // to float32's rounding
                }))
                hull.faces.push_back(face);
        }
}

} // namespace

Status make_hull(const Mesh& mesh, const HullRules& rules, Hull& hull) {
    Maker maker(mesh, rules.tolerance);
    PLAIT_TRY(maker.check_closed());
    PLAIT_TRY(maker.check_edges());
    PLAIT_TRY(maker.find_faces());
    PLAIT_TRY(maker.finish(hull));
    if (rules.margin)
        add_box(hull);
    return {};
}

Status check_hull_faces(std::span<const HullFace> faces) {
    constexpr size_t most = PLAIT_HULL_FACES_MAX + 6;
    if (faces.size() < 4 || faces.size() > most)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("%zu faces, range is [4, %zu]", faces.size(), most)};
    for (size_t i = 0; i < faces.size(); ++i) {
        const HullFace& f = faces[i];
        const double length = std::hypot(double(f[0]), double(f[1]), double(f[2]));
        if (!(std::abs(length - 1) <= unit_error))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("face %zu: its normal is %g long, not 1", i, length)};
        if (!(std::abs(double(f[3])) <= 2 * largest_half))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("face %zu: distance is %g, range is [-%g, %g] m", i, double(f[3]),
                                2 * largest_half, 2 * largest_half)};
    }
    return {};
}

} // namespace plait
