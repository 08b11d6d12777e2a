// Where hair is at one moment, out of a caller's arrays.
#pragma once

#include "api/roots.hpp"
#include "core/follows/hair_frame.hpp"

namespace plait::api {

// `positions`, of that name: rows as long as PLAIT_FIELD_POSITION has them, or any that hold the longest strand.
Status read_hair(const plait_roots* roots, const plait_view& positions, size_t strands,
                 uint32_t longest, RootsCopy& copy, HairFrame& frame,
                 const char* name = "positions");

} // namespace plait::api
