// Colliders.
#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "core/params/params.hpp"

#include <algorithm>

using namespace plait;

namespace {

plait_collider_desc default_collider() {
    plait_collider_desc desc{};
    desc.struct_size = sizeof desc;
    desc.capsule.radius_a = desc.capsule.radius_b = 0.1f;
    desc.plane.normal[1] = 1;
    std::fill_n(desc.box.half_extents, 3, 0.1f);
    desc.box.orientation[3] = 1;
    desc.friction = 0.3f;
    desc.pose = identity_pose;
    return desc;
}

Result<plait_collider_desc> read_collider(const plait_collider_desc* desc) {
    plait_collider_desc given = default_collider();
    PLAIT_TRY(api::read_struct(desc, given, "desc"));
    PLAIT_TRY(check_collider(given));
    const auto pose = checked_pose(given.pose, "desc->pose");
    if (!pose)
        return pose.error();
    given.pose = *pose;
    return given;
}

plait_collider_mesh_desc default_mesh_collider() {
    plait_collider_mesh_desc desc{};
    desc.struct_size = sizeof desc;
    desc.cells = 48;
    desc.margin = 5e-4f;
    desc.friction = 0.3f;
    desc.clearance = 1;
    desc.pose = identity_pose;
    return desc;
}

Result<plait_collider_mesh_desc> read_mesh_collider(const plait_collider_mesh_desc* desc) {
    plait_collider_mesh_desc given = default_mesh_collider();
    PLAIT_TRY(api::read_struct(desc, given, "desc"));
    PLAIT_TRY(check_mesh_collider(given));
    const auto pose = checked_pose(given.pose, "desc->pose");
    if (!pose)
        return pose.error();
    given.pose = *pose;
    return given;
}

plait_collider_hull_desc default_hull() {
    plait_collider_hull_desc desc{};
    desc.struct_size = sizeof desc;
    desc.friction = 0.3f;
    desc.tolerance = 1e-4f;
    desc.pose = identity_pose;
    return desc;
}

Result<plait_collider_hull_desc> read_hull(const plait_collider_hull_desc* desc) {
    plait_collider_hull_desc given = default_hull();
    PLAIT_TRY(api::read_struct(desc, given, "desc"));
    PLAIT_TRY(check_hull_collider(given));
    const auto pose = checked_pose(given.pose, "desc->pose");
    if (!pose)
        return pose.error();
    given.pose = *pose;
    return given;
}

} // namespace

extern "C" {

void plait_collider_desc_init(plait_collider_desc* desc, size_t size) {
    api::init_struct(desc, size, default_collider());
}

plait_result plait_collider_create(plait_sim* sim, const plait_collider_desc* desc,
                                   plait_collider_id* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(out, "out"));
        const auto given = read_collider(desc);
        if (!given)
            return given.error();
        const auto id = sim->sim.create_collider(*given);
        if (!id)
            return id.error();
        *out = *id;
        return {};
    });
}

void plait_collider_mesh_desc_init(plait_collider_mesh_desc* desc, size_t size) {
    api::init_struct(desc, size, default_mesh_collider());
}

plait_result plait_collider_create_mesh(plait_sim* sim, const plait_mesh* mesh,
                                        const plait_collider_mesh_desc* desc,
                                        plait_collider_id* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(mesh, "mesh"));
        PLAIT_TRY(api::need(out, "out"));
        const auto given = read_mesh_collider(desc);
        if (!given)
            return given.error();
        const auto id = sim->sim.create_mesh_collider(mesh->mesh, *given);
        if (!id)
            return id.error();
        *out = *id;
        return {};
    });
}

void plait_collider_hull_desc_init(plait_collider_hull_desc* desc, size_t size) {
    api::init_struct(desc, size, default_hull());
}

plait_result plait_collider_create_hull(plait_sim* sim, const plait_mesh* mesh,
                                        const plait_collider_hull_desc* desc,
                                        plait_collider_id* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(mesh, "mesh"));
        PLAIT_TRY(api::need(out, "out"));
        const auto given = read_hull(desc);
        if (!given)
            return given.error();
        const auto id = sim->sim.create_hull_collider(mesh->mesh, *given);
        if (!id)
            return id.error();
        *out = *id;
        return {};
    });
}

plait_result plait_collider_set_pose(plait_sim* sim, plait_collider_id collider,
                                     const plait_pose* pose) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(pose, "pose"));
        const auto checked = checked_pose(*pose, "pose");
        if (!checked)
            return checked.error();
        return sim->sim.set_collider_pose(collider, *checked);
    });
}

plait_result plait_collider_place(plait_sim* sim, plait_collider_id collider,
                                  const plait_pose* pose) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(pose, "pose"));
        const auto checked = checked_pose(*pose, "pose");
        if (!checked)
            return checked.error();
        return sim->sim.place_collider(collider, *checked);
    });
}

plait_result plait_collider_set_positions(plait_sim* sim, plait_collider_id collider,
                                          const plait_view* positions) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(positions, "positions"));
        std::pmr::vector<float> values(&sim->memory());
        PLAIT_TRY(api::copy_view(*positions, 3, "positions", values));
        return sim->sim.set_collider_positions(collider, values);
    });
}

plait_result plait_collider_set_shape(plait_sim* sim, plait_collider_id collider,
                                      const plait_collider_desc* desc) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        const auto given = read_collider(desc);
        if (!given)
            return given.error();
        return sim->sim.set_collider_shape(collider, *given);
    });
}

plait_result plait_collider_describe(const plait_sim* sim, plait_collider_id collider,
                                     plait_collider_desc* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::check_output(out, "out"));
        const auto desc = sim->sim.colliders().describe(collider);
        if (!desc)
            return desc.error();
        api::write_struct(out, *desc);
        return {};
    });
}

plait_result plait_colliders_list(const plait_sim* sim, plait_collider_id* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(count, "count"));
        const Colliders& colliders = sim->sim.colliders();
        *count = dst ? colliders.list({dst, *count}) : colliders.count();
        return {};
    });
}

plait_result plait_collider_destroy(plait_sim* sim, plait_collider_id collider) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        return sim->sim.destroy_collider(collider);
    });
}
plait_result plait_sim_share_colliders(plait_sim* sim, plait_sim* with) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        if (with == sim)
            return api::invalid("with is the sim itself");
        if (with && &with->owner != &sim->owner)
            return api::invalid("with is of another context");
        return sim->sim.share_colliders(with ? &with->sim : nullptr);
    });
}
}
