#include "closed_forms.hpp"

#include <cmath>

namespace plait::conformance {

using namespace cases;

namespace {

// 2 x 2 x 2 voxels of 1 m at the origin, 4 slots each.
plait_grid_params grid(uint32_t tent = PLAIT_TENT_VOXEL) {
    plait_grid_params params = {};
    params.vertex_stride = 3;
    params.edge_count = 2;
    params.capacity = 4;
    params.voxel_edge = 1;
    params.q[3] = 1;
    params.h = 0.5f;
    params.slot_hash = PLAIT_SLOT_HASH_PCG;
    params.tent = tent;
    params.diffuse_ratio = 2;
    params.diffuse_factor = 0.9f;
    params.diffuse_floor = 0.5f;
    return params;
}

// At the centre of voxel 0; halfway from there to its face, weight 1/2; outside.
const std::vector<float> x = {.5f, .5f, .5f, 1, .75f, .5f, .5f, 1, 3, .5f, .5f, 1};
// The first moves at (2, 0, 0) m/s, the second at (-1, 4, 0).
const std::vector<float> before = {-.5f, .5f, .5f, 1, 1.25f, -1.5f, .5f, 1, 0, 0, 0, 1};

void clear_fills(Bench& bench) {
    const auto out = bench.run(PLAIT_STAGE_grid_clear, 3, 1,
                               plait_grid_clear_params{PLAIT_SLOT_EMPTY}, {uints({1, 2, 3, 4})});
    EXPECT_EQ(out[0].words,
              (std::vector<uint32_t>{PLAIT_SLOT_EMPTY, PLAIT_SLOT_EMPTY, PLAIT_SLOT_EMPTY, 4}));
}

// One vertex in each of three voxels: index = y nv^2 + z nv + x.
void slots_are_in_the_voxel(Bench& bench) {
    const auto out =
        bench.run(PLAIT_STAGE_grid_slots, 3, 1, grid(),
                  {uints({3}), float4s({1.5f, .5f, .5f, 1, .5f, 1.5f, .5f, 1, .5f, .5f, 1.5f, 1}),
                   uints(std::vector<uint32_t>(32, PLAIT_SLOT_EMPTY)), uints({0})});
    const uint32_t home[] = {1, 4, 2};
    size_t filled = 0;
    for (size_t slot = 0; slot < 32; ++slot)
        if (const uint32_t vertex = out[2].words[slot]; vertex != PLAIT_SLOT_EMPTY) {
            ++filled;
            ASSERT_LT(vertex, 3u);
            EXPECT_EQ(slot / 4, home[vertex]);
        }
    EXPECT_EQ(filled, 3u);
    EXPECT_EQ(out[3].words[0], 0u);
}

void slots_count_what_is_outside(Bench& bench) {
    const float nan = NAN;
    const auto out =
        bench.run(PLAIT_STAGE_grid_slots, 3, 1, grid(),
                  {uints({3}), float4s({-.01f, .5f, .5f, 1, .5f, 2, .5f, 1, .5f, .5f, nan, 1}),
                   uints(std::vector<uint32_t>(32, PLAIT_SLOT_EMPTY)), uints({5})});
    EXPECT_EQ(out[2].words, std::vector<uint32_t>(32, PLAIT_SLOT_EMPTY));
    EXPECT_EQ(out[3].words[0], 8u);
}

void density_and_velocity_are_tent_means(Bench& bench) {
    std::vector<uint32_t> slots(32, PLAIT_SLOT_EMPTY);
    slots[1] = 0;
    slots[3] = 1;
    const auto density = bench.run(PLAIT_STAGE_grid_density, 8, 4, grid(),
                                   {uints(slots), float4s(x), unwritten_floats(8)})[2];
    expect_near(density, {1.5f, 0, 0, 0, 0, 0, 0, 0});
    const auto velocity =
        bench.run(PLAIT_STAGE_grid_velocity, 8, 4, grid(),
                  {uints(slots), float4s(x), float4s(before), density, unwritten_float4s(8)})[4];
    std::vector<float> expected(32, 0);
    expected[0] = (2 - .5f) / 1.5f;
    expected[1] = .5f * 4 / 1.5f;
    expected[3] = std::sqrt((4 + .5f * 17) / 1.5f);
    expect_near(velocity, expected);
}

// Sums and back: the same density and means as from the slots, here of all vertices.
std::pair<Array, Array> splat(Bench& bench, uint32_t tent, const std::vector<float>& position,
                              const std::vector<float>& position_prev) {
    const auto sums = bench.run(PLAIT_STAGE_grid_splat, 1, 1, grid(tent),
                                {uints({3}), float4s(position), float4s(position_prev),
                                 uints(std::vector<uint32_t>(80, 0)), uints({0})});
    EXPECT_EQ(sums[4].words[0], 1u);
    const auto out = bench.run(PLAIT_STAGE_grid_resolve, 8, 1, grid(tent),
                               {sums[3], unwritten_floats(8), unwritten_float4s(8)});
    return {out[1], out[2]};
}

void splat_is_the_exact_sum(Bench& bench) {
    const auto [density, velocity] = splat(bench, PLAIT_TENT_VOXEL, x, before);
    expect_near(density, {1.5f, 0, 0, 0, 0, 0, 0, 0});
    std::vector<float> expected(32, 0);
    expected[0] = (2 - .5f) / 1.5f;
    expected[1] = .5f * 4 / 1.5f;
    expected[3] = std::sqrt((4 + .5f * 17) / 1.5f);
    expect_near(velocity, expected);
}

// The first vertex sits on node 0, the second a quarter of the way to node 1; a third beyond the
// centres of the rim gives all to the corner node.
void splat_trilinear_shares_between_nodes(Bench& bench) {
    auto at = x, was = before;
    auto [density, velocity] = splat(bench, PLAIT_TENT_TRILINEAR, at, was);
    expect_near(density, {1.75f, .25f, 0, 0, 0, 0, 0, 0});
    EXPECT_NEAR(velocity.floats[4], -1, 1e-6);
    EXPECT_NEAR(velocity.floats[1], .75f * 4 / 1.75f, 1e-6);
    for (size_t c = 0; c < 3; ++c)
        at[c] = 1.9f;
    density = splat(bench, PLAIT_TENT_TRILINEAR, at, was).first;
    expect_near(density, {.75f, .25f, 0, 0, 0, 0, 0, 1});
}

void splat_limits_the_speed(Bench& bench) {
    auto was = before;
    was[0] = x[0] - 5000;
    const auto velocity = splat(bench, PLAIT_TENT_VOXEL, x, was).second;
    EXPECT_NEAR(velocity.floats[0], (PLAIT_SUM_MAX_SPEED - .5f) / 1.5f, 1e-3);
}

// Hair that moves at a tenth of a millimetre per second has the rms speed of its vertices, so that
// the brake's rule, which has no scale, has none here either.
void splat_keeps_the_energy_of_slow_hair(Bench& bench) {
    auto was = x;
    for (size_t i = 0; i < was.size(); ++i)
        was[i] = x[i] - 1e-4f * (x[i] - before[i]);
    const auto velocity = splat(bench, PLAIT_TENT_VOXEL, x, was).second;
    EXPECT_NEAR(velocity.floats[3] / (1e-4 * std::sqrt((4 + .5 * 17) / 1.5)), 1, 5e-3);
}

// v = (2, 0, 0) in a voxel whose mean is (m, 0, 0).
float braked(Bench& bench, const plait_grid_params& params, float density, float mean, float rms,
             float w = 1) {
    std::vector<float> densities(8, 0), velocities(32, 0);
    densities[0] = density;
    velocities[0] = mean;
    velocities[3] = rms;
    auto at = x;
    at[3] = w;
    const auto out = bench.run(
        PLAIT_STAGE_grid_diffuse, 1, 1, params,
        {uints({3}), float4s(at), floats(densities), float4s(velocities), float4s(before)});
    const float v = (at[0] - out[4].floats[0]) / params.h;
    EXPECT_EQ(out[4].floats[1], before[1]);
    return v;
}

void diffuse_brakes_what_outruns_its_voxel(Bench& bench) {
    for (uint32_t tent : {PLAIT_TENT_VOXEL, PLAIT_TENT_TRILINEAR}) {
        plait_grid_params params = grid(tent);
        params.diffuse_rule = PLAIT_DIFFUSE_THESIS;
        EXPECT_NEAR(braked(bench, params, 1, .99f, 9), 1.8f, 1e-6);
        EXPECT_NEAR(braked(bench, params, 1, -.99f, 9), 1.8f, 1e-6);
        EXPECT_NEAR(braked(bench, params, 1, 1.01f, 0), 2, 1e-6);
        EXPECT_NEAR(braked(bench, params, 0, .1f, 0), 2, 1e-6);    // no hair to rub against
        EXPECT_NEAR(braked(bench, params, 1, .1f, 0, 0), 2, 1e-6); // pinned
        params.diffuse_rule = PLAIT_DIFFUSE_FLOORED;               // 2 * 0.5 * rms
        EXPECT_NEAR(braked(bench, params, 1, 0, 1.99f), 1.8f, 1e-6);
        EXPECT_NEAR(braked(bench, params, 1, 0, 2.01f), 2, 1e-6);
    }
}

// A quarter of the way from a node of mean 1 m/s to one at rest: the mean there is 3/4 m/s,
// whatever the nodes' densities; where there is no density there is no brake.
void diffuse_interpolates_between_nodes(Bench& bench) {
    plait_grid_params params = grid(PLAIT_TENT_TRILINEAR);
    params.diffuse_rule = PLAIT_DIFFUSE_THESIS;
    const auto brake = [&](float density, float ratio) {
        params.diffuse_ratio = ratio;
        std::vector<float> densities(8, 0), velocities(32, 0);
        densities[0] = 3 * density;
        densities[1] = density;
        velocities[0] = 1;
        const auto out = bench.run(PLAIT_STAGE_grid_diffuse, 1, 1, params,
                                   {uints({3}), float4s({.75f, .5f, .5f, 1}), floats(densities),
                                    float4s(velocities), float4s({-.25f, .5f, .5f, 1})});
        return (.75f - out[4].floats[0]) / params.h; // was 2 m/s
    };
    EXPECT_NEAR(brake(1, 2 / .76f), 1.8f, 1e-6);
    EXPECT_NEAR(brake(1, 2 / .74f), 2, 1e-6);
    EXPECT_NEAR(brake(0, 2 / .76f), 2, 1e-6);
}

} // namespace

const std::vector<ClosedForm>& grid_closed_forms() {
    static const std::vector<ClosedForm> list = {
        PLAIT_CLOSED_FORM(clear_fills),
        PLAIT_CLOSED_FORM(slots_are_in_the_voxel),
        PLAIT_CLOSED_FORM(slots_count_what_is_outside),
        PLAIT_CLOSED_FORM(density_and_velocity_are_tent_means),
        PLAIT_CLOSED_FORM(splat_is_the_exact_sum),
        PLAIT_CLOSED_FORM(splat_trilinear_shares_between_nodes),
        PLAIT_CLOSED_FORM(splat_limits_the_speed),
        PLAIT_CLOSED_FORM(splat_keeps_the_energy_of_slow_hair),
        PLAIT_CLOSED_FORM(diffuse_brakes_what_outruns_its_voxel),
        PLAIT_CLOSED_FORM(diffuse_interpolates_between_nodes),
    };
    return list;
}

} // namespace plait::conformance
