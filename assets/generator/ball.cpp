#include "ball.hpp"

#include "random.hpp"

namespace plait_generator {
namespace {

constexpr double cap = 1 - ball_hairline / ball_radius; // 1 - cos(angle) at its border
constexpr double clearance = 0.001;                     // m from the ball
constexpr double rise = 0.03;   // m of the way in which a strand leaves the ball for its layer
constexpr double lowest = 0.05; // least share of the layer
constexpr double sweep = 0.6 / (2 * pi); // turns about the pole: strands go to either side by half

enum Stream : uint64_t { root_polar = 50, root_azimuth, share_of_layer, way_about, own_length };

// Of x in [0, 0.55], to 1e-13: the series.
double arcsine(double x) {
    double sum = 0, term = x;
    for (int k = 1; k < 60; k += 2) {
        sum += term / k;
        term *= x * x * k / (k + 1);
    }
    return sum;
}

// e^-x of x >= 0, to 1e-12: the series of a 64th, squared six times.
double decay(double x) {
    const double part = -std::min(x, 64.0) / 64;
    double sum = 1;
    for (int k = 12; k > 0; --k)
        sum = 1 + part * sum / k;
    for (int k = 0; k < 6; ++k)
        sum *= sum;
    return sum;
}

} // namespace

double BallHair::own(uint64_t stream, uint32_t i) const {
    return random(style_.seed, stream, i);
}

// Equal areas: 1 - cos is drawn evenly, which is twice the square of the half angle's sine.
double BallHair::polar(uint32_t i) const {
    return 2 * arcsine(std::sqrt(0.5 * cap * own(root_polar, i)));
}

Path BallHair::strand(uint32_t i) const {
    const double layer = style_.volume * mix(lowest, 1.0, own(share_of_layer, i));
    const double length = style_.length * (1 - style_.length_variation * own(own_length, i));
    const double middle = ball_radius + style_.volume / 2; // radius that ways are measured at
    const double root = polar(i), turn = sweep * (own(way_about, i) - 0.5);
    Path path;
    for (uint32_t k = 0; k < style_.vertices; ++k) {
        const double share = static_cast<double>(k) / (style_.vertices - 1);
        const double along = length * share;
        const double r = ball_radius + clearance + layer * (1 - decay(along / rise));
        const double angle = root + along / middle, theta = std::min(angle, pi / 2);
        const double azimuth = own(root_azimuth, i) + turn * share;
        const double out = r * sin_turns(theta / (2 * pi));
        path.push_back({out * cos_turns(azimuth),
                        r * cos_turns(theta / (2 * pi)) - (angle - theta) * middle,
                        out * sin_turns(azimuth)});
    }
    return path;
}

Uv BallHair::uv(uint32_t i) const {
    const double from_pole = 0.5 * std::sqrt(own(root_polar, i)), azimuth = own(root_azimuth, i);
    return {0.5 + from_pole * cos_turns(azimuth), 0.5 + from_pole * sin_turns(azimuth)};
}

std::vector<Capsule> ball_colliders() {
    constexpr auto radius = static_cast<float>(ball_radius);
    return {{{0, 0, 0}, {0, 0, 0}, radius, radius, true}};
}

// Rings from pole to pole.
HeadMesh make_ball() {
    constexpr uint32_t rings = 72, around = 2 * rings;
    HeadMesh mesh;
    const auto add = [&](Vec3 n) {
        for (const double value : {n.x, n.y, n.z}) {
            mesh.positions.push_back(static_cast<float>(ball_radius * value));
            mesh.normals.push_back(static_cast<float>(value));
        }
    };
    add({0, 1, 0});
    for (uint32_t ring = 1; ring < rings; ++ring)
        for (uint32_t k = 0; k < around; ++k) {
            const double theta = 0.5 * ring / rings, phi = static_cast<double>(k) / around;
            add({sin_turns(theta) * sin_turns(phi), cos_turns(theta),
                 sin_turns(theta) * cos_turns(phi)});
        }
    add({0, -1, 0});
    const uint32_t last = 1 + (rings - 1) * around;
    const auto at = [&](uint32_t ring, uint32_t k) {
        return ring == 0 ? 0 : ring == rings ? last : 1 + (ring - 1) * around + k % around;
    };
    for (uint32_t ring = 0; ring < rings; ++ring)
        for (uint32_t k = 0; k < around; ++k) {
            const uint32_t a = at(ring, k), b = at(ring, k + 1);
            const uint32_t c = at(ring + 1, k), d = at(ring + 1, k + 1);
            if (ring > 0)
                mesh.triangles.insert(mesh.triangles.end(), {a, c, b});
            if (ring + 1 < rings)
                mesh.triangles.insert(mesh.triangles.end(), {b, c, d});
        }
    return mesh;
}

} // namespace plait_generator
