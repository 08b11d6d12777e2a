#include "core/bending_meshes.hpp"

#include "base/format.hpp"
#include "core/mesh_edges.hpp"

#include <plait/params.h>

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr float largest = 1e6f; // m

// What does not change while a mesh is there.
struct Fixed {
    explicit Fixed(std::pmr::memory_resource* memory)
        : first(memory), tree(memory), triangle(memory), ring(memory) {}
    std::pmr::vector<uint32_t> first, tree, triangle, ring;
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
    add_triangles(entry, to);
    add_ring(entry, to);
    to.vertices += entry.surface.positions.size();
}

Status put(Device& device, Buffer& to, plait_element element, const char* name, const auto& list) {
    PLAIT_TRY(device.create(to, element, list.size(), name));
    return device.write(to, list.data());
}

void append(std::pmr::vector<float>& to, std::span<const MeshPoint> points) {
    for (const MeshPoint& p : points)
        to.insert(to.end(), {p[0], p[1], p[2], 0.0f});
}

MeshPoint between(const MeshPoint& a, const MeshPoint& b, double share) {
    MeshPoint p = b;
    for (size_t k = 0; k < 3 && share < 1; ++k)
        p[k] = static_cast<float>(double(a[k]) + share * (double(b[k]) - double(a[k])));
    return p;
}

float farthest_way(const BendingMeshes::Entry& entry) {
    double most = 0;
    for (size_t i = 0; i < entry.from.size(); ++i) {
        double square = 0;
        for (size_t k = 0; k < 3; ++k)
            square += std::pow(double(entry.to[i][k]) - double(entry.from[i][k]), 2);
        most = std::max(most, square);
    }
    return static_cast<float>(std::sqrt(most) * (1 + 1e-6));
}

} // namespace

BendingMeshes::Entry::Entry(uint32_t of, bool sheet, std::pmr::memory_resource* memory)
    : slot(of), two_sided(sheet), surface(memory), clearance(memory), at(memory), target(memory),
      from(memory), to(memory), tree(memory) {}

void BendingMeshes::Entry::begin() {
    at = target = from = to = surface.positions;
    tree.build(surface);
}

Status BendingMeshes::make(Device& device, std::span<const Entry> entries,
                           BendingBuffers& to) const {
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
    PLAIT_TRY(put(device, to.triangle, PLAIT_ELEMENT_UINT, "mesh_triangle", fixed.triangle));
    PLAIT_TRY(put(device, to.ring, PLAIT_ELEMENT_UINT, "mesh_ring", fixed.ring));
    PLAIT_TRY(put(device, to.clearance, PLAIT_ELEMENT_FLOAT, "mesh_clearance", clearance));
    PLAIT_TRY(device.create(to.box, PLAIT_ELEMENT_FLOAT4, fixed.tree.size(), "mesh_box"));
    PLAIT_TRY(device.create(to.from, PLAIT_ELEMENT_FLOAT4, fixed.vertices, "mesh_from"));
    PLAIT_TRY(device.create(to.to, PLAIT_ELEMENT_FLOAT4, fixed.vertices, "mesh_to"));
    return device.create(to.bends, PLAIT_ELEMENT_FLOAT, entries.size(), "mesh_bends");
}

Status BendingMeshes::add(Device& device, Entry&& entry) {
    const auto after = std::ranges::upper_bound(entries_, entry.slot, {}, &Entry::slot);
    const auto place = entries_.insert(after, std::move(entry));
    BendingBuffers made;
    Status status = make(device, entries_, made);
    if (status)
        buffers_ = std::move(made);
    else
        entries_.erase(place);
    uploaded_ = uploaded_ && !status;
    return status;
}

Status BendingMeshes::remove(Device& device, uint32_t slot) {
    const auto place = std::ranges::find(entries_, slot, &Entry::slot);
    if (place == entries_.end())
        return {};
    Entry entry = std::move(*place);
    entries_.erase(place);
    BendingBuffers made;
    Status status = make(device, entries_, made);
    if (status)
        buffers_ = std::move(made);
    else
        entries_.insert(std::ranges::upper_bound(entries_, slot, {}, &Entry::slot),
                        std::move(entry));
    uploaded_ = uploaded_ && !status;
    return status;
}

Status BendingMeshes::assign(Device& device, Entries&& entries) {
    BendingBuffers made;
    PLAIT_TRY(make(device, entries, made));
    entries_ = std::move(entries);
    buffers_ = std::move(made);
    uploaded_ = false;
    return {};
}

Status BendingMeshes::set_positions(uint32_t slot, std::span<const float> positions) {
    Entry& entry = *std::ranges::find(entries_, slot, &Entry::slot);
    if (positions.size() != 3 * entry.target.size())
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("positions.count is %zu, the mesh has %zu vertices",
                            positions.size() / 3, entry.target.size())};
    for (size_t i = 0; i < positions.size(); ++i)
        if (!(std::abs(positions[i]) <= largest))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("positions[%zu]: coordinate is %g, range is [-1e6, 1e6] m", i / 3,
                                double(positions[i]))};
    for (size_t i = 0; i < positions.size(); ++i)
        entry.target[i / 3][i % 3] = positions[i];
    entry.posed = true;
    return {};
}

Status BendingMeshes::advance(Device& device, double end) {
    for (Entry& entry : entries_) {
        if (!entry.posed)
            continue;
        uploaded_ = uploaded_ && entry.from == entry.to;
        entry.from = entry.to;
        for (size_t i = 0; i < entry.to.size(); ++i)
            entry.to[i] = between(entry.at[i], entry.target[i], end);
        uploaded_ = uploaded_ && entry.from == entry.to;
    }
    return uploaded_ || entries_.empty() ? Status{} : upload(device);
}

Status BendingMeshes::upload(Device& device) {
    Scratch& s = scratch_;
    for (auto* list : {&s.box, &s.from, &s.to, &s.bends})
        list->clear();
    for (const Entry& entry : entries_) {
        entry.tree.fit(entry.surface.triangles, entry.from, entry.to, s.boxes);
        for (const MeshTree::Box& box : s.boxes)
            append(s.box, std::array{box.low, box.high});
        append(s.from, entry.from);
        append(s.to, entry.to);
        s.bends.push_back(farthest_way(entry));
    }
    PLAIT_TRY(device.upload(buffers_.box, s.box.data()));
    PLAIT_TRY(device.upload(buffers_.from, s.from.data()));
    PLAIT_TRY(device.upload(buffers_.to, s.to.data()));
    PLAIT_TRY(device.upload(buffers_.bends, s.bends.data()));
    uploaded_ = true;
    return {};
}

void BendingMeshes::arrive() {
    for (Entry& entry : entries_)
        if (entry.posed)
            entry.at = entry.target;
}

void BendingMeshes::stop() {
    for (Entry& entry : entries_)
        if (entry.posed)
            entry.from = entry.to = entry.at;
    uploaded_ = false;
}

} // namespace plait
