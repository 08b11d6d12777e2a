// The four winds of the published wind.
#pragma once

namespace plait {

// Fills `corner` (x y z _ four times) with `wind` leaned by `angle` (rad) to four sides, its speed
// kept.
void wind_cone(const float wind[3], float angle, float corner[16]);

} // namespace plait
