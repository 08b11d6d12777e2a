// Strand against strand: what holds and what slides by friction, in closed forms; what lies on what;
// what is dropped, refused, repeated; and what it costs where it is off.
#include "support.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace {

constexpr plait_model every_model[] = {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_CHAIN,
                                       PLAIT_MODEL_COSSERAT, PLAIT_MODEL_ROD};
constexpr float radius = 0.002f;
constexpr size_t vertices = 16;

plait_sim_desc meeting(plait_model model) {
    auto desc = plait_sim_desc_defaults();
    desc.model = model;
    desc.pins = 1;
    desc.params.strand_contact = PLAIT_STRAND_CONTACT_ON;
    desc.params.strand_radius = radius;
    if (model == PLAIT_MODEL_COSSERAT)
        desc.params.iterations = 12;
    return desc;
}

Strand line(Point from, Point way, float spacing, size_t count = vertices) {
    Strand strand;
    for (size_t i = 0; i < count; ++i) {
        const float along = spacing * static_cast<float>(i);
        strand.push_back(
            {from[0] + along * way[0], from[1] + along * way[1], from[2] + along * way[2]});
    }
    return strand;
}

plait_pin hold(uint32_t strand, uint32_t vertex) {
    return {strand, vertex, PLAIT_PIN_FRAME_REST, {0, 0, 0}, PLAIT_PIN_HELD};
}

// ---- distances, in float64 -----------------------------------------------------------------------

using Vector = std::array<double, 3>;

Vector at(const std::vector<float>& positions, size_t vertex) {
    return {double(positions[4 * vertex]), double(positions[4 * vertex + 1]),
            double(positions[4 * vertex + 2])};
}

Vector minus(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Of a point and a segment.
double distance(const Vector& p, const Vector& from, const Vector& to) {
    const Vector way = minus(to, from), out = minus(p, from);
    const double t = std::clamp(dot(way, out) / dot(way, way), 0.0, 1.0);
    const Vector off{out[0] - t * way[0], out[1] - t * way[1], out[2] - t * way[2]};
    return std::sqrt(dot(off, off));
}

// Of two segments: where both cross, seen along their common normal, or at an end of one.
double distance(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    double least = std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b),
                             distance(d, a, b)});
    const Vector u = minus(b, a), v = minus(d, c), w = minus(a, c);
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), determinant = uu * vv - uv * uv;
    const double s = (uv * dot(v, w) - vv * dot(u, w)) / determinant;
    const double t = (uu * dot(v, w) - uv * dot(u, w)) / determinant;
    if (determinant > 0 && s >= 0 && s <= 1 && t >= 0 && t <= 1) {
        const Vector off{w[0] + s * u[0] - t * v[0], w[1] + s * u[1] - t * v[1],
                         w[2] + s * u[2] - t * v[2]};
        least = std::min(least, std::sqrt(dot(off, off)));
    }
    return least;
}

// Of two strands of a sim, over the diameter.
double distance(const std::vector<float>& positions, size_t one, size_t other) {
    double least = std::numeric_limits<double>::max();
    for (size_t i = 0; i + 1 < vertices; ++i)
        for (size_t j = 0; j + 1 < vertices; ++j) {
            const size_t a = one * vertices + i, b = other * vertices + j;
            least = std::min(least, distance(at(positions, a), at(positions, a + 1),
                                             at(positions, b), at(positions, b + 1)));
        }
    return least / double(2 * radius);
}

// Where two strands cross, seen along z: 1 where `one` is above, -1 below, 0: they do not.
int above(const std::vector<float>& positions, size_t one, size_t other) {
    for (size_t i = 0; i + 1 < vertices; ++i)
        for (size_t j = 0; j + 1 < vertices; ++j) {
            const Vector a = at(positions, one * vertices + i),
                         c = at(positions, other * vertices + j);
            const Vector u = minus(at(positions, one * vertices + i + 1), a),
                         v = minus(at(positions, other * vertices + j + 1), c), w = minus(c, a);
            const double determinant = u[0] * v[1] - u[1] * v[0];
            const double s = (w[0] * v[1] - w[1] * v[0]) / determinant;
            const double t = (w[0] * u[1] - w[1] * u[0]) / determinant;
            if (determinant != 0 && s >= 0 && s <= 1 && t >= 0 && t <= 1)
                return a[2] + s * u[2] > c[2] + t * v[2] ? 1 : -1;
        }
    return 0;
}

class StrandContact : public OnBackend {};
ON_EVERY_BACKEND(StrandContact);

// ---- friction --------------------------------------------------------------------------------------

// A hair that hangs along x, and across it, a little above its tip, one that is taut along y and
// pinned at both ends. A pull of 2 m/s^2 presses the one on the other, `degrees` off the normal: both
// parts of it are borne by the same lever, so the hair slides along the other where tan(degrees)
// exceeds friction, whatever its stiffness.
plait::Sim pressed(const plait::Context& context, plait_model model, double degrees) {
    auto desc = meeting(model);
    const double angle = degrees * std::numbers::pi / 180;
    desc.params.drag = 5;
    desc.params.gravity[0] = 9.81f;
    desc.params.gravity[1] = static_cast<float>(2 * std::sin(angle));
    desc.params.gravity[2] = static_cast<float>(-2 * std::cos(angle));
    const Strands hair{line({0.1f, -0.1f, 0}, {0, 1, 0}, 0.2f / 15),
                       line({0, 0.005f, 2 * radius}, {1, 0, 0}, 0.0125f)};
    plait::Sim sim(context, make_groom(hair), desc);
    sim.set_pins({hold(0, vertices - 1)});
    return sim;
}

// m: by how much the tip of the hair has gone aside.
float gone_aside(const plait::Sim& sim) {
    return sim.read(PLAIT_FIELD_POSITION)[4 * (2 * vertices - 1) + 1] - 0.005f;
}

TEST_P(StrandContact, AHairSlidesOverATautOneWhereItIsSteeperThanFriction) {
    const double angle = std::atan(0.3) * 180 / std::numbers::pi;
    for (const plait_model model : every_model) {
        plait::Sim below = pressed(context, model, angle - 2),
                   above = pressed(context, model, angle + 2);
        run(below, 60);
        run(above, 60);
        const float begun = gone_aside(below);
        run(below, 240);
        EXPECT_LT(std::abs(gone_aside(below)), 3e-4f) << model;
        EXPECT_LT(std::abs(gone_aside(below) - begun), 1e-4f) << model << ": creeps";
        EXPECT_GT(gone_aside(above), 1e-3f) << model;
    }
}
