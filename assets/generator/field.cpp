#include "field.hpp"

#include "head_shape.hpp"

namespace plait_generator {
namespace {

constexpr double spacing = 0.005; // m
constexpr Vec3 low{-0.24, -0.46, -0.20}, high{0.24, 0.20, 0.20};

size_t count(double from, double to) {
    return static_cast<size_t>((to - from) / spacing + 1.5);
}

} // namespace

Field::Field() : size_{count(low.x, high.x), count(low.y, high.y), count(low.z, high.z)} {
    values_.reserve(size_[0] * size_[1] * size_[2]);
    for (size_t k = 0; k < size_[2]; ++k)
        for (size_t j = 0; j < size_[1]; ++j)
            for (size_t i = 0; i < size_[0]; ++i) {
                const Vec3 steps{static_cast<double>(i), static_cast<double>(j),
                                 static_cast<double>(k)};
                values_.push_back(static_cast<float>(head_distance(low + spacing * steps)));
            }
}

Surroundings Field::at(Vec3 p) const {
    const Vec3 q = (p - low) * (1 / spacing);
    const auto inside = [](double x, size_t n) { return x >= 0 && x < static_cast<double>(n - 1); };
    if (!inside(q.x, size_[0]) || !inside(q.y, size_[1]) || !inside(q.z, size_[2]))
        return {1, unit(p)};
    const auto i = static_cast<size_t>(q.x), j = static_cast<size_t>(q.y),
               k = static_cast<size_t>(q.z);
    const double x = q.x - static_cast<double>(i), y = q.y - static_cast<double>(j),
                 z = q.z - static_cast<double>(k);

    double along_x[2][2], slope_x[2][2];
    for (size_t b = 0; b < 2; ++b)
        for (size_t c = 0; c < 2; ++c) {
            const double from = value(i, j + b, k + c), to = value(i + 1, j + b, k + c);
            along_x[b][c] = mix(from, to, x);
            slope_x[b][c] = to - from;
        }
    const double at_z0 = mix(along_x[0][0], along_x[1][0], y),
                 at_z1 = mix(along_x[0][1], along_x[1][1], y);
    const Vec3 gradient{
        mix(mix(slope_x[0][0], slope_x[1][0], y), mix(slope_x[0][1], slope_x[1][1], y), z),
        mix(along_x[1][0] - along_x[0][0], along_x[1][1] - along_x[0][1], z), at_z1 - at_z0};
    return {mix(at_z0, at_z1, z), unit(gradient, {0, 1, 0})};
}

} // namespace plait_generator
