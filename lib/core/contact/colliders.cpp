#include "core/contact/colliders.hpp"

#include "base/format.hpp"

#include <plait/params.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace plait {
namespace {

// Id: generation above, slot index + 1 below, so that zero is no collider.
plait_collider_id make_id(size_t index, uint32_t generation) {
    return {(uint64_t{generation} << 32) | (index + 1)};
}

void take_shape(Colliders::Slot& slot, const plait_collider_desc& desc) {
    slot.kind = static_cast<uint32_t>(desc.kind);
    slot.friction = desc.friction;
    slot.form = desc.inward;
    slot.scale = desc.scale;
    const bool capsule = desc.kind == PLAIT_COLLIDER_KIND_CAPSULE;
    const bool plane = desc.kind == PLAIT_COLLIDER_KIND_PLANE;
    const bool box = desc.kind == PLAIT_COLLIDER_KIND_BOX;
    const plait_capsule round = capsule ? desc.capsule : plait_capsule{};
    const plait_plane flat = plane ? desc.plane : plait_plane{};
    const plait_box edged = box ? desc.box : plait_box{};
    std::copy_n(plane ? flat.point : box ? edged.centre : round.a, 3, slot.a);
    std::copy_n(round.b, 3, slot.b);
    slot.radius_a = round.radius_a;
    slot.radius_b = round.radius_b;
    std::copy_n(flat.normal, 3, slot.normal);
    std::copy_n(edged.half_extents, 3, slot.half_extents);
    slot.rounding = edged.rounding;
    std::copy_n(edged.orientation, 4, slot.orientation);
}

} // namespace

Result<uint32_t> Colliders::find(plait_collider_id id) const {
    const uint64_t index = (id.value & 0xffffffffu) - 1;
    const auto generation = static_cast<uint32_t>(id.value >> 32);
    if (index < slots_.size() && slots_[index].alive && slots_[index].generation == generation)
        return static_cast<uint32_t>(index);
    return Error{PLAIT_NOT_FOUND, format("collider id 0x%llx is not in this sim",
                                         static_cast<unsigned long long>(id.value))};
}

Status Colliders::set_substeps(Device& device, std::span<const uint32_t> numbers) {
    std::pmr::vector<uint32_t> substeps(numbers.begin(), numbers.end(), substeps_.get_allocator());
    substeps_.swap(substeps);
    Status status = reserve(device, count_, face_count_);
    if (!status)
        substeps_.swap(substeps);
    else if (substeps_ != substeps)
        uploaded_ = false;
    return status;
}

Colliders::Slot& Colliders::take_slot(const plait_pose& pose) {
    auto slot = std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.alive; });
    if (slot == slots_.end())
        slot = slots_.emplace(slots_.end());
    faces_.resize(slots_.size());
    slot->generation += 1;
    slot->alive = 1;
    slot->target = pose;
    slot->at = slot->before = slot->from = slot->to = goal(*slot);
    ++count_;
    uploaded_ = false;
    return *slot;
}

Result<plait_collider_id> Colliders::create(Device& device, const plait_collider_desc& desc) {
    PLAIT_TRY(reserve(device, count_ + 1, face_count_));
    Slot& slot = take_slot(desc.pose);
    take_shape(slot, desc);
    return make_id(static_cast<size_t>(&slot - slots_.data()), slot.generation);
}

Result<plait_collider_id> Colliders::create_mesh(Device& device,
                                                 const plait_collider_mesh_desc& desc) {
    PLAIT_TRY(reserve(device, count_ + 1, face_count_));
    Slot& slot = take_slot(desc.pose);
    slot.kind = PLAIT_COLLIDER_KIND_MESH;
    slot.form = static_cast<uint32_t>(desc.form);
    slot.friction = desc.friction;
    slot.orientation[3] = 1;
    ++meshes_;
    bending_ += bends(slot);
    return make_id(static_cast<size_t>(&slot - slots_.data()), slot.generation);
}

Result<plait_collider_id>
Colliders::create_hull(Device& device, const plait_collider_hull_desc& desc, const Hull& hull) {
    PLAIT_TRY(reserve(device, count_ + 1, face_count_ + hull.faces.size()));
    Slot& slot = take_slot(desc.pose);
    slot.kind = PLAIT_COLLIDER_KIND_HULL;
    std::ranges::copy(hull.centre, slot.a);
    std::ranges::copy(hull.half_extents, slot.half_extents);
    slot.rounding = desc.margin;
    slot.friction = desc.friction;
    slot.form = desc.inward;
    slot.scale = desc.scale;
    slot.orientation[3] = 1;
    const auto index = static_cast<size_t>(&slot - slots_.data());
    faces_[index].assign(hull.faces.begin(), hull.faces.end());
    face_count_ += hull.faces.size();
    return make_id(index, slot.generation);
}

Status Colliders::set_pose(plait_collider_id id, const plait_pose& pose) {
    const auto index = find(id);
    if (!index)
        return index.error();
    slots_[*index].target = pose;
    return {};
}

Status Colliders::place(plait_collider_id id, const plait_pose& pose) {
    const auto index = find(id);
    if (!index)
        return index.error();
    Slot& slot = slots_[*index];
    slot.target = pose;
    slot.at = slot.before = slot.from = slot.to = goal(slot);
    uploaded_ = false;
    return {};
}

Status Colliders::set_shape(plait_collider_id id, const plait_collider_desc& desc) {
    const auto index = find(id);
    if (!index)
        return index.error();
    if (is_mesh(slots_[*index]) || is_hull(slots_[*index]))
        return Error{PLAIT_INVALID_STATE,
                     format("collider id 0x%llx is a %s, which keeps its shape: destroy it and "
                            "create another",
                            static_cast<unsigned long long>(id.value),
                            is_hull(slots_[*index]) ? "hull" : "mesh")};
    take_shape(slots_[*index], desc);
    uploaded_ = false;
    return {};
}

Result<plait_collider_desc> Colliders::describe(plait_collider_id id) const {
    const auto index = find(id);
    if (!index)
        return index.error();
    plait_collider_desc desc = shape_of(slots_[*index]);
    desc.pose = slots_[*index].target;
    return desc;
}

plait_collider_desc Colliders::shape_of(const Slot& slot) {
    plait_collider_desc desc{};
    std::memcpy(&desc.kind, &slot.kind, sizeof desc.kind); // of a snapshot it may be any number
    desc.friction = slot.friction;
    if (slot.kind == PLAIT_COLLIDER_KIND_CAPSULE) {
        std::copy_n(slot.a, 3, desc.capsule.a);
        std::copy_n(slot.b, 3, desc.capsule.b);
        desc.capsule.radius_a = slot.radius_a;
        desc.capsule.radius_b = slot.radius_b;
    } else if (slot.kind == PLAIT_COLLIDER_KIND_PLANE) {
        std::copy_n(slot.a, 3, desc.plane.point);
        std::copy_n(slot.normal, 3, desc.plane.normal);
    } else if (slot.kind != PLAIT_COLLIDER_KIND_MESH) { // a hull has a box around it
        std::copy_n(slot.a, 3, desc.box.centre);
        std::copy_n(slot.half_extents, 3, desc.box.half_extents);
        desc.box.rounding = slot.rounding;
        std::copy_n(slot.orientation, 4, desc.box.orientation);
    }
    if (!is_mesh(slot))
        desc.inward = slot.form;
    desc.scale = slot.scale;
    return desc;
}

size_t Colliders::list(std::span<plait_collider_id> dst) const {
    size_t number = 0;
    for (size_t i = 0; i < slots_.size() && number < dst.size(); ++i)
        if (slots_[i].alive)
            dst[number++] = make_id(i, slots_[i].generation);
    return number;
}

Status Colliders::destroy(plait_collider_id id) {
    const auto index = find(id);
    if (!index)
        return index.error();
    Slot& slot = slots_[*index];
    const uint32_t generation = slot.generation;
    meshes_ -= is_mesh(slot);
    bending_ -= bends(slot);
    face_count_ -= faces_[*index].size();
    faces_[*index].clear();
    slot = {}; // equal states have equal bytes
    slot.generation = generation;
    --count_;
    uploaded_ = false;
    return {};
}

void Colliders::undo(plait_collider_id id) {
    const auto index = find(id);
    if (!index)
        return;
    (void)destroy(id);
    if (--slots_[*index].generation == 0 && *index + 1 == slots_.size()) {
        slots_.pop_back();
        faces_.pop_back();
    }
}

Status Colliders::advance(Device& device, double end, bool bends) {
    bends_ = bends;
    for (Slot& slot : slots_) {
        const bool rested = same_pose(slot.from, slot.to) && same_pose(slot.before, slot.to);
        slot.before = slot.from;
        slot.from = slot.to;
        slot.to = interpolate(slot.at, goal(slot), end);
        uploaded_ = uploaded_ && (!slot.alive || (rested && same_pose(slot.from, slot.to)));
    }
    return upload(device);
}

void Colliders::arrive() {
    for (Slot& slot : slots_)
        slot.at = goal(slot);
}

void Colliders::stop() {
    for (Slot& slot : slots_)
        slot.before = slot.from = slot.to = slot.at;
    uploaded_ = false;
}

void Colliders::jump(double end) {
    for (Slot& slot : slots_)
        slot.before = slot.from = slot.to = interpolate(slot.at, goal(slot), end);
    uploaded_ = false;
}

void Colliders::carry(const plait_pose& motion) {
    for (Slot& slot : slots_) {
        if (!slot.alive) // all of it stays zero
            continue;
        for (plait_pose* pose : {&slot.before, &slot.from, &slot.to})
            *pose = carried(*pose, identity_pose, motion);
    }
    uploaded_ = false;
}

void Colliders::rescale(float scale, const HeadWays& ways) {
    scale_ = scale;
    for (Slot& slot : slots_) {
        if (!slot.alive)
            continue;
        for (const auto& [pose, way] :
             {std::pair{&slot.at, &ways.at}, std::pair{&slot.before, &ways.before},
              std::pair{&slot.from, &ways.from}, std::pair{&slot.to, &ways.to}})
            for (size_t i = 0; i < 3; ++i)
                pose->t[i] += (*way)[i];
    }
    uploaded_ = false;
}

Status Colliders::assign(Device& device, std::span<const Slot> slots, FacesOf&& faces,
                         float scale) {
    const auto alive = static_cast<uint32_t>(
        std::count_if(slots.begin(), slots.end(), [](const Slot& s) { return s.alive != 0; }));
    size_t face_count = 0;
    for (const Faces& each : faces)
        face_count += each.size();
    slots_.reserve(slots.size());
    PLAIT_TRY(reserve(device, alive, face_count));
    slots_.assign(slots.begin(), slots.end());
    faces_ = std::move(faces);
    face_count_ = face_count;
    meshes_ = static_cast<uint32_t>(std::count_if(slots.begin(), slots.end(), is_mesh));
    bending_ = static_cast<uint32_t>(std::count_if(slots.begin(), slots.end(), bends));
    count_ = alive;
    scale_ = scale;
    uploaded_ = false;
    return {};
}

Status Colliders::take(Device& device, const Colliders& from) {
    std::pmr::vector<Slot> slots(from.slots_, slots_.get_allocator());
    for (Slot& slot : slots)
        if (slot.alive)
            slot.at = slot.before = slot.from = slot.to = goal(slot);
    FacesOf faces(from.faces_, faces_.get_allocator());
    return assign(device, slots, std::move(faces), scale_);
}

bool Colliders::are(std::span<const Slot> slots, const FacesOf& faces) const {
    const auto same = [](const Slot& a, const Slot& b) {
        return std::memcmp(&a, &b, offsetof(Slot, target)) == 0;
    };
    return std::ranges::equal(slots_, slots, same) && faces_ == faces;
}

} // namespace plait
