// What is shown beside positions and tangents: the frame before, and the box around all of it.
#include "support.hpp"

#include <algorithm>

namespace {

class Output : public OnBackend {};
ON_EVERY_BACKEND(Output);

plait::SimDesc with_last_frame() {
    plait::SimDesc desc;
    desc.keep_last_frame = 1;
    desc.follows_per_guide = 2;
    return desc;
}

TEST_P(Output, LastFrameIsWhatWasShownBeforeTheLastCall) {
    for (const uint32_t interpolated : {0u, 1u}) {
        auto desc = with_last_frame();
        desc.interpolate_output = interpolated;
        plait::Sim sim(context, make_groom(tuft(3, 8)), desc);
        EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION_LAST_FRAME), sim.read(PLAIT_FIELD_POSITION));
        for (const double dt : {0.03, 0.001, 0.02, 0.0}) {
            if (dt > 0)
                sim.set_roots(head_at({static_cast<float>(dt), 0, 0}));
            const auto before = sim.read(PLAIT_FIELD_POSITION);
            sim.step(dt);
            EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION_LAST_FRAME), before) << dt;
        }
        const auto last = sim.read(PLAIT_FIELD_POSITION_LAST_FRAME);
        EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), last) << "nothing moves in no time";
    }
}

TEST_P(Output, WhatJumpsHasTheFrameBeforeWhereItIs) {
    plait::Sim sim(context, make_groom(tuft(3, 8)), with_last_frame());
    run(sim, 3);
    EXPECT_GT(largest_difference(sim.read(PLAIT_FIELD_POSITION_LAST_FRAME),
                                 sim.read(PLAIT_FIELD_POSITION)),
              1e-4f);
    sim.teleport(head_at({1, 2, 3}));
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION_LAST_FRAME), sim.read(PLAIT_FIELD_POSITION));
    run(sim, 3);
    sim.reset();
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION_LAST_FRAME), sim.read(PLAIT_FIELD_POSITION));
}

TEST_P(Output, LastFrameIsOffUnlessItIsAskedFor) {
    plait::Sim sim(context, make_groom(tuft(3, 8)));
    size_t size = 0;
    EXPECT_EQ(plait_sim_read(sim, PLAIT_FIELD_POSITION_LAST_FRAME, nullptr, &size),
              PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("keep_last_frame"), std::string::npos);
}

// Of 3 strands of 8 and their follows, and of more vertices than one pass takes.
TEST_P(Output, BoundsAreThoseOfAllVerticesShown) {
    for (const size_t strands : {3, 700}) {
        plait::Sim sim(context, make_groom(tuft(strands, 8)), with_last_frame());
        run(sim, 2);
        const auto positions = sim.read(PLAIT_FIELD_POSITION);
        std::vector<float> expected{positions[0], positions[1], positions[2], 0};
        expected.insert(expected.end(), expected.begin(), expected.begin() + 4);
        for (size_t i = 0; i < positions.size(); ++i)
            if (i % 4 != 3) {
                expected[i % 4] = std::min(expected[i % 4], positions[i]);
                expected[4 + i % 4] = std::max(expected[4 + i % 4], positions[i]);
            }
        EXPECT_EQ(sim.read(PLAIT_FIELD_BOUNDS), expected);
        EXPECT_LT(expected[0], expected[4]);
    }
}

TEST_P(Output, BoundsAreNotWritten) {
    plait::Sim sim(context, make_groom(tuft(3, 8)));
    const std::vector<float> box(8, 0);
    EXPECT_EQ(plait_sim_write(sim, PLAIT_FIELD_BOUNDS, box.data(), 32), PLAIT_INVALID_ARGUMENT);
}

// The model articulated writes them with positions, where strands of several lengths and numbers of
// substeps lie, in whatever order; those of written positions are the stage's. Bit for bit
// where what is read and written are the device's floats; the reference has doubles.
TEST_P(Output, TangentsOfTheModelAreThoseOfTheStage) {
    Strands groom = tuft(70, 16);
    for (size_t strand = 0; strand < groom.size(); strand += 3)
        groom[strand].resize(3 + strand % 9);
    for (const uint32_t follows : {0u, 2u}) {
        plait::SimDesc desc;
        desc.follows_per_guide = follows;
        desc.interpolate_output = 0; // what is shown is what is written
        plait::Sim sim(context, make_groom(groom), desc);
        std::vector<uint32_t> substeps;
        for (uint32_t strand = 0; strand < groom.size(); ++strand)
            substeps.push_back(1 + strand % 4);
        const auto of_guides = [&](const std::vector<float>& of_all) {
            const auto guides = of_all.size() / (1 + follows);
            return std::vector<float>(of_all.begin(), of_all.begin() + static_cast<long>(guides));
        };
        for (const bool several : {false, true}) {
            if (several)
                take_substeps(sim, substeps);
            sim.set_roots(head_at({0.01f, 0.02f, 0}));
            sim.step(several ? 0.05 : 0.02);
            const auto positions = sim.read(PLAIT_FIELD_POSITION);
            const auto tangents = sim.read(PLAIT_FIELD_TANGENT);
            sim.write(PLAIT_FIELD_POSITION, of_guides(positions));
            const float near = GetParam() == "opencl" ? 1e-30f : 1e-5f;
            EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), positions), near);
            EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_TANGENT), tangents), near);
            sim.set_roots(head_at({0, 0, 0.3f}));
            sim.step(0.02);
            EXPECT_GT(largest_difference(sim.read(PLAIT_FIELD_TANGENT), tangents), 1e-3f);
        }
    }
}

} // namespace
