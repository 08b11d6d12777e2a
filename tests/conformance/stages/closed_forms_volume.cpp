// The pressure of volume: against a table that another program made, columns that stand and hang,
// and what it may never do: touch what parts, make momentum or energy.
#include "closed_forms.hpp"
#include "inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plait::conformance {

using namespace cases;

namespace {

constexpr float edge = 0.02f, h = 1.0f / 60, g = 9.81f;

struct TableNode {
    uint32_t seed, x, y, z, solid;
    double mass, mass_rest, v[3], pressure, change[3];
};
constexpr TableNode table[] = {
#include "pressure.inc"
};

struct State {
    explicit State(uint32_t edge_count)
        : n(edge_count), density(count(), 0), rest(count(), 0), velocity(4 * count(), 0),
          solid(4 * count(), 0) {}

    uint32_t count() const { return n * n * n; }
    uint32_t at(uint32_t x, uint32_t y, uint32_t z) const { return (y * n + z) * n + x; }
    void put(uint32_t node, float hair, float kept, std::array<float, 3> v) {
        density[node] = hair;
        rest[node] = kept;
        std::copy(v.begin(), v.end(), &velocity[4 * size_t{node}]);
    }
    void close(uint32_t node) { solid[4 * size_t{node} + 3] = 1; }

    uint32_t n;
    std::vector<float> density, rest, velocity, solid;
};

struct Solved {
    std::vector<float> pressure, change, push; // the last two: float4
    std::vector<float> potential;              // for the step to come

    double v(const State& state, uint32_t node, size_t axis) const {
        return double(state.velocity[4 * size_t{node} + axis]) +
               double(change[4 * size_t{node} + axis]) -
               double(change[4 * size_t{node} + 3]) *
                   double(state.velocity[4 * size_t{node} + axis]);
    }
};

// `before`: potentials that are carried, if any.
// `wetness`: of all hair, which has its share of the cohesion of it; `viscosity`, 1/s.
Solved solve(Bench& bench, const State& state, uint32_t sweeps, float cohesion = 0,
             const std::vector<float>& before = {}, float wetness = 0, float viscosity = 0) {
    plait_volume_params params{};
    params.edge_count = state.n;
    params.voxel_edge = edge;
    params.h = h;
    params.share = 1;
    params.recovery = 0.2f;
    params.most_recovery = 5 * h;
    params.cohesion = cohesion * (1 - 0.5f * wetness);
    params.wet_cohesion = cohesion / 2;
    params.wet = wetness > 0;
    params.carried = before.empty() ? 0 : 1;
    const auto equations =
        bench.run(PLAIT_STAGE_volume_faces, state.count(), 1, params,
                  {floats(state.density), float4s(state.velocity), floats(state.rest),
                   wetness > 0 ? floats(std::vector<float>(state.count(), wetness)) : null_array(),
                   float4s(state.solid), before.empty() ? null_array() : floats(before),
                   unwritten_float4s(state.count()), unwritten_float4s(state.count()),
                   unwritten_floats(state.count())});
    const Array &link = equations[6], &node = equations[7];
    Array pressure = equations[8];
    const uint32_t items = state.n * state.n * ((state.n + 1) / 2);
    for (uint32_t sweep = 0; sweep < sweeps; ++sweep)
        for (const uint32_t colour : {0u, 1u})
            pressure =
                bench.run(PLAIT_STAGE_volume_pressure, items, 1,
                          plait_volume_sweep_params{state.n, colour}, {link, node, pressure})[2];
    const auto out =
        bench.run(PLAIT_STAGE_volume_impulse, state.count(), 1,
                  plait_volume_impulse_params{state.n, edge, h, viscosity},
                  {floats(state.density), float4s(state.velocity), link, pressure,
                   unwritten_floats(2 * state.count()), unwritten_float4s(2 * state.count())});
    Solved solved{pressure.floats, {}, {}, out[4].floats};
    for (size_t i = 0; i < out[5].floats.size(); i += 8) {
        solved.change.insert(solved.change.end(), &out[5].floats[i], &out[5].floats[i] + 4);
        solved.push.insert(solved.push.end(), &out[5].floats[i] + 4, &out[5].floats[i] + 8);
    }
    return solved;
}

State state_of_table(uint32_t seed) {
    State state(8);
    const double cell = double(edge) * double(edge) * double(edge);
    for (const TableNode& row : table) {
        if (row.seed != seed)
            continue;
        const uint32_t node = state.at(row.x, row.y, row.z);
        if (row.solid)
            state.close(node);
        if (row.mass > 0)
            state.put(node, static_cast<float>(row.mass / cell),
                      static_cast<float>(row.mass_rest / row.mass),
                      {static_cast<float>(row.v[0]), static_cast<float>(row.v[1]),
                       static_cast<float>(row.v[2])});
    }
    return state;
}

// Of the greatest pressure, and of the greatest change of velocity.
void expect_table(Bench& bench, uint32_t sweeps, double tolerance) {
    for (const uint32_t seed : {1u, 2u}) {
        const State state = state_of_table(seed);
        const Solved solved = solve(bench, state, sweeps);
        double most = 0, most_change = 0, off = 0, off_change = 0;
        for (const TableNode& row : table) {
            if (row.seed != seed)
                continue;
            const uint32_t node = state.at(row.x, row.y, row.z);
            most = std::max(most, row.pressure);
            off = std::max(off, std::abs(double(solved.pressure[node]) - row.pressure));
            for (size_t i = 0; i < 3; ++i) {
                const double got = double(solved.change[4 * size_t{node} + i]);
                most_change = std::max(most_change, std::abs(row.change[i]));
                off_change = std::max(off_change, std::abs(got - row.change[i]));
            }
        }
        EXPECT_GT(most, 0);
        EXPECT_LT(off, tolerance * most) << "seed " << seed << ", " << sweeps << " sweeps";
        EXPECT_LT(off_change, tolerance * most_change) << "seed " << seed;
    }
}

void pressure_is_the_table_s(Bench& bench) {
    expect_table(bench, 10, 2e-3);
    expect_table(bench, 50, 1e-5);
}

// Cells of one column, all around closed but below or above.
State column(uint32_t cells, bool stands) {
    State state(cells + 4);
    for (uint32_t node = 0; node < state.count(); ++node)
        state.close(node);
    const uint32_t first = stands ? 1 : 3; // open on the other side
    for (uint32_t y = 1; y < state.n - 1; ++y) {
        const uint32_t node = state.at(2, y, 2);
        state.solid[4 * size_t{node} + 3] = 0;
        if (y >= first && y < first + cells)
            state.put(node, 20, 20, {0, -g * h, 0});
    }
    if (!stands) // hangs from the ceiling
        state.close(state.at(2, first + cells, 2));
    return state;
}

void column_stands_on_its_pressure(Bench& bench) {
    constexpr uint32_t cells = 4;
    const State state = column(cells, true);
    const Solved solved = solve(bench, state, 100);
    for (uint32_t k = 0; k < cells; ++k) {
        const double expected = 20 * double(g) * double(edge) * (cells - k - 0.5);
        EXPECT_NEAR(solved.pressure[state.at(2, 1 + k, 2)], expected, 1e-5 * 20 * g * edge * cells);
        EXPECT_NEAR(solved.v(state, state.at(2, 1 + k, 2), 1), 0, 1e-5 * g * h) << k;
    }
}

// Hair of a tenth of the density in the place of other hair needs a tenth of its pressure.
void carried_pressure_is_that_of_the_hair_that_is_there(Bench& bench) {
    constexpr uint32_t cells = 4;
    const Solved held = solve(bench, column(cells, true), 100);
    State thin = column(cells, true);
    for (uint32_t k = 0; k < cells; ++k)
        thin.put(thin.at(2, 1 + k, 2), 2, 2, {0, 0, 0}); // the push has held it
    const Solved solved = solve(bench, thin, 10, 0, held.potential);
    for (uint32_t k = 0; k < cells; ++k) {
        const uint32_t node = thin.at(2, 1 + k, 2);
        EXPECT_NEAR(solved.pressure[node], 0.1 * double(held.pressure[node]),
                    1e-5 * 2 * g * edge * cells);
        EXPECT_NEAR(solved.v(thin, node, 1), 0, 1e-5 * g * h) << k;
        EXPECT_NEAR(solved.push[4 * size_t{node} + 1], g, 1e-4 * g) << k;
    }
}

// The ceiling holds the uppermost cell; the face below it bears what hangs there and half a cell.
void column_hangs_by_its_cohesion(Bench& bench) {
    constexpr uint32_t cells = 4;
    const State state = column(cells, false);
    const float needed = g * edge * (float{cells} - 0.5f);
    const auto lowest = [&](float cohesion) {
        return solve(bench, state, 200, cohesion).v(state, state.at(2, 3, 2), 1);
    };
    EXPECT_NEAR(lowest(1.05f * needed), 0, 1e-4 * g * h);
    EXPECT_LT(lowest(0.95f * needed), -0.01 * g * h);
    EXPECT_NEAR(lowest(0), -g * h, 1e-6 * g * h);
    const auto wet = [&](float cohesion) {
        return solve(bench, state, 200, cohesion, {}, 0.7f).v(state, state.at(2, 3, 2), 1);
    };
    EXPECT_NEAR(wet(1.05f * needed), 0, 1e-4 * g * h);
    EXPECT_LT(wet(0.95f * needed), -0.01 * g * h);
}

// Hair of a random density in the middle of a grid, and its rest density over it.
State cloud(uint32_t seed, float share, bool spreads) {
    State state(10);
    Random random(seed);
    for (uint32_t y = 2; y < 8; ++y)
        for (uint32_t z = 2; z < 8; ++z)
            for (uint32_t x = 2; x < 8; ++x) {
                const auto hair = static_cast<float>(random.uniform(5, 30));
                std::array<float, 3> v{};
                for (float& component : v)
                    component = static_cast<float>(random.uniform(-1, 1));
                if (spreads) // from the middle
                    v = {float(x) - 4.5f, float(y) - 4.5f, float(z) - 4.5f};
                state.put(state.at(x, y, z), hair, share * hair, v);
            }
    return state;
}

void parting_hair_is_left_alone(Bench& bench) {
    const State state = cloud(3, 1.1f, true);
    const Solved solved = solve(bench, state, 10);
    for (const float p : solved.pressure)
        EXPECT_EQ(p, 0.0f);
    for (const float v : solved.change)
        EXPECT_EQ(v, 0.0f);
}

// Potentials of up to 1 m^2/s^2 have pushed at it by no more than 2/e. It flies apart, and of most of
// it hardly anything is left: no more than they have given is taken back.
void what_carried_pressure_gave_is_all_that_goes_with_it(Bench& bench) {
    for (const uint32_t seed : {7u, 8u, 9u}) {
        State state = cloud(seed, 1.1f, true);
        Random random(seed);
        std::vector<float> before(2 * state.count(), 0);
        for (uint32_t node = 0; node < state.count(); ++node)
            if (state.density[node] > 0) {
                before[2 * node] = static_cast<float>(random.uniform(0, 1));
                before[2 * node + 1] = state.density[node];
                state.density[node] *= random.uniform(0, 1) < 0.6 ? 1e-5f : 1.0f;
            }
        const Solved solved = solve(bench, state, 50, 0, before);
        float most = 0;
        for (const float change : solved.change)
            most = std::max(most, std::abs(change));
        EXPECT_LT(most, 2 * h / edge) << "seed " << seed;
        EXPECT_GT(most, 0.1f * h / edge);
    }
}

// That of hair of the state; with `carried` where other hair was the step before.
void expect_momentum_kept(Bench& bench, uint32_t seed, float share, bool carried) {
    const State state = cloud(seed, share, false);
    const std::vector<float> before =
        carried ? solve(bench, cloud(seed + 3, share, false), 10).potential : std::vector<float>();
    const Solved solved = solve(bench, state, 10, 0, before);
    for (size_t axis = 0; axis < 3; ++axis) {
        double sum = 0, size = 0;
        for (uint32_t node = 0; node < state.count(); ++node) {
            const double gained =
                double(state.density[node]) * double(solved.change[4 * size_t{node} + axis]);
            sum += gained;
            size += std::abs(gained);
        }
        EXPECT_GT(size, 1);
        EXPECT_LT(std::abs(sum), 1e-6 * size)
            << "seed " << seed << ", axis " << axis << (carried ? ", carried" : "");
    }
}

void pressure_keeps_momentum(Bench& bench) {
    for (const uint32_t seed : {1u, 2u, 3u})
        for (const float share : {0.6f, 1.0f})
            for (const bool carried : {false, true})
                expect_momentum_kept(bench, seed, share, carried);
}

// With pressures of all sizes, so that friction is another at every face, on hair that then moves as
// one: what it takes is no momentum, and energy.
void friction_keeps_momentum_and_takes_energy(Bench& bench) {
    for (const uint32_t seed : {10u, 11u, 12u}) {
        const State state = cloud(seed, 1, false);
        const Solved bare = solve(bench, state, 10), rubbed = solve(bench, state, 10, 0, {}, 0, 30);
        ASSERT_EQ(bare.pressure, rubbed.pressure);
        double before = 0, after = 0;
        for (size_t axis = 0; axis < 3; ++axis) {
            double sum = 0, size = 0;
            for (uint32_t node = 0; node < state.count(); ++node) {
                const double density = double(state.density[node]);
                const double v = double(state.velocity[4 * size_t{node} + axis]);
                const double gained = rubbed.v(state, node, axis) - bare.v(state, node, axis);
                sum += density * gained;
                size += std::abs(density * gained);
                before += density * v * v;
                after += density * (v + gained) * (v + gained);
            }
            EXPECT_GT(size, 1);
            EXPECT_LT(std::abs(sum), 1e-6 * size) << "seed " << seed << ", axis " << axis;
        }
        EXPECT_LT(after, 0.9 * before) << "seed " << seed;
        float least = 1, most = 0; // as much as pressure asks for
        for (uint32_t node = 0; node < state.count(); ++node)
            if (state.density[node] > 0) {
                least = std::min(least, rubbed.change[4 * size_t{node} + 3]);
                most = std::max(most, rubbed.change[4 * size_t{node} + 3]);
            }
        EXPECT_GE(least, 0.999f / 3) << "30/60 loose: 0.5/1.5";
        EXPECT_NEAR(most, 2.5f / 3.5f, 1e-5f) << "five times that, pressed";
    }
}

void pressure_adds_no_energy_to_hair_that_is_as_dense_as_at_rest(Bench& bench) {
    for (const uint32_t seed : {4u, 5u, 6u}) {
        const State state = cloud(seed, 1, false);
        const Solved solved = solve(bench, state, 50);
        double before = 0, after = 0;
        for (uint32_t node = 0; node < state.count(); ++node)
            for (size_t axis = 0; axis < 3; ++axis) {
                const double v = double(state.velocity[4 * size_t{node} + axis]);
                before += double(state.density[node]) * v * v;
                after += double(state.density[node]) * solved.v(state, node, axis) *
                         solved.v(state, node, axis);
            }
        EXPECT_LE(after, before * (1 + 1e-6));
        EXPECT_LT(after, before); // it does something
    }
}

} // namespace

const std::vector<ClosedForm>& volume_closed_forms() {
    static const std::vector<ClosedForm> list = {
        PLAIT_CLOSED_FORM(pressure_is_the_table_s),
        PLAIT_CLOSED_FORM(column_stands_on_its_pressure),
        PLAIT_CLOSED_FORM(carried_pressure_is_that_of_the_hair_that_is_there),
        PLAIT_CLOSED_FORM(what_carried_pressure_gave_is_all_that_goes_with_it),
        PLAIT_CLOSED_FORM(column_hangs_by_its_cohesion),
        PLAIT_CLOSED_FORM(parting_hair_is_left_alone),
        PLAIT_CLOSED_FORM(pressure_keeps_momentum),
        PLAIT_CLOSED_FORM(friction_keeps_momentum_and_takes_energy),
        PLAIT_CLOSED_FORM(pressure_adds_no_energy_to_hair_that_is_as_dense_as_at_rest)};
    return list;
}

} // namespace plait::conformance
