// Follow strands are kept out of colliders.
#pragma once

#include "core/base/layout.hpp"
#include "core/base/schedule.hpp"
#include "core/contact/bodies.hpp"

namespace plait {

// Follows lie over lanes in `order`; `position`: float4 [strands*V], in which they are moved.
void append_out_of_bodies(Schedule& schedule, const Layout& layout, const Bodies& bodies,
                          const Buffer& order, const Buffer& position);

} // namespace plait
