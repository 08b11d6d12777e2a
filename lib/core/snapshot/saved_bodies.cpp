// Colliders as a snapshot holds them: slots, faces of hulls, meshes by form.
#include "core/snapshot/snapshot_format.hpp"

#include "base/format.hpp"
#include "base/memory.hpp"
#include "core/params/params.hpp"

#include <algorithm>
#include <cmath>

namespace plait::snapshots {
namespace {

// All but kind, friction and poses is as create_mesh() makes it.
Status check_mesh_slot(const Colliders::Slot& slot) {
    plait_collider_mesh_desc desc{};
    desc.cells = 8;
    desc.friction = slot.friction;
    std::memcpy(&desc.form, &slot.form, sizeof desc.form); // it may be any number
    PLAIT_TRY(check_mesh_collider(desc));
    Colliders::Slot bare = slot;
    for (float* vector : {bare.a, bare.b, bare.normal, bare.half_extents})
        std::fill_n(vector, 3, 0.0f);
    bare.radius_a = bare.radius_b = bare.rounding = bare.scale = 0;
    std::copy_n(identity_pose.q, 4, bare.orientation);
    if (std::memcmp(&bare, &slot, sizeof slot) != 0)
        return Error{PLAIT_INVALID_ARGUMENT, "is a mesh, and has a shape besides"};
    return {};
}

// As create_hull() makes it, and as a box it is none that may not be.
Status check_hull_slot(const Colliders::Slot& slot) {
    plait_collider_desc around = Colliders::shape_of(slot);
    around.kind = PLAIT_COLLIDER_KIND_BOX;
    PLAIT_TRY(check_collider(around));
    Colliders::Slot bare = slot;
    for (float* vector : {bare.b, bare.normal})
        std::fill_n(vector, 3, 0.0f);
    bare.radius_a = bare.radius_b = 0;
    std::copy_n(identity_pose.q, 4, bare.orientation);
    if (std::memcmp(&bare, &slot, sizeof slot) != 0)
        return Error{PLAIT_INVALID_ARGUMENT, "is a hull, and has another shape besides"};
    return {};
}

Status check_shape(const Colliders::Slot& slot) {
    if (Colliders::is_mesh(slot))
        return check_mesh_slot(slot);
    return Colliders::is_hull(slot) ? check_hull_slot(slot)
                                    : check_collider(Colliders::shape_of(slot));
}

Status check_slot(const Colliders::Slot& slot, size_t index, float scale) {
    if (slot.alive > 1)
        return malformed(format("collider %zu: alive is %u, range is [0, 1]", index, slot.alive));
    if (!slot.alive) {
        Colliders::Slot gone{};
        gone.generation = slot.generation;
        if (std::memcmp(&gone, &slot, sizeof slot) != 0)
            return malformed(format("collider %zu is gone, but not all of it is zero", index));
        return {};
    }
    if (const auto status = check_shape(slot); !status)
        return malformed(format("collider %zu: %s", index, status.error().message.c_str()));
    PLAIT_TRY(check_pose(slot.target, "collider", 1));
    for (const plait_pose* pose : {&slot.at, &slot.from, &slot.to})
        PLAIT_TRY(check_pose(*pose, "collider", scale));
    return {};
}

Status check_rules(const ClearanceRules& rules, uint32_t slot) {
    plait_collider_mesh_desc desc{};
    desc.cells = 8;
    desc.margin = rules.margin;
    desc.clearance = rules.keeps_rest;
    if (const auto status = check_mesh_collider(desc); !status)
        return malformed(format("collider %u: %s", slot, status.error().message.c_str()));
    return {};
}

// One mesh from `from` on, which it moves on; `vertices`: [guides][V].
Result<MeshColliders::Entry> saved_mesh(uint32_t slot, size_t vertices,
                                        std::span<const unsigned char>& from,
                                        std::pmr::memory_resource* memory) {
    SavedMesh saved;
    if (from.size() < sizeof saved)
        return malformed(format("collider %u: it ends before its mesh", slot));
    std::memcpy(&saved, from.data(), sizeof saved);
    from = from.subspan(sizeof saved);
    PLAIT_TRY(check_rules(saved.rules, slot));
    uint64_t count = 1;
    for (const uint32_t nodes : saved.nodes) {
        if (nodes < 2 || nodes > 1024)
            return malformed(format("collider %u: %u nodes, range is [2, 1024]", slot, nodes));
        count *= nodes;
    }
    const uint64_t floats = count + vertices;
    if (from.size() / sizeof(float) < floats)
        return malformed(format("collider %u: %llu numbers of a mesh, %zu bytes are left", slot,
                                static_cast<unsigned long long>(floats), from.size()));
    for (size_t i = 0; i < floats; ++i)
        PLAIT_TRY(check_range(from.data(), i, "mesh"));
    for (size_t i = 0; i < 3; ++i)
        if (!(std::abs(saved.origin[i]) <= largest))
            return outside("origin", i, double(saved.origin[i]), "[-4e6, 4e6]");
    for (const float size : {saved.edge, saved.band})
        if (!(size > 0 && size <= largest))
            return outside("mesh edge", slot, double(size), "(0, 4e6]");
    const auto field = share_in<MeshField>(memory, memory);
    std::copy_n(saved.origin, 3, field->origin.begin());
    std::copy_n(saved.nodes, 3, field->nodes.begin());
    field->edge = saved.edge;
    field->band = saved.band;
    field->value.resize(count);
    std::memcpy(field->value.data(), from.data(), count * sizeof(float));
    from = from.subspan(count * sizeof(float));
    MeshColliders::Entry entry{slot, field, saved.rules, std::pmr::vector<float>(vertices, memory)};
    std::memcpy(entry.clearance.data(), from.data(), vertices * sizeof(float));
    from = from.subspan(vertices * sizeof(float));
    return entry;
}

} // namespace

Result<std::pmr::vector<Colliders::Slot>>
saved_slots(std::span<const unsigned char>& from, float scale, std::pmr::memory_resource* memory) {
    uint32_t count = 0;
    if (!take(from, count) || from.size() / sizeof(Colliders::Slot) < count)
        return malformed(format("%u colliders, %zu bytes are left", count, from.size()));
    std::pmr::vector<Colliders::Slot> slots(count, memory);
    if (!slots.empty())
        std::memcpy(slots.data(), from.data(), slots.size() * sizeof slots[0]);
    from = from.subspan(slots.size() * sizeof(Colliders::Slot));
    for (size_t i = 0; i < slots.size(); ++i)
        PLAIT_TRY(check_slot(slots[i], i, scale));
    return slots;
}

Result<Colliders::FacesOf> saved_faces(std::span<const Colliders::Slot> slots,
                                       std::span<const unsigned char>& from,
                                       std::pmr::memory_resource* memory) {
    Colliders::FacesOf list(slots.size(), memory);
    for (size_t i = 0; i < slots.size(); ++i) {
        if (!Colliders::is_hull(slots[i]))
            continue;
        uint32_t count = 0;
        if (from.size() >= sizeof count)
            std::memcpy(&count, from.data(), sizeof count);
        if (from.size() < sizeof count || (from.size() - sizeof count) / sizeof(HullFace) < count)
            return malformed(format("collider %zu: it ends before the faces of its hull", i));
        list[i].resize(count);
        if (count > 0)
            std::memcpy(list[i].data(), from.data() + sizeof count, count * sizeof(HullFace));
        from = from.subspan(sizeof count + count * sizeof(HullFace));
        if (const auto status = check_hull_faces(list[i]); !status)
            return malformed(format("collider %zu: %s", i, status.error().message.c_str()));
    }
    return list;
}

Result<MeshColliders::Entries> saved_meshes(std::span<const Colliders::Slot> slots, size_t vertices,
                                            std::span<const unsigned char>& from,
                                            std::pmr::memory_resource* memory) {
    MeshColliders::Entries list(memory);
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (!Colliders::is_mesh(slots[i]) || Colliders::bends(slots[i]))
            continue;
        auto entry = saved_mesh(i, vertices, from, memory);
        if (!entry)
            return entry.error();
        list.push_back(std::move(*entry));
    }
    return list;
}

namespace {

// `count` rows of three from `from` on, which it moves on.
template <typename Row>
void take_rows(std::span<const unsigned char>& from, size_t count, std::pmr::vector<Row>& to) {
    to.resize(count);
    std::memcpy(to.data(), from.data(), count * sizeof(Row));
    from = from.subspan(count * sizeof(Row));
}

// The same of points, which it holds to their range.
Status take_points(std::span<const unsigned char>& from, size_t count,
                   std::pmr::vector<MeshPoint>& to) {
    for (size_t i = 0; i < 3 * count; ++i)
        PLAIT_TRY(check_range(from.data(), i, "mesh"));
    take_rows(from, count, to);
    return {};
}

Status check_bending(const SavedBendingMesh& saved, uint32_t slot, size_t clearances, size_t left) {
    if (saved.two_sided > 1 || saved.posed > 1)
        return malformed(format("collider %u: two_sided is %u, posed is %u, range is [0, 1]", slot,
                                saved.two_sided, saved.posed));
    if (saved.vertices < 3 || saved.triangles < 1)
        return malformed(format("collider %u: %u vertices and %u triangles, at least 3 and 1", slot,
                                saved.vertices, saved.triangles));
    const uint64_t words = uint64_t{3} * saved.vertices * (saved.posed ? 5 : 1) +
                           uint64_t{3} * saved.triangles + clearances * (saved.two_sided ? 5 : 1);
    if (left / sizeof(float) < words)
        return malformed(format("collider %u: %llu numbers of a mesh, %zu bytes are left", slot,
                                static_cast<unsigned long long>(words), left));
    return {};
}

// One mesh from `from` on, which it moves on.
Result<BendingMeshes::Entry> saved_bending_mesh(uint32_t slot, size_t vertices,
                                                std::span<const unsigned char>& from,
                                                std::pmr::memory_resource* memory) {
    SavedBendingMesh saved;
    if (from.size() < sizeof saved)
        return malformed(format("collider %u: it ends before its mesh", slot));
    std::memcpy(&saved, from.data(), sizeof saved);
    from = from.subspan(sizeof saved);
    PLAIT_TRY(check_bending(saved, slot, vertices, from.size()));
    PLAIT_TRY(check_rules(saved.rules, slot));
    const auto surface = share_in<BendingSurface>(memory, saved.two_sided != 0, memory);
    PLAIT_TRY(take_points(from, saved.vertices, surface->set.positions));
    BendingMeshes::Entry entry(slot, surface, memory);
    entry.posed = saved.posed != 0;
    entry.rules = saved.rules;
    BendingMeshes::Places& p = entry.places;
    for (auto* places : {&p.at, &p.target, &p.from, &p.to})
        if (entry.posed)
            PLAIT_TRY(take_points(from, saved.vertices, *places));
    take_rows(from, saved.triangles, surface->set.triangles);
    for (const Triangle& triangle : surface->set.triangles)
        for (const uint32_t corner : triangle)
            if (corner >= saved.vertices)
                return malformed(format("collider %u: a corner is %u, range is [0, %u)", slot,
                                        corner, saved.vertices));
    const size_t numbers = vertices * (entry.two_sided() ? 5 : 1);
    for (size_t i = 0; i < numbers; ++i)
        PLAIT_TRY(check_range(from.data(), i, "mesh"));
    surface->tree.build(surface->set);
    entry.begin();
    take_rows(from, vertices, entry.clearance);
    if (entry.two_sided())
        take_rows(from, 4 * vertices, entry.sides);
    return entry;
}

} // namespace

Result<BendingMeshes::Entries> saved_bending(std::span<const Colliders::Slot> slots,
                                             size_t vertices, std::span<const unsigned char>& from,
                                             std::pmr::memory_resource* memory) {
    BendingMeshes::Entries list(memory);
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (!Colliders::bends(slots[i]))
            continue;
        auto entry = saved_bending_mesh(i, vertices, from, memory);
        if (!entry)
            return entry.error();
        list.push_back(std::move(*entry));
    }
    return list;
}

} // namespace plait::snapshots
