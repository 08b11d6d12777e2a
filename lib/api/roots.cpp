#include "api/roots.hpp"

#include "api/structs.hpp"
#include "api/view.hpp"

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

} // namespace

Status read_roots(const plait_roots* given, RootsCopy& copy) {
    plait_roots roots{};
    roots.head = identity_pose;
    PLAIT_TRY(read_struct(given, roots, "roots"));
    const auto head = checked_pose(roots.head, "roots->head");
    if (!head)
        return head.error();
    copy.head = *head;
    if (roots.root_poses.count > 0 && roots.bones.count > 0)
        return invalid("roots->root_poses and roots->bones are both given, give one");
    PLAIT_TRY(read_own(roots.root_poses, copy));
    return read_bones(roots.bones, copy);
}

} // namespace plait::api
