// The exact inter-hair sums on every device and the reference, against tables made in float64.
#include "grid_scene.hpp"
#include "table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace plait::test {
namespace {

class GridExact : public ::testing::TestWithParam<DeviceName> {
  protected:
    StageDevice device{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Devices, GridExact, ::testing::ValuesIn(every_device()), device_test_name);

// The table's nodes are at integers; ours are voxel centres, half a voxel further.
std::vector<Particle> table_particles() {
    std::vector<Particle> particles;
    for (const auto& row : read_table("grid_particles.csv")) {
        Particle p{};
        for (size_t c = 0; c < 3; ++c) {
            p.x[c] = static_cast<float>(row[c] + 0.5);
            p.v[c] = static_cast<float>(row[3 + c]);
        }
        particles.push_back(p);
    }
    return particles;
}

GridScene table_scene(StageDevice& device, const std::vector<Particle>& particles) {
    plait_grid_params params = grid_params(8, 1, 1.0f);
    params.tent = PLAIT_TENT_TRILINEAR;
    return {device, params, particles.size()};
}

TEST_P(GridExact, nodes_match_the_table) {
    const auto particles = table_particles();
    ASSERT_EQ(particles.size(), 1000u);
    GridScene scene = table_scene(device, particles);
    scene.params.h = 1.0f; // so that history keeps the velocities' digits
    scene.place(particles);
    scene.exact();
    EXPECT_EQ(scene.outside(), 0u);
    const auto density = scene.density();
    const auto velocity = scene.velocity();
    double total = 0.0;
    for (const auto& row : read_table("grid_nodes.csv")) {
        const auto node = static_cast<size_t>(row[1] * 64 + row[2] * 8 + row[0]);
        total += density[node];
        EXPECT_NEAR(density[node], row[3], 1e-5) << "node " << node;
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(velocity[node][c], row[4 + c], 1e-5) << "node " << node;
    }
    EXPECT_NEAR(total, 1000.0, 1e-3) << "density is not a partition of the vertices";
}

// What grid_diffuse interpolates, seen through it: with factor 0 and floor 0 it stops every
// component above ratio * |mean|, so the largest ratio that still stops a vertex is |v| / |mean|
// there.
TEST_P(GridExact, interpolated_mean_matches_the_table) {
    const auto particles = table_particles();
    const auto gathered = read_table("grid_gathered_velocity.csv");
    GridScene scene = table_scene(device, particles);
    scene.params.h = 1.0f;
    scene.params.diffuse_rule = PLAIT_DIFFUSE_THESIS;
    scene.params.diffuse_factor = 0.0f;
    for (const float ratio : {0.5f, 1.0f, 2.0f, 4.0f}) {
        scene.params.diffuse_ratio = ratio;
        scene.place(particles);
        scene.exact();
        scene.diffuse();
        const auto v = scene.velocities();
        for (size_t i = 0; i < particles.size(); ++i)
            for (size_t c = 0; c < 3; ++c) {
                const double speed = std::abs(static_cast<double>(particles[i].v[c]));
                const double allowed = ratio * std::abs(gathered[i][c]);
                if (std::abs(speed - allowed) < 1e-5 * ratio)
                    continue;
                EXPECT_EQ(std::abs(v[i][c]) < 1e-6, speed > allowed)
                    << "particle " << i << ", component " << c << ", ratio " << ratio;
            }
    }
}

std::vector<Particle> random_particles(size_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> within(0.0f, 7.999f), speed(-20.0f, 20.0f);
    std::vector<Particle> particles(n);
    for (Particle& p : particles)
        p = {{within(random), within(random), within(random)},
             {speed(random), speed(random), speed(random)}};
    return particles;
}

// In the scene two particles are a strand.
std::vector<Particle> permuted_strands(const std::vector<Particle>& particles) {
    std::vector<size_t> order(particles.size() / 2);
    std::iota(order.begin(), order.end(), size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(12));
    std::vector<Particle> permuted;
    for (const size_t strand : order)
        permuted.insert(permuted.end(), {particles[2 * strand], particles[2 * strand + 1]});
    return permuted;
}

TEST_P(GridExact, sums_do_not_depend_on_order_by_a_bit) {
    const auto particles = random_particles(4000, 11);
    GridScene scene = table_scene(device, particles);
    scene.place(particles);
    scene.exact();
    const auto first = scene.sums();
    scene.exact();
    EXPECT_EQ(scene.sums(), first) << "run twice";
    scene.place(permuted_strands(particles));
    scene.exact();
    EXPECT_EQ(scene.sums(), first) << "strands permuted";
}

// Everyone in one voxel at up to 64 m/s, the most that counts: the low words of the sums overflow
// thousands of times.
TEST_P(GridExact, carries_reach_the_high_word) {
    constexpr size_t n = 3000;
    std::vector<Particle> particles(
        n, Particle{{0.5f, 0.5f, 0.5f}, {-PLAIT_SUM_MAX_SPEED, 40.0f, 0.25f}});
    GridScene scene(device, grid_params(1, 1, 1.0f), n);
    scene.params.h = 1.0f;
    scene.place(particles);
    scene.exact();
    EXPECT_EQ(scene.density()[0], static_cast<float>(n));
    const Float4 v = scene.velocity()[0];
    EXPECT_NEAR(v[0], -PLAIT_SUM_MAX_SPEED, 1e-4f);
    EXPECT_NEAR(v[1], 40.0f, 1e-4f);
    EXPECT_NEAR(v[2], 0.25f, 1e-6f);
    EXPECT_NEAR(v[3], std::sqrt(4096 + 1600 + 0.0625), 1e-3);
}

// Splat, resolve, gather: sum of weight * node mean over all vertices is sum of v. Read from the
// nodes, as sum of D V, which the gather of the table shares node by node.
TEST_P(GridExact, momentum_survives_the_grid) {
    const auto particles = random_particles(2000, 21);
    GridScene scene = table_scene(device, particles);
    scene.place(particles);
    scene.exact();
    const auto before = scene.velocities();
    const auto density = scene.density();
    const auto velocity = scene.velocity();
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0.0, speed = 0.0, on_grid = 0.0;
        for (const auto& v : before) {
            sum += v[c];
            speed += std::abs(v[c]);
        }
        for (size_t node = 0; node < density.size(); ++node)
            on_grid += static_cast<double>(density[node]) * velocity[node][c];
        EXPECT_NEAR(on_grid, sum, 1e-6 * speed) << "component " << c;
    }
}

// The same scene turned and moved together with its grid.
TEST_P(GridExact, turns_with_its_frame) {
    const auto particles = random_particles(1000, 31);
    GridScene scene = table_scene(device, particles);
    scene.params.h = 1.0f;
    scene.place(particles);
    scene.exact();
    const auto density = scene.density();
    const auto velocity = scene.velocity();

    // A third of a turn about (1, 1, 1) takes x to y, y to z, z to x; then 3 m along x.
    auto turned = particles;
    for (Particle& p : turned) {
        p.x = {p.x[2] + 3.0f, p.x[0], p.x[1]};
        p.v = {p.v[2], p.v[0], p.v[1]};
    }
    for (float& component : scene.params.q)
        component = 0.5f;
    scene.params.t[0] = 3.0f;
    scene.place(turned);
    scene.exact();
    const auto turned_density = scene.density();
    const auto turned_velocity = scene.velocity();
    for (size_t node = 0; node < density.size(); ++node) {
        EXPECT_NEAR(turned_density[node], density[node], 1e-4f) << "node " << node;
        for (size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(turned_velocity[node][c] * density[node], velocity[node][c] * density[node],
                        2e-3f)
                << "node " << node;
    }
}

// Two groups that swing through each other: the mean of x is 0, so the thesis rule brakes everyone.
// The floored one spares them: 1 m/s is below 2 * 0.5 * rms = 1.12 m/s.
TEST_P(GridExact, floor_spares_hair_that_swings_against_itself) {
    std::vector<Particle> particles;
    for (int i = 0; i < 100; ++i)
        particles.push_back({{0.5f, 0.5f, 0.5f}, {i % 2 == 0 ? 1.0f : -1.0f, 0.5f, 0.0f}});
    GridScene scene(device, grid_params(1, 1, 1.0f), particles.size());
    scene.params.h = 1.0f;
    for (const uint32_t rule : {PLAIT_DIFFUSE_THESIS, PLAIT_DIFFUSE_FLOORED}) {
        scene.params.diffuse_rule = rule;
        scene.place(particles);
        scene.exact();
        scene.diffuse();
        const double kept = rule == PLAIT_DIFFUSE_THESIS ? 0.9 : 1.0;
        const auto v = scene.velocities();
        for (size_t i = 0; i < v.size(); ++i) {
            EXPECT_NEAR(v[i][0], kept * static_cast<double>(particles[i].v[0]), 1e-6);
            EXPECT_NEAR(v[i][1], 0.5, 1e-6);
        }
    }
}

// One in a hundred outruns the rest: it alone is braked, to 0.9 of its speed, in that component
// only.
TEST_P(GridExact, outrunner_is_braked_alone) {
    std::vector<Particle> particles(100, Particle{{0.5f, 0.5f, 0.5f}, {1.0f, 0.5f, 0.0f}});
    particles[17].v = {5.0f, 0.5f, 0.0f};
    GridScene scene(device, grid_params(1, 1, 1.0f), particles.size());
    scene.params.h = 1.0f;
    scene.place(particles);
    scene.exact();
    scene.diffuse();
    const auto v = scene.velocities();
    for (size_t i = 0; i < v.size(); ++i) {
        EXPECT_NEAR(v[i][0], i == 17 ? 4.5 : 1.0, 1e-6);
        EXPECT_NEAR(v[i][1], 0.5, 1e-6);
        EXPECT_NEAR(v[i][2], 0.0, 1e-6);
    }
}

} // namespace
} // namespace plait::test
