// How sims come to share colliders, and how that ends.
#include "base/format.hpp"
#include "core/mesh/mesh_distance.hpp"
#include "core/sim/sim.hpp"

#include <algorithm>

namespace plait {

bool Sim::shares_with(const Sim& other) const {
    const Sim* each = sharer_;
    while (each != this && each != &other)
        each = each->sharer_;
    return each == &other;
}

void Sim::leave() {
    Sim* before = this;
    while (before->sharer_ != this)
        before = before->sharer_;
    before->sharer_ = sharer_;
    sharer_ = this;
}

Status Sim::share_colliders(Sim* with) {
    stir();
    if (!with) {
        leave();
        return {};
    }
    if (shares_with(*with))
        return {};
    if (sharer_ != this)
        return Error{PLAIT_INVALID_STATE, "the sim shares the colliders of others already: end "
                                          "that first, by with = NULL"};
    if (with->colliders_.meshes() > 0)
        PLAIT_TRY(check_meets_meshes(*this));
    PLAIT_TRY(colliders_.count() > 0 ? take_same_bodies(*with) : take_bodies(*with));
    sharer_ = with->sharer_;
    with->sharer_ = this;
    return {};
}

// Of all meshes of another, for the hair of this.
Result<Sim::MeshSets> Sim::measure_meshes_of(Sim& from) {
    const auto pose_of = [&](uint32_t slot) { return from.colliders_.slots()[slot].target; };
    MeshColliders::Entries fields(&context_.memory);
    for (const MeshColliders::Entry& other : from.meshes_.entries()) {
        MeshColliders::Entry entry{other.slot, other.field, other.rules,
                                   std::pmr::vector<float>(&context_.memory)};
        PLAIT_TRY(measure(entry, pose_of(other.slot)));
        fields.push_back(std::move(entry));
    }
    BendingMeshes::Entries nearest(&context_.memory);
    for (size_t i = 0; i < from.bending_.entries().size(); ++i) {
        auto entry = from.bending_.for_other_hair(device(), i, scale_);
        if (!entry)
            return entry.error();
        const MeshDistance distance(entry->surface->set, &context_.memory);
        PLAIT_TRY(measure(*entry, distance, pose_of(entry->slot)));
        nearest.push_back(std::move(*entry));
    }
    MeshSets sets;
    auto of_fields = meshes_.make(device(), std::move(fields), from.meshes_.set());
    if (!of_fields)
        return of_fields.error();
    sets.fields.emplace(std::move(*of_fields));
    auto of_nearest = bending_.make(device(), std::move(nearest), from.bending_.set());
    if (!of_nearest)
        return of_nearest.error();
    sets.nearest.emplace(std::move(*of_nearest));
    return sets;
}

// A sim that has none comes to have those of another, as if it had made them now.
Status Sim::take_bodies(Sim& from) {
    auto sets = measure_meshes_of(from);
    if (!sets)
        return sets.error();
    struct Undo {
        Sim* sim;
        MeshSets* sets;
        std::pmr::vector<Colliders::Slot> slots; // all of them gone
        bool swapped = false;
        ~Undo() {
            if (!sim)
                return;
            if (swapped)
                sim->swap(*sets);
            (void)sim->colliders_.assign(sim->device(), slots,
                                         Colliders::FacesOf(slots.size(), &sim->context_.memory),
                                         sim->scale_);
            (void)sim->model_->open(sim->device(), sim->part_needs());
        }
    };
    const auto own = colliders_.slots();
    Undo undo{this, &*sets, {own.begin(), own.end(), &context_.memory}};
    if (from.colliders_.meshes() > 0)
        PLAIT_TRY(open_planes(from.bending_.has_sheets()));
    PLAIT_TRY(colliders_.take(device(), from.colliders_));
    swap(*sets);
    undo.swapped = true;
    PLAIT_TRY(check_stages());
    bending_.stop(schedule_);
    PLAIT_TRY(submit());
    undo.sim = nullptr;
    return {};
}

bool Sim::are_bodies(std::span<const Colliders::Slot> slots, const Colliders::FacesOf& faces,
                     MeshColliders::Entries& fields, BendingMeshes::Entries& nearest) const {
    const auto same_field = [](const auto& a, const auto& b) {
        return a.slot == b.slot && a.rules == b.rules &&
               (a.field == b.field || *a.field == *b.field);
    };
    const auto same_surface = [](const auto& a, const auto& b) {
        return a.slot == b.slot && a.rules == b.rules && a.two_sided() == b.two_sided() &&
               (a.surface == b.surface || a.surface->set == b.surface->set);
    };
    if (!colliders_.are(slots, faces) ||
        !std::ranges::equal(fields, meshes_.entries(), same_field) ||
        !std::ranges::equal(nearest, bending_.entries(), same_surface))
        return false;
    for (size_t i = 0; i < fields.size(); ++i)
        fields[i].field = meshes_.entries()[i].field;
    for (size_t i = 0; i < nearest.size(); ++i)
        nearest[i].surface = bending_.entries()[i].surface;
    return true;
}

// A sim that has the same already, as after a snapshot, keeps where they are for it.
Status Sim::take_same_bodies(Sim& from) {
    constexpr uint32_t none = UINT32_MAX;
    auto fields = meshes_.without(none);
    auto nearest = bending_.without(device(), none);
    if (!nearest)
        return nearest.error();
    if (!from.are_bodies(colliders_.slots(), colliders_.faces(), fields, *nearest))
        return Error{PLAIT_INVALID_STATE,
                     format("the sim has %u colliders of its own, which are not those of `with` by "
                            "id and shape, those included that were destroyed: destroy them first",
                            colliders_.count())};
    auto of_fields = meshes_.make(device(), std::move(fields), from.meshes_.set());
    if (!of_fields)
        return of_fields.error();
    auto of_nearest = bending_.make(device(), std::move(*nearest), from.bending_.set());
    if (!of_nearest)
        return of_nearest.error();
    meshes_.swap(*of_fields);
    bending_.swap(*of_nearest);
    return {};
}

} // namespace plait
