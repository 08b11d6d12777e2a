#include "core/roots/root_binding.hpp"

#include "base/format.hpp"
#include "core/mesh/mesh_distance.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr double far_off = 0.01; // m

using Vec3 = Eigen::Vector3d;

Vec3 vector_of(const MeshPoint& p) {
    return Vec3(double(p[0]), double(p[1]), double(p[2]));
}

plait_root_place place_of(const Mesh& mesh, const MeshNearest& nearest, const Vec3& root) {
    const Triangle& t = mesh.surface.triangles[nearest.triangle];
    const Vec3 a = vector_of(mesh.surface.positions[t[0]]);
    const Vec3 ab = vector_of(mesh.surface.positions[t[1]]) - a;
    const Vec3 ac = vector_of(mesh.surface.positions[t[2]]) - a;
    const Vec3 n = ab.cross(ac), own = nearest.point - a;
    const double v = own.cross(ac).dot(n) / n.squaredNorm();
    const double w = ab.cross(own).dot(n) / n.squaredNorm();
    return {nearest.triangle,
            {static_cast<float>(1 - v - w), static_cast<float>(v), static_cast<float>(w)},
            static_cast<float>((root - a).dot(n.normalized())),
            static_cast<float>(nearest.distance)};
}

std::pmr::vector<float> rows_of(std::span<const MeshPoint> points, float scale,
                                std::pmr::memory_resource* memory) {
    std::pmr::vector<float> rows(memory);
    rows.reserve(4 * points.size());
    for (const MeshPoint& p : points)
        rows.insert(rows.end(), {scale * p[0], scale * p[1], scale * p[2], 0.0f});
    return rows;
}

// Of those that `corners` names, the farthest by `distance`.
template <typename Distance>
uint32_t farthest(std::span<const uint32_t> corners, const Distance& distance) {
    return *std::ranges::max_element(corners, {}, distance);
}

// Two far apart, one far from their line, one far from the plane of the three.
std::array<uint32_t, 4> find_solid(std::span<const MeshPoint> points,
                                   std::span<const uint32_t> corners) {
    const auto at = [&](uint32_t vertex) { return vector_of(points[vertex]); };
    const uint32_t a = corners[0];
    const uint32_t b = farthest(corners, [&](uint32_t v) { return (at(v) - at(a)).norm(); });
    const Vec3 ab = at(b) - at(a);
    const uint32_t c =
        farthest(corners, [&](uint32_t v) { return ab.cross(at(v) - at(a)).norm(); });
    const Vec3 n = ab.cross(at(c) - at(a));
    const uint32_t d =
        farthest(corners, [&](uint32_t v) { return std::abs(n.dot(at(v) - at(a))); });
    constexpr double flat = 0.01;
    if (std::abs(n.dot(at(d) - at(a))) < flat * ab.norm() * ab.norm() * ab.norm())
        return {};
    return {a, b, c, d};
}

// Columns from the first to the others.
Eigen::Matrix3d edges_of(const std::array<MeshPoint, 4>& solid) {
    Eigen::Matrix3d edges;
    for (Eigen::Index i = 0; i < 3; ++i)
        edges.col(i) = vector_of(solid[static_cast<size_t>(i) + 1]) - vector_of(solid[0]);
    return edges;
}

} // namespace

Result<RootBinding> RootBinding::create(Device& device, const Mesh& mesh, const Layout& layout,
                                        std::span<const float> rest,
                                        std::span<plait_root_place> places,
                                        std::pmr::memory_resource* memory) {
    RootBinding binding;
    binding.memory_ = memory;
    binding.vertices_ = static_cast<uint32_t>(mesh.surface.positions.size());
    const MeshDistance distance(mesh.surface, memory);
    std::pmr::vector<uint32_t> corners(memory);
    uint32_t hint = 0;
    for (uint32_t root = 0; root < layout.guides; ++root) {
        const float* x = &rest[4 * size_t{root} * layout.row];
        const Vec3 at = vector_of({x[0], x[1], x[2]});
        const MeshNearest nearest = distance.nearest(at, hint);
        hint = nearest.triangle;
        const Triangle& triangle = mesh.surface.triangles[nearest.triangle];
        corners.insert(corners.end(), triangle.begin(), triangle.end());
        if (nearest.distance > far_off) {
            ++binding.far_;
            const float* tip = x + 4 * (size_t{layout.row} - 1); // rows past it are as it is
            const double of_tip =
                distance.nearest(vector_of({tip[0], tip[1], tip[2]}), hint).distance;
            binding.turned_ += of_tip < 0.5 * nearest.distance;
        }
        if (const auto off = static_cast<float>(nearest.distance); off > binding.farthest_) {
            binding.farthest_ = off;
            binding.farthest_root_ = root;
        }
        if (!places.empty())
            places[root] = place_of(mesh, nearest, at);
    }
    binding.solid_ = find_solid(mesh.surface.positions, corners);
    for (size_t i = 0; i < binding.solid_.size(); ++i)
        binding.solid_rest_[i] = mesh.surface.positions[binding.solid_[i]];
    const std::pmr::vector<float> rows = rows_of(mesh.surface.positions, 1, memory);
    PLAIT_TRY(device.create(binding.corner_, PLAIT_ELEMENT_UINT, corners.size(), "skin_corner"));
    PLAIT_TRY(device.create(binding.rest_, PLAIT_ELEMENT_FLOAT4, binding.vertices_, "skin_rest"));
    PLAIT_TRY(device.create(binding.at_, PLAIT_ELEMENT_FLOAT4, binding.vertices_, "skin_at"));
    PLAIT_TRY(device.write(binding.corner_, corners.data()));
    PLAIT_TRY(device.write(binding.rest_, rows.data()));
    PLAIT_TRY(device.write(binding.at_, rows.data()));
    return binding;
}

Status RootBinding::check_count(size_t positions) const {
    if (vertices_ == 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     "mesh_positions are given, but the roots are bound to no mesh"};
    if (positions != vertices_)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("mesh_positions.count is %zu, the mesh that the roots are bound to has "
                            "%u vertices",
                            positions, vertices_)};
    return {};
}

// Triangles tell nothing of mirrors, as each may have been turned over. Four points do, where they are to
// each other as they were: what bends does not turn them inside out and keep their distances.
Status RootBinding::check(std::span<const MeshPoint> positions) const {
    PLAIT_TRY(check_count(positions.size()));
    if (solid_[0] == solid_[1])
        return {};
    std::array<MeshPoint, 4> now;
    for (size_t i = 0; i < now.size(); ++i)
        now[i] = positions[solid_[i]];
    const Eigen::Matrix3d map = edges_of(now) * edges_of(solid_rest_).inverse();
    const double volume = map.determinant();
    const double square = std::pow(std::cbrt(volume), 2);
    constexpr double alike = 0.1; // of squares of lengths
    if (!(volume < 0) ||
        !((map.transpose() * map - square * Eigen::Matrix3d::Identity()).norm() < alike * square))
        return {};
    return Error{
        PLAIT_INVALID_ARGUMENT,
        format("mesh_positions mirror the mesh that the roots are bound to, by a "
               "determinant of %g; allowed is above 0. A mirrored character is a groom and "
               "a mesh that are mirrored when they are imported",
               volume)};
}

void RootBinding::append(Schedule& schedule, const Layout& layout, const State& state,
                         const Buffer& poses) const {
    if (vertices_ > 0)
        schedule.add(PLAIT_STAGE_skin_mesh, layout.guides, plait_layout_params{layout.row},
                     {&corner_, &rest_, &at_, &state.rest, &poses});
}

Status RootBinding::append(Device& device, Schedule& schedule, const Layout& layout,
                           const State& state, std::span<const MeshPoint> positions, float scale,
                           const Buffer& poses) const {
    PLAIT_TRY(device.upload(at_, rows_of(positions, 1 / scale, memory_).data()));
    append(schedule, layout, state, poses);
    return {};
}

Status RootBinding::take(Device& device, Schedule& schedule, const Layout& layout,
                         const State& state, const Taken& taken, const Buffer& poses) {
    if (!next_)
        PLAIT_TRY(device.create(next_, PLAIT_ELEMENT_FLOAT4, vertices_, "skin_at"));
    schedule.add(PLAIT_STAGE_mesh_take, vertices_,
                 plait_mesh_take_params{taken.words, 1 / taken.scale},
                 {&taken.floats, &at_, &next_});
    at_.swap(next_);
    append(schedule, layout, state, poses);
    return {};
}

} // namespace plait
