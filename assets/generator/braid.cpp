// The three middles follow x = a sin(t), z = b sin(2 t), each a third of a period behind the other:
// the figure of eight that every strand of a plait goes round. Straight bundles of radius r would
// touch where they cross for b = 2 r / sqrt(3) = 1.15 r, and side by side for a^2 + b^2 = 16 r^2 /
// 3, or a = 2 r. The bundles lean, which brings them closer, so a and b are greater; and hair gives
// way, so that their middles come to three quarters of two radii.
#include "braid.hpp"

#include "fall.hpp"
#include "head_shape.hpp"
#include "random.hpp"

namespace plait_generator {
namespace {

constexpr double depth_ratio = 1.4;    // b / r
constexpr double width_ratio = 2.3;    // a / r
constexpr double taper = 0.35;         // share of its radius that a bundle loses by the tie
constexpr double gather_reach = 0.045; // m from the gathering where hair leaves the head for it
constexpr double settle_way = 0.025;   // m of braid in which hair from the head finds its bundle
constexpr double tie_way = 0.02;       // m in which the bundles come together at the tie
constexpr double tuft = 0.06;          // m of loose hair after the tie

enum Stream : uint64_t { place_radius = 30, place_angle, tuft_length, layer };

double third_largest_side(const std::vector<Vec3>& roots) {
    std::vector<double> sides;
    sides.reserve(roots.size());
    for (const Vec3 root : roots)
        sides.push_back(std::abs(root.x));
    const auto third = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 3);
    std::nth_element(sides.begin(), third, sides.end());
    return *third;
}

} // namespace

BraidedHair::BraidedHair(const Style& style, const std::vector<Vec3>& roots)
    : style_(style), roots_(roots), side_(third_largest_side(roots)) {
    // The braid as a whole hangs like one thick strand, its back on the neck and the shoulders.
    const double thickness = 0.8 * (1 + depth_ratio) * style.bundle_radius;
    const Vec3 gathering = to_distance({0, -0.045, -0.2}, thickness);
    axis_ = fall(field_, gathering,
                 [](Vec3) {
                     return Vec3{0, -1, 0};
                 },
                 {style.braid_length + 2 * tuft, 0.05, thickness, 0, 0, false});
}

uint32_t BraidedHair::bundle(uint32_t i) const {
    const double x = roots_[i].x;
    return x > side_ ? 1 : x < -side_ ? 2 : 0; // as the figure of eight has them at the gathering
}

BraidedHair::Frame BraidedHair::frame(double along) const {
    const double at = std::clamp(along / walk_step, 0.0, static_cast<double>(axis_.size()) - 1.001);
    const auto i = static_cast<size_t>(at);
    const Vec3 middle = mix(axis_[i], axis_[i + 1], at - static_cast<double>(i));
    const Vec3 down =
        unit(mix(tangent(axis_, i), tangent(axis_, i + 1), at - static_cast<double>(i)));
    const Vec3 across{1, 0, 0}; // the braid hangs in the plane x = 0
    return {middle, across, unit(cross(across, down))};
}

double BraidedHair::bundle_radius(double along) const {
    const double end = style_.braid_length;
    const double tapered = 1 - taper * std::min(along / end, 1.0);
    const double tied = 1 - 0.45 * smoothstep(end - tie_way, end, along);
    const double spread = 1 + 1.2 * smoothstep(end, end + tuft / 2, along);
    const double brush = 1 - 0.7 * smoothstep(end + tuft / 2, end + tuft, along);
    return style_.bundle_radius * tapered * tied * spread * brush;
}

Vec3 BraidedHair::bundle_middle(uint32_t bundle, double along) const {
    const Frame here = frame(along);
    const double tie = style_.braid_length;
    const double turns = std::min(along, tie) / style_.braid_pitch + bundle / 3.0;
    const double apart =
        bundle_radius(along) * mix(1.0, 0.3, smoothstep(tie - tie_way, tie, along));
    return here.middle + apart * (width_ratio * sin_turns(turns) * here.across +
                                  depth_ratio * sin_turns(2 * turns) * here.out);
}

// Each strand keeps its place in the bundle's cross-section, which turns once in two pitches.
Vec3 BraidedHair::in_bundle(uint32_t i, double along) const {
    const double radius = bundle_radius(along) * std::sqrt(random(style_.seed, place_radius, i));
    const double turns = random(style_.seed, place_angle, i) + 0.5 * along / style_.braid_pitch;
    const double step = 0.002;
    const Vec3 middle = bundle_middle(bundle(i), along);
    const Vec3 way = unit(bundle_middle(bundle(i), along + step) - middle);
    const Vec3 first = unit(reject(frame(along).out, way));
    return middle + radius * (cos_turns(turns) * first + sin_turns(turns) * cross(way, first));
}

double BraidedHair::end_of(uint32_t i) const {
    const double uneven = 1 - style_.length_variation * random(style_.seed, tuft_length, i);
    return style_.braid_length + tuft * uneven;
}

// Where along the braid a strand is settled in its bundle: farther down if it grows below the
// gathering.
double BraidedHair::joins_at(uint32_t i) const {
    return settle_way + 1.2 * std::max(0.0, axis_.front().y - roots_[i].y);
}

// Along the scalp, towards the gathering.
Path BraidedHair::to_gathering(uint32_t i) const {
    const Vec3 goal = frame(joins_at(i) - settle_way).middle;
    const auto comb = [&](Vec3 p) { // over the ears, not into them
        const double before_ear = smoothstep(-0.035, 0.0, p.z) * smoothstep(0.075, 0.045, p.y);
        return unit(goal - p) + Vec3{0, 1.5 * before_ear, 0};
    };
    const double own_layer = style_.volume * mix(0.15, 1.0, random(style_.seed, layer, i));
    return fall(field_, roots_[i], comb,
                {0.4, style_.stiffness, 0.0008, own_layer, style_.lift, false},
                [&](Vec3 p) { return length(goal - p) < gather_reach; });
}

Path BraidedHair::strand(uint32_t i) const {
    Path path = to_gathering(i);
    // A cubic from where the strand leaves the head to where it is settled in its bundle.
    const Vec3 from = path.back(), from_way = tangent(path, path.size() - 1);
    const double settled = joins_at(i);
    const Vec3 to = in_bundle(i, settled), to_way = unit(in_bundle(i, settled + 0.004) - to);
    const double pull = 0.9 * length(to - from);
    for (int k = 1; k < 12; ++k)
        path.push_back(hermite(from, pull * from_way, to, pull * to_way, k / 12.0));
    for (double along = settled; along < end_of(i); along += 0.003)
        path.push_back(in_bundle(i, along));
    push_out(path, field_, 0.0008, 0.01);
    return path;
}

} // namespace plait_generator
