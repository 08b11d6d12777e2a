// What a groom is, in numbers a person can judge: how many strands, how large, in which unit.
#pragma once

#include "figure.hpp"

#include <string>
#include <vector>

namespace simulate {

// "long: 10000 strands of 16 vertices, 160000 in all; 0.38 x 0.45 x 0.31 m, 0.41 m long on average;
// 14 colliders of the mannequin"
std::string loaded_line(const Scene& scene, const Figure& figure);

// The unit of length, in metres, in which a groom of this extent is nearest to a head of hair: a
// metre, a centimetre or a millimetre.
float likely_scale(float extent);

// What looks wrong about the size, each a sentence for the user; none: nothing does.
std::vector<std::string> size_warnings(const Scene& scene, const Figure& figure);

// The same of a sag-free start that had to stiffen joints beyond what hair is.
std::vector<std::string> stiffening_warnings(const Scene& scene, const Figure& figure,
                                             const plait_sim_stats& stats);

} // namespace simulate
