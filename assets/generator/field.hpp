// The head's distance field sampled once, for walks that ask for it a hundred times a strand.
#pragma once

#include "vec.hpp"

#include <array>
#include <vector>

namespace plait_generator {

struct Surroundings {
    double distance; // to the mannequin, m
    Vec3 normal;     // unit, away from it
};

// Trilinear on a lattice of 5 mm: within 0.1 mm of head_distance near the scalp, worse at the nose
// and ears. Beyond the lattice everything is far.
class Field {
  public:
    Field();
    Surroundings at(Vec3 p) const;

  private:
    double value(size_t i, size_t j, size_t k) const {
        return values_[i + size_[0] * (j + size_[1] * k)];
    }

    std::array<size_t, 3> size_;
    std::vector<float> values_;
};

} // namespace plait_generator
