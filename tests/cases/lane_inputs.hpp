// Strands in the lane layout for the cases: random rods near a pose that their material can hold.
#pragma once

#include "inputs.hpp"

namespace plait::cases {

// Arrays are [strand][V][components]; the runner lays them out for the device's tile.
struct LaneHair {
    Hair hair; // rest shape, poses, counts
    std::vector<float> material, rest;
    std::vector<float> x, v, q, q_before, x_before, v_before;
    std::vector<float> normal_force; // N
    std::vector<float> capsules;     // float4 [6*colliders]; empty: none
    std::vector<float> faces;        // float4, of hulls, whose rows say where in them theirs begin
};

// A strand is at its pose, bent and turned a little in every joint, and moves.
LaneHair make_lane_hair(const Size& size, uint32_t seed);
// With a moving capsule near the middle of every strand, of friction 0.3 or as given; every third
// starts inside it.
LaneHair make_lane_hair_in_contact(const Size& size, uint32_t seed, float friction);
// With a wider capsule at the middle of every strand that moves less and that the substep before pressed it to,
// by a force of the size of its weight.
LaneHair make_lane_hair_calm(const Size& size, uint32_t seed);
LaneHair make_lane_hair_pressed(const Size& size, uint32_t seed, float friction);
// With moving boxes, some of them rounded, capsules, and a plane under all; in some a strand starts
// inside. Before them in the buffer `far` that no strand meets.
LaneHair make_lane_hair_on_surfaces(const Size& size, uint32_t seed, float friction, uint32_t far);
// With a moving hull near the middle of every strand, some with a margin; every third starts inside.
LaneHair make_lane_hair_on_hulls(const Size& size, uint32_t seed, float friction);
// Inside of a moving capsule, box or hull around all of it, out of which the vertex farthest out begins.
LaneHair make_lane_hair_in_room(const Size& size, uint32_t seed, float kind, float friction);
inline constexpr float room_kinds[] = {PLAIT_KIND_CAPSULE, PLAIT_KIND_BOX, PLAIT_KIND_HULL};
const std::vector<Size>& contact_sizes();
// Turned so fast that a solve, cut short, leaves more energy than a strand may keep.
LaneHair make_lane_hair_spun(const Size& size, uint32_t seed);
// Wrung in every joint though soft in twist, and fast in the substep before: a share of any shows.
LaneHair make_lane_hair_wrung(const Size& size, uint32_t seed);

// `count` different numbers below `strands`, not in order where there is a choice.
std::vector<uint32_t> other_order(uint32_t strands, uint32_t count);

// The same strands in the same lanes, whose rows of `buffers` lie in another order: of `rest` and `pose`
// where none are named.
Setup reordered(Setup setup, std::initializer_list<size_t> buffers = {1, 2});

// A long substep under strong forces, so that 1 % of any of them shows.
plait_lane_params lane_params(const Size& size, uint32_t iterations, uint32_t bdf2);
// BDF2 and a tenth of the gravity: velocities change by more than it does, and no pairs count.
plait_lane_params lane_params_afloat(const Size& size, uint32_t iterations);

// The setup of a stage over lanes: `bends` with orientations.
Setup lane_setup(const Size& size, const LaneHair& hair, const plait_lane_params& params,
                 bool bends);
// Of `articulated`, on surfaces of every kind, alone and behind 70 others.
void add_rods_on_surfaces(Case& result, uint32_t seed);
void add_rods_on_hulls(Case& result);
void add_rods_in_rooms(Case& result);

// Every third vertex has a plane near it, below which some start; or it is pressed to one.
Setup on_planes(Setup setup, const LaneHair& hair, float friction, bool bends,
                bool pressed = false);
void add_rods_on_planes(Case& result); // of friction 0.3 and 100
void add_rods_among_strands(Case& result);

// The tip of every strand is pinned, and of those of more than five vertices the middle, to places
// a centimetre off; every second by springs far stiffer than its inertia.
Setup pinned(Setup setup, const LaneHair& hair, bool bends);
void add_pinned(Case& result, bool bends);

// The same lanes in a sim that has longer strands, too: rows of buffers that hold all strands have
// `more` vertices than the lanes.
Setup in_longer_rows(Setup setup, plait_stage stage, uint32_t more);
// Setups of few vertices so; for the last of a case's.
void add_longer_rows(Case& result);

} // namespace plait::cases
