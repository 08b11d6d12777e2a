// What a groom is, in numbers a person can judge: how many strands, how large, in which unit.
#pragma once

#include "figure.hpp"

#include <string>
#include <vector>

namespace simulate {

// "long: 10000 strands of 16 vertices, 160000 in all; 0.38 x 0.45 x 0.31 m, 0.41 m long on average;
// 14 colliders of the mannequin"
std::string loaded_line(const Scene& scene, const Figure& figure);

// What looks wrong about the size, each a sentence for the user; none: nothing does. What the library
// warns of the groom is not among them.
std::vector<std::string> size_warnings(const Scene& scene, const Figure& figure);

} // namespace simulate
