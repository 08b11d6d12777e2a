// Mends one strand at a time so that it can be simulated, counting what it did.
#pragma once

#include "core/base/polyline.hpp"
#include "core/groom/groom.hpp"

#include <unordered_set>

namespace plait {

// Coordinates beyond this leave float32 no digits for hair and overflow when squared.
inline constexpr float max_coordinate = 1e6f; // m
// Strands shorter than this have no direction that float32 squares can hold.
inline constexpr double min_strand_length = 1e-6; // m

class StrandMender {
  public:
    StrandMender(const ImportRules& rules, std::pmr::memory_resource* memory)
        : rules_(rules), memory_(memory), arc_(memory), roots_(memory) {}

    // Mends `strand` in place. False: it cannot be kept (counted).
    Result<bool> mend(size_t index, Points& strand);
    Repairs& repairs() { return repairs_; }

  private:
    struct RootHash {
        size_t operator()(const Point& p) const;
    };

    Status note(plait_repair kind, size_t strand, const std::string& what);
    Result<bool> has_finite_vertices(size_t index, const Points& strand);
    Result<bool> has_length(size_t index, const Points& strand);
    Status fit_vertex_count(size_t index, Points& strand);
    Result<bool> space_vertices(size_t index, Points& strand);
    Status note_short_segments(size_t index, double shortest, double resolution, bool& any);
    Status note_root(size_t index, const Point& root);

    ImportRules rules_;
    std::pmr::memory_resource* memory_;
    std::pmr::vector<double> arc_; // of the strand in hand
    std::pmr::unordered_set<Point, RootHash> roots_;
    Repairs repairs_;
};

} // namespace plait
