// How hair leaves the scalp, lies on the head and falls: the walk that every hairstyle starts from.
#pragma once

#include "generator.hpp"
#include "path.hpp"

#include <functional>

namespace plait_generator {

// The direction, not necessarily unit, that hair at p tends to.
using Comb = std::function<Vec3(Vec3 p)>;

// Away from the parting to both sides and backwards; radially from the crown behind it.
Vec3 comb_parted(Vec3 p, double part);

// Below the ears, away from the ridge of the shoulders: down the chest or down the back. `combed`:
// the direction otherwise; `spread`: where in the layer of such hair, [0, 1].
Vec3 comb_past_shoulder(Vec3 combed, Vec3 p, bool before, double spread);

// Down and forward, off the throat.
Vec3 comb_beard(Vec3 p);

// Back over the head and down at its sides.
Vec3 comb_back(Vec3 p);

struct Walk {
    double length;  // m
    double bend;    // m of path in which the direction turns to the comb's: stiffness
    double nearest; // m from the head at the root
    double layer;   // m added to that in the end
    double lift;    // share of the surface normal in the first direction
    bool clear_face;
};

inline constexpr double walk_step = 0.004; // m

// A polyline from `root` with steps of walk_step that follows the comb and never enters the head,
// until its length is reached or stop(p) is true. Hair that has come a longer way over the head
// lies farther from it, on top of the hair that grows below.
Path fall(const Field& field, Vec3 root, const Comb& comb, const Walk& walk,
          const std::function<bool(Vec3 p)>& stop = nullptr);

} // namespace plait_generator
