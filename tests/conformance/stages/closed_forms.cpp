#include "closed_forms.hpp"

#include <array>
#include <cmath>

namespace plait::conformance {

using namespace cases;
using Point = std::array<float, 3>;

namespace {

const std::vector<float> unit_pose = {0, 0, 0, 1, 0, 0, 0, 0};
const float s45 = std::sqrt(0.5f);
const std::vector<float> quarter_about_z = {0, 0, s45, s45, 1, 2, 3, 0}; // and t = (1, 2, 3)

// Two pinned vertices, one that moves at 3 m/s along z, and padding.
void integrate_is_free_fall(Bench& bench) {
    const std::vector<float> rest = {0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0};
    const std::vector<float> x = {5, 5, 5, 0, 6, 5, 5, 0, 2, 0, 0, 1, 9, 9, 9, 1};
    const std::vector<float> before = {4, 4, 4, 0, 4, 4, 4, 0, 2, 0, -.3f, 1, 8, 8, 8, 1};
    Array pull = null_array();
    plait_integrate_params params = {4, 0.1f, 0, 0, 0, {0, -10, 0}, 0};
    const auto fall = [&] {
        return bench.run(PLAIT_STAGE_integrate, 4, 1, params,
                         {float4s(rest), uints({3}), float4s(unit_pose), pull, float4s(x),
                          float4s(before), float4s(before)});
    };
    auto out = fall();
    expect_near(out[4], {0, 0, 0, 0, 1, 0, 0, 0, 2, -.1f, .3f, 1, 9, 9, 9, 1});
    expect_near(out[5], {5, 5, 5, 0, 6, 5, 5, 0, 2, 0, 0, 1, 8, 8, 8, 1}, 0);
    expect_near(out[6], before, 0);
    params.damping = 0.1f; // e^(-60 * 0.1 * 0.1) of the velocity is left
    params.global_stiffness = 0.5f;
    params.global_range = 0.5f; // vertices 0 and 1 of 3
    out = fall();
    expect_near(out[4], {0, 0, 0, 0, 1, 0, 0, 0, 2, -.1f, .3f * std::exp(-.6f), 1, 9, 9, 9, 1});
    params.global_range = 1;
    out = fall();
    expect_near(out[4], {0, 0, 0, 0, 1, 0, 0, 0, 2, -.05f, .15f * std::exp(-.6f), 1, 9, 9, 9, 1});
    params = {4, 0.1f, 0, 0, 0, {0, -10, 0}, 1};
    pull = float4s({9, 9, 9, 0, 9, 9, 9, 0, 3, 7, -4, 0, 9, 9, 9, 0}); // of the free vertex
    out = fall();
    expect_near(out[4], {0, 0, 0, 0, 1, 0, 0, 0, 2.03f, -.03f, .26f, 1, 9, 9, 9, 1});
}

// A component that is not finite or too large, and a vertex whose components may be just as they
// are; past the tip of the second strand nothing pulls.
const float most = PLAIT_MOST_ACCELERATION;
const std::vector<float> pulls = {NAN, 2, 3, 0,      1, -INFINITY, 3,    0, 1, 2, 1.001f * most,
                                  0,   1, 2, -1e30f, 0, 1,         most, 3, 0, 4, 5,
                                  6,   0};
const std::vector<float> allowed = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, most, 3, 0, 0, 0};

void accelerations_out_of_range_do_not_pull_at_lanes(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_lane_accelerate, 2, 3, plait_lane_tile_params{3, 1, 3, 0},
                  {null_array(), uints({3, 2}), float4s(pulls), null_array(),
                   lane_floats(std::vector<float>(18, 7), 3)});
    expect_near(out[4], allowed, 0);
}

void accelerations_out_of_range_do_not_pull_at_vertices(Bench& bench) {
    std::vector<float> x, fallen;
    for (size_t i = 0; i < 6; ++i) {
        x.insert(x.end(), {0, 0, 0, 1});
        for (size_t c = 0; c < 3; ++c)
            fallen.push_back(0.01f * allowed[3 * i + c]);
        fallen.push_back(1);
    }
    const plait_integrate_params params = {3, 0.1f, 0, 0, 0, {0, 0, 0}, 1};
    std::vector<float> poses = unit_pose;
    poses.insert(poses.end(), unit_pose.begin(), unit_pose.end());
    const auto out = bench.run(PLAIT_STAGE_integrate, 6, 1, params,
                               {float4s(x), uints({3, 2}), float4s(poses), float4s(pulls),
                                float4s(x), float4s(x), float4s(x)});
    expect_near(out[4], fallen, 1e-4); // of 100 m
}

void global_shape_goes_part_of_the_way(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_global_shape, 3, 1, plait_global_shape_params{3, 0.25f, 0.6f},
                  {float4s({0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0}), uints({3}),
                   float4s(quarter_about_z), float4s({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1})});
    // rest 1 is at (1, 3, 3); 2 is beyond 0.6 * 3 vertices, 0 is pinned
    expect_near(out[3], {0, 0, 0, 0, .25f, .75f, .75f, 1, 0, 0, 0, 1});
}

void length_splits_by_movability(Bench& bench) {
    const auto shorten = [&](float w) {
        return bench.run(
            PLAIT_STAGE_length, 1, 3, plait_length_params{3, 1},
            {floats({1, 1, 0}), uints({2}), float4s({0, 0, 0, w, 0, 3, 0, 1, 7, 7, 7, 1})})[2];
    };
    expect_near(shorten(1), {0, 1, 0, 1, 0, 2, 0, 1, 7, 7, 7, 1});
    expect_near(shorten(0), {0, 0, 0, 0, 0, 1, 0, 1, 7, 7, 7, 1});
}

// Even edges first: the middle vertex of a pinned chain is moved by edge 0 and then shared by
// edge 1.
void length_is_red_then_black(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_length, 1, 3, plait_length_params{3, 1},
                  {floats({1, 1, 0}), uints({3}), float4s({0, 0, 0, 0, 2, 0, 0, 1, 4, 0, 0, 1})});
    expect_near(out[2], {0, 0, 0, 0, 2, 0, 0, 1, 3, 0, 0, 1});
}

// A free vertex between two that are far away, and a capsule.
std::vector<float> touch(Bench& bench, const std::vector<float>& capsule, const Point& x,
                         const Point& before) {
    const auto out = bench.run(
        PLAIT_STAGE_tressfx_collide, 2, 1, plait_tressfx_collide_params{2, 1, 0},
        {uints({2}), float4s(capsule), float4s({9, 9, 9, 0, before[0], before[1], before[2], 1}),
         float4s({0, 0, 0, 0, x[0], x[1], x[2], 1})});
    expect_near(floats({out[3].floats.begin(), out[3].floats.begin() + 4}), {0, 0, 0, 0}, 0);
    return {out[3].floats.begin() + 4, out[3].floats.end()};
}

// Along x; over the substep it moves along x and spins about it by the half angle `spin`.
std::vector<float> capsule(float ra, float rb, float friction, float motion = 0, float spin = 0) {
    const std::vector<float> begin = {0, 0, 0, ra, 1, 0, 0, rb};
    const std::vector<float> end = {motion, 0, 0, ra, 1 + motion, 0, 0, rb};
    const std::vector<float> turn = {std::sin(spin), 0, 0, std::cos(spin)};
    std::vector<float> packed;
    for (const auto& part : {begin, end, turn, {friction, 0, 0, 0}})
        packed.insert(packed.end(), part.begin(), part.end());
    return packed;
}

void collide_pushes_to_the_surface(Bench& bench) {
    const auto push = [&](const std::vector<float>& c, const Point& x) {
        return floats(touch(bench, c, x, x));
    };
    expect_near(push(capsule(.5f, .5f, 0), {.3f, .2f, 0}), {.3f, .5f, 0, 1});
    expect_near(push(capsule(.5f, .5f, 0), {-.1f, 0, 0}), {-.5f, 0, 0, 1});
    expect_near(push(capsule(.5f, .5f, 0), {1, 0, .2f}), {1, 0, .5f, 1});
    expect_near(push(capsule(.5f, .5f, 0), {.3f, .6f, 0}), {.3f, .6f, 0, 1}, 0);
    // Tapered: sin(phi) = (0.5 - 0.3)/1; from the foot (1/4, 0, 0), where the radius is 0.45.
    const float nx = .2f, ny = std::sqrt(.96f);
    expect_near(push(capsule(.5f, .3f, 0), {.25f + .1f * nx, .1f * ny, 0}),
                {.25f + .45f * nx, .45f * ny, 0, 1});
    // The sphere of radius 2 at a holds the one at b.
    expect_near(push(capsule(2, .5f, 0), {0, 1, 0}), {0, 2, 0, 1});
}

// Moved 0.1 m along the surface and pushed 0.3 m out of it.
void collide_rubs(Bench& bench) {
    const auto rub = [&](float friction, float motion) {
        return floats(
            touch(bench, capsule(.5f, .5f, friction, motion), {.3f, .2f, 0}, {.2f, .5f, 0}));
    };
    expect_near(rub(0, 0), {.3f, .5f, 0, 1});
    expect_near(rub(.2f, 0), {.24f, .5f, 0, 1});
    expect_near(rub(1, 0), {.2f, .5f, 0, 1});   // stopped, not reversed
    expect_near(rub(1, .1f), {.3f, .5f, 0, 1}); // moves with the surface
    // held on a capsule that spins by a twentieth: carried around it, pushed .3 m out
    const auto out = touch(bench, capsule(.5f, .5f, 9, 0, .025f), {.3f, .2f, 0}, {.3f, .5f, 0});
    expect_near(floats(out), {.3f, .5f, .5f * std::sin(.05f), 1});
}

std::vector<float> row(const std::vector<std::vector<float>>& elements) {
    std::vector<float> packed;
    for (const auto& element : elements)
        packed.insert(packed.end(), element.begin(), element.end());
    return packed;
}

// Through `p`, which moves by `motion` along x.
std::vector<float> plane(const Point& p, const std::vector<float>& normal, float friction,
                         float motion = 0) {
    const std::vector<float> n = {normal[0], normal[1], normal[2], 0};
    return row({{p[0], p[1], p[2], 0},
                n,
                {p[0] + motion, p[1], p[2], 0},
                n,
                {0, 0, 0, 1},
                {friction, PLAIT_KIND_PLANE, 0, 0}});
}

std::vector<float> box(const Point& half, float rounding, const std::vector<float>& orientation) {
    return row({{0, 0, 0, rounding},
                orientation,
                {0, 0, 0, rounding},
                {half[0], half[1], half[2], 0},
                {0, 0, 0, 1},
                {0, PLAIT_KIND_BOX, 0, 0}});
}

void collide_pushes_out_of_planes(Bench& bench) {
    const auto p = plane({5, .1f, -7}, {0, 1, 0}, 0);
    expect_near(floats(touch(bench, p, {.3f, -2, .1f}, {.3f, -2, .1f})), {.3f, .1f, .1f, 1});
    expect_near(floats(touch(bench, p, {.3f, .2f, 0}, {.3f, 2, 0})), {.3f, .2f, 0, 1}, 0);
    const auto leaning = plane({0, 0, 0}, {.6f, .8f, 0}, 0);
    expect_near(floats(touch(bench, leaning, {-1, 0, 3}, {0, 0, 0})), {-.64f, .48f, 3, 1});
    // .3 m deep, slipped by .1 m along the surface: friction takes .06 m, or carries along
    const auto rub = [&](float friction, float motion) {
        return floats(touch(bench, plane({0, .5f, 0}, {0, 1, 0}, friction, motion), {.3f, .2f, 0},
                            {.2f, .5f, 0}));
    };
    expect_near(rub(.2f, 0), {.24f, .5f, 0, 1});
    expect_near(rub(9, .1f), {.3f, .5f, 0, 1});
}

void collide_pushes_out_of_boxes(Bench& bench) {
    const auto push = [&](const std::vector<float>& b, const Point& x) {
        return floats(touch(bench, b, x, x));
    };
    const auto sharp = box({.4f, .2f, .3f}, 0, {0, 0, 0, 1});
    expect_near(push(sharp, {.3f, .15f, .1f}), {.3f, .2f, .1f, 1}); // the nearest face
    expect_near(push(sharp, {-.35f, .1f, .1f}), {-.4f, .1f, .1f, 1});
    expect_near(push(sharp, {.1f, 0, -.25f}), {.1f, 0, -.3f, 1});
    expect_near(push(sharp, {.3f, .21f, 0}), {.3f, .21f, 0, 1}, 0);
    const auto rounded = box({.4f, .2f, .3f}, .1f, {0, 0, 0, 1});
    expect_near(push(rounded, {.3f, .25f, .1f}), {.3f, .3f, .1f, 1});
    expect_near(push(rounded, {.3f, .15f, .1f}), {.3f, .3f, .1f, 1});    // in the box without it
    expect_near(push(rounded, {.43f, .24f, .1f}), {.46f, .28f, .1f, 1}); // an edge
    expect_near(push(rounded, {.42f, -.21f, .32f}),
                {.4f + .2f / 3, -.2f - .1f / 3, .3f + .2f / 3, 1}); // a corner
    // a quarter about z: its x lies along y
    const float s = std::sqrt(.5f);
    const auto turned = box({.4f, .2f, .3f}, 0, {0, 0, s, s});
    expect_near(push(turned, {.1f, .35f, 0}), {.1f, .4f, 0, 1});
    expect_near(push(turned, {.19f, .1f, 0}), {.2f, .1f, 0, 1});
}

// Without width it is a capsule, without extents a sphere.
void collide_box_becomes_a_capsule(Bench& bench) {
    auto rod = box({.5f, 0, 0}, .25f, {0, 0, 0, 1});
    auto ball = box({0, 0, 0}, .25f, {.36f, -.48f, .64f, .48f});
    auto as_rod = row({{-.5f, 0, 0, .25f}, {.5f, 0, 0, .25f}});
    auto as_ball = row({{0, 0, 0, .25f}, {0, 0, 0, .25f}});
    for (auto* c : {&as_rod, &as_ball}) {
        const std::vector<float> ends = *c;
        *c = row({ends, ends, {0, 0, 0, 1}, {0, PLAIT_KIND_CAPSULE, 0, 0}});
    }
    for (const Point& x : {Point{.1f, .2f, .05f}, Point{.6f, -.1f, .1f}, Point{-.55f, .02f, .2f},
                           Point{.05f, -.1f, .15f}}) {
        expect_near(floats(touch(bench, rod, x, x)), touch(bench, as_rod, x, x));
        expect_near(floats(touch(bench, ball, x, x)), touch(bench, as_ball, x, x));
    }
}

void local_shape_straightens(Bench& bench) {
    // k = 0.8/2; the target of vertex 2 is (2, 0, 0); vertex 1 is pinned, then free.
    const auto bend = [&](float w, uint32_t iterations) {
        return bench.run(PLAIT_STAGE_local_shape, 1, 1,
                         plait_local_shape_params{3, 0.8f, iterations},
                         {float4s({0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0}), uints({3}),
                          float4s(unit_pose), float4s({0, 0, 0, 0, 1, 0, 0, w, 1, 1, 0, 1})})[3];
    };
    expect_near(bend(0, 1), {0, 0, 0, 0, 1, 0, 0, 0, 1.4f, .6f, 0, 1});
    expect_near(bend(1, 1), {0, 0, 0, 0, .6f, .4f, 0, 1, 1.4f, .6f, 0, 1});
    expect_near(bend(0, 2), {0, 0, 0, 0, 1, 0, 0, 0, 1.64f, .36f, 0, 1});
}

// Three vertices along x, the last two free, at rest; h = 0.1 s.
Array blow(Bench& bench, uint32_t form, const Point& wind) {
    const std::vector<float> x = {0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 1, 3, 0, 0, 1};
    plait_tressfx_wind_params params = {4, 0.1f, form, 5, {wind[0], wind[1], wind[2], 0}, {}};
    for (size_t corner = 0; corner < 4; ++corner)
        for (size_t c = 0; c < 3; ++c)
            params.corner[4 * corner + c] = wind[c] / 2; // any two opposite ones sum to the wind
    return bench.run(PLAIT_STAGE_tressfx_wind, 1, 4, params,
                     {uints({4}), float4s(x), float4s(x)})[2];
}

void wind_drags_across_the_strand(Bench& bench) {
    // s = h k |u| = 0.1 * 5 * 2 = 1: half of the air's way of 0.2 m
    expect_near(blow(bench, PLAIT_WIND_DRAG, {0, 0, 2}),
                {0, 0, 0, 0, 1, 0, 0, 0, 2, 0, .1f, 1, 3, 0, .1f, 1});
    expect_near(blow(bench, PLAIT_WIND_DRAG, {2, 0, 0}),
                {0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 1, 3, 0, 0, 1});
}

// -((d x W) x d) h^2 = -|d|^2 W h^2 across the strand: against the wind, as published.
void wind_as_published_blows_backwards(Bench& bench) {
    expect_near(blow(bench, PLAIT_WIND_PUBLISHED, {0, 0, 2}),
                {0, 0, 0, 0, 1, 0, 0, 0, 2, 0, -.02f, 1, 3, 0, 0, 1});
}

void clamp_limits_the_step(Bench& bench) {
    const auto out = bench.run(PLAIT_STAGE_clamp, 3, 1, plait_clamp_params{3, 1},
                               {float4s({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0}),
                                float4s({0, 3, 4, 1, 0, 0, .5f, 1, 0, 3, 4, 0})});
    expect_near(out[1], {0, .6f, .8f, 1, 0, 0, .5f, 1, 0, 3, 4, 0});
}

// Arc lengths 1 and 3, reach 1: the first vertex is drawn in, the second is near enough.
void attach_bounds_the_distance_to_the_root(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_attach, 1, 1, plait_attach_params{3, 1},
                  {floats({1, 2, 0}), uints({3}), float4s({0, 0, 0, 0, 0, 3, 4, 1, 2, 0, 0, 1})});
    expect_near(out[2], {0, 0, 0, 0, 0, .6f, .8f, 1, 2, 0, 0, 1});
}

// The root segment turns from x to y while its root moves to (5, 0, 0).
void shock_carries_the_strand(Bench& bench) {
    const std::vector<float> x = {5, 0, 0, 0, 5, 1, 0, 0, 9, 9, 9, 1, 9, 9, 9, 1};
    const std::vector<float> before = {1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 1, 3, 0, 0, 1};
    const auto motion_of = [&](float threshold, uint32_t form) {
        return bench.run(PLAIT_STAGE_strand_data, 1, 1,
                         plait_strand_data_params{4, .25f, threshold, form},
                         {float4s(x), float4s(before), float4s(before), unwritten_float4s(2)})[3];
    };
    // a = |x1 - prev1| = |(3, 1, 0)| = sqrt 10
    const float a = std::sqrt(10.0f);
    expect_near(motion_of(2 * a, PLAIT_SHOCK_THRESHOLD), {0, 0, s45, s45, 5, -1, 0, .25f});
    expect_near(motion_of(.9f * a, PLAIT_SHOCK_THRESHOLD), {0, 0, s45, s45, 5, -1, 0, 1});
    expect_near(motion_of(a / 1.5f, PLAIT_SHOCK_CONTINUOUS), {0, 0, s45, s45, 5, -1, 0, .625f});
    const auto out = bench.run(
        PLAIT_STAGE_velocity_shock, 4, 1, plait_layout_params{4},
        {uints({3}), float4s({0, 0, s45, s45, 5, -1, 0, .5f}), float4s(x), float4s(before)});
    expect_near(out[2], {5, 0, 0, 0, 5, 1, 0, 0, .5f * (9 - 4), .5f * (9 + 8), 9, 1, 9, 9, 9, 1});
    expect_near(out[3], {1, 0, 0, 0, 2, 0, 0, 0, .5f * (3 + 5), .5f * (0 + 2), 0, 1, 3, 0, 0, 1});
}

void roots_meet_halfway(Bench& bench) {
    plait_roots_params params = {{0, 0, 0, 1},
                                 {-4, 0, 0, 0},
                                 {0, 0, 0, 1},
                                 {0, 0, 0, 0},
                                 {0, 0, 1, 0},
                                 {2, 0, 0, 0},
                                 .5f,
                                 0,
                                 0};
    auto out = bench.run(PLAIT_STAGE_roots, 1, 1, params,
                         {null_array(), null_array(), null_array(), unwritten_float4s(2)});
    expect_near(out[3], {0, 0, s45, s45, 1, 0, 0, 0});
    params.per_root = 1; // a root shifted along x is turned to y by the head
    const std::vector<float> root = {0, 0, 0, 1, 3, 0, 0, 0};
    out = bench.run(PLAIT_STAGE_roots, 1, 1, params,
                    {null_array(), float4s(root), float4s(root), unwritten_float4s(2)});
    expect_near(out[3], {0, 0, s45, s45, 1, 3, 0, 0});
    params.per_root = 0; // braked: from -4 over 0 to 2 it is past the middle
    params.bends = 1;
    std::fill_n(params.head_to_q, 3, 0.0f);
    params.head_to_q[3] = 1;
    out = bench.run(PLAIT_STAGE_roots, 1, 1, params,
                    {null_array(), null_array(), null_array(), unwritten_float4s(2)});
    expect_near(out[3], {0, 0, 0, 1, -4 * -.125f + 2 * .375f, 0, 0, 0});
}

void reset_and_teleport_are_rigid(Bench& bench) {
    const std::vector<float> rest = {1, 0, 0, 0, 2, 0, 0, 0}, state = {0, 0, 0, 0, 0, 0, 0, 5};
    const std::vector<float> posed = {1, 3, 3, 0, 1, 4, 3, 5};
    auto out = bench.run(PLAIT_STAGE_tressfx_reset, 2, 1, plait_layout_params{2},
                         {float4s(rest), float4s(quarter_about_z), float4s(state),
                          unwritten_float4s(2), unwritten_float4s(2)});
    for (size_t i = 2; i < 5; ++i)
        expect_near(out[i], posed);
    out = bench.run(PLAIT_STAGE_tressfx_teleport, 2, 1, plait_layout_params{2},
                    {float4s(quarter_about_z), float4s(unit_pose), float4s(posed), float4s(posed),
                     float4s(posed)});
    for (size_t i = 2; i < 5; ++i)
        expect_near(out[i], {1, 0, 0, 0, 2, 0, 0, 5});
}

void output_blends_in_the_root_frame(Bench& bench) {
    const std::vector<float> posed = {1, 3, 3, 0, 1, 4, 3, 5}; // local (1, 0, 0), (2, 0, 0)
    const auto local = bench.run(PLAIT_STAGE_output_keep, 2, 1, plait_layout_params{2},
                                 {float4s(quarter_about_z), float4s(posed), unwritten_float4s(2)});
    expect_near(local[2], {1, 0, 0, 0, 2, 0, 0, 5});
    const auto out =
        bench.run(PLAIT_STAGE_output, 2, 1, plait_output_params{2, .25f},
                  {float4s({1, 4, 0, 0, 2, 4, 0, 5}), float4s(posed), float4s(quarter_about_z),
                   float4s(quarter_about_z), unwritten_float4s(2)});
    // local (1, 3, 0) and (2, 3, 0)
    expect_near(out[4], {-2, 3, 3, 0, -2, 4, 3, 5});
}

void output_shows_what_swings_on_its_arc(Bench& bench) {
    // local (1, 0, 0) and (1, 1, 0): the tip has turned by a right angle, halfway of it by half
    const auto out =
        bench.run(PLAIT_STAGE_output, 2, 1, plait_output_params{2, .5f},
                  {float4s({1, 0, 0, 0, 2, 0, 0, 5}), float4s({1, 3, 3, 0, 0, 3, 3, 5}),
                   float4s(quarter_about_z), float4s(quarter_about_z), unwritten_float4s(2)});
    const float half = std::sqrt(.5f); // local (1 + half, half, 0)
    expect_near(out[4], {1, 3, 3, 0, 1 - half, 3 + half, 3, 5});
}

void follow_turns_with_the_guide(Bench& bench) {
    const auto place = [&](uint32_t form) {
        const auto out = bench.run(
            PLAIT_STAGE_tressfx_follow, 3, 1, plait_tressfx_follow_params{3, 1, 1, form},
            {float4s({0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), float4s(unit_pose), uints({2}),
             uints({0}), float4s({0, 1, 0, 0}),
             float4s({0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7})});
        return floats({out[5].floats.begin() + 12, out[5].floats.end()});
    };
    expect_near(place(PLAIT_FOLLOW_PUBLISHED), {0, 1, 0, 0, 0, 2.5f, 0, 1, 0, 2.5f, 0, 1});
    expect_near(place(PLAIT_FOLLOW_ROTATING), {-1, 0, 0, 0, -1.5f, 1, 0, 1, -1.5f, 1, 0, 1});
}

// Four segments of 1 m around a square: three quarters of a turn, not one quarter back.
void guide_turns_go_on_beyond_half_a_turn(Bench& bench) {
    const auto out = bench.run(
        PLAIT_STAGE_guide_turns, 1, 1, plait_layout_params{6},
        {float4s({0, 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 1, 3, 0, 0, 1, 4, 0, 0, 1, 4, 0, 0, 1}),
         float4s(unit_pose), uints({5}),
         float4s({0, 0, 0, 0, 1, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1, 0, 0, 0, 1, 9, 9, 9, 1}),
         unwritten_float4s(6)});
    expect_near(out[4], {0, 0, 0,   1,    0, 0, s45, s45,  0, 0, 1,   0,
                         0, 0, s45, -s45, 0, 0, s45, -s45, 0, 0, s45, -s45});
}

// Between a guide at rest and one that has turned by 270 degrees: by 135, whichever of its two
// quaternions the second one's root has. One guide alone: by all of that.
void follow_turns_by_the_mean(Bench& bench) {
    const auto place = [&](const std::vector<float>& weights, float sign) {
        const auto out = bench.run(
            PLAIT_STAGE_follow_turns, 1, 3, plait_follow_turns_params{3, 1, 2},
            {null_array(), float4s({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, sign, 0, 0, 2, 0}),
             float4s({0, 0, 0, 1,    0, 0, 0,          1,           0, 0, 0,          1,
                      0, 0, 0, sign, 0, 0, sign * s45, -sign * s45, 0, 0, sign * s45, -sign * s45}),
             uints({0, 1, 0, 0}), float4s(weights),
             lane_floats({0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, 4),
             lane_floats({5, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1}, 4), unwritten_float4s(9)});
        return floats({out[7].floats.begin() + 24, out[7].floats.end()});
    };
    for (const float sign : {1.0f, -1.0f})
        expect_near(place({.5f, .5f, 0, 0}, sign),
                    {5, 0, 1, 0, 5 - s45, s45, 1, 1, 5 - s45, s45, 1, 1});
    expect_near(place({1, 0, 0, 0}, 1), {5, 0, 0, 0, 6, 0, 0, 1, 6, 0, 0, 1});
}

// Beside its centre, 1 m to the right, with segments of 1 m and a reach of 0.08 * 2 + 2 of them: at
// first the path is 1 m away, then what is left of it.
void follow_clump_leans_to_the_centre(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_follow_clump, 1, 1, plait_follow_clump_params{4, 1, {1, 1, 1, 1}, 0},
                  {uints({0}), floats({0, 1, 2, 2}), null_array(), floats({0, 1, 2, 2}),
                   float4s({1, 0, 0, 0, 1, 1, 0, 0, 1, 2, 0, 0, 1, 2, 0, 0, //
                            0, 0, 0, 0, 0, 1, 0, 5, 0, 2, 0, 5, 7, 7, 7, 5})});
    const std::vector<float> follow(out[4].floats.begin() + 16, out[4].floats.end());
    expect_near(floats(follow), {0, 0, 0, 0, .420124f, .907467f, 0, 5, .679404f, 1.873269f, 0, 5,
                                 .679404f, 1.873269f, 0, 5});
}

// Segments of 1 m down to a floor at a slope of 0.8: the second, which would end 0.6 m under it, is turned up
// by so much, and the third lies on it.
void follow_collide_lies_on_a_floor(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_follow_collide, 1, 4, plait_follow_collide_params{4, 1, 1, 0},
                  {null_array(), float4s({0, 0, 0, 0, 0, 1,
                                          0, 0, 0, 0, 0, 0,
                                          0, 1, 0, 0, //
                                          0, 0, 0, 1, 0, PLAIT_KIND_PLANE,
                                          0, 0}),
                   float4s({9, 9, 9, 9, 9,   9,   9, 9, 9,    9,    9, 9, 9,    9,     9, 9, //
                            0, 1, 0, 0, .6f, .2f, 0, 1, 1.2f, -.6f, 0, 1, 1.8f, -1.4f, 0, 1})});
    const std::vector<float> follow(out[2].floats.begin() + 16, out[2].floats.end());
    expect_near(floats(follow),
                {0, 1, 0, 0, .6f, .2f, 0, 1, 1.5797959f, 0, 0, 1, 2.5797959f, 0, 0, 1});
}

// Along +y with a pitch of four segments: each offset is the one before, turned by a quarter.
void follow_curl_is_a_helix(Bench& bench) {
    plait_follow_curl_params params{5, 1, {1, 1, 1, 1}, 4, 1, {0, 0, 0, 0}, 1, 3};
    const auto out = bench.run(
        PLAIT_STAGE_follow_curl, 1, 1, params,
        {float4s(unit_pose), uints({0}), uints({0}), float4s({0, 1, 0, 0}), floats({0, 1, 2, 3, 3}),
         float4s({9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, //
                  0, 0, 0, 0, 0, 1, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 7, 7, 7, 1})});
    const std::vector<float> x(out[5].floats.begin() + 20, out[5].floats.end());
    const float a = x[4], b = x[6];
    expect_near(floats({a * a + b * b}), {1});
    expect_near(floats(x), {0, 0, 0, 0, a, 1, b, 1, b, 2, -a, 1, -a, 3, -b, 1, -a, 3, -b, 1});
}

void tangents_point_to_the_tip(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_tangents, 4, 1, plait_tangents_params{4, 0},
                  {uints({3}), float4s({0, 0, 0, 0, 2, 0, 0, 1, 2, 0, 3, 1, 7, 7, 7, 7}),
                   unwritten_float4s(4)});
    expect_near(out[2], {1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0});
    expect_near(out[1], {0, 0, 0, 0, 2, 0, 0, 1, 2, 0, 3, 1, 2, 0, 3, 1}, 0);
}

// The direction of a segment of no length: from the root's side, else from the tip's, else +y.
void tangents_are_never_zero(Bench& bench) {
    const auto of = [&](std::vector<float> x) {
        return bench.run(PLAIT_STAGE_tangents, 3, 1, plait_tangents_params{3, 0},
                         {uints({3}), float4s(std::move(x)), unwritten_float4s(3)})[2];
    };
    expect_near(of({0, 0, 0, 0, 2, 0, 0, 1, 2, 0, 0, 1}), {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    expect_near(of({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 1}), {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0});
    expect_near(of({5, 0, 0, 0, 5, 0, 0, 1, 5, 0, 0, 1}), {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
}

// The same three over lanes, and one of fewer vertices, whose padding repeats its tip.
void lane_unpack_shows_tangents_that_are_never_zero(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_lane_unpack, 4, 3, plait_lane_unpack_params{3, 1, 3, .5f, 1},
                  {null_array(), uints({3, 3, 3, 2}),
                   lane_floats({0, 0, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3,
                                5, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 4, 0, 9, 9, 9},
                               3),
                   lane_floats(std::vector<float>(36, 2), 3), unwritten_float4s(12),
                   unwritten_float4s(12), unwritten_float4s(12)});
    expect_near(out[4], {0, 0, 0, 0, 2, 0, 0, 1, 2, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 1,
                         5, 0, 0, 0, 5, 0, 0, 1, 5, 0, 0, 1, 1, 0, 0, 0, 1, 4, 0, 1, 1, 4, 0, 1});
    expect_near(out[6], {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0,
                         0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    for (size_t i = 0; i < 11; ++i) // of the last strand's padding there is no history
        expect_near(floats({out[4].floats[4 * i] - out[5].floats[4 * i]}), {1});
}

void stats_measure_stretch(Bench& bench) {
    const float inf = INFINITY;
    const auto out = bench.run(
        PLAIT_STAGE_stats, 2, 1, plait_layout_params{3},
        {floats({1, 1, 0, 1, 1, 0}), uints({3, 3}),
         float4s(
             {0, 0, 0, 0, 1.5f, 0, 0, 1, 1.5f, .9f, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, inf, 0, 0, 1}),
         float4s({0, 0, 0, 0, 1.5f, 0, 0, 1, 1.5f, .9f, 2, 1, 0, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1}),
         unwritten_float4s(2)});
    expect_near(out[4], {.5f, 0, 2, .3f, 0, 1, 1, 0});
}

} // namespace

Outputs Bench::run(plait_stage stage, const Setup& setup) {
    std::string error;
    Outputs outputs = cases::run(subject_.api(), subject_.device(), stage, setup, error);
    EXPECT_EQ(error, "");
    return outputs.empty() ? setup.buffers : outputs;
}

void expect_near(const Array& got, const std::vector<float>& expected, double tolerance) {
    ASSERT_EQ(got.floats.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(got.floats[i], expected[i], tolerance) << "float " << i;
}

const std::vector<ClosedForm>& strand_closed_forms() {
    static const std::vector<ClosedForm> list = {
        PLAIT_CLOSED_FORM(integrate_is_free_fall),
        PLAIT_CLOSED_FORM(accelerations_out_of_range_do_not_pull_at_lanes),
        PLAIT_CLOSED_FORM(accelerations_out_of_range_do_not_pull_at_vertices),
        PLAIT_CLOSED_FORM(global_shape_goes_part_of_the_way),
        PLAIT_CLOSED_FORM(length_splits_by_movability),
        PLAIT_CLOSED_FORM(length_is_red_then_black),
        PLAIT_CLOSED_FORM(collide_pushes_to_the_surface),
        PLAIT_CLOSED_FORM(collide_rubs),
        PLAIT_CLOSED_FORM(collide_pushes_out_of_planes),
        PLAIT_CLOSED_FORM(collide_pushes_out_of_boxes),
        PLAIT_CLOSED_FORM(collide_box_becomes_a_capsule),
        PLAIT_CLOSED_FORM(local_shape_straightens),
        PLAIT_CLOSED_FORM(wind_drags_across_the_strand),
        PLAIT_CLOSED_FORM(wind_as_published_blows_backwards),
        PLAIT_CLOSED_FORM(clamp_limits_the_step),
        PLAIT_CLOSED_FORM(attach_bounds_the_distance_to_the_root),
        PLAIT_CLOSED_FORM(shock_carries_the_strand),
        PLAIT_CLOSED_FORM(roots_meet_halfway),
        PLAIT_CLOSED_FORM(reset_and_teleport_are_rigid),
        PLAIT_CLOSED_FORM(output_blends_in_the_root_frame),
        PLAIT_CLOSED_FORM(output_shows_what_swings_on_its_arc),
        PLAIT_CLOSED_FORM(follow_turns_with_the_guide),
        PLAIT_CLOSED_FORM(guide_turns_go_on_beyond_half_a_turn),
        PLAIT_CLOSED_FORM(follow_turns_by_the_mean),
        PLAIT_CLOSED_FORM(follow_clump_leans_to_the_centre),
        PLAIT_CLOSED_FORM(follow_collide_lies_on_a_floor),
        PLAIT_CLOSED_FORM(follow_curl_is_a_helix),
        PLAIT_CLOSED_FORM(tangents_point_to_the_tip),
        PLAIT_CLOSED_FORM(tangents_are_never_zero),
        PLAIT_CLOSED_FORM(lane_unpack_shows_tangents_that_are_never_zero),
        PLAIT_CLOSED_FORM(stats_measure_stretch),
    };
    return list;
}

} // namespace plait::conformance
