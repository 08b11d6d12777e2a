// Every strand keeps its place in the tail's cross-section. The tail leaves the holder away from
// the head, is as wide there as the holder, bushes out below it and thins towards its end, as
// strands of different lengths end.
#include "ponytail.hpp"

#include "fall.hpp"
#include "head_shape.hpp"
#include "random.hpp"

namespace plait_generator {
namespace {

constexpr double clearance = 0.0008;  // m from the head, of hair on its way to the holder
constexpr double gather_reach = 0.05; // m from the holder where hair leaves the head for it
constexpr double bush = 1.1;          // share by which the tail widens below the holder
constexpr double bush_way = 0.12;     // m in which it does
constexpr double taper = 0.55;        // share of that width that it loses by its end

enum Stream : uint64_t { place_radius = 40, place_angle, tail_length, layer };

} // namespace

TiedHair::TiedHair(const Style& style, const std::vector<Vec3>& roots)
    : style_(style), roots_(roots) {
    const double stands_off = 1.6 * style.holder_radius;
    const Vec3 holder = to_distance({0, style.holder_height, -0.2}, stands_off);
    axis_ = fall(
        field_, holder,
        [](Vec3) {
            return Vec3{0, -1, 0};
        },
        {style.tail_length + walk_step, 0.04, stands_off, 0.5 * style.holder_radius, 0.9, false});
    normals_ = untwisted_normals(axis_, {1, 0, 0});
}

double TiedHair::tail_radius(double along) const {
    const double wide = 1 + bush * smoothstep(0, bush_way, along);
    return style_.holder_radius * wide *
           (1 - taper * smoothstep(bush_way, style_.tail_length, along));
}

Vec3 TiedHair::in_tail(uint32_t i, double along) const {
    const double at = std::clamp(along / walk_step, 0.0, static_cast<double>(axis_.size()) - 1.001);
    const auto k = static_cast<size_t>(at);
    const double share = at - static_cast<double>(k);
    const Vec3 middle = mix(axis_[k], axis_[k + 1], share);
    const Vec3 way = unit(mix(tangent(axis_, k), tangent(axis_, k + 1), share));
    const Vec3 first = unit(reject(mix(normals_[k], normals_[k + 1], share), way));
    const double radius = tail_radius(along) * std::sqrt(random(style_.seed, place_radius, i));
    const double turns = random(style_.seed, place_angle, i);
    return middle + radius * (cos_turns(turns) * first + sin_turns(turns) * cross(way, first));
}

// Along the scalp, over the ears, towards the holder.
Path TiedHair::to_holder(uint32_t i) const {
    const Vec3 goal = holder();
    const auto comb = [&](Vec3 p) {
        const double before_ear = smoothstep(-0.035, 0.0, p.z) * smoothstep(0.075, 0.045, p.y);
        return unit(goal - p) + Vec3{0, 1.5 * before_ear, 0};
    };
    const double own_layer = style_.volume * mix(0.15, 1.0, random(style_.seed, layer, i));
    return fall(field_, roots_[i], comb,
                {0.4, style_.stiffness, clearance, own_layer, style_.lift, false},
                [&](Vec3 p) { return length(goal - p) < gather_reach; });
}

Path TiedHair::strand(uint32_t i) const {
    Path path = to_holder(i);
    const Vec3 from = path.back(), from_way = tangent(path, path.size() - 1);
    const Vec3 to = in_tail(i, 0), to_way = unit(in_tail(i, walk_step) - to);
    const double pull = 0.9 * length(to - from);
    for (int k = 1; k < 12; ++k)
        path.push_back(hermite(from, pull * from_way, to, pull * to_way, k / 12.0));
    const double end =
        style_.tail_length * (1 - style_.length_variation * random(style_.seed, tail_length, i));
    for (double along = 0; along < end; along += 0.003)
        path.push_back(in_tail(i, along));
    push_out(path, field_, clearance, 0.01);
    return path;
}

} // namespace plait_generator
