// The plait.
#pragma once

#include "generator.hpp"
#include "path.hpp"

#include <array>

namespace plait_generator {

// Hair combed back to a gathering at the nape, from where three bundles cross over one another.
class BraidedHair {
  public:
    // Keeps references to both.
    BraidedHair(const Style& style, const std::vector<Vec3>& roots);

    Path strand(uint32_t i) const;

    // Which of the three bundles strand i is in.
    uint32_t bundle(uint32_t i) const;

    // Middle of a bundle, `along` metres after the gathering, measured down the braid.
    Vec3 bundle_middle(uint32_t bundle, double along) const;

    // Radius of a bundle there.
    double bundle_radius(double along) const;

  private:
    struct Frame {
        Vec3 middle, across, out; // across: to the right; out: away from the back
    };
    Frame frame(double along) const;
    Vec3 in_bundle(uint32_t i, double along) const;
    double end_of(uint32_t i) const;
    double joins_at(uint32_t i) const;
    Path to_gathering(uint32_t i) const;

    const Style& style_;
    const std::vector<Vec3>& roots_;
    Field field_;
    Path axis_;   // of the whole braid, points 4 mm apart
    double side_; // |x| of a root beyond which it belongs to a side bundle
};

} // namespace plait_generator
