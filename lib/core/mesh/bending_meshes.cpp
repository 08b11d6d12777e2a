#include "core/mesh/bending_meshes.hpp"

#include "base/format.hpp"
#include "core/mesh/mesh_edges.hpp"

#include <plait/params.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plait {
namespace {

// What does not change while a mesh is there.
struct Fixed {
    explicit Fixed(std::pmr::memory_resource* memory)
        : first(memory), tree(memory), under(memory), triangle(memory), ring(memory) {}
    std::pmr::vector<uint32_t> first, tree, under, triangle, ring;
    size_t vertices = 0;
};

// Corners, and across which edge which triangle lies, by their numbers in the tree's order.
void add_triangles(const BendingMeshes::Entry& entry, Fixed& to) {
    auto* memory = to.triangle.get_allocator().resource();
    const auto& triangles = entry.surface.triangles;
    const auto order = entry.tree.order();
    std::pmr::vector<uint32_t> number(order.size(), 0u, memory);
    for (uint32_t i = 0; i < order.size(); ++i)
        number[order[i]] = i;
    const MeshEdges edges(triangles, memory);
    for (const uint32_t t : order) {
        to.triangle.insert(to.triangle.end(), triangles[t].begin(), triangles[t].end());
        for (size_t corner = 0; corner < 3; ++corner) {
            const auto sides = edges.edge(edges.edge_of(t, corner));
            to.triangle.push_back(sides.size() == 2 ? number[sides[sides[0].triangle == t].triangle]
                                                    : PLAIT_MESH_NO_TRIANGLE);
        }
    }
}

// Of each vertex the triangles around it.
void add_ring(const BendingMeshes::Entry& entry, Fixed& to) {
    const auto& triangles = entry.surface.triangles;
    const auto order = entry.tree.order();
    const size_t vertices = entry.surface.positions.size(), begin = to.ring.size();
    to.ring.resize(begin + vertices + 1 + 3 * triangles.size(), 0u);
    uint32_t* const first = &to.ring[begin];
    for (const Triangle& t : triangles)
        for (const uint32_t corner : t)
            ++first[corner];
    auto next = static_cast<uint32_t>(vertices + 1);
    for (size_t i = 0; i <= vertices; ++i)
        first[i] = next += std::exchange(first[i], 0u); // where the list of it ends
    for (size_t i = order.size(); i-- > 0;)
        for (const uint32_t corner : triangles[order[i]])
            first[--first[corner]] = static_cast<uint32_t>(i);
}

void add_fixed(const BendingMeshes::Entry& entry, Fixed& to) {
    const auto here = [](size_t size) { return static_cast<uint32_t>(size); };
    to.first.insert(to.first.end(),
                    {here(to.tree.size() / 2),
                     here(to.triangle.size() / PLAIT_MESH_TRIANGLE_STRIDE), here(to.vertices),
                     here(to.ring.size()), entry.two_sided ? 1u : 0u,
                     here(entry.surface.triangles.size())});
    for (const MeshTree::Node& node : entry.tree.nodes())
        to.tree.insert(to.tree.end(), {node.first, node.number});
    for (const MeshTree::Under& under : entry.tree.under())
        to.under.insert(to.under.end(), {under.first, under.triangles, under.nodes});
    add_triangles(entry, to);
    add_ring(entry, to);
    to.vertices += entry.surface.positions.size();
}

Status put(Device& device, Buffer& to, plait_element element, const char* name, const auto& list) {
    PLAIT_TRY(device.create(to, element, list.size(), name));
    return device.write(to, list.data());
}

std::pmr::vector<float> rows_of(std::span<const MeshPoint> points,
                                std::pmr::memory_resource* memory) {
    std::pmr::vector<float> rows(memory);
    rows.reserve(4 * points.size());
    for (const MeshPoint& p : points)
        rows.insert(rows.end(), {p[0], p[1], p[2], 0.0f});
    return rows;
}

Status write_points(Device& device, const Buffer& to, size_t first,
                    const std::pmr::vector<MeshPoint>& points) {
    const auto rows = rows_of(points, points.get_allocator().resource());
    return device.write(to, first, points.size(), rows.data());
}

Status read_points(Device& device, const Buffer& from, size_t first, size_t count,
                   std::pmr::vector<MeshPoint>& to) {
    std::pmr::vector<float> rows(4 * count, to.get_allocator().resource());
    PLAIT_TRY(device.read(from, first, count, rows.data()));
    to.resize(count);
    for (size_t i = 0; i < count; ++i)
        std::copy_n(&rows[4 * i], 3, to[i].begin());
    return {};
}

// Triangles under the greatest nodes of one launch of mesh_refit, over those of the one before.
constexpr uint32_t fit_ratio = 32;

} // namespace

BendingMeshes::Entry::Entry(uint32_t of, bool sheet, std::pmr::memory_resource* memory)
    : slot(of), two_sided(sheet), surface(memory), clearance(memory), tree(memory), sides(memory),
      places(memory) {}

void BendingMeshes::Entry::begin() {
    tree.build(surface);
    for (auto* list : {&places.at, &places.target, &places.from, &places.to})
        if (list->empty())
            *list = surface.positions;
    aimed = places.target != places.at;
    there = places.to == places.at;
    still = places.from == places.to;
}

BendingMeshes::Entry& BendingMeshes::of(uint32_t slot) {
    return *std::ranges::find(entries_, slot, &Entry::slot);
}

uint64_t BendingMeshes::device_bytes() const {
    uint64_t sum = entries_.empty() ? 0 : buffers_.bytes();
    for (const Entry& entry : entries_)
        sum += entry.at.bytes() + entry.target.bytes();
    return sum;
}

Status BendingMeshes::make(Device& device, std::span<Entry> entries, BendingBuffers& to) const {
    if (entries.empty())
        return {};
    std::pmr::memory_resource* memory = entries_.get_allocator().resource();
    Fixed fixed(memory);
    for (const Entry& entry : entries)
        add_fixed(entry, fixed);
    const size_t vertices = entries.front().clearance.size();
    std::pmr::vector<float> clearance(vertices * entries.size(), 0.0f, memory);
    for (size_t m = 0; m < entries.size(); ++m)
        for (size_t i = 0; i < vertices; ++i)
            clearance[i * entries.size() + m] = entries[m].clearance[i];
    PLAIT_TRY(put(device, to.first, PLAIT_ELEMENT_UINT, "mesh_first", fixed.first));
    PLAIT_TRY(put(device, to.tree, PLAIT_ELEMENT_UINT, "mesh_tree", fixed.tree));
    PLAIT_TRY(put(device, to.under, PLAIT_ELEMENT_UINT, "mesh_under", fixed.under));
    PLAIT_TRY(put(device, to.triangle, PLAIT_ELEMENT_UINT, "mesh_triangle", fixed.triangle));
    PLAIT_TRY(put(device, to.ring, PLAIT_ELEMENT_UINT, "mesh_ring", fixed.ring));
    PLAIT_TRY(put(device, to.clearance, PLAIT_ELEMENT_FLOAT, "mesh_clearance", clearance));
    const bool sheets = std::ranges::any_of(entries, &Entry::two_sided);
    std::pmr::vector<float> sides(sheets ? 4 * clearance.size() : 4, 0.0f, memory);
    for (size_t m = 0; m < entries.size(); ++m)
        for (size_t i = 0; i < entries[m].sides.size(); ++i)
            sides[(i / 4 * entries.size() + m) * 4 + i % 4] = entries[m].sides[i];
    PLAIT_TRY(device.create(to.side, PLAIT_ELEMENT_FLOAT4, sides.size() / 4, "mesh_side"));
    PLAIT_TRY(device.write(to.side, sides.data()));
    PLAIT_TRY(device.create(to.box, PLAIT_ELEMENT_FLOAT4, fixed.tree.size(), "mesh_box"));
    PLAIT_TRY(device.create(to.way, PLAIT_ELEMENT_FLOAT, fixed.tree.size() / 2, "mesh_way"));
    PLAIT_TRY(device.create(to.from, PLAIT_ELEMENT_FLOAT4, fixed.vertices, "mesh_from"));
    PLAIT_TRY(device.create(to.to, PLAIT_ELEMENT_FLOAT4, fixed.vertices, "mesh_to"));
    PLAIT_TRY(device.create(to.bends, PLAIT_ELEMENT_FLOAT, entries.size(), "mesh_bends"));
    size_t first = 0;
    for (Entry& entry : entries) {
        PLAIT_TRY(write_points(device, to.from, first, entry.places.from));
        PLAIT_TRY(write_points(device, to.to, first, entry.places.to));
        first += entry.vertices();
        if (entry.at)
            continue;
        Buffer at, target;
        PLAIT_TRY(device.create(at, PLAIT_ELEMENT_FLOAT4, entry.vertices(), "mesh_at"));
        PLAIT_TRY(device.create(target, PLAIT_ELEMENT_FLOAT4, entry.vertices(), "mesh_target"));
        PLAIT_TRY(write_points(device, at, 0, entry.places.at));
        PLAIT_TRY(write_points(device, target, 0, entry.places.target));
        entry.at = std::move(at);
        entry.target = std::move(target);
    }
    for (Entry& entry : entries) {
        const size_t triangles = entry.two_sided ? 0 : entry.surface.triangles.size();
        to.insides.push_back(static_cast<uint32_t>(triangles));
        entry.fitted = false;
        entry.places = Places(memory);
        entry.sides.clear();
    }
    return {};
}

// To the host, of all, where the step begins and ends.
Status BendingMeshes::pull(Device& device) {
    for (size_t m = 0; m < entries_.size(); ++m) {
        auto places = read(device, m);
        if (!places)
            return places.error();
        entries_[m].places = std::move(*places);
        auto sides = read_sides(device, m);
        if (!sides)
            return sides.error();
        entries_[m].sides = std::move(*sides);
    }
    return {};
}

bool BendingMeshes::has_sheets() const {
    return std::ranges::any_of(entries_, &Entry::two_sided);
}

Result<std::pmr::vector<float>> BendingMeshes::read_sides(Device& device, size_t index) const {
    std::pmr::vector<float> sides(entries_.get_allocator().resource());
    if (!entries_[index].two_sided)
        return sides;
    std::pmr::vector<float> all(4 * buffers_.side.count(), sides.get_allocator());
    PLAIT_TRY(device.read(buffers_.side, all.data()));
    sides.resize(all.size() / entries_.size());
    for (size_t i = 0; i < sides.size(); ++i)
        sides[i] = all[(i / 4 * entries_.size() + index) * 4 + i % 4];
    return sides;
}

// By vertex and mesh.
template <typename Forgets>
Status BendingMeshes::forget_where(Device& device, const Forgets& forgets) {
    std::pmr::vector<float> all(4 * buffers_.side.count(), entries_.get_allocator().resource());
    PLAIT_TRY(device.read(buffers_.side, all.data()));
    for (size_t i = 0; i < buffers_.side.count(); ++i)
        if (forgets(i / entries_.size(), i % entries_.size()))
            std::fill_n(&all[4 * i], 4, 0.0f);
    return device.upload(buffers_.side, all.data());
}

Status BendingMeshes::forget_sides(Device& device, uint32_t slot) {
    const auto entry = std::ranges::find(entries_, slot, &Entry::slot);
    if (entry == entries_.end() || !entry->two_sided)
        return {};
    const auto index = static_cast<size_t>(entry - entries_.begin());
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
    const std::pmr::vector<float> none(4 * buffers_.side.count(), 0.0f,
                                       entries_.get_allocator().resource());
    return device.upload(buffers_.side, none.data());
}

Result<BendingMeshes::Places> BendingMeshes::read(Device& device, size_t index) const {
    const Entry& entry = entries_[index];
    Places places(entries_.get_allocator().resource());
    size_t first = 0;
    for (size_t m = 0; m < index; ++m)
        first += entries_[m].vertices();
    const size_t count = entry.vertices();
    PLAIT_TRY(read_points(device, entry.at, 0, count, places.at));
    for (MeshPoint& point : places.at)
        for (float& x : point)
            x *= entry.at_scale;
    places.target = places.at;
    if (entry.aimed)
        PLAIT_TRY(read_points(device, entry.target, 0, count, places.target));
    PLAIT_TRY(read_points(device, buffers_.from, first, count, places.from));
    PLAIT_TRY(read_points(device, buffers_.to, first, count, places.to));
    return places;
}

Status BendingMeshes::add(Device& device, Entry&& entry) {
    PLAIT_TRY(pull(device));
    const auto after = std::ranges::upper_bound(entries_, entry.slot, {}, &Entry::slot);
    const auto place = entries_.insert(after, std::move(entry));
    BendingBuffers made(entries_.get_allocator().resource());
    Status status = make(device, entries_, made);
    if (status)
        buffers_ = std::move(made);
    else
        entries_.erase(place);
    return status;
}

Status BendingMeshes::remove(Device& device, uint32_t slot) {
    auto place = std::ranges::find(entries_, slot, &Entry::slot);
    if (place == entries_.end())
        return {};
    PLAIT_TRY(pull(device));
    Entry entry = std::move(*place);
    entries_.erase(place);
    BendingBuffers made(entries_.get_allocator().resource());
    Status status = make(device, entries_, made);
    if (status)
        buffers_ = std::move(made);
    else
        entries_.insert(std::ranges::upper_bound(entries_, slot, {}, &Entry::slot),
                        std::move(entry));
    return status;
}

Status BendingMeshes::assign(Device& device, Entries&& entries) {
    BendingBuffers made(entries_.get_allocator().resource());
    PLAIT_TRY(make(device, entries, made));
    entries_ = std::move(entries);
    buffers_ = std::move(made);
    return {};
}

Status BendingMeshes::check_count(uint32_t slot, size_t count) const {
    const Entry& entry = *std::ranges::find(entries_, slot, &Entry::slot);
    if (count != entry.vertices())
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("positions.count is %zu, the mesh has %zu vertices", count, entry.vertices())};
    return {};
}

Status BendingMeshes::set_positions(Device& device, uint32_t slot,
                                    std::span<const float> positions) {
    Entry& entry = of(slot);
    PLAIT_TRY(check_count(slot, positions.size() / 3));
    for (size_t i = 0; i < positions.size(); ++i)
        if (!(std::abs(positions[i]) <= PLAIT_MESH_MOST_COORDINATE))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("positions[%zu]: coordinate is %g, range is [-1e6, 1e6] m", i / 3,
                                double(positions[i]))};
    std::pmr::vector<float> rows(4 * entry.vertices(), entries_.get_allocator().resource());
    for (size_t i = 0; i < positions.size(); ++i)
        rows[i / 3 * 4 + i % 3] = positions[i];
    PLAIT_TRY(device.upload(entry.target, rows.data()));
    entry.posed = entry.aimed = true;
    return {};
}

void BendingMeshes::take_positions(Schedule& schedule, uint32_t slot, const Buffer& taken,
                                   uint32_t words) {
    Entry& entry = of(slot);
    schedule.add(PLAIT_STAGE_mesh_take, static_cast<uint32_t>(entry.vertices()),
                 plait_mesh_take_params{words, 1}, {&taken, &entry.at, &entry.target});
    entry.posed = entry.aimed = true;
}

void BendingMeshes::advance(double end) {
    for (Entry& entry : entries_) {
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
                 {&entry.at, aimed ? &entry.target : &entry.at, &buffers_.from, &buffers_.to});
}

void BendingMeshes::take_target(Entry& entry) const {
    entry.at.swap(entry.target);
    entry.at_scale = target_scale_;
    entry.aimed = false;
}

void BendingMeshes::append_fit(Schedule& schedule, const Entry& entry, uint32_t mesh) const {
    const auto nodes = static_cast<uint32_t>(entry.tree.nodes().size());
    const BendingBuffers& b = buffers_;
    uint32_t least = 0, most = fit_ratio;
    for (;;) {
        schedule.add(PLAIT_STAGE_mesh_refit, nodes, plait_mesh_refit_params{mesh, least, most},
                     {&b.first, &b.under, &b.triangle, &b.from, &b.to, &b.way, &b.box, &b.bends});
        if (most >= entry.surface.triangles.size())
            return;
        least = most;
        most *= fit_ratio;
    }
}

void BendingMeshes::append(Schedule& schedule, bool all) const {
    size_t first = 0;
    for (size_t m = 0; m < entries_.size(); ++m) {
        const Entry& entry = entries_[m];
        if (entry.poses || all)
            append_pose(schedule, entry, first, entry.aimed, entry.part);
        if (entry.fits || all)
            append_fit(schedule, entry, static_cast<uint32_t>(m));
        first += entry.vertices();
    }
}

void BendingMeshes::arrive() {
    for (Entry& entry : entries_) {
        const bool arrived = std::exchange(entry.poses, false) && entry.part == 1.0f;
        if (!entry.aimed)
            continue;
        take_target(entry);
        entry.still = false;
        entry.there = arrived;
    }
}

void BendingMeshes::fit_new(Schedule& schedule) {
    for (size_t m = 0; m < entries_.size(); ++m)
        if (!std::exchange(entries_[m].fitted, true))
            append_fit(schedule, entries_[m], static_cast<uint32_t>(m));
}

void BendingMeshes::stop(Schedule& schedule) {
    size_t first = 0;
    for (size_t m = 0; m < entries_.size(); ++m) {
        Entry& entry = entries_[m];
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
    for (size_t m = 0; m < entries_.size(); first += entries_[m].vertices(), ++m) {
        Entry& entry = entries_[m];
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
    const BendingBuffers& b = buffers_;
    schedule.add(PLAIT_STAGE_mesh_nearest, part.lanes.strands, solve_params(part, doors, rows),
                 {&part.strand, &part.rest, &part.pose, &part.material, &rows.buffer,
                  &b.first,     &b.box,     &b.tree,    &b.triangle,    &b.ring,
                  &b.from,      &b.to,      &b.bends,   &b.clearance,   &part.pushed(),
                  &part.spring, &part.x,    &part.v,    &part.x_before, &part.v_before,
                  &part.plane,  &b.side},
                 part.lanes.row);
    doors.plane = true;
}

} // namespace plait
