#include "core/mesh/bending_meshes.hpp"

#include "base/format.hpp"

#include <plait/params.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plait {
namespace {

// Triangles under the greatest nodes of one launch of mesh_refit, over those of the one before.
constexpr uint32_t fit_ratio = 32;

} // namespace

BendingMeshes::Entry& BendingMeshes::of(uint32_t slot) {
    return *std::ranges::find(set_.entries, slot, &Entry::slot);
}

uint64_t BendingMeshes::device_bytes() const {
    uint64_t sum = set_.entries.empty() ? 0 : set_.buffers.bytes();
    for (const Entry& entry : set_.entries)
        sum += entry.at->bytes() + entry.target->bytes();
    return sum;
}

bool BendingMeshes::has_sheets() const {
    return std::ranges::any_of(set_.entries, &Entry::two_sided);
}

// By vertex and mesh.
template <typename Forgets>
Status BendingMeshes::forget_where(Device& device, const Forgets& forgets) {
    std::pmr::vector<float> all(4 * set_.buffers.side.count(),
                                set_.entries.get_allocator().resource());
    PLAIT_TRY(device.read(set_.buffers.side, all.data()));
    for (size_t i = 0; i < set_.buffers.side.count(); ++i)
        if (forgets(i / set_.entries.size(), i % set_.entries.size()))
            std::fill_n(&all[4 * i], 4, 0.0f);
    return device.upload(set_.buffers.side, all.data());
}

Status BendingMeshes::forget_sides(Device& device, uint32_t slot) {
    const auto entry = std::ranges::find(set_.entries, slot, &Entry::slot);
    if (entry == set_.entries.end() || !entry->two_sided())
        return {};
    const auto index = static_cast<size_t>(entry - set_.entries.begin());
    return forget_where(device, [&](size_t, size_t mesh) { return mesh == index; });
}

Status BendingMeshes::forget_sides(Device& device, std::span<const unsigned char> moved) {
    if (!has_sheets())
        return {};
    return forget_where(device, [&](size_t vertex, size_t) { return moved[vertex] != 0; });
}

Status BendingMeshes::forget_sides(Device& device) {
    if (!has_sheets())
        return {};
    const std::pmr::vector<float> none(4 * set_.buffers.side.count(), 0.0f,
                                       set_.entries.get_allocator().resource());
    return device.upload(set_.buffers.side, none.data());
}

Status BendingMeshes::check_count(uint32_t slot, size_t count) const {
    const Entry& entry = *std::ranges::find(set_.entries, slot, &Entry::slot);
    if (count != entry.vertices())
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("positions.count is %zu, the mesh has %zu vertices", count, entry.vertices())};
    return {};
}

Result<std::pmr::vector<float>> BendingMeshes::rows_of(uint32_t slot,
                                                       std::span<const float> positions) const {
    PLAIT_TRY(check_count(slot, positions.size() / 3));
    for (size_t i = 0; i < positions.size(); ++i)
        if (!(std::abs(positions[i]) <= PLAIT_MESH_MOST_COORDINATE))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("positions[%zu]: coordinate is %g, range is [-1e6, 1e6] m", i / 3,
                                double(positions[i]))};
    std::pmr::vector<float> rows(positions.size() / 3 * 4, set_.entries.get_allocator().resource());
    for (size_t i = 0; i < positions.size(); ++i)
        rows[i / 3 * 4 + i % 3] = positions[i];
    return rows;
}

Status BendingMeshes::set_positions(Device& device, uint32_t slot, std::span<const float> rows) {
    Entry& entry = of(slot);
    PLAIT_TRY(device.upload(*entry.target, rows.data()));
    entry.posed = entry.aimed = true;
    return {};
}

void BendingMeshes::take_positions(Schedule& schedule, uint32_t slot, const Buffer& taken,
                                   uint32_t words) {
    Entry& entry = of(slot);
    schedule.add(PLAIT_STAGE_mesh_take, static_cast<uint32_t>(entry.vertices()),
                 plait_mesh_take_params{words, 1}, {&taken, entry.at.get(), entry.target.get()});
    entry.posed = entry.aimed = true;
}

void BendingMeshes::advance(double end) {
    for (Entry& entry : set_.entries) {
        entry.poses = entry.aimed || !entry.there || !entry.still;
        entry.fits = entry.poses || !entry.fitted;
        entry.part = entry.aimed ? static_cast<float>(end) : 1.0f;
        entry.still = entry.there && !entry.aimed;
        entry.there = !entry.aimed;
        entry.fitted = true;
    }
}

void BendingMeshes::append_pose(Schedule& schedule, const Entry& entry, size_t first, bool aimed,
                                float part) const {
    schedule.add(PLAIT_STAGE_mesh_advance, static_cast<uint32_t>(entry.vertices()),
                 plait_mesh_advance_params{static_cast<uint32_t>(first), part, entry.at_scale,
                                           aimed ? target_scale_ : entry.at_scale},
                 {entry.at.get(), aimed ? entry.target.get() : entry.at.get(), &set_.buffers.from,
                  &set_.buffers.to});
}

void BendingMeshes::take_target(Entry& entry) const {
    entry.at.swap(entry.target);
    entry.at_scale = target_scale_;
    entry.aimed = false;
}

void BendingMeshes::append_fit(Schedule& schedule, const Entry& entry, uint32_t mesh) const {
    const auto nodes = static_cast<uint32_t>(entry.surface->tree.nodes().size());
    const BendingBuffers& b = set_.buffers;
    const SurfaceGeometry& g = *b.surfaces;
    uint32_t least = 0, most = fit_ratio;
    for (;;) {
        schedule.add(PLAIT_STAGE_mesh_refit, nodes, plait_mesh_refit_params{mesh, least, most},
                     {&g.first, &g.under, &g.triangle, &b.from, &b.to, &b.way, &b.box, &b.bends});
        if (most >= entry.surface->set.triangles.size())
            return;
        least = most;
        most *= fit_ratio;
    }
}

void BendingMeshes::append(Schedule& schedule, bool all) const {
    size_t first = 0;
    for (size_t m = 0; m < set_.entries.size(); ++m) {
        const Entry& entry = set_.entries[m];
        if (entry.poses || all)
            append_pose(schedule, entry, first, entry.aimed, entry.part);
        if (entry.fits || all)
            append_fit(schedule, entry, static_cast<uint32_t>(m));
        first += entry.vertices();
    }
}

void BendingMeshes::arrive() {
    for (Entry& entry : set_.entries) {
        const bool arrived = std::exchange(entry.poses, false) && entry.part == 1.0f;
        if (!entry.aimed)
            continue;
        take_target(entry);
        entry.still = false;
        entry.there = arrived;
    }
}

void BendingMeshes::fit_new(Schedule& schedule) {
    for (size_t m = 0; m < set_.entries.size(); ++m)
        if (!std::exchange(set_.entries[m].fitted, true))
            append_fit(schedule, set_.entries[m], static_cast<uint32_t>(m));
}

void BendingMeshes::stop(Schedule& schedule) {
    size_t first = 0;
    for (size_t m = 0; m < set_.entries.size(); ++m) {
        Entry& entry = set_.entries[m];
        const bool rests = entry.there && entry.still;
        for (int end = 0; end < 2 && !rests; ++end) // of the path
            append_pose(schedule, entry, first, false, 1);
        if (!rests || !entry.fitted)
            append_fit(schedule, entry, static_cast<uint32_t>(m));
        entry.there = entry.still = entry.fitted = true;
        first += entry.vertices();
    }
}

void BendingMeshes::place(Schedule& schedule, uint32_t slot) {
    size_t first = 0;
    for (size_t m = 0; m < set_.entries.size(); first += set_.entries[m].vertices(), ++m) {
        Entry& entry = set_.entries[m];
        if (entry.slot != slot)
            continue;
        if (entry.aimed)
            take_target(entry);
        for (int end = 0; end < 2; ++end) // of the path
            append_pose(schedule, entry, first, false, 1);
        append_fit(schedule, entry, static_cast<uint32_t>(m));
        entry.there = entry.still = entry.fitted = true;
    }
}

void BendingMeshes::fill(Schedule& schedule, const Part& part, const ColliderRows& rows,
                         Doors& doors) const {
    if (!buffers() || !part.plane)
        return;
    const BendingBuffers& b = set_.buffers;
    const SurfaceGeometry& g = *b.surfaces;
    doors.hollow = bool(part.hollow);
    schedule.add(PLAIT_STAGE_mesh_nearest, part.lanes.strands, solve_params(part, doors, rows),
                 {&part.strand, &part.rest, &part.pose,  &part.material, &rows.buffer,
                  &g.first,     &b.box,     &g.tree,     &g.triangle,    &g.ring,
                  &b.from,      &b.to,      &b.bends,    &b.clearance,   &part.pushed(),
                  &part.spring, &part.x,    &part.v,     &part.x_before, &part.v_before,
                  &part.plane,  &b.side,    &part.hollow},
                 part.lanes.row);
    doors.plane = true;
}

} // namespace plait
