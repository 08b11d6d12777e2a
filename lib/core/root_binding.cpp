#include "core/root_binding.hpp"

#include "base/format.hpp"
#include "core/mesh_distance.hpp"

#include <Eigen/Geometry>

#include <algorithm>

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

std::pmr::vector<float> rows_of(std::span<const MeshPoint> points,
                                std::pmr::memory_resource* memory) {
    std::pmr::vector<float> rows(memory);
    rows.reserve(4 * points.size());
    for (const MeshPoint& p : points)
        rows.insert(rows.end(), {p[0], p[1], p[2], 0.0f});
    return rows;
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
    const std::pmr::vector<float> rows = rows_of(mesh.surface.positions, memory);
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

void RootBinding::append(Schedule& schedule, const Layout& layout, const State& state,
                         const Buffer& poses) const {
    if (vertices_ > 0)
        schedule.add(PLAIT_STAGE_skin_mesh, layout.guides, plait_layout_params{layout.row},
                     {&corner_, &rest_, &at_, &state.rest, &poses});
}

Status RootBinding::append(Device& device, Schedule& schedule, const Layout& layout,
                           const State& state, std::span<const MeshPoint> positions,
                           const Buffer& poses) const {
    PLAIT_TRY(device.upload(at_, rows_of(positions, memory_).data()));
    append(schedule, layout, state, poses);
    return {};
}

Status RootBinding::take(Device& device, Schedule& schedule, const Layout& layout,
                         const State& state, const Taken& taken, const Buffer& poses) {
    if (!next_)
        PLAIT_TRY(device.create(next_, PLAIT_ELEMENT_FLOAT4, vertices_, "skin_at"));
    schedule.add(PLAIT_STAGE_mesh_take, vertices_, plait_mesh_take_params{taken.words},
                 {&taken.floats, &at_, &next_});
    at_.swap(next_);
    append(schedule, layout, state, poses);
    return {};
}

} // namespace plait
