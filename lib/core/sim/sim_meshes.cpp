// What meshes are to the hair of one sim.
#include "base/format.hpp"
#include "core/mesh/mesh_distance.hpp"
#include "core/sim/sim.hpp"

namespace plait {

// Roots are where the last step left them.
Result<std::pmr::vector<float>> Sim::clearance_of(const MeshDistanceOf& distance,
                                                  ClearanceRules rules, const plait_pose& pose) {
    std::pmr::vector<float> rest(4 * size_t{layout_.guide_vertices()}, &context_.memory);
    std::pmr::vector<float> roots(4 * state_.pose.count(), &context_.memory);
    PLAIT_TRY(device().read(state_.rest, 0, layout_.guide_vertices(), rest.data()));
    PLAIT_TRY(device().read(state_.pose, roots.data()));
    return measure_clearance({distance, in_units(pose), rest, roots, layout_.row, rules},
                             &context_.memory);
}

Status Sim::measure(MeshColliders::Entry& entry, const plait_pose& pose) {
    auto clearance =
        clearance_of([&](const std::array<double, 3>& x) { return sample_field(*entry.field, x); },
                     entry.rules, pose);
    if (!clearance)
        return clearance.error();
    entry.clearance = std::move(*clearance);
    return {};
}

// The mesh is as it was made.
Status Sim::measure(BendingMeshes::Entry& entry, const MeshDistance& distance,
                    const plait_pose& pose) {
    uint32_t hint = 0;
    auto clearance = clearance_of(
        [&](const std::array<double, 3>& x) {
            const MeshNearest nearest = distance.nearest({x[0], x[1], x[2]}, hint);
            hint = nearest.triangle;
            return entry.two_sided() ? nearest.distance : nearest.signed_distance();
        },
        entry.rules, pose);
    if (!clearance)
        return clearance.error();
    entry.clearance = std::move(*clearance);
    return {};
}

Status Sim::take_meshes(MeshColliders::Entries&& meshes, BendingMeshes::Entries&& bending) {
    PartNeeds needs = part_needs();
    needs.plane = !meshes.empty() || !bending.empty() || pairs_.buffers();
    needs.hollow = std::ranges::any_of(bending, &BendingMeshes::Entry::two_sided);
    PLAIT_TRY(model_->open(device(), needs));
    auto fields = meshes_.make(device(), std::move(meshes), meshes_.set());
    if (!fields)
        return fields.error();
    auto nearest = bending_.make(device(), std::move(bending), bending_.set());
    if (!nearest)
        return nearest.error();
    meshes_.swap(*fields);
    bending_.swap(*nearest);
    return {};
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

Result<const Buffer*> Sim::room_for_root_positions(size_t count, size_t words) {
    PLAIT_TRY(binding_.check_count(count));
    return room_for(count, words);
}

Status Sim::take_root_positions(const plait_pose& head, uint32_t words) {
    stir();
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

} // namespace plait
