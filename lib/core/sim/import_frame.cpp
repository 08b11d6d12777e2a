#include "core/sim/import_frame.hpp"

#include "core/base/pose.hpp"

#include <algorithm>

namespace plait {
namespace {

void turn_axes(float* p, plait_axes axes) {
    const float y = p[1], z = p[2];
    switch (axes) {
    case PLAIT_AXES_Z_UP:
        p[1] = z;
        p[2] = -y;
        break;
    case PLAIT_AXES_Y_UP_LEFT_HANDED:
        p[2] = -z;
        break;
    case PLAIT_AXES_Z_UP_LEFT_HANDED:
        p[1] = z;
        p[2] = y;
        break;
    default:
        break;
    }
}

bool is_identity(const plait_pose& pose) {
    return std::ranges::equal(pose.q, identity_pose.q) &&
           std::ranges::equal(pose.t, identity_pose.t);
}

} // namespace

// Three turns by a right angle are one back; a reflection is its own reverse.
void turn_to_axes(float* point, plait_axes axes) {
    for (int turn = 0; turn < (axes == PLAIT_AXES_Z_UP ? 3 : 1); ++turn)
        turn_axes(point, axes);
}

bool reflects(plait_axes axes) {
    return axes == PLAIT_AXES_Y_UP_LEFT_HANDED || axes == PLAIT_AXES_Z_UP_LEFT_HANDED;
}

void place_points(std::span<float> positions, plait_axes axes, const plait_pose& pose) {
    const bool stays = is_identity(pose);
    for (size_t i = 0; i + 2 < positions.size(); i += 3) {
        float* const p = &positions[i];
        turn_axes(p, axes);
        if (stays)
            continue;
        const float from[3] = {p[0], p[1], p[2]};
        transform(pose, from, p);
    }
}

} // namespace plait
