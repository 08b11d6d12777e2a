#include "fur.hpp"

#include "random.hpp"

namespace plait_generator {
namespace {

constexpr double clearance = 0.0004; // m from the ball

enum Stream : uint64_t { root_height = 60, root_azimuth, own_length, wander };

} // namespace

// Evenly over the whole ball: the height is drawn evenly.
Vec3 FurHair::normal(uint32_t i) const {
    const double y = 2 * own(root_height, i) - 1, out = std::sqrt(1 - y * y);
    const double azimuth = own(root_azimuth, i);
    return {out * cos_turns(azimuth), y, out * sin_turns(azimuth)};
}

// It leaves the skin as `lift` says and lies down along the way, combed to the ball's lower pole and
// a little aside, each hair by itself.
Path FurHair::strand(uint32_t i) const {
    const Vec3 up = normal(i);
    const Vec3 down = unit(reject(Vec3{0, -1, 0}, up), {1, 0, 0});
    const Vec3 aside = cross(up, down);
    const double stray = style_.stray / style_.length * (2 * own(wander, i) - 1);
    const double whole = style_.length * (1 - style_.length_variation * own(own_length, i));
    const double step = whole / (style_.vertices - 1);
    Path path{ball_radius * up};
    for (uint32_t k = 1; k < style_.vertices; ++k) {
        const double share = static_cast<double>(k) / (style_.vertices - 1);
        const double lifted = style_.lift * (1 - 0.6 * share);
        const Vec3 way = unit(lifted * up + (1 - lifted) * down + stray * share * aside);
        const Vec3 next = path.back() + step * way;
        const double height = length(next);
        path.push_back(height < ball_radius + clearance ? (ball_radius + clearance) / height * next
                                                        : next);
    }
    return path;
}

Uv FurHair::uv(uint32_t i) const {
    return equal_area(normal(i));
}

double FurHair::own(uint64_t stream, uint32_t i) const {
    return random(style_.seed, stream, i);
}

} // namespace plait_generator
