// A ponytail: hair combed back to a holder behind the head and falling free from there.
#pragma once

#include "field.hpp"
#include "generator.hpp"
#include "path.hpp"

namespace plait_generator {

class TiedHair {
  public:
    // Keeps references to both.
    TiedHair(const Style& style, const std::vector<Vec3>& roots);

    Path strand(uint32_t i) const;

    // The middle of the holder.
    Vec3 holder() const { return axis_.front(); }

  private:
    Vec3 in_tail(uint32_t i, double along) const;
    double tail_radius(double along) const;
    Path to_holder(uint32_t i) const;

    const Style& style_;
    const std::vector<Vec3>& roots_;
    Field field_;
    Path axis_;                 // of the tail, points 4 mm apart
    std::vector<Vec3> normals_; // across the axis, one to a point
};

} // namespace plait_generator
