// How the head moves: named motions by formula, or keyframes from a file.
#pragma once

#include "common.hpp"

#include <plait/plait.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace simulate {

// Of the head about its pivot: turns in degrees, moves in metres.
struct HeadState {
    float yaw = 0.0f;   // about +y: positive looks towards +x
    float pitch = 0.0f; // about +x: positive looks down
    float roll = 0.0f;  // about +z: positive leans towards -x
    float x = 0.0f, y = 0.0f, z = 0.0f;
};

struct Keyframe {
    float time; // s
    HeadState head;
};

class Motion {
  public:
    virtual ~Motion() = default;
    virtual HeadState at(float time) const = 0;
};

// A name, or a file that ends in .csv or .json. Throws Failure.
std::unique_ptr<Motion> make_motion(const std::string& name_or_file);

// `keys` in increasing time; Catmull-Rom in between, held still before and after.
std::unique_ptr<Motion> make_keyframed(std::vector<Keyframe> keys);

// One of a list in JSON. Throws Failure.
Keyframe read_keyframe(JsonReader& in);

// "" if they can be followed; else what is wrong with them: "has no keyframes", ...
std::string keyframe_problem(const std::vector<Keyframe>& keys);

// p maps to R (p - pivot) + pivot + move, R = yaw * pitch * roll.
plait_pose to_pose(const HeadState& head, const std::array<float, 3>& pivot);

} // namespace simulate
