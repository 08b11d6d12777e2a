// Volume: hair that keeps its room, what goes on over snapshots, switches and teleports, what refuses
// it, and what it costs where it is off. How well it keeps it: tests/accuracy.
#include "support.hpp"

#include <algorithm>
#include <cstring>

namespace {

constexpr size_t vertices = 10, side = 9;
constexpr float spacing = 0.009f;

// Layers of limp hair along x, rooted in a wall.
Strands layers() {
    Strands strands;
    for (size_t j = 0; j < side; ++j)
        for (size_t k = 0; k < side; ++k) {
            Strand strand;
            for (size_t i = 0; i < vertices; ++i)
                strand.push_back({0.02f * float(i), spacing * float(j), spacing * float(k)});
            strands.push_back(strand);
        }
    return strands;
}

plait::SimDesc limp() {
    plait::SimDesc desc;
    desc.material.bend_stiffness = 1e-11f;
    desc.grid.edge_count = 16;
    desc.grid.edge = 0.4f;
    desc.grid.origin[0] = -0.1f;
    desc.grid.origin[1] = -0.1f;
    desc.grid.origin[2] = -0.16f;
    return desc;
}

plait::SimDesc with_volume() {
    plait::SimDesc desc = limp();
    desc.grid.on = true;
    desc.volume.on = true;
    return desc;
}

// On a floor below the lowest layer, between walls: a heap in the open would run apart, as a liquid
// does.
plait::Sim on_floor(const plait::Context& context, const plait::SimDesc& desc) {
    plait::Sim sim(context, make_groom(layers()), desc);
    struct Side {
        size_t axis;
        float at, normal;
    };
    for (const Side& one :
         {Side{1, -spacing / 2, 1}, Side{2, -spacing / 2, 1}, Side{2, spacing * (side - 0.5f), -1},
          Side{0, -0.005f, 1}, Side{0, 0.19f, -1}}) {
        auto plane = smooth_collider();
        plane.kind = PLAIT_COLLIDER_KIND_PLANE;
        std::fill_n(plane.plane.normal, 3, 0.0f);
        plane.plane.point[one.axis] = one.at;
        plane.plane.normal[one.axis] = one.normal;
        (void)sim.create_collider(plane);
    }
    return sim;
}

// Mean height of the outer half of all strands over the floor, over that at rest.
float height_of(const plait::Sim& sim) {
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    float sum = 0;
    for (size_t strand = 0; strand < side * side; ++strand)
        for (size_t i = vertices / 2; i < vertices; ++i)
            sum += positions[4 * (strand * vertices + i) + 1] + spacing / 2;
    return sum / float(side * side * (vertices - vertices / 2)) / (spacing * float(side) / 2);
}

class VolumeOf : public OnBackend {};
ON_EVERY_BACKEND(VolumeOf);

TEST_P(VolumeOf, HoldsLayersApartThatWouldLieOnTheFloor) {
    plait::Sim bare = on_floor(context, limp()), sim = on_floor(context, with_volume());
    run(bare, 60);
    run(sim, 60);
    EXPECT_GT(height_of(sim), 2.5f * height_of(bare)) << ": " << height_of(bare);
    EXPECT_GT(height_of(sim), 0.4f); // of limp hair that slides down between walls
    EXPECT_LT(height_of(sim), 1.1f);
    EXPECT_EQ(sim.measure().nonfinite, 0u);
    EXPECT_EQ(sim.measure().grid_outside, 0u);
}

TEST_P(VolumeOf, OffItCostsNothingAndChangesNoBit) {
    auto profiled = plait_context_desc_defaults();
    profiled.backend = GetParam().c_str();
    profiled.profile = 1;
    const plait::Context timed(profiled);
    plait::Sim never = on_floor(timed, limp()), stopped = on_floor(timed, limp());
    const auto bytes = never.describe().device_bytes;
    stopped.set_all(with_volume());
    EXPECT_GT(stopped.describe().device_bytes, bytes);
    stopped.set_all(limp());
    EXPECT_EQ(stopped.describe().device_bytes, bytes);
    for (plait::Sim* each : {&never, &stopped})
        (void)launched_stages(*each); // of its making
    run(never, 3);
    run(stopped, 3);
    EXPECT_EQ(never.read(PLAIT_FIELD_POSITION), stopped.read(PLAIT_FIELD_POSITION));
    EXPECT_EQ(never.hash(), stopped.hash());
    EXPECT_EQ(launched_stages(never), launched_stages(stopped));
    stopped.set_all(with_volume());
    run(stopped, 2);
    const auto stages = launched_stages(stopped);
    EXPECT_EQ(std::ranges::count(stages, "volume_gather"), 3) << "with a start";
    EXPECT_EQ(std::ranges::count(stages, "volume_pressure"), 2 * (200 + 2 * 10));
    EXPECT_EQ(std::ranges::count(stages, "lane_diffuse"), 0);
    EXPECT_EQ(std::ranges::count(stages, "grid_diffuse"), 0);
}

TEST_P(VolumeOf, RepeatsBitForBit) {
    plait::Sim one = on_floor(context, with_volume());
    plait::Sim other = on_floor(context, with_volume());
    run(one, 20);
    run(other, 20);
    EXPECT_EQ(one.hash(), other.hash());
}

// The pressure itself, and what it does to vertices in the next step.
TEST_P(VolumeOf, SnapshotsHoldThePressure) {
    plait::Sim sim = on_floor(context, with_volume());
    run(sim, 15);
    const auto saved = sim.save();
    sim.restore(saved); // the reference, too, goes on from float32
    plait::Sim again(context, make_groom(layers()), with_volume());
    again.restore(saved);
    EXPECT_EQ(again.hash(), sim.hash());
    run(sim, 10);
    run(again, 10);
    EXPECT_EQ(again.hash(), sim.hash());
    // a sim without volume, or of another grid, takes the rest
    plait::Sim bare(context, make_groom(layers()), limp());
    bare.restore(saved);
    plait::SimDesc finer = with_volume();
    finer.grid.edge_count = 20;
    plait::Sim other(context, make_groom(layers()), finer);
    other.restore(saved);
    EXPECT_EQ(other.read(PLAIT_FIELD_POSITION), bare.read(PLAIT_FIELD_POSITION));
    run(other, 10);
    EXPECT_EQ(other.measure().nonfinite, 0u);
    // and one with volume that of a sim without
    again.restore(bare.save());
    run(again, 10);
    EXPECT_EQ(again.measure().nonfinite, 0u);
}

TEST_P(VolumeOf, BeginsAnewWithAReset) {
    plait::Sim sim = on_floor(context, with_volume());
    const uint64_t begin = sim.hash();
    run(sim, 7);
    const auto first = sim.read(PLAIT_FIELD_POSITION);
    sim.reset();
    EXPECT_EQ(sim.hash(), begin);
    run(sim, 7);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), first);
}

// The pressure begins anew and holds what it held: a teleport to where the head is leaves the pile as high.
TEST_P(VolumeOf, TeleportsCarryHairAsItLies) {
    plait::Sim sim = on_floor(context, with_volume()), still = on_floor(context, with_volume());
    run(sim, 30);
    run(still, 30);
    sim.teleport(head_at({0, 0, 0})); // where it is
    run(sim, 30);
    run(still, 30);
    EXPECT_NEAR(height_of(sim), height_of(still), 0.05f);
    EXPECT_EQ(sim.measure().grid_outside, 0u);
}

// Accelerations of 0 and air without a mass take what pressure does to the solve, too. Of
// `articulated` roundings let contacts choose otherwise after ten steps, in which hair without it falls by 14 cm.
TEST_P(VolumeOf, AddsUpWithAccelerationsAndWind) {
    plait::SimDesc desc = with_volume();
    desc.params.drag = 0; // which rests in a wind
    plait::Sim plain = on_floor(context, desc), windy = on_floor(context, desc);
    desc.acceleration.on = true;
    plait::Sim pulled = on_floor(context, desc);
    auto wind = plait_wind_desc_defaults();
    wind.air_density = 1e-12f;
    windy.set_wind(wind);
    for (plait::Sim* each : {&plain, &windy, &pulled})
        run(*each, 10);
    const auto positions = plain.read(PLAIT_FIELD_POSITION);
    EXPECT_EQ(pulled.read(PLAIT_FIELD_POSITION), positions);
    EXPECT_LT(largest_difference(windy.read(PLAIT_FIELD_POSITION), positions), 1e-4f);
}

// Strands that come to another part, of other substeps, keep what presses them.
TEST_P(VolumeOf, StaysOverSwitches) {
    plait::Sim sim = on_floor(context, with_volume());
    run(sim, 20);
    const auto twice = of_substeps(2);
    std::vector<uint32_t> indices;
    for (size_t strand = 0; strand < side * side; ++strand)
        indices.push_back(strand % 3 == 0);
    sim.set_settings({plait_strand_settings_defaults(), twice}, indices);
    run(sim, 1);
    const auto saved = sim.save();
    run(sim, 40);
    plait::Sim bare = on_floor(context, limp());
    run(bare, 20);
    bare.set_settings({plait_strand_settings_defaults(), twice}, indices);
    run(bare, 41);
    EXPECT_GT(height_of(sim), 2.5f * height_of(bare)) << height_of(bare);
    EXPECT_LT(height_of(sim), 1.1f);
    plait::Sim again = on_floor(context, with_volume());
    again.restore(saved);
    sim.restore(saved);
    EXPECT_EQ(again.hash(), sim.hash());
    run(sim, 5);
    run(again, 5);
    EXPECT_EQ(again.hash(), sim.hash());
}

TEST_P(VolumeOf, NeedsSumsOfAllHairAndStrandsOverLanes) {
    plait::Sim sim(context, make_groom(layers()), limp());
    const auto volume = plait_volume_desc_defaults();
    auto grid = plait_grid_desc_defaults();
    grid.form = PLAIT_GRID_FORM_SLOTS;
    sim.set_grid(&grid);
    EXPECT_EQ(plait_sim_set_volume(sim, &volume), PLAIT_INVALID_STATE);
    EXPECT_NE(std::strstr(plait_last_error(), "slots"), nullptr) << plait_last_error();
    sim.set_grid(nullptr);
    sim.set_volume(&volume);
    EXPECT_EQ(plait_sim_set_grid(sim, &grid), PLAIT_INVALID_STATE);
    plait::Sim flat(context, make_groom(layers()), tressfx_desc());
    EXPECT_EQ(plait_sim_set_volume(flat, &volume), PLAIT_INVALID_STATE);
    EXPECT_NE(std::strstr(plait_last_error(), "model"), nullptr) << plait_last_error();
}

// A grid that is on gives way, so that none of one's own is as one of the defaults.
TEST_P(VolumeOf, WithoutAGridIsAsWithTheDefaultOne) {
    plait::SimDesc desc = with_volume();
    desc.grid = {plait_grid_desc_defaults(), true};
    plait::Sim own = on_floor(context, desc);
    desc.grid.on = false;
    plait::Sim none = on_floor(context, desc);
    run(own, 5);
    run(none, 5);
    EXPECT_EQ(own.hash(), none.hash());
}

// A step in which hair falls by a quarter of a voxel, or more.
TEST_P(VolumeOf, WarnsOfStepsThatAreTooLongForItsVoxels) {
    plait::SimDesc desc = with_volume();
    plait::Sim fine(context, make_groom(layers()), desc);
    EXPECT_EQ(std::strstr(fine.describe().warning, "volume"), nullptr);
    desc.step = 1.0f / 30;
    plait::Sim coarse(context, make_groom(layers()), desc);
    EXPECT_NE(std::strstr(coarse.describe().warning, "volume"), nullptr)
        << coarse.describe().warning;
}

} // namespace
