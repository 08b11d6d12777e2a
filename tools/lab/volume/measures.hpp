// What is measured of hair that is to keep its volume.
#pragma once

#include "cloud.hpp"

#include <array>
#include <utility>

namespace lab::volume {

struct Room {
    double volume; // m^3: (sum of masses)^2 over the sum of their squares in cells of 12 mm
    double height; // m, over the ball, mean of what is above its equator
};
Room room_of(const Cloud& cloud);

double strand_length(const Cloud& rest, uint32_t row); // m, mean
double way(const Cloud& before, const Cloud& now);     // m, rms of all vertices

// |sum of m dv| over the sum of m |dv|; 0 where nothing changes.
double momentum_change(const Cloud& cloud, const std::vector<Vec3>& changed);
// Of kinetic energy about the mean velocity, over what there is.
double energy_change(const Cloud& cloud, const std::vector<Vec3>& changed);

// Pairs of vertices of different strands that lie within 12 mm of one another at rest.
class Neighbours {
  public:
    Neighbours(const Cloud& rest, uint32_t row);
    double kept(const Cloud& now) const;  // share that still does
    double crowd(const Cloud& now) const; // such pairs now, over those at rest

  private:
    uint32_t row_;
    std::vector<std::pair<size_t, size_t>> pairs_;
};

} // namespace lab::volume
