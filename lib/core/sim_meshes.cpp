// Colliders that are meshes.
#include "base/format.hpp"
#include "core/models/traits.hpp"
#include "core/sim.hpp"

namespace plait {

// Roots are where the last step left them.
Result<std::pmr::vector<float>> Sim::clearance_of(const MeshField& field,
                                                  const plait_collider_mesh_desc& desc) {
    std::pmr::vector<float> rest(4 * size_t{layout_.guide_vertices()}, &context_.memory);
    std::pmr::vector<float> roots(4 * state_.pose.count(), &context_.memory);
    PLAIT_TRY(device().read(state_.rest, 0, layout_.guide_vertices(), rest.data()));
    PLAIT_TRY(device().read(state_.pose, roots.data()));
    return measure_clearance(
        {field, desc.pose, rest, roots, layout_.row, desc.margin, desc.clearance != 0},
        &context_.memory);
}

Status Sim::take_meshes(MeshColliders::Entries&& meshes) {
    PLAIT_TRY(model_->keep_planes(device(), !meshes.empty() || pairs_.buffers()));
    return meshes_.assign(device(), std::move(meshes));
}

Result<plait_collider_id> Sim::create_mesh_collider(const Mesh& mesh,
                                                    const plait_collider_mesh_desc& desc) {
    if (desc_.model == PLAIT_MODEL_TRESSFX)
        return Error{PLAIT_INVALID_STATE,
                     format("the sim is of model 0 (tressfx), whose strands do not meet meshes; "
                            "those of the models %s do",
                            list_models(&ModelTraits::switches).c_str())};
    MeshColliders::Entry entry{0, MeshField(&context_.memory),
                               std::pmr::vector<float>(&context_.memory)};
    PLAIT_TRY(bake_field(mesh, {desc.cells, desc.two_sided != 0}, entry.field));
    auto clearance = clearance_of(entry.field, desc);
    if (!clearance)
        return clearance.error();
    entry.clearance = std::move(*clearance);
    const auto id = colliders_.create_mesh(device(), desc.pose, desc.friction);
    if (!id)
        return id.error();
    entry.slot = *colliders_.find(*id);
    Status status = model_->keep_planes(device(), true);
    if (status)
        status = meshes_.add(device(), std::move(entry));
    if (status)
        status = check_stages();
    if (status)
        return id;
    (void)destroy_collider(*id);
    return status.error();
}

Status Sim::destroy_collider(plait_collider_id id) {
    const auto slot = colliders_.find(id);
    if (!slot)
        return slot.error();
    if (Colliders::is_mesh(colliders_.slots()[*slot])) {
        PLAIT_TRY(meshes_.remove(device(), *slot));
        if (!needs_planes())
            PLAIT_TRY(model_->keep_planes(device(), false));
    }
    return colliders_.destroy(id);
}

} // namespace plait
