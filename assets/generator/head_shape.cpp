// Blended ellipsoids and round cones, after I. Quilez's catalogue of distance functions
// (https://iquilezles.org/articles/distfunctions, 2013). The measures are those of an adult: head
// height 0.24 m, breadth 0.153 m, length 0.204 m.
#include "head_shape.hpp"

#include "generator.hpp"

namespace plait_generator {
namespace {

// First-order distance to an ellipsoid: exact on its surface.
double ellipsoid(Vec3 p, Vec3 centre, Vec3 radii) {
    const Vec3 q = (p - centre) / radii;
    const double scaled = length(q), slope = length(q / radii);
    return slope > 1e-9 ? scaled * (scaled - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

double sphere(Vec3 p, Vec3 centre, double radius) {
    return length(p - centre) - radius;
}

// Capsule whose radius goes evenly from ra to rb: exact for ra == rb, else first order.
double cone(Vec3 p, Vec3 a, double ra, Vec3 b, double rb) {
    const Vec3 axis = b - a;
    const double t = std::clamp(dot(p - a, axis) / dot(axis, axis), 0.0, 1.0);
    return length(p - a - t * axis) - mix(ra, rb, t);
}

// Union, difference and intersection, rounded over about k where the surfaces meet. Beyond k apart
// they do not touch each other at all.
double join(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * k / 4;
}
double carve(double a, double b, double k) {
    return -join(-a, b, k);
}
double meet(double a, double b, double k) {
    return -join(-a, -b, k);
}

// In the parts below, p.x >= 0: the mannequin is symmetric.

double cranium(Vec3 p) {
    const double vault = ellipsoid(p, {0, 0.036, -0.010}, {0.0765, 0.094, 0.094});
    const double forehead = ellipsoid(p, {0, 0.046, 0.034}, {0.062, 0.060, 0.056});
    const double occiput = ellipsoid(p, {0, 0.008, -0.058}, {0.058, 0.055, 0.046});
    return join(join(vault, forehead, 0.03), occiput, 0.03);
}

double jaw(Vec3 p) {
    p.x = std::sqrt(p.x * p.x + 1.6e-5); // no crease down the chin
    const double face = ellipsoid(p, {0, -0.028, 0.034}, {0.056, 0.070, 0.054});
    const double flesh = ellipsoid(p, {0.029, -0.044, 0.050}, {0.024, 0.032, 0.026});
    const double angle = cone(p, {0.043, -0.052, 0.010}, 0.015, {0.012, -0.092, 0.066}, 0.0150);
    const double ramus = cone(p, {0.053, -0.005, 0.004}, 0.014, {0.043, -0.052, 0.010}, 0.015);
    const double chin = ellipsoid(p, {0, -0.0945, 0.0755}, {0.0175, 0.0140, 0.0150});
    return join(join(join(join(face, angle, 0.03), ramus, 0.03), flesh, 0.03), chin, 0.022);
}

double cheeks_and_brow(Vec3 p, double head) {
    const double cheek = ellipsoid(p, {0.040, -0.018, 0.061}, {0.020, 0.015, 0.017});
    const double brow = cone(p, {0.019, 0.0280, 0.0820}, 0.0060, {0.043, 0.0270, 0.068}, 0.0060);
    return join(join(head, cheek, 0.030), brow, 0.022);
}

// Closed lids over the eyeballs, with the crease where they meet.
double eyes(Vec3 p, double head) {
    const double socket = ellipsoid(p, {0.0325, 0.0075, 0.0965}, {0.0180, 0.0120, 0.0155});
    const double lids = ellipsoid(p, {0.0315, 0.0045, 0.0720}, {0.0165, 0.0125, 0.0135});
    const double left =
        cone(p, {0.0190, -0.0005, 0.0835}, 0.0004, {0.0310, -0.0030, 0.0868}, 0.0008);
    const double right =
        cone(p, {0.0310, -0.0030, 0.0868}, 0.0008, {0.0440, 0.0005, 0.0800}, 0.0004);
    return carve(join(carve(head, socket, 0.014), lids, 0.006), std::min(left, right), 0.003);
}

double nose(Vec3 p, double head) {
    const double bridge = cone(p, {0, 0.020, 0.0850}, 0.0066, {0, -0.0220, 0.1040}, 0.0080);
    const double tip = ellipsoid(p, {0, -0.0265, 0.1060}, {0.0092, 0.0080, 0.0090});
    const double wing = ellipsoid(p, {0.0110, -0.0305, 0.0970}, {0.0072, 0.0066, 0.0095});
    const double whole = join(join(bridge, tip, 0.008), wing, 0.008);
    return join(head, whole, 0.014);
}

double mouth(Vec3 p, double head) {
    const double muzzle = ellipsoid(p, {0, -0.062, 0.070}, {0.030, 0.026, 0.0225});
    const double upper = ellipsoid(p, {0, -0.0605, 0.0865}, {0.0225, 0.0058, 0.0105});
    const double lower = ellipsoid(p, {0, -0.0700, 0.0858}, {0.0185, 0.0066, 0.0102});
    const double philtrum = cone(p, {0, -0.0420, 0.0975}, 0.0010, {0, -0.0540, 0.0985}, 0.0018);
    const double bow = carve(join(head, muzzle, 0.02), philtrum, 0.005);
    return join(bow, join(upper, lower, 0.001), 0.004);
}

double ear(Vec3 p) {
    const Vec3 leaning{p.x - 0.35 * (-p.z - 0.012), p.y - 0.002, p.z - 0.20 * p.y}; // out and back
    const double shell = ellipsoid(leaning, {0.0765, 0, -0.013}, {0.0085, 0.0300, 0.0185});
    const double bowl = ellipsoid(leaning, {0.0880, 0.001, -0.010}, {0.0080, 0.0200, 0.0110});
    const double lobe = sphere(leaning, {0.0750, -0.026, -0.006}, 0.0070);
    return join(carve(shell, bowl, 0.006), lobe, 0.010);
}

double neck_and_shoulders(Vec3 p) {
    p.x = std::sqrt(p.x * p.x + 1e-4); // no crease along the spine
    const double neck = cone(p, {0, -0.05, -0.016}, 0.047, {0, -0.215, -0.036}, 0.050);
    const double trapezius =
        cone(p, {0.015, -0.175, -0.046}, 0.034, {0.125, -0.230, -0.048}, 0.030);
    const double shoulder = cone(p, {0.08, -0.262, -0.045}, 0.055, {0.137, -0.268, -0.045}, 0.044);
    const double chest = ellipsoid(p, {0, -0.355, -0.042}, {0.152, 0.180, 0.098});
    const double bust = join(join(chest, shoulder, 0.06), trapezius, 0.05);
    return meet(join(neck, bust, 0.045), -0.415 - p.y, 0.02);
}

} // namespace

double skull_distance(Vec3 p) {
    p.x = std::abs(p.x);
    double head = join(cranium(p), jaw(p), 0.03);
    if (p.z > 0.02 && p.y < 0.07 && p.y > -0.13) // the rest is too far to matter
        head = mouth(p, nose(p, eyes(p, cheeks_and_brow(p, head))));
    return p.y < 0.03 ? join(head, neck_and_shoulders(p), 0.03) : head;
}

double head_distance(Vec3 p) {
    const double skull = skull_distance(p);
    p.x = std::abs(p.x);
    return p.x > 0.05 && std::abs(p.y) < 0.06 ? join(skull, ear(p), 0.006) : skull;
}

Vec3 head_normal(Vec3 p) {
    // Differences along a tetrahedron's corners: four evaluations.
    constexpr double h = 1e-5;
    const Vec3 corners[] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
    Vec3 sum;
    for (const Vec3 corner : corners)
        sum += head_distance(p + h * corner) * corner;
    return unit(sum, {0, 1, 0});
}

Vec3 to_distance(Vec3 p, double distance) {
    for (int i = 0; i < 20; ++i) {
        const double error = distance - head_distance(p);
        if (std::abs(error) < 1e-9)
            break;
        p += error * head_normal(p);
    }
    return p;
}

double head_distance(double x, double y, double z) {
    return head_distance(Vec3{x, y, z});
}

} // namespace plait_generator
