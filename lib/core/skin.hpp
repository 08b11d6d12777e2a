// Linear blend skinning of the roots on the device: one rigid pose per strand from four weighted
// bones.
#pragma once

#include "core/groom.hpp"
#include "core/layout.hpp"
#include "core/schedule.hpp"
#include "core/state.hpp"

#include <span>

namespace plait {

using BoneMatrix = std::array<float, 12>; // 3x4 row-major

class Skin {
  public:
    // Without buffers where the groom has no skin.
    static Result<Skin> create(Device& device, const Groom& groom);

    uint32_t bones() const { return bones_; } // 0: no skin
    // INVALID_ARGUMENT: too few, or a matrix without a closest rotation (rank below two).
    Status check(std::span<const BoneMatrix> bones) const;
    // Uploads `bones`, and appends what makes the strands' poses of them.
    Status append(Device& device, Schedule& schedule, const Layout& layout, const State& state,
                  std::span<const BoneMatrix> bones, const Buffer& poses) const;
    // Appends the same for what is uploaded, to be built.
    void append(Schedule& schedule, const Layout& layout, const State& state,
                const Buffer& poses) const;
    uint64_t device_bytes() const { return index_.bytes() + weight_.bytes() + matrix_.bytes(); }

  private:
    uint32_t bones_ = 0;
    Buffer index_;  // uint [4*guides]
    Buffer weight_; // float [4*guides]
    Buffer matrix_; // float4 [3*bones]
};

} // namespace plait
