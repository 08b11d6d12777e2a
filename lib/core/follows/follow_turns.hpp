// Follow strands of a map: placed by the turns of their guides, in two stages.
#pragma once

#include "core/base/lane_layout.hpp"
#include "core/base/schedule.hpp"
#include "core/follows/follow_map.hpp"
#include "core/strands/state.hpp"

namespace plait {

class FollowTurns {
  public:
    struct Rules {
        uint32_t pinned; // vertices of a strand, of inverse mass 0, as those of guides
        uint32_t tile;   // strands, of the lane layout
        // Strands, guides among them, after which those that are placed may end; empty: all are.
        std::span<const uint32_t> ends;
    };
    static Result<FollowTurns> create(Device& device, const Groom& guides, const FollowMap& map,
                                      const Layout& layout, const Rules& rules,
                                      std::pmr::memory_resource* memory);

    explicit operator bool() const { return static_cast<bool>(turn_); }
    // `pose` and the guides' rows of `guides` are of the same moment. Of follows so many as `layout`
    // has are placed, in `position`.
    void append(Schedule& schedule, const Layout& layout, const State& state, const Buffer& pose,
                const Buffer& guides, const Buffer& position) const;
    // [4*follows*V]: roots, then segments. Waits.
    Status read_rest(Device& device, const Layout& layout, std::span<float> rest,
                     std::pmr::memory_resource* memory) const;
    const Buffer& order() const { return order_; } // follow of each lane
    uint64_t device_bytes() const;

  private:
    LaneLayout lanes(const Layout& layout) const { return {layout.follows, layout.row, tile_}; }

    Buffer turn_;   // float4 [guides*V]
    Buffer bound_;  // float4 [guides*V]: where guides have not turned; none: at rest
    Buffer order_;  // uint [follows]: of each lane
    Buffer guides_; // uint [4*follows], lane by lane
    Buffer weight_; // float4 [follows], lane by lane
    Buffer place_;  // 4 components in the lane layout
    Buffer rest_;   // 4 components in the lane layout
    uint32_t tile_ = 1;
};

} // namespace plait
