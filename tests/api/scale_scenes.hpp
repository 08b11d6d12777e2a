// Hair that is larger or smaller than its groom, for the tests of what it does.
#pragma once

#include "support.hpp"

#include <functional>

namespace scaled {

inline constexpr plait_model models[] = {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_TRESSFX};
inline constexpr size_t strands = 4, vertices = 12;
inline constexpr float length = 0.22f; // m, of a strand
inline const Point place = {0.4f, 1.1f, -0.3f};

inline plait_roots roots_at(float scale, Point t = place) {
    auto roots = head_at(t);
    roots.scale = scale;
    return roots;
}

inline plait_pose pose_at(Point t = place) {
    return {{0, 0, 0, 1}, {t[0], t[1], t[2]}};
}

// Under the hair, of which some comes to lie on it.
inline plait_collider_desc ball(Point at = place) {
    auto desc = smooth_collider();
    desc.capsule.a[0] = desc.capsule.b[0] = 0.09f;
    desc.capsule.a[1] = desc.capsule.b[1] = -0.06f;
    desc.capsule.b[2] = 0.03f;
    desc.capsule.radius_a = desc.capsule.radius_b = 0.05f;
    desc.pose = pose_at(at);
    return desc;
}

// Hair on a head at `place`, before its first step; roots are set.
struct Scene {
    using Change = std::function<void(plait::SimDesc&)>;
    Scene(const plait::Context& context, plait_model model, float of, const Change& change = {})
        : scale(of), sim(make(context, model, change)) {
        sim.set_roots(roots_at(scale, at));
    }
    // On a head that is so many times as far from the origin, too: the same to the bit, where that is a
    // power of two.
    void move_away() {
        for (float& x : at)
            x *= scale;
        sim.teleport(roots_at(scale, at));
    }
    static plait::Sim make(const plait::Context& context, plait_model model, const Change& change) {
        plait::SimDesc desc;
        desc.model = model;
        desc.keep_last_frame = 1;
        desc.follows_per_guide = 2;
        if (model == PLAIT_MODEL_TRESSFX) { // whose hair stretches, and is braked against the world
            desc.params.gravity[1] = -1;
            desc.tressfx.vsp_coeff = 0;
        } else {
            desc.params.drag = 4;
        }
        if (change)
            change(desc);
        return plait::Sim(context, make_groom(tuft(strands, vertices)), desc);
    }
    // Of all strands, seen from the head and in its size.
    std::vector<float> hair() const {
        auto own = sim.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < own.size(); ++i)
            if (i % 4 < 3)
                own[i] = (own[i] - at[i % 4]) / scale;
        return own;
    }
    void resize(float to) {
        scale = to;
        sim.set_roots(roots_at(to, at));
    }

    float scale;
    Point at = place; // of the head
    plait::Sim sim;
};

} // namespace scaled
