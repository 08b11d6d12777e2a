// The choices of the public header as kernels know them. The public header stands alone and cannot
// take the list of params.h; so both have one, and here they are held to be the same.
#pragma once

#include <plait/params.h>
#include <plait/plait.h>

#include <type_traits>

namespace plait {

template <typename Choice> constexpr plait_u32 of_kernels(Choice choice) {
    static_assert(std::is_enum_v<Choice>);
    return static_cast<plait_u32>(choice);
}

static_assert(of_kernels(PLAIT_WIND_FORM_PUBLISHED) == PLAIT_WIND_PUBLISHED);
static_assert(of_kernels(PLAIT_WIND_FORM_DRAG) == PLAIT_WIND_DRAG);
static_assert(of_kernels(PLAIT_FOLLOW_FORM_PUBLISHED) == PLAIT_FOLLOW_PUBLISHED);
static_assert(of_kernels(PLAIT_FOLLOW_FORM_ROTATING) == PLAIT_FOLLOW_ROTATING);
static_assert(of_kernels(PLAIT_SHOCK_FORM_THRESHOLD) == PLAIT_SHOCK_THRESHOLD);
static_assert(of_kernels(PLAIT_SHOCK_FORM_CONTINUOUS) == PLAIT_SHOCK_CONTINUOUS);
static_assert(of_kernels(PLAIT_SLOT_HASH_RULE_THESIS) == PLAIT_SLOT_HASH_THESIS);
static_assert(of_kernels(PLAIT_SLOT_HASH_RULE_PCG) == PLAIT_SLOT_HASH_PCG);
static_assert(of_kernels(PLAIT_TENT_FORM_VOXEL) == PLAIT_TENT_VOXEL);
static_assert(of_kernels(PLAIT_TENT_FORM_TRILINEAR) == PLAIT_TENT_TRILINEAR);
static_assert(of_kernels(PLAIT_DIFFUSE_RULE_THESIS) == PLAIT_DIFFUSE_THESIS);
static_assert(of_kernels(PLAIT_DIFFUSE_RULE_FLOORED) == PLAIT_DIFFUSE_FLOORED);

} // namespace plait
