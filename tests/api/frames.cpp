// A frame of reference that hair feels by a share, and what is drawn at any rate of frames.
#include "support.hpp"

#include <algorithm>

namespace {

class Frames : public OnBackend {};
ON_EVERY_BACKEND(Frames);

plait_pose pose_at(Point t, double angle = 0) {
    return {
        {0, static_cast<float>(std::sin(angle / 2)), 0, static_cast<float>(std::cos(angle / 2))},
        {t[0], t[1], t[2]}};
}

plait_pose after(const plait_pose& a, Point p) {
    const float c = 1 - 2 * a.q[1] * a.q[1], s = 2 * a.q[1] * a.q[3];
    return {{a.q[0], a.q[1], a.q[2], a.q[3]},
            {a.t[0] + c * p[0] + s * p[2], a.t[1] + p[1], a.t[2] - s * p[0] + c * p[2]}};
}

// A head that nods in a vehicle, with a body beside it: positions in the vehicle's frame.
struct Journey {
    float felt = 0;
    plait_frame_air air = PLAIT_FRAME_AIR_UNFELT;
    bool framed = true;
    uint32_t substeps = 1;
    plait_pose (*vehicle)(int) = nullptr;
    int begins = 0;         // the frame of the call that is the first with a frame of reference
    int unfelt_from = 1000; // likewise the first in which none of it is felt
    float drag = 2;
    bool alone = false; // no body
    plait_model model = PLAIT_MODEL_ARTICULATED;
};

std::vector<float> ridden(const plait::Context& context, const Journey& journey, int frames = 90) {
    plait::SimDesc desc;
    desc.substeps = journey.substeps;
    desc.model = journey.model;
    if (journey.model == PLAIT_MODEL_TRESSFX) { // whose brakes are against the world
        desc.params.gravity[1] = 0;
        desc.tressfx.damping = desc.tressfx.vsp_coeff = 0;
    }
    plait::Sim sim(context, make_groom(tuft(6, 12)), desc);
    auto params = sim.params();
    params.drag = journey.drag;
    sim.set_params(params);
    auto body = smooth_collider();
    body.capsule.a[1] = body.capsule.b[1] = -0.08f;
    body.capsule.a[0] = body.capsule.b[0] = 0.08f;
    body.capsule.a[2] = -0.2f;
    body.capsule.b[2] = 0.2f;
    body.capsule.radius_a = body.capsule.radius_b = 0.03f;
    const plait_collider_id id = journey.alone ? plait_collider_id{} : sim.create_collider(body);
    plait_pose vehicle = pose_at({0, 0, 0});
    for (int f = 0; f < frames; ++f) {
        if (journey.vehicle)
            vehicle = journey.vehicle(f);
        const Point nod = {0.01f * std::sin(0.3f * static_cast<float>(f)), 0, 0};
        auto roots = plait_roots_defaults();
        roots.head = after(vehicle, nod);
        sim.set_roots(roots);
        if (f == 0)
            sim.teleport(roots);
        if (!journey.alone)
            sim.set_collider_pose(id, roots.head);
        if (journey.framed && journey.vehicle && f >= journey.begins) {
            auto frame_of = plait_frame_desc_defaults();
            frame_of.pose = vehicle;
            frame_of.felt_translation = frame_of.felt_rotation =
                f < journey.unfelt_from ? journey.felt : 0.0f;
            frame_of.air = journey.air;
            sim.set_frame(frame_of);
        }
        sim.step(frame);
    }
    auto positions = sim.read(PLAIT_FIELD_POSITION);
    const float c = 1 - 2 * vehicle.q[1] * vehicle.q[1], s = -2 * vehicle.q[1] * vehicle.q[3];
    for (size_t i = 0; i < positions.size(); i += 4) {
        const float x = positions[i] - vehicle.t[0], z = positions[i + 2] - vehicle.t[2];
        positions[i] = c * x + s * z;
        positions[i + 1] -= vehicle.t[1];
        positions[i + 2] = -s * x + c * z;
    }
    return positions;
}

// 30 m/s^2: it brakes from 15 m/s, and stands.
plait_pose braking(int f) {
    const double t = std::min(f / 60.0, 0.5);
    return pose_at({static_cast<float>(15 * t - 15 * t * t), 0, 0});
}

// 3 m/s on a circle of 2 m, turning with it.
plait_pose circling(int f) {
    const double angle = 1.5 * f / 60;
    return pose_at(
        {static_cast<float>(2 - 2 * std::cos(angle)), 0, static_cast<float>(2 * std::sin(angle))},
        angle);
}

TEST_P(Frames, HairInAVehicleThatIsNotFeltMovesAsInOneThatStands) {
    for (const uint32_t substeps : {1u, 3u}) {
        const auto standing = ridden(context, {.substeps = substeps});
        EXPECT_LE(largest_difference(ridden(context, {.substeps = substeps, .vehicle = braking}),
                                     standing),
                  1e-5f);
        EXPECT_LE(largest_difference(ridden(context, {.substeps = substeps, .vehicle = circling}),
                                     standing),
                  1e-5f);
        // without a frame it is carried by the head
        EXPECT_GE(
            largest_difference(
                ridden(context, {.framed = false, .substeps = substeps, .vehicle = braking}, 20),
                ridden(context, {.substeps = substeps}, 20)),
            1e-2f);
    }
}

// Car and head drive on and the frame begins, or they set off, in frame 10.
TEST_P(Frames, AFrameThatBeginsThrowsNoHair) {
    using Vehicle = plait_pose (*)(int);
    const auto standing = [](int) { return pose_at({0, 0, 0}); };
    const Vehicle driving = [](int f) { return pose_at({static_cast<float>(f) / 2, 0, 0}); };
    const Vehicle starting = [](int f) {
        return pose_at({static_cast<float>(std::max(f - 10, 0)) / 2, 0, 0});
    };
    const Vehicle speeding = [](int f) { // 30 m/s^2
        const float t = static_cast<float>(std::max(f - 10, 0)) / 60;
        return pose_at({15 * t * t, 0, 0});
    };
    const Vehicle turning = [](int f) { return pose_at({0, 0, 0}, std::max(f - 10, 0) / 30.0); };
    for (const plait_model model : {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_TRESSFX})
        for (const uint32_t substeps : {1u, 2u, 4u}) {
            const Journey still{.substeps = substeps,
                                .vehicle = standing,
                                .drag = 0,
                                .alone = true,
                                .model = model};
            for (const Vehicle vehicle : {driving, starting, speeding, turning}) {
                auto journey = still;
                journey.vehicle = vehicle;
                journey.begins = 10;
                auto other = still;
                if (vehicle == driving) { // without drag it is all the same
                    other.vehicle = driving;
                    other.framed = false;
                }
                EXPECT_LE(
                    largest_difference(ridden(context, journey, 40), ridden(context, other, 40)),
                    1e-5f)
                    << substeps << " substeps, model " << model << ", at last at "
                    << vehicle(39).t[0];
            }
        }
}

// The share changes in the step in which the car sets off, or while it drives.
TEST_P(Frames, AShareThatChangesThrowsNoHair) {
    for (const uint32_t substeps : {1u, 3u}) {
        Journey driven{.framed = false, .substeps = substeps, .drag = 0, .alone = true};
        driven.vehicle = [](int f) { return pose_at({static_cast<float>(f) / 2, 0, 0}); };
        auto changed = driven;
        changed.framed = true;
        changed.felt = 1;
        changed.unfelt_from = 11;
        EXPECT_LE(largest_difference(ridden(context, changed, 40), ridden(context, driven, 40)),
                  1e-5f)
            << substeps << " substeps";
        const Journey still{.substeps = substeps};
        auto journey = still;
        journey.vehicle = [](int f) {
            return pose_at({static_cast<float>(std::max(f - 10, 0)) / 2, 0, 0});
        };
        journey.felt = 1; // of a car that stands
        journey.unfelt_from = 11;
        EXPECT_LE(largest_difference(ridden(context, journey, 40), ridden(context, still, 40)),
                  1e-5f)
            << substeps << " substeps";
    }
}

TEST_P(Frames, AFrameThatIsFeltWholeIsNone) {
    for (const auto vehicle : {braking, circling}) {
        const auto without = ridden(context, {.framed = false, .vehicle = vehicle});
        EXPECT_EQ(ridden(context, {.felt = 1, .vehicle = vehicle}), without);
    }
}

TEST_P(Frames, HalfIsBetween) {
    const auto none = ridden(context, {.vehicle = braking}, 20);
    const auto half = ridden(context, {.felt = 0.5f, .vehicle = braking}, 20);
    const auto whole = ridden(context, {.felt = 1, .vehicle = braking}, 20);
    const float all = largest_difference(none, whole);
    EXPECT_GE(largest_difference(none, half), 0.3f * all);
    EXPECT_LE(largest_difference(none, half), 0.7f * all);
}

plait_pose cruising(int f) {
    return pose_at({static_cast<float>(f) / 4, 0, 0}); // 15 m/s
}

// Hair in an open car streams; in a closed one that is felt it does not, once the start is forgotten.
TEST_P(Frames, AirStandsInTheWorldOrGoesAlong) {
    const auto after_a_while = [&](const Journey& journey) {
        return ridden(context, journey, 400);
    };
    const auto standing = after_a_while({});
    const auto open = after_a_while({.air = PLAIT_FRAME_AIR_WORLD, .vehicle = cruising});
    const auto closed =
        after_a_while({.felt = 1, .air = PLAIT_FRAME_AIR_FRAME, .vehicle = cruising});
    const auto through =
        after_a_while({.felt = 1, .air = PLAIT_FRAME_AIR_UNFELT, .vehicle = cruising});
    EXPECT_GE(largest_difference(open, standing), 0.05f);
    EXPECT_LE(largest_difference(closed, standing), 2e-3f);
    EXPECT_LE(largest_difference(open, through), 2e-3f);
}

TEST_P(Frames, WhatIsNoFrameIsRefused) {
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    auto desc = plait_frame_desc_defaults();
    desc.felt_rotation = 1.5f;
    EXPECT_EQ(plait_sim_set_frame(sim.get(), &desc), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("felt_rotation is 1.5, range is [0, 1]"),
              std::string::npos);
    desc = plait_frame_desc_defaults();
    desc.pose.q[3] = 2;
    EXPECT_EQ(plait_sim_set_frame(sim.get(), &desc), PLAIT_INVALID_ARGUMENT);
    desc = plait_frame_desc_defaults();
    desc.air = static_cast<plait_frame_air>(3);
    EXPECT_EQ(plait_sim_set_frame(sim.get(), &desc), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(plait_sim_set_frame(nullptr, nullptr), PLAIT_INVALID_ARGUMENT);
}

TEST_P(Frames, SnapshotsHoldThem) {
    plait::Sim sim(context, make_groom(tuft(4, 8)));
    auto frame_of = plait_frame_desc_defaults();
    const auto ride = [&](plait::Sim& s, int from, int to) {
        for (int f = from; f < to; ++f) {
            frame_of.pose = braking(f);
            s.set_frame(frame_of);
            auto roots = plait_roots_defaults();
            roots.head = braking(f);
            s.set_roots(roots);
            s.step(frame);
        }
    };
    ride(sim, 0, 10);
    const auto bytes = sim.save();
    ride(sim, 10, 20);
    plait::Sim other(context, make_groom(tuft(4, 8)));
    other.restore(bytes);
    ride(other, 10, 20);
    EXPECT_LE(largest_difference(other.read(PLAIT_FIELD_POSITION), sim.read(PLAIT_FIELD_POSITION)),
              1e-6f);
}

// A head that runs at 5 m/s and turns, drawn at any rate.
class Rates : public OnBackend {};
ON_EVERY_BACKEND(Rates);

TEST_P(Rates, RootsAreDrawnOnTheHeadAtAnyRateOfFrames) {
    const std::vector<std::vector<double>> rates = {{1 / 24.0},  {1 / 30.0},  {1 / 48.0},
                                                    {1 / 60.0},  {1 / 90.0},  {1 / 120.0},
                                                    {1 / 144.0}, {1 / 240.0}, {0.004, 0.03, 0.011}};
    for (const auto& rate : rates) {
        plait::Sim sim(context, make_groom({{{0.1f, 0, 0}, {0.1f, -0.1f, 0}, {0.1f, -0.2f, 0}}}));
        double time = 0, most = 0, last = 0;
        float before[3] = {};
        for (size_t f = 0; time < 0.5; ++f) {
            const double dt = rate[f % rate.size()];
            time += dt;
            const auto head = pose_at({static_cast<float>(5 * time), 0, 0}, 2 * std::sin(6 * time));
            auto roots = plait_roots_defaults();
            roots.head = head;
            sim.set_roots(roots);
            sim.step(dt);
            const auto hair = sim.read(PLAIT_FIELD_POSITION);
            const plait_pose root = after(head, {0.1f, 0, 0});
            double square = 0;
            for (size_t i = 0; i < 3; ++i)
                square += std::pow(double(hair[i]) - double(root.t[i]), 2);
            most = std::max(most, std::sqrt(square));
            last = std::abs(double(hair[8]) - double(before[0]));
            before[0] = hair[8];
        }
        EXPECT_LE(most, 5e-4) << 1 / rate[0] << " frames a second";
        EXPECT_GT(last, 0) << "hair that does not move is on no head that does";
    }
}

// A frame carries no collider that is gone: a snapshot would be refused.
TEST_P(Frames, WhatIsGoneIsNotCarried) {
    plait::Sim sim(context, make_groom(tuft(2, 8)));
    sim.destroy_collider(sim.create_collider(smooth_collider()));
    auto frame_of = plait_frame_desc_defaults();
    for (const Point at : {Point{0, 0, 0}, Point{0, 0.1f, 0}, Point{0, 0.3f, 0}}) {
        frame_of.pose = pose_at(at, 0.5 * double(at[1]));
        sim.set_frame(frame_of);
        sim.step(frame);
    }
    sim.restore(sim.save());
}

// A photo mode: the head is moved in no time, and hair is on it.
TEST_P(Rates, AStepOfNoTimeDrawsHairOnItsHead) {
    plait::Sim sim(context, make_groom(tuft(2, 8)));
    run(sim, 10);
    const auto still = sim.read(PLAIT_FIELD_POSITION);
    sim.set_roots(head_at({1, 2, 3}));
    sim.step(0);
    auto moved = sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < moved.size(); ++i)
        moved[i] -= i % 4 < 3 ? static_cast<float>(i % 4 + 1) : 0;
    EXPECT_LE(largest_difference(moved, still), 1e-6f);
}

// A character that is made somewhere is there: 112 m away is no way of 10 km/s.
TEST_P(Rates, TheFirstAimIsWhereTheHairIs) {
    plait::Sim here(context, make_groom(tuft(2, 8))), there(context, make_groom(tuft(2, 8)));
    for (int f = 0; f < 30; ++f) {
        here.set_roots(head_at({0, 0, 0}));
        there.set_roots(head_at({112, 0, 0}));
        here.step(frame);
        there.step(frame);
    }
    auto moved = there.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < moved.size(); i += 4)
        moved[i] -= 112;
    EXPECT_LE(largest_difference(moved, here.read(PLAIT_FIELD_POSITION)), 1e-5f);
}

TEST_P(Rates, AJumpThatNoHeadMakesIsSaidOnce) {
    std::vector<std::string> said;
    auto desc = plait_context_desc_defaults();
    const std::string backend = GetParam();
    desc.backend = backend.c_str();
    desc.log_user = &said;
    desc.log = [](plait_log_level level, const char* text, void* user) {
        if (level >= PLAIT_LOG_LEVEL_WARNING)
            static_cast<std::vector<std::string>*>(user)->emplace_back(text);
    };
    plait::Context loud(desc);
    plait::Sim sim(loud, make_groom(tuft(2, 8)));
    for (int f = 0; f < 10; ++f) {
        sim.set_roots(head_at({0.02f * static_cast<float>(f), 0, 0}));
        sim.step(frame);
    }
    said.clear();
    sim.set_roots(head_at({100, 0, 0}));
    sim.step(frame);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("plait_sim_teleport"), std::string::npos) << said[0];
    sim.set_roots(head_at({0, 0, 0}));
    sim.step(frame);
    EXPECT_EQ(said.size(), 1u);
}

} // namespace
