// Reading without waiting: what a fence promises, and what is refused.
#include "support.hpp"

#include <plait/plait_async.h>

namespace {

class Async : public OnBackend {};
ON_EVERY_BACKEND(Async);

TEST_P(Async, ReadsWhatWaitingReads) {
    plait::Sim sim(context, make_groom(tuft(300, 16)));
    for (const plait_field field : {PLAIT_FIELD_POSITION, PLAIT_FIELD_TANGENT, PLAIT_FIELD_BOUNDS,
                                    PLAIT_FIELD_REST, PLAIT_FIELD_PIN}) {
        sim.step(frame);
        std::vector<float> later;
        const auto fence = sim.read_later(field, later);
        sim.fence_wait(fence);
        EXPECT_TRUE(sim.fence_reached(fence));
        EXPECT_EQ(later, sim.read(field)) << field;
    }
}

// A game draws the hair of the frame before while the device works on this one: what is read is of the
// moment it was asked for, whatever was enqueued since.
TEST_P(Async, ReadsTheHairOfItsMoment) {
    const auto groom = make_groom(tuft(300, 16));
    plait::Sim ahead(context, groom), waiting(context, groom);
    std::vector<float> hair[2], before;
    uint64_t fences[2] = {};
    for (size_t f = 0; f < 20; ++f) {
        ahead.step(frame);
        fences[f % 2] = ahead.read_later(PLAIT_FIELD_POSITION, hair[f % 2]);
        if (f > 0) {
            ASSERT_GT(fences[f % 2], fences[(f - 1) % 2]);
            ahead.fence_wait(fences[(f - 1) % 2]);
            EXPECT_EQ(hair[(f - 1) % 2], before) << "frame " << f;
        }
        waiting.step(frame);
        before = waiting.read(PLAIT_FIELD_POSITION);
    }
    ahead.fence_wait(fences[1]);
}

TEST_P(Async, AFenceIsReachedWithoutAWait) {
    plait::Sim sim(context, make_groom(tuft(300, 16)));
    for (int i = 0; i < 10; ++i)
        sim.step(frame);
    const auto fence = sim.fence();
    while (!sim.fence_reached(fence)) {
    }
    EXPECT_TRUE(sim.fence_reached(fence)) << "and stays so";
    EXPECT_GT(sim.fence(), fence);
}

// Nothing is written after it: the vector goes with this scope.
TEST_P(Async, ASimThatIsDestroyedHasReadWhatItWasAskedTo) {
    const auto groom = make_groom(tuft(300, 16));
    std::vector<float> later, now;
    {
        plait::Sim sim(context, groom);
        now = sim.read(PLAIT_FIELD_POSITION);
        sim.read_later(PLAIT_FIELD_POSITION, later);
    }
    EXPECT_EQ(later, now);
}

TEST_P(Async, WhatIsNoneIsRefused) {
    plait::Sim sim(context, make_groom(tuft(3, 4)));
    const auto refused = [&](plait_result result, const std::string& why) {
        EXPECT_EQ(result, PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(why), std::string::npos)
            << plait_last_error();
    };
    uint32_t reached = 7;
    refused(plait_sim_fence_reached(sim, 1, &reached), "there is no fence yet");
    const uint64_t fence = sim.fence();
    refused(plait_sim_fence_reached(sim, 0, &reached), "fence is 0, range is [1, ");
    refused(plait_sim_fence_wait(sim, fence + 1), "the fences that were made");
    EXPECT_EQ(reached, 7u);
    std::vector<float> dst(3 * 4 * 4);
    uint64_t made = 0;
    const auto read = [&](plait_field field, size_t size) {
        return plait_sim_read_later(sim, field, dst.data(), size, &made);
    };
    const size_t size = dst.size() * sizeof(float);
    refused(read(PLAIT_FIELD_POSITION, size - 4), "size is 188, the field has 192 bytes");
    refused(read(PLAIT_FIELD_VELOCITY, size), "(VELOCITY), which the host computes");
    refused(read(PLAIT_FIELD_POSITION_PREV, size), "(POSITION_PREV), which the host computes");
    EXPECT_EQ(read(PLAIT_FIELD_GRID_DENSITY, size), PLAIT_INVALID_STATE);
    EXPECT_EQ(made, 0u);
}

} // namespace
