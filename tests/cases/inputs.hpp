// Hair for the cases: random, the same on every machine, in metres near the origin.
#pragma once

#include "case.hpp"

#include <array>
#include <random>

namespace plait::cases {

class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    double uniform(double low, double high) { // std distributions differ between libraries
        return low + (high - low) * (next() >> 8) * 0x1p-24;
    }
    uint32_t below(uint32_t bound) { return next() % bound; }
    std::array<double, 3> direction();
    std::array<double, 4> rotation(); // unit quaternion (x, y, z, w)

  private:
    uint32_t next() { return static_cast<uint32_t>(engine_()); } // the type is 64 bits wide
    std::mt19937 engine_;
};

using Point = std::array<double, 3>;
Point rotate(const std::array<double, 4>& q, const Point& p);

// Odd sizes: strand counts that fill no work-group, lengths that are no power of two.
struct Size {
    uint32_t strands;
    uint32_t stride; // V
};
const std::vector<Size>& sizes();
std::string name_of(const Size& size);

constexpr float segment_length = 0.02f; // m

// Strands of mixed vertex counts, bent and moving: [strands][V], padding repeats the tip.
struct Hair {
    Size size;
    std::vector<uint32_t> vertex_count;
    std::vector<float> rest, position, position_prev, position_prev2; // float4
    std::vector<float> rest_length;
    std::vector<float> pose, pose_other; // two poses a step apart, 2 float4 per strand

    uint32_t vertices() const { return size.strands * size.stride; }
};
// Vertices 0 and 1 of every strand are pinned, and here and there one further out.
Hair make_hair(const Size& size, uint32_t seed);

// Of every vertex, padding too, up to `most` in any direction; w 0: [strands][V] float4.
std::vector<float> accelerations(const Size& size, double most);
// float4 [strands*stride]: most vertices are free, the others pinned in either frame within a
// metre.
std::vector<float> pin_rows(const Size& size, uint32_t seed);

// Of a collider at the substep's begin its first point alone is read, not the radius there: turned
// as the collider turns, it says where any other point was.
const std::vector<std::string>& unread_of_colliders();

} // namespace plait::cases
