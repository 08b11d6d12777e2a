// Follow strands of a map: placed by the turns of their guides, in two stages.
#pragma once

#include "core/follow_map.hpp"
#include "core/schedule.hpp"
#include "core/state.hpp"

namespace plait {

class FollowTurns {
  public:
    // The first `pinned` vertices of a strand have inverse mass 0, as those of guides.
    static Result<FollowTurns> create(Device& device, const Groom& guides, const FollowMap& map,
                                      const Layout& layout, uint32_t pinned,
                                      std::pmr::memory_resource* memory);

    explicit operator bool() const { return static_cast<bool>(turn_); }
    // `pose` and the guides' rows of `position` are of the same moment.
    void append(Schedule& schedule, const Layout& layout, const State& state, const Buffer& pose,
                const Buffer& position) const;
    const Buffer& rest() const { return rest_; } // roots, then segments
    uint64_t device_bytes() const;

  private:
    Buffer turn_;   // float4 [guides*V]
    Buffer guides_; // uint [4*follows]
    Buffer weight_; // float4 [follows]
    Buffer place_;  // float4 [follows*V]
    Buffer rest_;   // float4 [follows*V]
};

} // namespace plait
