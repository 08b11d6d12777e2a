#include "core/mesh/mesh_colliders.hpp"

#include "base/memory.hpp"
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

Status make_geometry(Device& device, std::span<const MeshColliders::Entry> entries,
                     std::pmr::memory_resource* memory, FieldGeometry& to) {
    std::pmr::vector<float> grid(memory), values(memory);
    std::pmr::vector<uint32_t> nodes(memory);
    for (const MeshColliders::Entry& entry : entries) {
        const MeshField& field = *entry.field;
        grid.insert(grid.end(), field.origin.begin(), field.origin.end());
        grid.push_back(field.edge);
        nodes.insert(nodes.end(), field.nodes.begin(), field.nodes.end());
        nodes.push_back(static_cast<uint32_t>(values.size()));
        values.insert(values.end(), field.value.begin(), field.value.end());
    }
    PLAIT_TRY(put(device, to.grid, PLAIT_ELEMENT_FLOAT4, "mesh_grid", grid, 4));
    PLAIT_TRY(put(device, to.nodes, PLAIT_ELEMENT_UINT, "mesh_nodes", nodes, 1));
    return put(device, to.values, PLAIT_ELEMENT_FLOAT, "mesh_values", values, 1);
}

Status make_clearance(Device& device, std::span<const MeshColliders::Entry> entries,
                      std::pmr::memory_resource* memory, Buffer& to) {
    const size_t vertices = entries.front().clearance.size();
    std::pmr::vector<float> clearance(vertices * entries.size(), memory);
    for (size_t m = 0; m < entries.size(); ++m)
        for (size_t i = 0; i < vertices; ++i)
            clearance[i * entries.size() + m] = entries[m].clearance[i];
    return put(device, to, PLAIT_ELEMENT_FLOAT, "mesh_clearance", clearance, 1);
}

} // namespace

MeshColliders::Entries MeshColliders::without(uint32_t slot) const {
    Entries list(set_.entries.get_allocator());
    for (const Entry& entry : set_.entries)
        if (entry.slot != slot)
            list.push_back({entry.slot,
                            entry.field,
                            entry.rules,
                            {entry.clearance, list.get_allocator().resource()}});
    return list;
}

MeshColliders::Entries MeshColliders::with(Entry&& entry) const {
    Entries list = without(entry.slot);
    const auto after = std::ranges::upper_bound(list, entry.slot, {}, &Entry::slot);
    list.insert(after, std::move(entry));
    return list;
}

Result<MeshColliders::Set> MeshColliders::make(Device& device, Entries&& entries,
                                               const Set& like) const {
    Set made(std::move(entries));
    if (made.entries.empty())
        return made;
    std::pmr::memory_resource* const memory = set_.entries.get_allocator().resource();
    if (std::ranges::equal(made.entries, like.entries, {}, &Entry::field, &Entry::field)) {
        made.buffers.fields = like.buffers.fields;
    } else {
        const auto geometry = share_in<FieldGeometry>(memory);
        PLAIT_TRY(make_geometry(device, made.entries, memory, *geometry));
        made.buffers.fields = geometry;
    }
    PLAIT_TRY(make_clearance(device, made.entries, memory, made.buffers.clearance));
    return made;
}

std::pmr::vector<float> measure_clearance(const ClearanceInput& input,
                                          std::pmr::memory_resource* memory) {
    std::pmr::vector<float> list(input.rest.size() / 4, input.rules.margin, memory);
    if (input.rules.keeps_rest == 0)
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
        list[i] = static_cast<float>(std::min(double(input.rules.margin), distance));
    }
    return list;
}

void MeshColliders::fill(Schedule& schedule, const Part& part, const ColliderRows& rows,
                         Doors& doors) const {
    if (!buffers() || !part.plane)
        return;
    const FieldGeometry& g = *set_.buffers.fields;
    schedule.add(PLAIT_STAGE_mesh_field, part.lanes.strands, solve_params(part, doors, rows),
                 {&part.strand, &part.rest, &part.pose, &part.material, &rows.buffer, &g.grid,
                  &g.nodes, &g.values, &set_.buffers.clearance, &part.pushed(), &part.spring,
                  &part.x, &part.v, &part.x_before, &part.v_before, &part.plane},
                 part.lanes.row);
    doors.plane = true;
}

} // namespace plait
