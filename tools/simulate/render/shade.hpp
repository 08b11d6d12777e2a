// Light leaving a point towards the eye.
#pragma once

#include "geometry.hpp"

namespace render {

// Four uniform numbers in [0, 1) that pick this sample's directions.
using Sample = std::array<float, 4>;

Eigen::Vector3f shade(const Geometry& geometry, const Surfel& surfel, const Eigen::Vector3f& to_eye,
                      const Look& look, const Sample& sample);

} // namespace render
