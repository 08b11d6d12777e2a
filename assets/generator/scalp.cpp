#include "scalp.hpp"

#include "generator.hpp"
#include "head_shape.hpp"
#include "random.hpp"
#include "scatter.hpp"
#include "surface_nets.hpp"

namespace plait_generator {
namespace {

// The hairline seen from the side: from the nape around the ear and the temple to the forehead.
struct Knot {
    double z, y;
};
constexpr Knot hairline[] = {{-0.200, -0.074}, {-0.070, -0.076}, {-0.046, -0.066}, {-0.030, -0.034},
                             {-0.016, 0.018},  {-0.004, 0.036},  {0.008, 0.026},   {0.018, -0.004},
                             {0.028, 0.006},   {0.040, 0.044},   {0.058, 0.066},   {0.078, 0.088},
                             {0.200, 0.100}};

double hairline_at(double z) {
    size_t i = 1;
    while (i + 1 < std::size(hairline) && hairline[i].z < z)
        ++i;
    const double t = smoothstep(hairline[i - 1].z, hairline[i].z, z);
    return mix(hairline[i - 1].y, hairline[i].y, t);
}

Surface scalp_surface(bool beard) {
    constexpr double spacing = 0.004;
    const Vec3 corner = beard ? Vec3{-0.096, -0.154, -0.106} : Vec3{-0.096, -0.09, -0.126};
    const auto place = [&](size_t i, size_t j, size_t k) {
        const Vec3 steps{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        return corner + spacing * steps;
    };
    return surface_nets([](Vec3 p) { return head_distance(p); }, {{49, 59, 57}, place});
}

// Draws points uniformly by area from a surface's triangles.
class AreaSampler {
  public:
    explicit AreaSampler(const Surface& surface) : surface_(surface) {
        for (size_t t = 0; t < surface.triangles.size(); t += 3) {
            const Vec3 a = corner(t), normal = cross(corner(t + 1) - a, corner(t + 2) - a);
            areas_.push_back((areas_.empty() ? 0 : areas_.back()) + length(normal) / 2);
        }
    }
    double area() const { return areas_.back(); }

    Vec3 at(double choice, double u, double v) const { // each in [0, 1)
        const auto above = std::upper_bound(areas_.begin(), areas_.end(), choice * area());
        const size_t t = 3 * static_cast<size_t>(above - areas_.begin());
        const double root = std::sqrt(u);
        return corner(t) * (1 - root) + corner(t + 1) * (root * (1 - v)) +
               corner(t + 2) * (root * v);
    }

  private:
    Vec3 corner(size_t i) const { return surface_.points[surface_.triangles[i]]; }

    const Surface& surface_;
    std::vector<double> areas_; // running sum
};

} // namespace

double scalp_height(Vec3 p) {
    const double height = p.y - hairline_at(p.z);
    const bool on_ear = height > 0 && skull_distance(p) > 5e-4;
    return on_ear ? -1 : height;
}

double scalp_height(double x, double y, double z) {
    return scalp_height(Vec3{x, y, z});
}

// From the sideburns down along the cheek to the corner of the mouth, the upper lip, not the mouth
// itself, and below the chin as far as the throat.
double beard_height(Vec3 p) {
    const double aside = std::abs(p.x);
    const double cheek = mix(-0.046, 0.0, smoothstep(0.034, 0.062, aside)); // height of its border
    const double lip = std::max(std::abs(p.y + 0.0655) - 0.0085, aside - 0.026);  // of the mouth
    const double behind = p.z - mix(0.028, -0.002, smoothstep(-0.03, -0.1, p.y)); // of the ear
    const double throat = p.y + mix(0.105, 0.128, smoothstep(0.0, 0.06, p.z));
    const bool on_ear = skull_distance(p) > 5e-4;
    return on_ear ? -1 : std::min({cheek - p.y, lip, behind, throat});
}

std::vector<Vec3> scatter_roots(size_t count, uint64_t seed, bool beard) {
    const Surface surface = scalp_surface(beard);
    const AreaSampler sampler(surface);
    // More candidates give evener spacing; five per root is Yuksel's choice, three nearly as even.
    const size_t wanted = std::max<size_t>((count > 100000 ? 3 : 5) * count, 64);
    std::vector<Vec3> candidates;
    candidates.reserve(wanted);
    uint64_t drawn = 0;
    while (candidates.size() < wanted) {
        const Vec3 p =
            sampler.at(random(seed, 1, drawn), random(seed, 2, drawn), random(seed, 3, drawn));
        ++drawn;
        if ((beard ? beard_height(p) : scalp_height(p)) > 0.001)
            candidates.push_back(p);
    }
    const double scalp_area =
        sampler.area() * static_cast<double>(wanted) / static_cast<double>(drawn);

    std::vector<Vec3> roots;
    for (const uint32_t i : spread_out(candidates, count, scalp_area))
        roots.push_back(to_distance(candidates[i], 0));
    return roots;
}

Uv scalp_uv(Vec3 root) {
    return equal_area(unit(root - Vec3{0, 0.02, -0.01}));
}

Uv equal_area(Vec3 d) {
    const double scale = std::sqrt(2 / (1 + std::max(d.y, -0.999))) / 4;
    return {0.5 + scale * d.x, 0.5 + scale * d.z};
}

} // namespace plait_generator
