// No solve raises its potential, and no substep gives energy: in float64, from what went into a
// stage over lanes and what came out, for strands that move hard. V and its names are
// strands/rod.clh's.
#include "closed_forms.hpp"
#include "lane_inputs.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plait::conformance {

using namespace cases;

namespace {

using Vec3 = Eigen::Vector3d;
using Quat = Eigen::Quaterniond;

struct State {
    std::vector<Vec3> x, v; // x relative to the root
    std::vector<Quat> q;
};

struct Strand {
    std::vector<double> length, stretch, bend, mass;
    std::vector<Vec3> section; // (kt, 0, kc)
    std::vector<Quat> rest;
    std::vector<Vec3> acceleration; // beside gravity
    std::vector<Vec3> pin;          // relative to the root
    std::vector<double> held;       // N/m, by the pin
    double drag = 1;                // scale of the params'
    Quat root;
    Vec3 root_at;
};

// Index of each buffer in the setups of lane_setup().
struct Places {
    size_t rest = 1, pose = 2, material = 3, turns = 4, x, v, q = 0, q_before = 0;
    size_t colliders, accelerations, pins;
    explicit Places(bool bends)
        : x(bends ? 9 : 8), v(x + 1), colliders(x - 4), accelerations(x - 3), pins(x - 2) {
        if (bends)
            q = v + 1, q_before = v + 2;
    }
};

Vec3 vec3_at(const Array& array, size_t row, size_t components = 3) {
    const float* p = &array.floats[components * row];
    return {p[0], p[1], p[2]};
}

Quat quat_at(const Array& array, size_t row) {
    const float* p = &array.floats[4 * row];
    return {p[3], p[0], p[1], p[2]};
}

State state_of(const Setup& setup, size_t strand, bool bends) {
    const Places at(bends);
    State state;
    for (size_t i = 0; i < setup.width; ++i) {
        const size_t row = strand * setup.width + i;
        state.x.push_back(i == 0 ? Vec3::Zero() : vec3_at(setup.buffers[at.x], row));
        state.v.push_back(vec3_at(setup.buffers[at.v], row));
        if (bends)
            state.q.push_back(quat_at(setup.buffers[at.q], row).normalized());
    }
    return state;
}

// Up to the tip.
Strand strand_of(const Setup& setup, size_t strand, bool bends, bool sections) {
    const Places at(bends);
    Strand s;
    for (size_t i = 0; i < setup.width; ++i) {
        const size_t row = strand * setup.width + i;
        const float* m = &setup.buffers[at.material].floats[PLAIT_LANE_MATERIAL_COMPONENTS * row];
        s.length.push_back(double(m[PLAIT_LANE_LENGTH]));
        s.stretch.push_back(double(m[PLAIT_LANE_STRETCH]));
        s.bend.push_back(double(m[PLAIT_LANE_BEND]));
        s.mass.push_back(double(m[PLAIT_LANE_MASS]));
        s.section.emplace_back(sections ? double(m[PLAIT_LANE_TWIST]) : 0, 0,
                               sections ? double(m[PLAIT_LANE_CROSS]) : 0);
        s.acceleration.push_back(vec3_at(setup.buffers[at.accelerations], row));
        s.pin.push_back(vec3_at(setup.buffers[at.pins], row, 4));
        s.held.push_back(
            double(setup.buffers[at.pins].floats[4 * row + 3])); // 0 where they are off
        if (bends)
            s.rest.push_back(quat_at(setup.buffers[at.turns], row));
        if (m[PLAIT_LANE_LENGTH] == 0)
            break;
    }
    const size_t last = (strand + 1) * setup.width - 1;
    s.drag = double(
        setup.buffers[at.material].floats[PLAIT_LANE_MATERIAL_COMPONENTS * last + PLAIT_LANE_DRAG]);
    s.root = quat_at(setup.buffers[at.pose], 2 * strand);
    s.root_at = s.root * vec3_at(setup.buffers[at.rest], strand * setup.width, 4) +
                vec3_at(setup.buffers[at.pose], 2 * strand + 1, 4);
    return s;
}

double elastic(const Strand& s, const State& at) {
    double sum = 0;
    for (size_t i = 0; i + 1 < s.mass.size() && !at.q.empty(); ++i) {
        const Quat turn = ((i == 0 ? s.root : at.q[i - 1]) * s.rest[i]).conjugate() * at.q[i];
        const Vec3 strain = at.x[i + 1] - at.x[i] - s.length[i] * (at.q[i] * Vec3::UnitX());
        sum += s.stretch[i] / 2 * strain.squaredNorm() +
               s.bend[i] * turn.vec().squaredNorm() / (1 + std::abs(turn.w())) +
               turn.vec().dot(s.section[i].cwiseProduct(turn.vec())) / 2;
    }
    return sum;
}

double held_by_pins(const Strand& s, const State& at) {
    double sum = 0;
    for (size_t i = 1; i < s.mass.size(); ++i)
        sum += s.held[i] / 2 * (at.x[i] - s.pin[i]).squaredNorm();
    return sum;
}

struct Forces {
    double h, drag;
    Vec3 push;
    Forces(const plait_lane_params& p, const Strand& s)
        : h(double(p.h)), drag(double(p.drag) * s.drag),
          push(Vec3(p.gravity[0], p.gravity[1], p.gravity[2]) +
               drag * Vec3(p.air[0], p.air[1], p.air[2])) {}
};

struct Balance {
    double before = 0, after = 0; // J, kinetic energy relative to the root, and what may become it
};

Balance balance(const Strand& s, const Forces& f, const Vec3& shift, const State& from,
                const State& to) {
    Balance b{elastic(s, from) - elastic(s, to) + held_by_pins(s, from) - held_by_pins(s, to), 0};
    const double gain = 1 + f.drag * f.h;
    const double still = 1e-10 / (f.h * f.h); // 1e-5 of its distance from the root is rounding
    for (size_t i = 1; i < s.mass.size(); ++i) {
        const Vec3 inertial = from.v[i] / gain + shift / f.h, moves = to.v[i] + shift / f.h;
        b.before +=
            s.mass[i] * (gain / 2 * (inertial.squaredNorm() + still * to.x[i].squaredNorm()) +
                         (f.push + s.acceleration[i]).dot(to.x[i] - from.x[i]));
        b.after += s.mass[i] * gain / 2 * moves.squaredNorm();
    }
    return b;
}

using Vec4 = Eigen::Vector4d;

// How deep a point is in the hull of two spheres (centre, radius): the distance is convex along the
// axis.
double depth_in(const Vec4& a, const Vec4& b, const Vec3& x) {
    const auto above = [&](double k) {
        const Vec4 at = (1 - k) * a + k * b;
        return (x - at.head<3>()).norm() - at.w();
    };
    double low = 0, high = 1;
    for (int i = 0; i < 80; ++i) {
        const double third = (high - low) / 3;
        if (above(low + third) < above(high - third))
            high -= third;
        else
            low += third;
    }
    return -above(low);
}

// Of a collider whose rows lie from `row` on, at the substep's end.
double depth_under(const Array& colliders, size_t row, const Vec3& x) {
    const auto at = [&](size_t element) { return quat_at(colliders, row + element).coeffs(); };
    const Vec4 a = at(PLAIT_COLLIDER_END), b = at(PLAIT_COLLIDER_END + 1);
    const double kind = at(PLAIT_COLLIDER_FRICTION).y();
    if (kind == double{PLAIT_KIND_CAPSULE})
        return depth_in(a, b, x);
    if (kind == double{PLAIT_KIND_PLANE})
        return b.head<3>().dot(a.head<3>() - x);
    // of a box: how far the nearest face, or all of it, is
    const Quat q = quat_at(colliders, row + PLAIT_COLLIDER_BEGIN + 1);
    const Vec3 beyond = (q.conjugate() * (x - a.head<3>())).cwiseAbs() - b.head<3>();
    return a.w() - (beyond.maxCoeff() > 0 ? beyond.cwiseMax(0).norm() : beyond.maxCoeff());
}

// What the contacts' springs hold: as at l/200 in all that is deeper.
double held(const Strand& s, const Setup& setup, const State& at, bool bends) {
    const auto& p = setup.params_as<plait_lane_params>();
    const Array& colliders = setup.buffers[Places(bends).colliders];
    double sum = 0;
    for (size_t i = 1; i < s.mass.size(); ++i) {
        double depth = 0;
        for (size_t c = p.collider_first; c < p.collider_first + p.collider_count; ++c) {
            const Vec3 x = s.root_at + at.x[i];
            depth = std::max(depth, depth_under(colliders, PLAIT_COLLIDER_STRIDE * c, x));
        }
        depth = std::min(depth, s.length[i - 1] / 200);
        sum += s.mass[i] * double(p.contact_rate) / 2 * depth * depth;
    }
    return sum;
}

// What a stage leaves is what the next substep starts from.
Setup after(Bench& bench, plait_stage stage, const Setup& setup) {
    Setup next = setup;
    next.buffers = bench.run(stage, setup.items, setup.width, setup.params_as<plait_lane_params>(),
                             setup.buffers);
    return next;
}

// Strands limited and all substeps of them.
struct Count {
    size_t limited = 0, all = 0;
};

void check_substep(const Setup& before, const Setup& now, bool bends, bool sections, Count& count) {
    const Places at(bends);
    for (size_t k = 0; k < before.items; ++k) {
        const Strand s = strand_of(before, k, bends, sections);
        const Forces forces(before.params_as<plait_lane_params>(), s);
        const Vec3 shift = vec3_at(before.buffers[at.x], k * before.width) - s.root_at;
        Balance b = balance(s, forces, shift, state_of(before, k, bends), state_of(now, k, bends));
        b.before += held(s, before, state_of(before, k, bends), bends) -
                    held(s, before, state_of(now, k, bends), bends);
        // x, q and v are float32
        const double rounding =
            1e-4 * std::abs(b.before) + 1e-6 * elastic(s, state_of(before, k, bends)) + 1e-13;
        EXPECT_LE(b.after, std::max(b.before, 0.0) + rounding) << before.name << ", strand " << k;
        count.limited += b.after > 0.999 * b.before - rounding;
        ++count.all;
    }
}

// Roots and colliders stand still: else they give energy.
void stop(Setup& setup, bool bends) {
    const Places at(bends);
    for (size_t k = 0; k < setup.items; ++k) {
        const Vec3 root = strand_of(setup, k, bends, false).root_at;
        for (int c = 0; c < 3; ++c)
            setup.buffers[at.x].floats[3 * k * setup.width + c] = static_cast<float>(root[c]);
    }
    std::vector<float>& colliders = setup.buffers[at.colliders].floats;
    for (size_t c = 0; c < colliders.size(); c += size_t{4} * PLAIT_COLLIDER_STRIDE) {
        float* capsule = &colliders[c];
        std::copy_n(capsule + 4 * PLAIT_COLLIDER_END, 4, capsule + 4 * PLAIT_COLLIDER_BEGIN);
        const float none[] = {0, 0, 0, 1};
        std::copy_n(none, 4, capsule + 4 * PLAIT_COLLIDER_TURN);
    }
}

// What is pressed to a collider, slides along it or starts inside keeps what it has, and what its
// contact's spring gives back.
void no_contact_gives_energy(Bench& bench, plait_stage stage, uint32_t iterations, bool bends,
                             bool sections) {
    Count count;
    std::vector<std::pair<Size, LaneHair>> hairs;
    for (const Size& size : contact_sizes()) {
        for (const uint32_t seed : {32u, 39u})
            hairs.emplace_back(size, make_lane_hair_in_contact(size, seed, 0.3f));
        for (const uint32_t seed : {36u, 45u})
            hairs.emplace_back(size, make_lane_hair_on_surfaces(size, seed, 0.3f, 0));
    }
    for (const auto& [size, hair] : hairs) {
        Setup setup = lane_setup(size, hair, lane_params(size, iterations, 0), bends);
        stop(setup, bends);
        for (int i = 0; i < 12; ++i) {
            const Setup next = after(bench, stage, setup);
            check_substep(setup, next, bends, sections, count);
            setup = next;
        }
    }
    EXPECT_GT(count.limited, count.all / 100); // else nothing was tried
    EXPECT_LT(count.limited, count.all);
}

// What a pin gives is what its spring held.
void no_pin_gives_energy(Bench& bench, plait_stage stage, uint32_t iterations, bool bends,
                         bool sections) {
    Count count;
    for (const Size& size : {Size{67, 16}, Size{7, 31}}) {
        const LaneHair lanes = make_lane_hair_spun(size, 7);
        const plait_lane_params params = lane_params(size, iterations, 0);
        Setup setup = pinned(lane_setup(size, lanes, params, bends), lanes, bends);
        stop(setup, bends);
        for (int i = 0; i < 12; ++i) {
            const Setup next = after(bench, stage, setup);
            check_substep(setup, next, bends, sections, count);
            setup = next;
        }
    }
    EXPECT_GT(count.limited, 0u); // else nothing was tried
    EXPECT_LT(count.limited, count.all);
}

void no_substep_gives_energy(Bench& bench, plait_stage stage, uint32_t iterations, bool bends,
                             bool sections) {
    constexpr int substeps = 12;
    Count count;
    for (const Size& size : {Size{67, 16}, Size{7, 31}})
        for (const float drag : {0.0f, 4.0f}) {
            plait_lane_params params = lane_params(size, iterations, 0);
            params.drag = drag;
            Setup setup = lane_setup(size, make_lane_hair_spun(size, 7), params, bends);
            for (int i = 0; i < substeps; ++i) {
                const Setup next = after(bench, stage, setup);
                check_substep(setup, next, bends, sections, count);
                setup = next;
            }
        }
    EXPECT_GT(count.limited, count.all / 100); // else nothing was tried
    EXPECT_LT(count.limited, count.all);
}

void articulated_gives_no_energy(Bench& bench) {
    no_substep_gives_energy(bench, PLAIT_STAGE_articulated, 0, true, true);
    no_contact_gives_energy(bench, PLAIT_STAGE_articulated, 0, true, true);
    no_pin_gives_energy(bench, PLAIT_STAGE_articulated, 0, true, true);
}

} // namespace

const std::vector<ClosedForm>& energy_closed_forms() {
    static const std::vector<ClosedForm> list = {
        PLAIT_CLOSED_FORM(articulated_gives_no_energy),
    };
    return list;
}

} // namespace plait::conformance
