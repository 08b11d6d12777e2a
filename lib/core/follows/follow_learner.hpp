// Weights of a follow map from the motion of all of its strands.
#pragma once

#include "core/follows/hair_frame.hpp"

namespace plait {

class FollowLearner {
  public:
    explicit FollowLearner(std::pmr::memory_resource* memory);

    // Once, before all else. INVALID_ARGUMENT: `groom` is not made of the strands of `map`.
    Status create(const Groom& groom, const FollowMap& map);

    size_t strands() const { return rest_.vertex_counts.size(); }
    uint32_t longest() const { return longest_; } // vertices
    // INVALID_ARGUMENT names the place, the value and the range, and nothing is added.
    Status add(const RootPoses& roots, const HairFrame& frame);

    struct Fit {
        double before = 0, after = 0; // m, rms distance of the follows' vertices
    };
    uint64_t frames() const { return frames_; }
    // `out` is empty before. INVALID_STATE: no frame was added.
    Status learn(FollowMap& out, Fit& fit) const;

  private:
    using Quat = std::array<double, 4>;
    using Gram = std::array<double, FollowMap::per_strand * FollowMap::per_strand>;

    void bind();
    void place_follows();
    void turn_guide(const RootPoses& roots, const HairFrame& frame, size_t guide);
    void add_follow(const RootPoses& roots, const HairFrame& frame, size_t follow);

    FollowMap map_;
    StrandSet rest_; // the groom's strands, where the map has them bound
    uint32_t longest_ = 0;
    std::pmr::vector<uint32_t> origin_; // strands of the groom: guides, then follows
    std::pmr::vector<size_t> first_;    // vertex of each of the groom's strands
    std::pmr::vector<std::array<float, FollowMap::per_strand>>
        place_;                    // of the segment before a vertex, in the guides of its strand
    std::pmr::vector<Quat> turns_; // of the segment after a vertex of a guide, in the last frame
    std::pmr::vector<Gram> grams_; // [follows]
    uint64_t frames_ = 0;
};

} // namespace plait
