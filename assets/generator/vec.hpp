// Vectors, and the few transcendental functions that a C library may round as it likes.
#pragma once

#include <algorithm>
#include <cmath>

namespace plait_generator {

inline constexpr double pi = 3.14159265358979323846;

struct Vec3 {
    double x = 0, y = 0, z = 0;
};

inline Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(Vec3 a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
inline Vec3 operator*(double s, Vec3 a) {
    return a * s;
}
inline Vec3 operator/(Vec3 a, Vec3 b) {
    return {a.x / b.x, a.y / b.y, a.z / b.z};
}
inline Vec3& operator+=(Vec3& a, Vec3 b) {
    return a = a + b;
}
inline double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
inline Vec3 mix(Vec3 a, Vec3 b, double t) {
    return a + t * (b - a);
}
inline double mix(double a, double b, double t) {
    return a + t * (b - a);
}

inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Unit vector along a, or `otherwise` where a has no direction.
inline Vec3 unit(Vec3 a, Vec3 otherwise = {0, -1, 0}) {
    const double size = length(a);
    return size > 1e-12 ? a * (1 / size) : otherwise;
}

// Part of a perpendicular to the unit vector n.
inline Vec3 reject(Vec3 a, Vec3 n) {
    return a - dot(a, n) * n;
}

// 0 below `from`, 1 above `to`, smooth between; `from` may be the greater.
inline double smoothstep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// sin(2 pi turns), the Taylor polynomial on a quarter turn; error below 1e-13.
inline double sin_turns(double turns) {
    double t = turns - std::floor(turns + 0.5); // [-1/2, 1/2)
    if (t > 0.25)
        t = 0.5 - t;
    else if (t < -0.25)
        t = -0.5 - t;
    const double x = 2 * pi * t, x2 = x * x;
    double sum = 1;
    for (int k = 17; k > 1; k -= 2)
        sum = 1 - sum * x2 / (k * (k - 1));
    return x * sum;
}

inline double cos_turns(double turns) {
    return sin_turns(turns + 0.25);
}

} // namespace plait_generator
