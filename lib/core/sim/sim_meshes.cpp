// Colliders that are made of meshes.
#include "base/format.hpp"
#include "core/mesh/mesh_distance.hpp"
#include "core/sim/sim.hpp"

namespace plait {

// Roots are where the last step left them.
Result<std::pmr::vector<float>> Sim::clearance_of(const MeshDistanceOf& distance,
                                                  const plait_collider_mesh_desc& desc) {
    std::pmr::vector<float> rest(4 * size_t{layout_.guide_vertices()}, &context_.memory);
    std::pmr::vector<float> roots(4 * state_.pose.count(), &context_.memory);
    PLAIT_TRY(device().read(state_.rest, 0, layout_.guide_vertices(), rest.data()));
    PLAIT_TRY(device().read(state_.pose, roots.data()));
    return measure_clearance(
        {distance, in_units(desc.pose), rest, roots, layout_.row, desc.margin, desc.clearance != 0},
        &context_.memory);
}

Status Sim::take_meshes(MeshColliders::Entries&& meshes, BendingMeshes::Entries&& bending) {
    PartNeeds needs = part_needs();
    needs.plane = !meshes.empty() || !bending.empty() || pairs_.buffers();
    PLAIT_TRY(model_->open(device(), needs));
    PLAIT_TRY(meshes_.assign(device(), std::move(meshes)));
    return bending_.assign(device(), std::move(bending));
}

Status Sim::add_field(uint32_t slot, const Mesh& mesh, const plait_collider_mesh_desc& desc) {
    MeshColliders::Entry entry{slot, MeshField(&context_.memory),
                               std::pmr::vector<float>(&context_.memory)};
    PLAIT_TRY(bake_field(mesh, {desc.cells, desc.two_sided != 0}, entry.field));
    auto clearance = clearance_of(
        [&](const std::array<double, 3>& x) { return sample_field(entry.field, x); }, desc);
    if (!clearance)
        return clearance.error();
    entry.clearance = std::move(*clearance);
    return meshes_.add(device(), std::move(entry));
}

Status Sim::add_bending(uint32_t slot, const Mesh& mesh, const plait_collider_mesh_desc& desc) {
    const bool two_sided = desc.two_sided != 0;
    if (!two_sided)
        PLAIT_TRY(check_sides(mesh));
    BendingMeshes::Entry entry(slot, two_sided, &context_.memory);
    entry.surface.positions = mesh.surface.positions;
    entry.surface.triangles = mesh.surface.triangles;
    entry.begin();
    const MeshDistance distance(entry.surface, &context_.memory);
    uint32_t hint = 0;
    auto clearance = clearance_of(
        [&](const std::array<double, 3>& x) {
            const MeshNearest nearest = distance.nearest({x[0], x[1], x[2]}, hint);
            hint = nearest.triangle;
            return two_sided ? nearest.distance : nearest.signed_distance();
        },
        desc);
    if (!clearance)
        return clearance.error();
    entry.clearance = std::move(*clearance);
    return bending_.add(device(), std::move(entry));
}

Result<plait_collider_id> Sim::create_mesh_collider(const Mesh& mesh,
                                                    const plait_collider_mesh_desc& desc) {
    if (desc_.model == PLAIT_MODEL_TRESSFX)
        return Error{PLAIT_INVALID_STATE,
                     "the sim is of model 0 (tressfx), whose strands do not meet meshes; those of "
                     "articulated do"};
    const auto id = colliders_.create_mesh(device(), desc);
    if (!id)
        return id.error();
    const uint32_t slot = *colliders_.find(*id);
    PartNeeds needs = part_needs();
    needs.plane = true;
    Status status = model_->open(device(), needs);
    if (status)
        status = desc.form == PLAIT_MESH_FORM_NEAREST ? add_bending(slot, mesh, desc)
                                                      : add_field(slot, mesh, desc);
    if (status)
        status = check_stages();
    if (status)
        return id;
    (void)destroy_collider(*id);
    return status.error();
}

Result<plait_collider_id> Sim::create_hull_collider(const Mesh& mesh,
                                                    const plait_collider_hull_desc& desc) {
    Hull hull(&context_.memory);
    PLAIT_TRY(make_hull(mesh, {double(desc.tolerance), desc.margin > 0}, hull));
    return if_built(colliders_.create_hull(device(), desc, hull));
}

// Solves have the stages of contact from the beginning; what follows may get one of its own.
Result<plait_collider_id> Sim::if_built(Result<plait_collider_id> made) {
    if (!made || !display_.meets_colliders(params_))
        return made;
    const Status status = check_stages();
    if (status)
        return made;
    (void)destroy_collider(*made);
    return status.error();
}

// Of a mesh whose vertices may be moved.
Result<uint32_t> Sim::bending_slot(plait_collider_id id) const {
    const auto slot = colliders_.find(id);
    if (!slot)
        return slot.error();
    const Colliders::Slot& collider = colliders_.slots()[*slot];
    if (!Colliders::is_mesh(collider))
        return Error{PLAIT_INVALID_STATE,
                     format("collider id 0x%llx is of kind %u and has no vertices; a mesh of form "
                            "1 (NEAREST) has",
                            static_cast<unsigned long long>(id.value), collider.kind)};
    if (!Colliders::bends(collider))
        return Error{PLAIT_INVALID_STATE,
                     format("collider id 0x%llx is a mesh of form 0 (FIELD), whose distances were "
                            "made once, for the shape it had: create it with form 1 (NEAREST)",
                            static_cast<unsigned long long>(id.value))};
    return *slot;
}

Status Sim::set_collider_positions(plait_collider_id id, std::span<const float> positions) {
    const auto slot = bending_slot(id);
    if (!slot)
        return slot.error();
    return bending_.set_positions(device(), *slot, positions);
}

Status Sim::place_collider(plait_collider_id id, const plait_pose& pose) {
    const auto slot = colliders_.find(id);
    if (!slot)
        return slot.error();
    if (Colliders::bends(colliders_.slots()[*slot])) {
        PLAIT_TRY(bending_.forget_sides(device(), *slot));
        schedule_.clear();
        bending_.place(schedule_, *slot);
        PLAIT_TRY(submit());
    }
    return colliders_.place(id, pose);
}

// What ran before it may still read the one that was too small: devices keep it as long.
Result<const Buffer*> Sim::room_for(size_t count, size_t words) {
    const size_t floats = (count - 1) * words + 3;
    if (taken_.count() < floats) {
        Buffer made;
        PLAIT_TRY(device().create(made, PLAIT_ELEMENT_FLOAT, floats, "mesh_taken"));
        taken_ = std::move(made);
    }
    return &taken_;
}

Result<const Buffer*> Sim::room_for_positions(plait_collider_id id, size_t count, size_t words) {
    const auto slot = bending_slot(id);
    if (!slot)
        return slot.error();
    PLAIT_TRY(bending_.check_count(*slot, count));
    return room_for(count, words);
}

Status Sim::take_positions(plait_collider_id id, uint32_t words) {
    const auto slot = bending_slot(id);
    if (!slot)
        return slot.error();
    schedule_.clear();
    bending_.take_positions(schedule_, *slot, taken_, words);
    return submit();
}

Result<const Buffer*> Sim::room_for_root_positions(size_t count, size_t words) {
    PLAIT_TRY(binding_.check_count(count));
    return room_for(count, words);
}

Status Sim::take_root_positions(const plait_pose& head, uint32_t words) {
    const auto poses = roots_.target_poses(device());
    if (!poses)
        return poses.error();
    schedule_.clear();
    PLAIT_TRY(
        binding_.take(device(), schedule_, layout_, state_, {taken_, words, scale_}, **poses));
    PLAIT_TRY(submit());
    roots_.aim_at_target_poses(in_units(head), 0);
    return aimed();
}

Status Sim::destroy_collider(plait_collider_id id) {
    const auto slot = colliders_.find(id);
    if (!slot)
        return slot.error();
    if (Colliders::is_mesh(colliders_.slots()[*slot])) {
        PLAIT_TRY(meshes_.remove(device(), *slot));
        PLAIT_TRY(bending_.remove(device(), *slot));
        PLAIT_TRY(model_->open(device(), part_needs()));
    }
    return colliders_.destroy(id);
}

} // namespace plait
