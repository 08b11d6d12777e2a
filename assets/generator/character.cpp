// The mannequin with bones. What hair grows on is the head bone's alone, so that hair that goes with
// that bone stays on the skin.
#include "head_mesh.hpp"
#include "vec.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plait_generator {
namespace {

constexpr double spacing =
    3.3; // the coarsest at which the mesh has an edge between two triangles only

// Chest, neck, head: in the middle of the ribs, where the neck leaves the shoulders, and in the skull's base.
constexpr Joint joints[] = {{"chest", -1, {0, -0.4f, -0.04f}},
                            {"neck", 0, {0, -0.21f, -0.036f}},
                            {"head", 1, {0, -0.03f, -0.012f}}};

// Along the neck, which leans forward, m: below the first all is the chest's, from the third on the
// head's: the hairline's lowest point is at -0.087, the chin at -0.102.
constexpr double chest_end = -0.24, neck_middle = -0.17, head_begin = -0.09;

void append_skin(Character& character, Vec3 p) {
    const double up = p.y + 0.2 * p.z;
    const double chest = smoothstep(neck_middle, chest_end, up);
    const double head = smoothstep(neck_middle, head_begin, up);
    const bool above = up > neck_middle;
    const auto most = static_cast<float>(above ? head : chest);
    for (const uint8_t bone :
         {static_cast<uint8_t>(above ? 2 : 0), uint8_t{1}, uint8_t{0}, uint8_t{0}})
        character.bones.push_back(bone);
    for (const float weight : {most, 1 - most, 0.0f, 0.0f})
        character.weights.push_back(weight);
}

constexpr int rate = 30; // keys a second
constexpr int keys = 4 * rate + 1;
constexpr double neck_share = 0.35; // of the head's turns
constexpr double lift = 0.02;       // m, of the chest, twice a second

using Quaternion = std::array<double, 4>; // xyzw

// Yaw after pitch, given as tangents of half of them.
Quaternion turned(double yaw, double pitch) {
    const double norm = 1 / std::sqrt((1 + yaw * yaw) * (1 + pitch * pitch));
    return {pitch * norm, yaw * norm, -yaw * pitch * norm, norm};
}

double bump(double from, double to, double t) {
    const double middle = (from + to) / 2;
    return smoothstep(from, middle, t) * smoothstep(to, middle, t);
}

void append_key(Character& character, size_t joint, double t) {
    const double yaw =
        0.36 * (smoothstep(0.3, 0.9, t) - 2 * smoothstep(1.2, 2.0, t) + smoothstep(2.3, 2.9, t));
    const double pitch = 0.14 * (bump(2.8, 3.4, t) + bump(3.4, 4.0, t));
    const double share = joint == 0 ? 0 : joint == 1 ? neck_share : 1 - neck_share;
    for (const double value : turned(share * yaw, share * pitch))
        character.turns.push_back(static_cast<float>(value));
}

} // namespace

Character make_character() {
    Character character;
    character.mesh = make_head_of(spacing);
    character.joints.assign(std::begin(joints), std::end(joints));
    const auto& x = character.mesh.positions;
    for (size_t v = 0; v < x.size(); v += 3)
        append_skin(character, {double(x[v]), double(x[v + 1]), double(x[v + 2])});
    for (int key = 0; key < keys; ++key) {
        const double t = static_cast<double>(key) / rate;
        const double step = 2 * t - std::floor(2 * t); // of half a second
        character.time.push_back(static_cast<float>(t));
        for (size_t axis = 0; axis < 3; ++axis)
            character.chest_at.push_back(
                joints[0].at[axis] +
                (axis == 1 ? static_cast<float>(lift * bump(0, 1, step)) : 0.0f));
    }
    for (size_t joint = 0; joint < std::size(joints); ++joint)
        for (int key = 0; key < keys; ++key)
            append_key(character, joint, static_cast<double>(key) / rate);
    return character;
}

} // namespace plait_generator
