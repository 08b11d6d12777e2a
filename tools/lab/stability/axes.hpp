// What the axes of the stability sweep start from, and those that have a file of their own.
#pragma once

#include "sweep.hpp"

namespace lab::stability {

constexpr double pi = 3.14159265358979323846;
using Points = std::vector<AxisPoint>;

plait_pose pose_at(double x); // m along x, unturned
std::string axis_text(double value);
// Two strands, straight and curl, at 60 Hz, Γ 10, 1 g.
Trial base_trial(const Subject& subject, uint32_t segments = 16);

void add_surfaces(Points& points); // surfaces.cpp
void add_pins(Points& points);     // pins.cpp

} // namespace lab::stability
