// Linear blend skinning of the roots on the device: one rigid pose per strand from four weighted
// bones.
#pragma once

#include "core/base/layout.hpp"
#include "core/base/schedule.hpp"
#include "core/groom/groom.hpp"
#include "core/strands/state.hpp"

#include <array>
#include <memory_resource>
#include <span>

namespace plait {

using BoneMatrix = std::array<float, 12>; // 3x4 row-major

class Skin {
  public:
    // Without buffers where the groom has no skin.
    static Result<Skin> create(Device& device, const Groom& groom);

    uint32_t bones() const { return bones_; } // 0: no skin
    // How many times as large as at rest bones are, together, and of the one that is farthest from it
    // along its axes.
    struct Scale {
        float all = 1;
        size_t bone = 0;
        std::array<double, 3> of_bone{1, 1, 1};
        bool is_even() const;
    };
    // INVALID_ARGUMENT: too few, a matrix without a closest rotation (rank below two), or one that
    // mirrors.
    Result<Scale> scale_of(std::span<const BoneMatrix> bones,
                           std::pmr::memory_resource* memory) const;
    // Uploads `bones` as they are without their scale `own`, and their places, of which `scale` metres
    // are one of the groom's, and appends what makes the strands' poses of them.
    Status append(Device& device, Schedule& schedule, const Layout& layout, const State& state,
                  std::span<BoneMatrix> bones, float own, float scale, const Buffer& poses) const;
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
