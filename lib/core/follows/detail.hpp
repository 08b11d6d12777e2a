// What follow strands get after the simulation: clumps, curl, frizz.
#pragma once

#include "core/base/schedule.hpp"
#include "core/strands/state.hpp"

#include <plait/plait.h>

#include <memory_resource>
#include <span>

namespace plait {

plait_detail_desc default_detail_desc();
// INVALID_ARGUMENT names the field, its value and its range.
Status check_detail(const plait_detail_desc& desc);

// The strands of a sim at rest, and what they follow.
struct StrandsAtRest {
    const Layout& layout;
    std::span<const float> rest;      // [4*strands*V], x y z and one that is not read
    std::span<const uint32_t> counts; // [strands]
    std::span<const uint32_t> guides; // [follows], that each follows most
};

class Detail {
  public:
    // `centres`: [follows] or empty. INVALID_ARGUMENT names the strand that is no centre.
    static Result<Detail> create(Device& device, const plait_detail_desc& desc,
                                 std::span<const uint32_t> centres, const StrandsAtRest& strands,
                                 std::pmr::memory_resource* memory);

    explicit operator bool() const { return static_cast<bool>(arc_); }
    // `pose` and `position` are of the same moment; follows are where their guides put them.
    // `wetness`: of guides, or null; drawn by it are follows whose centres are guides.
    void append(Schedule& schedule, const Layout& layout, const Buffer& pose,
                const Buffer& follow_guide, const Buffer& position,
                const Buffer* wetness = nullptr) const;
    uint64_t device_bytes() const;

  private:
    bool clumps() const;
    bool curls() const;

    plait_detail_desc desc_{};
    Buffer centre_; // uint [follows]
    Buffer arc_;    // float [follows*V], m
    Buffer place_;  // float [follows*V]; with clumps only
    Buffer way_;    // float4 [follows]; with curl or frizz only
};

} // namespace plait
