// Levels of detail of a groom: in each the first so many strands of one order are guides, and the rest
// follows them. So what is a guide in one level is one in all finer ones.
#pragma once

#include "core/follows/hair_frame.hpp"
#include "core/groom/groom.hpp"

namespace plait {

class Levels {
  public:
    static constexpr size_t most = 6;

    explicit Levels(std::pmr::memory_resource* memory)
        : groom_{StrandSet(memory), {}, {}}, order_(memory), guides_(memory), hung_(memory) {}

    // Once, before all else. `guides`: of each level, falling; empty: as many as suit the groom.
    // INVALID_ARGUMENT names the level, the value and the range.
    Status create(const Groom& groom, std::span<const uint32_t> guides, uint64_t seed);
    // After that: where all strands hang. INVALID_ARGUMENT as bind_map.
    Status hang(const RootPoses& roots, const HairFrame& frame);

    std::span<const uint32_t> guides() const { return guides_; }
    size_t strands() const { return groom_.shape.strands; }
    uint32_t longest() const { return groom_.shape.max_vertices; } // vertices
    const Groom& groom() const { return groom_; }
    std::span<const uint32_t> order() const { return order_; } // of the groom's strands
    // Strands of the order after which strands may end that are stepped or shown, ascending: guides of
    // each level, an eighth, a quarter and a half of all, and all.
    std::pmr::vector<uint32_t> ends() const;
    // rms distance of its hair from where all of it is in short steps, over how far hair swings.
    double share(size_t level) const;
    // What a sim of a level is made of; `out` and `map` are empty before. INVALID_ARGUMENT: the level
    // has no guides.
    Status take(size_t level, Groom& out, FollowMap& map) const;

  private:
    Groom groom_;
    std::pmr::vector<uint32_t> order_;  // guides first; any part of it is spread over the head
    std::pmr::vector<uint32_t> guides_; // of each level
    // [3*strands*longest]: rows of all strands where they hang, in the groom's space; empty: as groomed.
    std::pmr::vector<float> hung_;
};

} // namespace plait
