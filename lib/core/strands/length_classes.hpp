// Strands of one length lie together: a lane has the rows of the longest strand in its part.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// How strands are divided by their numbers of vertices, so that short ones do not pay for long
// ones. It depends on these numbers alone, not on settings, parameters or the device: a strand stays
// in its class, and a snapshot restores elsewhere.
class LengthClasses {
  public:
    // `counts`: vertices of each strand, 2 to PLAIT_MAX_VERTICES.
    LengthClasses(std::span<const uint32_t> counts, std::pmr::memory_resource* memory);

    // Vertices of each class's longest strand, ascending.
    std::span<const uint32_t> rows() const { return rows_; }
    // Of the class of a strand of `count` vertices.
    uint32_t row_of(uint32_t count) const {
        return *std::lower_bound(rows_.begin(), rows_.end(), count);
    }

  private:
    std::pmr::vector<uint32_t> rows_;
};

} // namespace plait
