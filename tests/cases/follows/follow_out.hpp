// Follow strands that run through bodies, for the stages that turn them out.
#pragma once

#include "follows/follow_detail.hpp"
#include "mesh/mesh_inputs.hpp"

namespace plait::cases {

// Strands of length beside the guides: outside of what add_body_row() places, but for what they run into.
FollowHair hair_through_bodies(const Size& size, uint32_t seed);

// Which lane each has: in another order.
Array lanes_of(const FollowHair& hair);

// The row in `collider` of a mesh of some 4 cm in size, turned, that a follow strand runs into on its way,
// or, `around_root`, that holds its root.
void add_body_row(std::vector<float>& rows, Random& random, const FollowHair& hair,
                  const Size& size, uint32_t follow, bool around_root, float share = 0);

// What is not read of rows of meshes, and of positions.
std::vector<std::string> out_unread();

plait_follow_collide_params out_params(const Size& size, uint32_t count);

} // namespace plait::cases
