// What methods that keep hair's volume are measured by, and what each of them does to a block of hair
// that can be worked out by hand.
#include "volume/measures.hpp"
#include "volume/methods.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace lab::volume;
using lab::Vec3;

constexpr double h = 1.0 / 60;
const Cube cube{Vec3(-0.16, -0.16, -0.16), 0.32, 16}; // nodes in the middles of voxels of 2 cm

// Two vertices to a voxel's edge, of 1e-6 kg, over `voxels` of them about the origin, times `squeeze`;
// as dense as is wanted where that is 1.
Cloud block(int voxels, double squeeze = 1) {
    Cloud cloud;
    const double apart = cube.voxel() / 2;
    for (int z = -voxels; z < voxels; ++z)
        for (int y = -voxels; y < voxels; ++y)
            for (int x = -voxels; x < voxels; ++x)
                cloud.x.push_back(squeeze * apart * Vec3(x + 0.5, y + 0.5, z + 0.5));
    cloud.v.assign(cloud.size(), Vec3::Zero());
    cloud.mass.assign(cloud.size(), 1e-6);
    cloud.wanted.assign(cloud.size(), 1e-6 / std::pow(apart, 3));
    cloud.moves.assign(cloud.size(), 1);
    return cloud;
}

Change act(const char* name, const Cloud& cloud) {
    for (const Method& method : all_methods())
        if (method.name == name)
            return method.program(cube, 0)->act(cloud, h);
    ADD_FAILURE() << name;
    return {};
}

// Along the way from the middle, mean; of whichever the change is.
double outwards(const Cloud& cloud, const std::vector<Vec3>& change) {
    double sum = 0;
    for (size_t i = 0; i < change.size(); ++i)
        sum += change[i].dot(cloud.x[i].normalized());
    return sum / static_cast<double>(cloud.size());
}

TEST(Nodes, share_a_vertex_out) {
    Cloud cloud = block(1);
    Nodes nodes(cube, 0);
    nodes.add_up(cloud);
    double mass = 0;
    for (size_t n = 0; n < nodes.count(); ++n)
        mass += nodes.density(n) * std::pow(cube.voxel(), 3);
    EXPECT_NEAR(mass, 8e-6, 1e-18);
    double weights = 0;
    for (const auto& [node, weight] : nodes.around(Vec3(0.013, -0.07, 0.031)))
        weights += weight;
    EXPECT_NEAR(weights, 1, 1e-12);
    EXPECT_TRUE(nodes.around(Vec3(0.16, 0, 0)).empty());
}

// In the middle of evenly dense hair a pressure that falls by G a metre pulls with G/density.
TEST(Nodes, pull_down_the_pressure_and_keep_momentum) {
    const Cloud cloud = block(5);
    Nodes nodes(cube, 0);
    nodes.add_up(cloud);
    std::vector<double> pressure(nodes.count());
    for (size_t n = 0; n < pressure.size(); ++n)
        pressure[n] = -3 * cube.voxel() * static_cast<double>(n / 256); // y
    const Vec3 pull = nodes.pull_of(pressure)[(size_t{8} * 16 + 8) * 16 + 8];
    EXPECT_NEAR(pull.y(), 3 / cloud.wanted[0], 1e-9 / cloud.wanted[0]);
    EXPECT_NEAR(pull.x(), 0, 1e-12);
    for (size_t n = 0; n < pressure.size(); ++n)
        pressure[n] = nodes.is_hair(n) ? std::sin(static_cast<double>(n)) : 0;
    const auto pulls = nodes.pull_of(pressure);
    Vec3 sum = Vec3::Zero();
    double sizes = 0;
    for (size_t n = 0; n < pulls.size(); ++n) {
        sum += nodes.density(n) * pulls[n];
        sizes += nodes.density(n) * pulls[n].norm();
    }
    EXPECT_GT(sizes, 0);
    EXPECT_LT(sum.norm(), 1e-12 * sizes);
}

TEST(VolumeMeasures, are_those_of_their_definitions) {
    Cloud cloud = block(2);
    for (size_t i = 0; i < cloud.size(); ++i)
        cloud.v[i] = Vec3(1, 0, 0) + cloud.x[i];
    const std::vector<Vec3> along(cloud.size(), Vec3(0, 2, 0));
    EXPECT_NEAR(momentum_change(cloud, along), 1, 1e-12);
    EXPECT_NEAR(momentum_change(cloud, cloud.x), 0, 1e-12) << "in pairs";
    EXPECT_NEAR(energy_change(cloud, cloud.x), 3, 1e-9) << "twice as fast about the mean";
    EXPECT_NEAR(energy_change(cloud, along), 0, 1e-9) << "of the mean it is not counted";
    EXPECT_EQ(momentum_change(cloud, std::vector<Vec3>(cloud.size(), Vec3::Zero())), 0);
    EXPECT_NEAR(way(block(2), block(2, 1.5)) / way(block(2), block(2, 2)), 0.5, 1e-9);
}

// Vertices in the middles of cells of 12 mm fill them; then all in half of the cells.
TEST(VolumeMeasures, count_room_by_cells) {
    Cloud cloud = block(1);
    for (size_t i = 0; i < 8; ++i)
        cloud.x[i] = Vec3(0.006 + 0.012 * static_cast<double>(i), 0.15, 0.006);
    const double cell = std::pow(0.012, 3);
    EXPECT_NEAR(room_of(cloud).volume, 8 * cell, 1e-12);
    for (size_t i = 0; i < 4; ++i)
        cloud.x[i] = cloud.x[i + 4];
    EXPECT_NEAR(room_of(cloud).volume, 4 * cell, 1e-12);
    cloud.x.assign(8, Vec3(0, 0.13, 0));
    cloud.x[0] = Vec3(0, -0.5, 0); // below the equator
    EXPECT_NEAR(room_of(cloud).height, 0.03, 1e-9);
}

TEST(VolumeMeasures, count_neighbours_of_other_strands) {
    Cloud rest = block(1); // of four strands of two vertices, 1 cm apart
    const Neighbours neighbours(rest, 2);
    EXPECT_EQ(neighbours.kept(rest), 1);
    EXPECT_EQ(neighbours.crowd(rest), 1);
    Cloud apart = rest;
    for (size_t i = 4; i < 8; ++i)
        apart.x[i] += Vec3(0, 0, 1);
    EXPECT_NEAR(neighbours.kept(apart), 0.5, 1e-12);
    Cloud together = rest;
    together.x.assign(8, Vec3::Zero());
    EXPECT_EQ(neighbours.kept(together), 1);
    EXPECT_NEAR(neighbours.crowd(together), 3, 1e-12) << "six instead of two";
}

TEST(VolumeMethods, push_as_they_are_told_apart_by) {
    const Cloud loose = block(4), dense = block(4, 0.9);
    // Down the density's gradient, also where hair is as dense as it should be.
    EXPECT_GT(outwards(loose, act("petrovic", loose).acceleration), 0.1);
    // A state equation has no pressure there, and in proportion to its stiffness where it is denser.
    EXPECT_NEAR(outwards(loose, act("fluid_soft", loose).acceleration), 0, 1e-9);
    const double soft = outwards(dense, act("fluid_soft", dense).acceleration);
    EXPECT_GT(soft, 0.1);
    EXPECT_NEAR(outwards(dense, act("fluid_stiff", dense).acceleration), 16 * soft, 1e-7);
    EXPECT_NEAR(outwards(dense, act("fluid_beyond", dense).acceleration), 32 * soft, 1e-7);
    // A projection knows no forces, and nothing of hair that rests and is not too dense.
    EXPECT_TRUE(act("projection", dense).acceleration.empty());
    EXPECT_NEAR(outwards(loose, act("projection", loose).velocity), 0, 1e-9);
}

TEST(VolumeMethods, keep_momentum_and_stop_hair_that_comes_together) {
    Cloud cloud = block(4);
    for (size_t i = 0; i < cloud.size(); ++i)
        cloud.v[i] = Vec3(0.4, 0, 0) - 3 * cloud.x[i] + 0.1 * Vec3(std::sin(double(i)), 0, 0);
    for (const char* name : {"petrovic", "fluid_soft", "projection"}) {
        const Change change = act(name, cloud);
        EXPECT_LT(momentum_change(cloud, change.velocity), 1e-9) << name;
        EXPECT_LT(energy_change(cloud, change.velocity), 0) << name << ": friction";
    }
}

// Deep inside, where hair is as dense as it should be, nothing may come together any more.
TEST(VolumeMethods, project_what_comes_together) {
    Cloud cloud = block(10);
    for (size_t i = 0; i < cloud.size(); ++i)
        cloud.v[i] = -3 * cloud.x[i];
    const auto friction = act("petrovic", cloud).velocity, all = act("projection", cloud).velocity;
    double before = 0, after = 0;
    for (size_t i = 0; i < cloud.size(); ++i)
        if (cloud.x[i].norm() < 0.04) {
            before += cloud.v[i].dot(cloud.x[i]);
            after += (cloud.v[i] + all[i] - friction[i]).dot(cloud.x[i]);
        }
    EXPECT_LT(before, 0);
    EXPECT_LT(std::abs(after), -0.3 * before);
}

} // namespace
