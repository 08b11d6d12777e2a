// Elastic energy of a Cosserat strand as far as its vertices show it.
#pragma once

#include "common.hpp"

#include <vector>

namespace lab {

// Straight at rest and clamped, as rods are.
struct ElasticStrand {
    std::vector<double> lengths; // m
    double EA, EI;               // N, N m^2
    Vec3 clamp;                  // direction the root is held in; half a joint
};

// How segments are turned is not among a sim's fields. This is the least that any turns give: a
// segment may lean off its edge (shear) where that saves more bending. So what is found to rise has
// risen, as long as nothing was hidden at the start, as in a strand at rest.
double least_elastic_energy(const ElasticStrand& strand, const std::vector<Vec3>& x);

} // namespace lab
