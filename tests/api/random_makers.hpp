// Poses, colliders, pins, winds and what else a sim may be given, at random and within range, for hair of a
// few guides around the origin.
#pragma once

#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

inline constexpr size_t guides = 5, longest = 17;
inline constexpr uint32_t follows_per_guide = 2, follows = guides * follows_per_guide;
inline constexpr uint32_t vertices_of[guides] = {4, 9, longest, longest, longest};
inline constexpr float spacing = 0.02f; // m, of the hair's vertices

class Dice {
  public:
    explicit Dice(uint32_t seed) : engine_(seed) {}

    uint32_t below(uint32_t end) { return static_cast<uint32_t>(engine_() % end); }
    bool one_in(uint32_t n) { return below(n) == 0; }
    // the same on every machine, which the standard's distributions are not
    float between(float low, float high) {
        return low + (high - low) * static_cast<float>(engine_()) / 4294967296.0f;
    }
    float decade(float low, float high) { return std::pow(10.0f, between(low, high)); }
    Point in_cube(float half) {
        return {between(-half, half), between(-half, half), between(-half, half)};
    }
    std::array<float, 4> turn() {
        std::array<float, 4> q{};
        float squared = 0;
        while (squared < 0.01f || squared > 1) {
            squared = 0;
            for (float& c : q) {
                c = between(-1, 1);
                squared += c * c;
            }
        }
        for (float& c : q)
            c /= std::sqrt(squared);
        return q;
    }

  private:
    std::mt19937 engine_;
};

// Where hair is; now and then as far as `far` m away, so that a collider or a target jumps.
inline Point somewhere(Dice& dice, float far) {
    return dice.in_cube(dice.one_in(8) ? far : 0.3f);
}

inline plait_pose random_pose(Dice& dice) {
    plait_pose pose{};
    const auto q = dice.turn();
    const auto t = somewhere(dice, 3); // in a frame: 200 m/s
    std::copy(q.begin(), q.end(), pose.q);
    std::copy(t.begin(), t.end(), pose.t);
    return pose;
}

inline plait_collider_desc random_collider(Dice& dice) {
    auto desc = smooth_collider();
    desc.kind = static_cast<plait_collider_kind>(dice.below(3));
    const Point a = dice.in_cube(0.1f), b = dice.one_in(4) ? a : dice.in_cube(0.2f);
    const Point n = dice.in_cube(1);
    const auto q = dice.turn();
    std::copy(a.begin(), a.end(), desc.capsule.a);
    std::copy(a.begin(), a.end(), desc.plane.point);
    std::copy(a.begin(), a.end(), desc.box.centre);
    std::copy(b.begin(), b.end(), desc.capsule.b);
    std::copy(n.begin(), n.end(), desc.plane.normal);
    std::copy(q.begin(), q.end(), desc.box.orientation);
    desc.capsule.radius_a = dice.decade(-4, -0.5f);
    desc.capsule.radius_b = dice.one_in(2) ? desc.capsule.radius_a : dice.decade(-4, -0.5f);
    for (float& half : desc.box.half_extents) // slabs, needles, points among them
        half = dice.one_in(4) ? 0 : dice.decade(-4, -0.5f);
    desc.box.rounding = dice.one_in(3) ? 0 : dice.decade(-5, -1);
    desc.friction = dice.one_in(3) ? 0 : dice.decade(-2, 1);
    desc.pose = random_pose(dice);
    return desc;
}

// A frame of reference near the head.
inline plait_frame_desc random_frame(Dice& dice, const Point& head) {
    auto desc = plait_frame_desc_defaults();
    const auto q = dice.turn();
    const Point off = dice.in_cube(0.3f);
    std::copy(q.begin(), q.end(), desc.pose.q);
    for (size_t i = 0; i < 3; ++i)
        desc.pose.t[i] = head[i] + off[i];
    desc.felt_translation = dice.one_in(3) ? 0 : dice.between(0, 1);
    desc.felt_rotation = dice.one_in(3) ? 0 : dice.between(0, 1);
    desc.air = static_cast<plait_frame_air>(dice.below(3));
    return desc;
}

// Closed, or a sheet of two sides, from 1 cm to 30 cm.
inline plait::Mesh random_mesh(Dice& dice, plait_collider_mesh_desc& desc) {
    const double size = double(dice.decade(-2, -0.5f));
    const ShapeMesh shapes[] = {box_mesh(size, 0.3 * size, size),
                                ellipsoid_mesh(size, 0.6 * size, 0.8 * size, 12, 8),
                                torus_mesh(size, 0.3 * size, 8, 12), sheet_mesh(size)};
    const uint32_t kind = dice.below(4);
    auto given = plait_mesh_desc_defaults();
    given.positions = {shapes[kind].positions.data(), shapes[kind].positions.size(), 0};
    given.triangles = {shapes[kind].triangles.data(), shapes[kind].triangles.size(), 0};
    desc.two_sided = kind == 3 || dice.one_in(4);
    desc.cells = 8 + dice.below(17);
    desc.clearance = dice.below(2);
    desc.margin = dice.one_in(2) ? 0 : dice.decade(-5, -2);
    desc.friction = dice.one_in(3) ? 0 : dice.decade(-2, 1);
    desc.pose = random_pose(dice);
    return plait::Mesh(given);
}

// A body of up to 240 faces, with a margin or none.
inline plait::Mesh random_hull(Dice& dice, plait_collider_hull_desc& desc) {
    const double size = double(dice.decade(-2, -0.5f));
    const ShapeMesh shape = dice.one_in(2) ? box_mesh(size, 0.3 * size, 0.01 * size)
                                           : ellipsoid_mesh(size, 0.6 * size, 0.8 * size, 16, 8);
    auto given = plait_mesh_desc_defaults();
    given.positions = {shape.positions.data(), shape.positions.size(), 0};
    given.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    desc.margin = dice.one_in(2) ? 0 : dice.decade(-5, -2);
    desc.friction = dice.one_in(3) ? 0 : dice.decade(-2, 1);
    desc.pose = random_pose(dice);
    return plait::Mesh(given);
}

// All vertices of a mesh somewhere within 2 cm of where they were.
inline std::vector<float> bent(Dice& dice, std::vector<float> positions) {
    for (float& c : positions)
        c += dice.between(-0.02f, 0.02f);
    return positions;
}

inline plait_pin random_pin(Dice& dice) {
    plait_pin pin{};
    pin.strand = dice.below(guides);
    pin.vertex = 1 + dice.below(vertices_of[pin.strand] - 1);
    pin.frame = static_cast<plait_pin_frame>(dice.below(3));
    const Point target = somewhere(dice, dice.decade(0, 5));
    std::copy(target.begin(), target.end(), pin.target);
    pin.stiffness = dice.decade(-9, 6);
    return pin;
}

// No vertex twice.
inline std::vector<plait_pin> random_pins(Dice& dice) {
    std::vector<plait_pin> pins;
    for (uint32_t i = dice.below(7); i > 0; --i) {
        const plait_pin pin = random_pin(dice);
        bool free = true;
        for (const plait_pin& other : pins)
            free = free && (other.strand != pin.strand || other.vertex != pin.vertex);
        if (free)
            pins.push_back(pin);
    }
    return pins;
}

inline plait_wind_desc random_wind(Dice& dice) {
    auto wind = plait_wind_desc_defaults();
    const Point velocity = dice.in_cube(dice.decade(-1, 1.5f));
    std::copy(velocity.begin(), velocity.end(), wind.velocity);
    wind.turbulence = dice.one_in(2) ? 0 : dice.decade(-1, 1);
    wind.scale = dice.decade(-2, 1);
    wind.octaves = 1 + dice.below(8);
    wind.gusts = dice.one_in(2) ? 0 : dice.between(0, 2);
    wind.gust_period = dice.decade(-2, 1);
    wind.tangential = dice.between(0, 1);
    wind.diameter = dice.one_in(2) ? 0 : dice.decade(-5, -3);
    wind.seed = dice.below(1000);
    wind.hairs_per_strand = static_cast<float>(wind.seed); // 0: itself
    wind.shelter = wind.seed % 4 > 0;
    return wind;
}

inline plait_detail_desc random_detail(Dice& dice) {
    auto detail = plait_detail_desc_defaults();
    for (size_t i = 0; i < 4; ++i) {
        detail.clump[i] = dice.between(0, 1);
        detail.curl[i] = dice.one_in(2) ? 0 : dice.decade(-4, -1);
        detail.frizz[i] = dice.one_in(2) ? 0 : dice.decade(-4, -1);
    }
    detail.curl_pitch = dice.decade(-3, 0);
    detail.curl_scatter = dice.between(0, 1);
    detail.frizz_length = dice.decade(-3, 0);
    detail.seed = dice.below(1000);
    detail.clumps = dice.below(follows + 1);
    return detail;
}

// Between the guides, of up to four of them each.
inline plait::FollowMap random_map(Dice& dice, const plait::Groom& hair) {
    auto desc = plait_follow_map_desc_defaults();
    std::vector<uint32_t> of;
    std::vector<float> weights;
    for (uint32_t i = 0; i < follows; ++i) {
        float sum = 0, one[4];
        for (float& weight : one)
            sum += weight = dice.one_in(3) ? 0 : dice.between(0, 1);
        for (const float weight : one) {
            of.push_back(dice.below(guides));
            weights.push_back(sum > 0 ? weight / sum : 0.25f);
        }
    }
    desc.follows = hair;
    desc.guide_count = guides;
    desc.guides = plait::view(of, 4);
    desc.weights = plait::view(weights, 4);
    return plait::FollowMap(desc);
}
