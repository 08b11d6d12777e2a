#include "api/roots.hpp"

#include "api/structs.hpp"
#include "api/view.hpp"
#include "core/base/ranges.hpp"

#include <cmath>

namespace plait::api {
namespace {

Status read_own(const plait_view& view, RootsCopy& copy) {
    PLAIT_TRY(copy_view(view, 1, "roots->root_poses", copy.own));
    for (size_t i = 0; i < copy.own.size(); ++i) {
        const auto pose = checked_pose(copy.own[i], "roots->root_poses");
        if (!pose)
            return invalid(format("%s, at index %zu", pose.error().message.c_str(), i));
        copy.own[i] = *pose;
    }
    return {};
}

Status read_bones(const plait_view& view, RootsCopy& copy) {
    PLAIT_TRY(copy_view(view, 1, "roots->bones", copy.bones));
    for (size_t bone = 0; bone < copy.bones.size(); ++bone)
        for (size_t i = 0; i < 12; ++i)
            if (const float value = copy.bones[bone][i]; !(std::abs(value) <= 1e6f))
                return invalid(format("roots->bones[%zu][%zu] is %g, range is [-1e6, 1e6]", bone, i,
                                      double(value)));
    return {};
}

Status read_mesh_positions(const plait_view& view, RootsCopy& copy) {
    PLAIT_TRY(copy_view(view, 1, "roots->mesh_positions", copy.mesh));
    for (size_t vertex = 0; vertex < copy.mesh.size(); ++vertex)
        for (const float value : copy.mesh[vertex])
            if (!(std::abs(value) <= 1e6f))
                return invalid(format("roots->mesh_positions[%zu]: coordinate is %g, range is "
                                      "[-1e6, 1e6] m",
                                      vertex, double(value)));
    return {};
}

// Of the ways to say where roots are at most one is given.
Status check_one_way(const plait_roots& roots) {
    const std::pair<const char*, const plait_view*> ways[] = {
        {"root_poses", &roots.root_poses},
        {"bones", &roots.bones},
        {"mesh_positions", &roots.mesh_positions}};
    const char* given = nullptr;
    for (const auto& [name, view] : ways) {
        if (view->count == 0)
            continue;
        if (given)
            return invalid(format("roots->%s and roots->%s are both given, give one", given, name));
        given = name;
    }
    return {};
}

} // namespace

plait_roots default_roots() {
    plait_roots roots{};
    roots.struct_size = sizeof roots;
    roots.head = identity_pose;
    roots.scale = 1;
    return roots;
}

Status read_roots(const plait_roots* given, RootsCopy& copy) {
    plait_roots roots = default_roots();
    PLAIT_TRY(read_struct(given, roots, "roots"));
    const auto head = checked_pose(roots.head, "roots->head");
    if (!head)
        return head.error();
    copy.head = *head;
    PLAIT_TRY(check_range("roots->scale", double(roots.scale), 1e-3f, 1e3));
    copy.scale = roots.scale;
    PLAIT_TRY(check_one_way(roots));
    PLAIT_TRY(read_own(roots.root_poses, copy));
    PLAIT_TRY(read_bones(roots.bones, copy));
    return read_mesh_positions(roots.mesh_positions, copy);
}

} // namespace plait::api
