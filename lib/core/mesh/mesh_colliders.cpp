#include "core/mesh/mesh_colliders.hpp"

#include "core/base/pose.hpp"

#include <plait/params.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// Of a coordinate: what float32 loses of a distance on its way through two frames.
constexpr double rounding = 1e-6;
// m, less than half a hair's width: strands at rest tremble in float32 and are
// not to be rubbed by the mesh for it.
constexpr double trembling = 3e-5;

// From the world.
std::array<double, 3> to_own_frame(const plait_pose& pose, const float* world) {
    const Eigen::Quaterniond q(double(pose.q[3]), double(pose.q[0]), double(pose.q[1]),
                               double(pose.q[2]));
    Eigen::Vector3d x;
    for (size_t k = 0; k < 3; ++k)
        x[static_cast<Eigen::Index>(k)] = double(world[k]) - double(pose.t[k]);
    const Eigen::Vector3d own = q.conjugate() * x;
    return {own.x(), own.y(), own.z()};
}

Status put(Device& device, Buffer& to, plait_element element, const char* name, const auto& list,
           size_t per_element) {
    PLAIT_TRY(device.create(to, element, list.size() / per_element, name));
    return device.write(to, list.data());
}

Status make_buffers(Device& device, std::span<const MeshColliders::Entry> entries,
                    std::pmr::memory_resource* memory, MeshBuffers& to) {
    if (entries.empty())
        return {};
    std::pmr::vector<float> grid(memory), values(memory), clearance(memory);
    std::pmr::vector<uint32_t> nodes(memory);
    const size_t vertices = entries.front().clearance.size();
    clearance.resize(vertices * entries.size());
    for (size_t m = 0; m < entries.size(); ++m) {
        const MeshField& field = entries[m].field;
        grid.insert(grid.end(), field.origin.begin(), field.origin.end());
        grid.push_back(field.edge);
        nodes.insert(nodes.end(), field.nodes.begin(), field.nodes.end());
        nodes.push_back(static_cast<uint32_t>(values.size()));
        values.insert(values.end(), field.value.begin(), field.value.end());
        for (size_t i = 0; i < vertices; ++i)
            clearance[i * entries.size() + m] = entries[m].clearance[i];
    }
    PLAIT_TRY(put(device, to.grid, PLAIT_ELEMENT_FLOAT4, "mesh_grid", grid, 4));
    PLAIT_TRY(put(device, to.nodes, PLAIT_ELEMENT_UINT, "mesh_nodes", nodes, 1));
    PLAIT_TRY(put(device, to.values, PLAIT_ELEMENT_FLOAT, "mesh_values", values, 1));
    return put(device, to.clearance, PLAIT_ELEMENT_FLOAT, "mesh_clearance", clearance, 1);
}

} // namespace

Status MeshColliders::add(Device& device, Entry&& entry) {
    const auto after = std::ranges::upper_bound(entries_, entry.slot, {}, &Entry::slot);
    const auto place = entries_.insert(after, std::move(entry));
    MeshBuffers made;
    Status status = make_buffers(device, entries_, entries_.get_allocator().resource(), made);
    if (status)
        buffers_ = std::move(made);
    else
        entries_.erase(place);
    return status;
}

Status MeshColliders::remove(Device& device, uint32_t slot) {
    const auto place = std::ranges::find(entries_, slot, &Entry::slot);
    if (place == entries_.end())
        return {};
    Entry entry = std::move(*place);
    entries_.erase(place);
    MeshBuffers made;
    Status status = make_buffers(device, entries_, entries_.get_allocator().resource(), made);
    if (status)
        buffers_ = std::move(made);
    else
        entries_.insert(std::ranges::upper_bound(entries_, slot, {}, &Entry::slot),
                        std::move(entry));
    return status;
}

Status MeshColliders::assign(Device& device, Entries&& entries) {
    MeshBuffers made;
    PLAIT_TRY(make_buffers(device, entries, entries_.get_allocator().resource(), made));
    entries_ = std::move(entries);
    buffers_ = std::move(made);
    return {};
}

std::pmr::vector<float> measure_clearance(const ClearanceInput& input,
                                          std::pmr::memory_resource* memory) {
    std::pmr::vector<float> list(input.rest.size() / 4, input.margin, memory);
    if (!input.keeps_rest)
        return list;
    for (size_t i = 0; i < list.size(); ++i) {
        const float* root = input.roots.data() + i / input.row * PLAIT_POSE_STRIDE * 4;
        plait_pose pose{};
        std::copy_n(root, 4, pose.q);
        std::copy_n(root + 4, 3, pose.t);
        float world[3];
        transform(pose, input.rest.data() + 4 * i, world);
        const std::array<double, 3> own = to_own_frame(input.pose, world);
        double largest = 0;
        for (size_t k = 0; k < 3; ++k)
            largest = std::max({largest, std::abs(double(world[k])), std::abs(own[k])});
        const double distance = input.distance(own) - rounding * largest - trembling;
        list[i] = static_cast<float>(std::min(double(input.margin), distance));
    }
    return list;
}

void MeshColliders::fill(Schedule& schedule, const Part& part, const ColliderRows& rows,
                         Doors& doors) const {
    if (!buffers() || !part.plane)
        return;
    schedule.add(PLAIT_STAGE_mesh_field, part.lanes.strands, solve_params(part, doors, rows),
                 {&part.strand, &part.rest, &part.pose, &part.material, &rows.buffer,
                  &buffers_.grid, &buffers_.nodes, &buffers_.values, &buffers_.clearance,
                  &part.pushed(), &part.spring, &part.x, &part.v, &part.x_before, &part.v_before,
                  &part.plane},
                 part.lanes.row);
    doors.plane = true;
}

} // namespace plait
