// How much hair lies inside what is drawn with it: head, meshes, body, hands.
#pragma once

#include "scene/figure.hpp"
#include "shot.hpp"

#include <memory>

namespace simulate {

// Of a kind of strands, over the frames looked at. Roots are not counted: they stand in the skin.
struct InsideCount {
    uint64_t vertices = 0;                      // looked at
    uint64_t deeper = 0;                        // of these than `limit`
    double worst_share = 0.0;                   // deeper ones of a frame, of its vertices
    float deepest = 0.0f;                       // m
    uint32_t frame = 0, strand = 0, vertex = 0; // of the deepest

    double share() const {
        return vertices ? static_cast<double>(deeper) / static_cast<double>(vertices) : 0.0;
    }
};

struct InsideReport {
    static constexpr float limit = 0.001f; // m: less is not seen
    uint32_t frames = 0;                   // looked at; 0: a build without Embree, or nothing solid
    double groomed = 0.0;                  // share that lies so deep at rest, of all strands
    InsideCount simulated, following;
};

class Inside {
  public:
    Inside(const Scene& scene, const Figure& figure);
    ~Inside();

    bool wants(uint32_t frame) const; // ten times a second, the first frame among them
    void take(const Shot& shot);
    InsideReport finish(); // of the frames taken since the run before

  private:
    struct State;
    double groomed() const;

    std::unique_ptr<State> state_; // null: nothing to look at
    InsideReport report_;
};

} // namespace simulate
