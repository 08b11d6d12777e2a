#include "fall.hpp"

#include "head_shape.hpp"

namespace plait_generator {
namespace {

constexpr double crown_z = -0.035; // m, where the parting ends
constexpr double bust = -0.25,
                 under = -0.5;      // below it, m, the underside of the bust: its normal's y
constexpr double settle_way = 0.06; // m of path in which a strand gets half of its layer's height

// Of an ellipsoid before the face, within which no hair hangs: how far p is inside, along which
// way.
Vec3 out_of_face(Vec3 p) {
    constexpr Vec3 centre{0, -0.03, 0.115}, radii{0.066, 0.115, 0.075};
    const Vec3 q = (p - centre) / radii;
    const double scaled = length(q);
    if (scaled >= 1)
        return {};
    const Vec3 aside = unit({p.x, 0, -0.5 * std::abs(p.x)}, {1, 0, 0});
    return (1 - scaled) * radii.x * aside;
}

// The comb's direction on the head, gravity's below it.
Vec3 or_hanging(Vec3 combed, Vec3 p) {
    return mix(unit(combed), {0, -1, 0}, smoothstep(0.02, -0.06, p.y));
}

} // namespace

Vec3 comb_parted(Vec3 p, double part) {
    const double behind = std::min(p.z - crown_z, 0.0);
    const Vec3 away = unit({p.x - part, 0, behind}, {p.x < part ? -1.0 : 1.0, 0, 0});
    const double front = smoothstep(crown_z, 0.08, p.z);
    const double side = smoothstep(0.01, 0.06, std::abs(p.x - part));
    return or_hanging(away + Vec3{0, -0.3 - 0.9 * side, -0.25 - 0.35 * front}, p);
}

Vec3 comb_past_shoulder(Vec3 combed, Vec3 p, bool before, double spread) {
    const double free = before ? mix(0.035, 0.065, spread) : mix(-0.105, -0.135, spread); // z, m
    constexpr double reach = 0.11; // m of fall in which it gets near there
    const double aside = std::clamp((free - p.z) / reach, -0.9, 0.9);
    return mix(unit(combed), unit({0, -1, aside}), smoothstep(0.06, -0.04, p.y));
}

Vec3 comb_back(Vec3 p) {
    const double side = smoothstep(0.03, 0.075, std::abs(p.x));
    return or_hanging({0.25 * p.x / 0.075, -0.35 - 0.5 * side, -1}, p);
}

Vec3 comb_beard(Vec3 p) {
    return {0.3 * p.x / 0.05, -1, 0.45};
}

Path fall(const Field& field, Vec3 root, const Comb& comb, const Walk& walk,
          const std::function<bool(Vec3 p)>& stop) {
    const Vec3 normal = head_normal(root);
    Vec3 p = root, way = unit(mix(unit(reject(comb(root), normal)), normal, walk.lift));
    Vec3 outward = normal;
    Path path{root};
    const double steps = std::max(walk.length / walk_step, 2.0);
    for (int i = 1; i <= steps && !(stop && stop(p)); ++i) {
        const double along = i * walk_step;
        // what is out of the bust hangs on, and does not turn in under it
        const double held =
            p.y < bust && outward.y < under ? 0 : std::max(0.0, dot(comb(p), outward));
        const Vec3 kept_in = comb(p) - held * outward;
        way = unit(mix(way, unit(kept_in), walk_step / walk.bend));
        p += walk_step * way;
        if (walk.clear_face)
            p += out_of_face(p);
        const Surroundings here = field.at(p);
        outward = here.normal;
        const double wanted = walk.nearest + walk.layer * along / (along + settle_way);
        if (here.distance < wanted) {
            p += (wanted - here.distance) * here.normal;
            way = unit(way + std::max(0.0, -dot(way, here.normal)) * here.normal);
        }
        path.push_back(p);
    }
    return path;
}

} // namespace plait_generator
