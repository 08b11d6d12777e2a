// What meshes of form NEAREST have on the device: made aside, as a set, when one comes or goes, and read back.
#include "core/mesh/bending_meshes.hpp"

#include "base/memory.hpp"
#include "core/mesh/mesh_edges.hpp"

#include <plait/params.h>

#include <algorithm>
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
    const auto& triangles = entry.surface->set.triangles;
    const auto order = entry.surface->tree.order();
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
    const auto& triangles = entry.surface->set.triangles;
    const auto order = entry.surface->tree.order();
    const size_t vertices = entry.surface->set.positions.size(), begin = to.ring.size();
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
                     here(to.ring.size()), entry.two_sided() ? 1u : 0u,
                     here(entry.surface->set.triangles.size())});
    for (const MeshTree::Node& node : entry.surface->tree.nodes())
        to.tree.insert(to.tree.end(), {node.first, node.number});
    for (const MeshTree::Under& under : entry.surface->tree.under())
        to.under.insert(to.under.end(), {under.first, under.triangles, under.nodes});
    add_triangles(entry, to);
    add_ring(entry, to);
    to.vertices += entry.surface->set.positions.size();
}

Status put(Device& device, Buffer& to, plait_element element, const char* name, const auto& list) {
    PLAIT_TRY(device.create(to, element, list.size(), name));
    return device.write(to, list.data());
}

std::pmr::vector<float> padded(std::span<const MeshPoint> points,
                               std::pmr::memory_resource* memory) {
    std::pmr::vector<float> rows(memory);
    rows.reserve(4 * points.size());
    for (const MeshPoint& p : points)
        rows.insert(rows.end(), {p[0], p[1], p[2], 0.0f});
    return rows;
}

Status write_points(Device& device, const Buffer& to, size_t first,
                    const std::pmr::vector<MeshPoint>& points) {
    const auto rows = padded(points, points.get_allocator().resource());
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

Result<std::shared_ptr<const SurfaceGeometry>>
make_geometry(Device& device, std::span<const BendingMeshes::Entry> entries,
              std::pmr::memory_resource* memory) {
    Fixed fixed(memory);
    const auto to = share_in<SurfaceGeometry>(memory, memory);
    for (const BendingMeshes::Entry& entry : entries) {
        add_fixed(entry, fixed);
        const size_t triangles = entry.two_sided() ? 0 : entry.surface->set.triangles.size();
        to->insides.push_back(static_cast<uint32_t>(triangles));
    }
    PLAIT_TRY(put(device, to->first, PLAIT_ELEMENT_UINT, "mesh_first", fixed.first));
    PLAIT_TRY(put(device, to->tree, PLAIT_ELEMENT_UINT, "mesh_tree", fixed.tree));
    PLAIT_TRY(put(device, to->under, PLAIT_ELEMENT_UINT, "mesh_under", fixed.under));
    PLAIT_TRY(put(device, to->triangle, PLAIT_ELEMENT_UINT, "mesh_triangle", fixed.triangle));
    PLAIT_TRY(put(device, to->ring, PLAIT_ELEMENT_UINT, "mesh_ring", fixed.ring));
    return std::shared_ptr<const SurfaceGeometry>(to);
}

// Of each vertex of the hair.
Status make_contact(Device& device, std::span<const BendingMeshes::Entry> entries,
                    std::pmr::memory_resource* memory, BendingBuffers& to) {
    using Entry = BendingMeshes::Entry;
    const size_t vertices = entries.front().clearance.size();
    std::pmr::vector<float> clearance(vertices * entries.size(), 0.0f, memory);
    for (size_t m = 0; m < entries.size(); ++m)
        for (size_t i = 0; i < vertices; ++i)
            clearance[i * entries.size() + m] = entries[m].clearance[i];
    PLAIT_TRY(put(device, to.clearance, PLAIT_ELEMENT_FLOAT, "mesh_clearance", clearance));
    const bool sheets = std::ranges::any_of(entries, &Entry::two_sided);
    std::pmr::vector<float> sides(sheets ? 4 * clearance.size() : 4, 0.0f, memory);
    for (size_t m = 0; m < entries.size(); ++m)
        for (size_t i = 0; i < entries[m].sides.size(); ++i)
            sides[(i / 4 * entries.size() + m) * 4 + i % 4] = entries[m].sides[i];
    PLAIT_TRY(device.create(to.side, PLAIT_ELEMENT_FLOAT4, sides.size() / 4, "mesh_side"));
    return device.write(to.side, sides.data());
}

// Where the call begins and ends.
Status make_aim(Device& device, BendingMeshes::Entry& entry, std::pmr::memory_resource* memory) {
    const auto at = share_in<Buffer>(memory), target = share_in<Buffer>(memory);
    PLAIT_TRY(device.create(*at, PLAIT_ELEMENT_FLOAT4, entry.vertices(), "mesh_at"));
    PLAIT_TRY(device.create(*target, PLAIT_ELEMENT_FLOAT4, entry.vertices(), "mesh_target"));
    PLAIT_TRY(write_points(device, *at, 0, entry.places.at));
    PLAIT_TRY(write_points(device, *target, 0, entry.places.target));
    entry.at = at;
    entry.target = target;
    return {};
}

Status make_paths(Device& device, std::span<BendingMeshes::Entry> entries,
                  std::pmr::memory_resource* memory, BendingBuffers& to) {
    size_t vertices = 0, first = 0;
    for (const BendingMeshes::Entry& entry : entries)
        vertices += entry.vertices();
    const size_t nodes = to.surfaces->tree.count() / 2;
    PLAIT_TRY(device.create(to.box, PLAIT_ELEMENT_FLOAT4, 2 * nodes, "mesh_box"));
    PLAIT_TRY(device.create(to.way, PLAIT_ELEMENT_FLOAT, nodes, "mesh_way"));
    PLAIT_TRY(device.create(to.from, PLAIT_ELEMENT_FLOAT4, vertices, "mesh_from"));
    PLAIT_TRY(device.create(to.to, PLAIT_ELEMENT_FLOAT4, vertices, "mesh_to"));
    PLAIT_TRY(device.create(to.bends, PLAIT_ELEMENT_FLOAT, entries.size(), "mesh_bends"));
    for (BendingMeshes::Entry& entry : entries) {
        PLAIT_TRY(write_points(device, to.from, first, entry.places.from));
        PLAIT_TRY(write_points(device, to.to, first, entry.places.to));
        first += entry.vertices();
        if (!entry.at)
            PLAIT_TRY(make_aim(device, entry, memory));
        entry.fitted = false;
        entry.places = BendingMeshes::Places(memory);
        entry.sides.clear();
    }
    return {};
}

} // namespace

BendingMeshes::Entry::Entry(uint32_t of, std::shared_ptr<const BendingSurface> given,
                            std::pmr::memory_resource* memory)
    : slot(of), surface(std::move(given)), clearance(memory), sides(memory), places(memory) {}

void BendingMeshes::Entry::begin() {
    for (auto* list : {&places.at, &places.target, &places.from, &places.to})
        if (list->empty())
            *list = surface->set.positions;
    aimed = places.target != places.at;
    there = places.to == places.at;
    still = places.from == places.to;
}

Result<BendingMeshes::Set> BendingMeshes::make(Device& device, Entries&& entries,
                                               const Set& like) const {
    std::pmr::memory_resource* const memory = set_.entries.get_allocator().resource();
    Set made(std::move(entries));
    if (made.entries.empty())
        return made;
    made.buffers.surfaces = like.buffers.surfaces;
    if (!std::ranges::equal(made.entries, like.entries, {}, &Entry::surface, &Entry::surface)) {
        auto geometry = make_geometry(device, made.entries, memory);
        if (!geometry)
            return geometry.error();
        made.buffers.surfaces = std::move(*geometry);
    }
    PLAIT_TRY(make_contact(device, made.entries, memory, made.buffers));
    PLAIT_TRY(make_paths(device, made.entries, memory, made.buffers));
    return made;
}

Result<BendingMeshes::Entries> BendingMeshes::without(Device& device, uint32_t slot) const {
    std::pmr::memory_resource* const memory = set_.entries.get_allocator().resource();
    Entries list(memory);
    for (size_t m = 0; m < set_.entries.size(); ++m) {
        const Entry& from = set_.entries[m];
        if (from.slot == slot)
            continue;
        auto places = read(device, m);
        if (!places)
            return places.error();
        auto sides = read_sides(device, m);
        if (!sides)
            return sides.error();
        Entry& entry = list.emplace_back(from.slot, from.surface, memory);
        entry.posed = from.posed;
        entry.rules = from.rules;
        entry.clearance = from.clearance;
        entry.sides = std::move(*sides);
        entry.places = std::move(*places);
        entry.at = from.at;
        entry.target = from.target;
        entry.at_scale = from.at_scale;
        entry.aimed = from.aimed;
        entry.there = from.there;
        entry.still = from.still;
        entry.poses = from.poses;
        entry.fits = from.fits;
        entry.part = from.part;
    }
    return list;
}

Result<BendingMeshes::Entries> BendingMeshes::with(Device& device, Entry&& entry) const {
    auto list = without(device, entry.slot);
    if (!list)
        return list;
    const auto after = std::ranges::upper_bound(*list, entry.slot, {}, &Entry::slot);
    list->insert(after, std::move(entry));
    return list;
}

Result<std::pmr::vector<float>> BendingMeshes::read_sides(Device& device, size_t index) const {
    std::pmr::vector<float> sides(set_.entries.get_allocator().resource());
    if (!set_.entries[index].two_sided())
        return sides;
    std::pmr::vector<float> all(4 * set_.buffers.side.count(), sides.get_allocator());
    PLAIT_TRY(device.read(set_.buffers.side, all.data()));
    sides.resize(all.size() / set_.entries.size());
    for (size_t i = 0; i < sides.size(); ++i)
        sides[i] = all[(i / 4 * set_.entries.size() + index) * 4 + i % 4];
    return sides;
}

Result<BendingMeshes::Places> BendingMeshes::read(Device& device, size_t index) const {
    const Entry& entry = set_.entries[index];
    Places places(set_.entries.get_allocator().resource());
    size_t first = 0;
    for (size_t m = 0; m < index; ++m)
        first += set_.entries[m].vertices();
    const size_t count = entry.vertices();
    PLAIT_TRY(read_points(device, *entry.at, 0, count, places.at));
    for (MeshPoint& point : places.at)
        for (float& x : point)
            x *= entry.at_scale;
    places.target = places.at;
    if (entry.aimed)
        PLAIT_TRY(read_points(device, *entry.target, 0, count, places.target));
    PLAIT_TRY(read_points(device, set_.buffers.from, first, count, places.from));
    PLAIT_TRY(read_points(device, set_.buffers.to, first, count, places.to));
    return places;
}

Result<BendingMeshes::Entry> BendingMeshes::for_other_hair(Device& device, size_t index,
                                                           float scale) const {
    const Entry& from = set_.entries[index];
    Entry entry(from.slot, from.surface, set_.entries.get_allocator().resource());
    entry.posed = from.posed;
    entry.rules = from.rules;
    entry.at_scale = from.aimed ? 1 / scale : from.at_scale;
    PLAIT_TRY(read_points(device, from.aimed ? *from.target : *from.at, 0, from.vertices(),
                          entry.places.at));
    entry.places.target = entry.places.from = entry.places.to = entry.places.at;
    entry.there = !from.posed;
    return entry;
}

} // namespace plait
