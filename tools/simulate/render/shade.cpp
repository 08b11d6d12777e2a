#include "shade.hpp"
#include "random.hpp"

#include <algorithm>
#include <numbers>

namespace render {

using Eigen::Vector3f;

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float far_away = 4.0f;     // m: the lights
constexpr float sky_reach = 0.12f;   // m: hair farther off does not darken the sky
constexpr float light_size = 0.045f; // radians, half angle: softens the shadows' edges
constexpr int most_hairs = 14;       // transmittance below 5 %
// To each light and the sky, from a point of the skin: on a smooth surface the grain of single rays
// through hair looks like stubble.
constexpr int skin_rays = 4;

// Share of light left after so many hairs: each as drawn stands for a lock and stops about a fifth.
Vector3f transmittance(int hairs, const Vector3f& colour) {
    if (hairs >= most_hairs)
        return Vector3f::Zero();
    // What comes through hair takes its colour on: absorption is weaker where the hair is brighter.
    const Vector3f tint = colour / std::max(1e-4f, colour.maxCoeff());
    const Vector3f absorption = 0.20f * (1.5f * Vector3f::Ones() - 0.5f * tint);
    return (-static_cast<float>(hairs) * absorption).array().exp();
}

// A direction at most light_size away from the light's.
Vector3f jittered(const Light& light, float u, float v) {
    const Vector3f side = light.towards.unitOrthogonal(), other = light.towards.cross(side);
    const float radius = light_size * std::sqrt(u), angle = 2.0f * pi * v;
    return (light.towards + radius * (std::cos(angle) * side + std::sin(angle) * other))
        .normalized();
}

Vector3f on_sphere(float u, float v) {
    const float z = 1.0f - 2.0f * u, radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {radius * std::cos(2.0f * pi * v), z, radius * std::sin(2.0f * pi * v)};
}

Vector3f visible(const Geometry& geometry, const Surfel& surfel, const Vector3f& direction,
                 float reach, const Vector3f& tint) {
    const float clearance = surfel.material == Material::hair ? 3.0f * surfel.radius : 2e-4f;
    const RTCRay ray = make_ray(surfel.position, direction, clearance, reach);
    return transmittance(hairs_on_ray(geometry.scene(), ray, most_hairs), tint);
}

Vector3f strand_colour(const Surfel& surfel, const Look& look) {
    const float s = std::clamp(1.35f * surfel.along - 0.1f, 0.0f, 1.0f);
    const Vector3f colour =
        look.hair_root + s * s * (3.0f - 2.0f * s) * (look.hair_tip - look.hair_root);
    const float lightness =
        1.0f + look.colour_variation * (2.0f * uniform(surfel.strand, 11) - 1.0f);
    const float warmth = 1.0f + 0.12f * (2.0f * uniform(surfel.strand, 29) - 1.0f);
    return (colour * lightness).cwiseProduct(Vector3f(warmth, 1.0f, 1.0f / warmth));
}

float gaussian(float x, float width) {
    return std::exp(-0.5f * x * x / (width * width)) / (width * std::sqrt(2.0f * pi));
}

// The angles of Marschner et al. 2003 between light, eye and hair.
struct Angles {
    float sin_light, sin_eye, cos_light;
    float cos_phi; // azimuth between light and eye, around the hair
};

Angles angles_of(const Vector3f& tangent, const Vector3f& light, const Vector3f& eye) {
    Angles angles{};
    angles.sin_light = std::clamp(tangent.dot(light), -1.0f, 1.0f);
    angles.sin_eye = std::clamp(tangent.dot(eye), -1.0f, 1.0f);
    const Vector3f across_light = light - angles.sin_light * tangent;
    const Vector3f across_eye = eye - angles.sin_eye * tangent;
    angles.cos_light = across_light.norm();
    angles.cos_phi =
        across_light.dot(across_eye) / std::max(1e-4f, angles.cos_light * across_eye.norm());
    return angles;
}

// Hair as Marschner et al. 2003 in the short form of Karis 2016 ("Physically based hair shading in
// Unreal"): R white and shifted to the root, TRT tinted and shifted to the tip, TT through the hair
// from behind; and a Kajiya-Kay 1989 term in place of multiple scattering. Returns reflected /
// incident.
Vector3f hair_scatter(const Surfel& surfel, const Vector3f& light, const Vector3f& eye,
                      const Vector3f& colour, const Look& look) {
    const Angles a = angles_of(surfel.tangent, light, eye);
    const float jitter =
        0.05f * (2.0f * uniform(surfel.strand, 43) - 1.0f); // no two cuticles alike
    const float half = 0.5f * (a.sin_light + a.sin_eye) + jitter;
    const float width = look.highlight, tilt = 0.09f;
    const float r = gaussian(half - 2.0f * tilt, width) * 0.25f *
                    std::sqrt(std::max(0.0f, 0.5f + 0.5f * a.cos_phi));
    const float tt = gaussian(half + tilt, 0.5f * width) * std::exp(-3.65f * a.cos_phi - 3.98f);
    const float trt =
        gaussian(half + 4.0f * tilt, 1.6f * width) * std::exp(6.0f * a.cos_phi - 6.2f);
    const Vector3f glow = colour.cwiseSqrt();
    const float wrap = 0.35f + 0.65f * std::max(0.0f, surfel.normal.dot(light));
    return 0.13f * r * (0.5f * Vector3f::Ones() + glow) + 0.30f * trt * glow + 0.22f * tt * glow +
           colour * (a.cos_light * wrap / pi * 2.0f);
}

Vector3f sky_light(const Vector3f& direction, const Look& look) {
    const float up = 0.5f + 0.5f * direction.y();
    return look.ground + up * (look.sky - look.ground);
}

Vector3f shade_hair(const Geometry& geometry, const Surfel& surfel, const Vector3f& eye,
                    const Look& look, const Sample& sample) {
    const Vector3f colour = strand_colour(surfel, look);
    Vector3f light = Vector3f::Zero();
    for (const Light& lamp : {look.key, look.rim}) {
        const Vector3f towards = jittered(lamp, sample[0], sample[1]);
        light += hair_scatter(surfel, towards, eye, colour, look)
                     .cwiseProduct(lamp.colour)
                     .cwiseProduct(visible(geometry, surfel, towards, far_away, colour));
    }
    const Vector3f out = (on_sphere(sample[2], sample[3]) + surfel.normal).normalized();
    return light + colour.cwiseProduct(sky_light(out, look))
                       .cwiseProduct(visible(geometry, surfel, out, sky_reach, colour));
}

Vector3f skin_light(const Geometry& geometry, const Surfel& surfel, const Vector3f& eye,
                    const Look& look, const Vector3f& skin, const Sample& sample) {
    Vector3f light = Vector3f::Zero();
    for (const Light& lamp : {look.key, look.rim}) {
        const Vector3f towards = jittered(lamp, sample[0], sample[1]);
        const float facing = surfel.normal.dot(towards);
        if (facing <= 0.0f)
            continue;
        const float shine =
            std::pow(std::max(0.0f, surfel.normal.dot((towards + eye).normalized())), 24.0f);
        light += (skin / pi * facing +
                  Vector3f::Constant(0.04f * (1.0f - surfel.scalp) * shine * facing))
                     .cwiseProduct(lamp.colour)
                     .cwiseProduct(visible(geometry, surfel, towards, far_away, look.hair_tip));
    }
    const Vector3f out = (on_sphere(sample[2], sample[3]) + surfel.normal).normalized();
    return light + skin.cwiseProduct(sky_light(out, look))
                       .cwiseProduct(visible(geometry, surfel, out, sky_reach, look.hair_tip));
}

// The k-th of skin_rays samples: a lattice in each pair, turned by `sample`.
Sample turned(Sample sample, int k) {
    constexpr float golden = 0.618033989f;
    for (size_t axis = 0; axis < sample.size(); ++axis) {
        const float step = axis % 2 ? golden : 1.0f / skin_rays;
        sample[axis] += static_cast<float>(k) * step;
        sample[axis] -= std::floor(sample[axis]);
    }
    return sample;
}

Vector3f shade_skin(const Geometry& geometry, const Surfel& surfel, const Vector3f& eye,
                    const Look& look, const Sample& sample) {
    const Vector3f skin = look.skin + surfel.scalp * (look.hair_root - look.skin);
    Vector3f light = Vector3f::Zero();
    for (int k = 0; k < skin_rays; ++k)
        light += skin_light(geometry, surfel, eye, look, skin, turned(sample, k));
    return light / static_cast<float>(skin_rays);
}

} // namespace

Vector3f shade(const Geometry& geometry, const Surfel& surfel, const Vector3f& to_eye,
               const Look& look, const Sample& sample) {
    return surfel.material == Material::hair ? shade_hair(geometry, surfel, to_eye, look, sample)
                                             : shade_skin(geometry, surfel, to_eye, look, sample);
}

} // namespace render
