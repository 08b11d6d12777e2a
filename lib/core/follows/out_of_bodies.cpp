#include "core/follows/out_of_bodies.hpp"

#include "core/mesh/bending_meshes.hpp"
#include "core/mesh/mesh_colliders.hpp"

namespace plait {

void append_out_of_bodies(Schedule& schedule, const Layout& layout, const Bodies& bodies,
                          const Buffer& order, const Buffer& position) {
    const auto params = [&](const ColliderRows& rows) {
        return plait_follow_collide_params{layout.row, layout.guides, rows.count, rows.first};
    };
    const uint32_t follows = layout.follows, row = layout.row;
    const Buffer& colliders = bodies.solids.buffer;
    if (bodies.solids.count > 0)
        schedule.add(PLAIT_STAGE_follow_collide, follows, params(bodies.solids),
                     {&order, &colliders, &position}, row);
    if (const MeshBuffers* const m = bodies.field_buffers)
        schedule.add(PLAIT_STAGE_follow_field, follows, params(bodies.fields),
                     {&order, &colliders, &m->fields->grid, &m->fields->nodes, &m->fields->values,
                      &position},
                     row);
    if (const BendingBuffers* const m = bodies.nearest_buffers)
        schedule.add(PLAIT_STAGE_follow_nearest, follows, params(bodies.nearest),
                     {&order, &colliders, &m->surfaces->first, &m->box, &m->surfaces->tree,
                      &m->surfaces->triangle, &m->surfaces->ring, &m->from, &m->to, &m->bends,
                      &position},
                     row);
}

} // namespace plait
