// Colliders, of one sim or of several that share them. Each sim keeps its own of what depends on its
// hair, its clock and its scale: paths, clearance, sides; only the geometry of meshes is held once. So a
// call is made in all of them, and each does what it would do if the body were its own, to the bit.
#include "base/format.hpp"
#include "base/memory.hpp"
#include "core/mesh/mesh_distance.hpp"
#include "core/sim/sim.hpp"

namespace plait {

// From this sim on.
template <typename Visit> Status Sim::for_each_sharer(const Visit& visit) {
    Sim* each = this;
    do {
        PLAIT_TRY(visit(*each));
        each = each->sharer_;
    } while (each != this);
    return {};
}

void Sim::swap(MeshSets& sets) {
    if (sets.fields)
        meshes_.swap(*sets.fields);
    if (sets.nearest)
        bending_.swap(*sets.nearest);
}

// ---- creating and destroying --------------------------------------------------------------------

// What becomes of one sim, and can be undone: its new collider, and its meshes as they were before.
struct Sim::Change {
    Sim* sim;
    plait_collider_id made{};
    MeshSets meshes{};

    void undo() {
        sim->swap(meshes);
        sim->colliders_.undo(made);
        (void)sim->model_->open(sim->device(), sim->part_needs()); // which makes nothing
    }
};

// Of all that share; undone however the call ends, unless they are kept.
struct Sim::Changes {
    explicit Changes(std::pmr::memory_resource* memory) : list(memory) {}
    Changes(const Changes&) = delete;
    Changes& operator=(const Changes&) = delete;
    ~Changes() {
        for (Change& change : list)
            if (!kept)
                change.undo();
    }
    std::pmr::vector<Change> list;
    bool kept = false;
};

// `make(sim, change)` makes it in one sim.
template <typename Make> Result<plait_collider_id> Sim::create_in_all(const Make& make) {
    Changes changes(&context_.memory);
    const Status status = for_each_sharer([&](Sim& sim) -> Status {
        sim.stir();
        Status made = make(sim, changes.list.emplace_back(Change{&sim}));
        if (made || &sim == this)
            return made;
        return Error{made.error().code,
                     "of a sim that shares its colliders: " + made.error().message};
    });
    if (!status)
        return status.error();
    changes.kept = true;
    return changes.list.front().made;
}

// Solves have the stages of contact from the beginning; what follows may get one of its own.
Result<plait_collider_id> Sim::create_collider(const plait_collider_desc& desc) {
    return create_in_all([&](Sim& sim, Change& change) -> Status {
        const auto id = sim.colliders_.create(sim.device(), desc);
        if (!id)
            return id.error();
        change.made = *id;
        return sim.display_.meets_colliders(sim.params_) ? sim.check_stages() : Status{};
    });
}

Result<plait_collider_id> Sim::create_hull_collider(const Mesh& mesh,
                                                    const plait_collider_hull_desc& desc) {
    Hull hull(&context_.memory);
    PLAIT_TRY(make_hull(mesh, {double(desc.tolerance), desc.margin > 0}, hull));
    return create_in_all([&](Sim& sim, Change& change) -> Status {
        const auto id = sim.colliders_.create_hull(sim.device(), desc, hull);
        if (!id)
            return id.error();
        change.made = *id;
        return sim.display_.meets_colliders(sim.params_) ? sim.check_stages() : Status{};
    });
}

// `asked`: the sim that was to have one.
Status Sim::check_meets_meshes(const Sim& asked) const {
    if (desc_.model != PLAIT_MODEL_TRESSFX)
        return {};
    return Error{PLAIT_INVALID_STATE,
                 format("%s of model 0 (tressfx), whose strands do not meet meshes; those of "
                        "articulated do",
                        &asked == this ? "the sim is" : "one of the sims that share colliders is")};
}

Status Sim::open_planes(bool of_sheets) {
    PartNeeds needs = part_needs();
    needs.plane = true;
    needs.hollow = needs.hollow || of_sheets;
    return model_->open(device(), needs);
}

Result<plait_collider_id> Sim::create_mesh_collider(const Mesh& mesh,
                                                    const plait_collider_mesh_desc& desc) {
    PLAIT_TRY(for_each_sharer([this](Sim& sim) { return sim.check_meets_meshes(*this); }));
    return desc.form == PLAIT_MESH_FORM_NEAREST ? create_bending(mesh, desc)
                                                : create_field(mesh, desc);
}

Result<plait_collider_id> Sim::create_field(const Mesh& mesh,
                                            const plait_collider_mesh_desc& desc) {
    Memory* const memory = &context_.memory;
    const auto field = share_in<MeshField>(memory, memory);
    PLAIT_TRY(bake_field(mesh, {desc.cells, desc.two_sided != 0}, *field));
    if (desc.two_sided && context_.log.callback)
        context_.log(
            PLAIT_LOG_LEVEL_WARNING,
            "sim: a sheet (two_sided) of form FIELD keeps no hair on its side: what a step "
            "carries through it stays there; a hood, a collar or a sleeve is of form "
            "NEAREST");
    return create_in_all([&](Sim& sim, Change& change) -> Status {
        const auto id = sim.colliders_.create_mesh(sim.device(), desc);
        if (!id)
            return id.error();
        change.made = *id;
        PLAIT_TRY(sim.open_planes(false));
        MeshColliders::Entry entry{*sim.colliders_.find(*id), field,
                                   ClearanceRules{desc.margin, desc.clearance},
                                   std::pmr::vector<float>(memory)};
        PLAIT_TRY(sim.measure(entry, desc.pose));
        auto next =
            sim.meshes_.make(sim.device(), sim.meshes_.with(std::move(entry)), meshes_.set());
        if (!next)
            return next.error();
        change.meshes.fields.emplace(std::move(*next));
        sim.swap(change.meshes);
        return sim.check_stages();
    });
}

Result<plait_collider_id> Sim::create_bending(const Mesh& mesh,
                                              const plait_collider_mesh_desc& desc) {
    Memory* const memory = &context_.memory;
    if (desc.two_sided == 0)
        PLAIT_TRY(check_sides(mesh));
    const auto surface = share_in<BendingSurface>(memory, desc.two_sided != 0, memory);
    surface->set.positions = mesh.surface.positions;
    surface->set.triangles = mesh.surface.triangles;
    surface->tree.build(surface->set);
    const MeshDistance distance(surface->set, memory);
    return create_in_all([&](Sim& sim, Change& change) -> Status {
        const auto id = sim.colliders_.create_mesh(sim.device(), desc);
        if (!id)
            return id.error();
        change.made = *id;
        PLAIT_TRY(sim.open_planes(desc.two_sided != 0));
        BendingMeshes::Entry entry(*sim.colliders_.find(*id), surface, memory);
        entry.rules = {desc.margin, desc.clearance};
        entry.begin();
        PLAIT_TRY(sim.measure(entry, distance, desc.pose));
        auto entries = sim.bending_.with(sim.device(), std::move(entry));
        if (!entries)
            return entries.error();
        auto next = sim.bending_.make(sim.device(), std::move(*entries), bending_.set());
        if (!next)
            return next.error();
        change.meshes.nearest.emplace(std::move(*next));
        sim.swap(change.meshes);
        return sim.check_stages();
    });
}

Status Sim::destroy_collider(plait_collider_id id) {
    const auto slot = colliders_.find(id);
    if (!slot)
        return slot.error();
    const bool mesh = Colliders::is_mesh(colliders_.slots()[*slot]);
    const bool bends = Colliders::bends(colliders_.slots()[*slot]);
    std::pmr::vector<MeshSets> left(&context_.memory); // of each sim, without it
    PLAIT_TRY(for_each_sharer([&](Sim& sim) -> Status {
        MeshSets& sets = left.emplace_back();
        if (bends) {
            auto entries = sim.bending_.without(sim.device(), *slot);
            if (!entries)
                return entries.error();
            auto next = sim.bending_.make(sim.device(), std::move(*entries),
                                          left.size() > 1 ? *left.front().nearest : bending_.set());
            if (!next)
                return next.error();
            sets.nearest.emplace(std::move(*next));
        } else if (mesh) {
            auto next = sim.meshes_.make(sim.device(), sim.meshes_.without(*slot),
                                         left.size() > 1 ? *left.front().fields : meshes_.set());
            if (!next)
                return next.error();
            sets.fields.emplace(std::move(*next));
        }
        return {};
    }));
    auto next = left.begin();
    return for_each_sharer([&](Sim& sim) {
        sim.stir();
        sim.swap(*next++);
        Status status = sim.colliders_.destroy(id);
        if (mesh)
            (void)sim.model_->open(sim.device(), sim.part_needs()); // which makes nothing
        return status;
    });
}

// ---- moving -------------------------------------------------------------------------------------

Status Sim::set_collider_pose(plait_collider_id id, const plait_pose& pose) {
    return for_each_sharer([&](Sim& sim) {
        const auto slot = sim.colliders_.find(id);
        if (slot && !same_pose(sim.colliders_.slots()[*slot].target, pose))
            sim.stir();
        return sim.colliders_.set_pose(id, pose);
    });
}

Status Sim::set_collider_shape(plait_collider_id id, const plait_collider_desc& desc) {
    return for_each_sharer([&](Sim& sim) {
        sim.stir();
        return sim.colliders_.set_shape(id, desc);
    });
}

Status Sim::set_collider_positions(plait_collider_id id, std::span<const float> positions) {
    const auto slot = bending_slot(id);
    if (!slot)
        return slot.error();
    const auto rows = bending_.rows_of(*slot, positions);
    if (!rows)
        return rows.error();
    return for_each_sharer([&](Sim& sim) {
        sim.stir();
        return sim.bending_.set_positions(sim.device(), *slot, *rows);
    });
}

Status Sim::take_positions(plait_collider_id id, uint32_t words) {
    const auto slot = bending_slot(id);
    if (!slot)
        return slot.error();
    return for_each_sharer([&](Sim& sim) {
        sim.stir();
        sim.schedule_.clear();
        sim.bending_.take_positions(sim.schedule_, *slot, taken_, words);
        return sim.submit();
    });
}

Status Sim::place_collider(plait_collider_id id, const plait_pose& pose) {
    const auto slot = colliders_.find(id);
    if (!slot)
        return slot.error();
    const bool bends = Colliders::bends(colliders_.slots()[*slot]);
    return for_each_sharer([&](Sim& sim) -> Status {
        sim.stir();
        if (bends) {
            PLAIT_TRY(sim.bending_.forget_sides(sim.device(), *slot));
            sim.schedule_.clear();
            sim.bending_.place(sim.schedule_, *slot);
            PLAIT_TRY(sim.submit());
        }
        return sim.colliders_.place(id, pose);
    });
}

} // namespace plait
