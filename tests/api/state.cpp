// Reading, writing, saving and restoring.
#include "forged.hpp"
#include "support.hpp"

#include <algorithm>
#include <functional>
#include <random>

namespace {

class State : public OnBackend {};
ON_EVERY_BACKEND(State);

plait::SimDesc busy() {
    plait::SimDesc desc;
    desc.follows_per_guide = 1;
    desc.interpolate_output = 1;
    desc.substeps = 2;
    desc.grid.on = true;
    return desc;
}

// A sim under way: a head half-way to its target, roots of their own, a moving collider.
void stir(plait::Sim& sim) {
    auto collider = smooth_collider();
    collider.pose.t[1] = -0.15f;
    const auto id = sim.create_collider(collider);
    auto floor = collider;
    floor.kind = PLAIT_COLLIDER_KIND_PLANE;
    sim.create_collider(floor);
    const std::vector<plait_pose> own(6, {{0, 0, 0, 1}, {0.01f, 0, 0}});
    auto roots = head_at({0.02f, 0, 0});
    roots.root_poses = plait::view(own);
    sim.set_roots(roots);
    sim.step(3.4 * frame);
    sim.set_roots(head_at({0.05f, 0, 0}));
    collider.pose.t[0] = 0.1f;
    sim.set_collider_pose(id, collider.pose);
}

// A straight strand without weight or air that is set to turn about its root goes on as fast: BDF2,
// which takes a velocity that jumped for an acceleration, would turn it faster: by half, of which
// the energy budget leaves 12 %.
TEST_P(State, WrittenVelocitiesAreWhatStrandsGoOnWith) {
    constexpr float speed = 2.0f; // rad/s
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_ARTICULATED;
    desc.params.bdf2 = 1;
    desc.params.drag = desc.material.bend_stiffness = 0;
    std::fill_n(desc.params.gravity, 3, 0.0f);
    Strands hanging(1);
    for (int i = 0; i < 9; ++i)
        hanging[0].push_back({0, -0.03f * static_cast<float>(i), 0});
    plait::Sim sim(context, make_groom(hanging), desc);
    auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
    for (size_t i = 0; i < velocity.size(); i += 4)
        velocity[i] = speed * 0.03f * static_cast<float>(i / 4);
    sim.write(PLAIT_FIELD_VELOCITY, velocity);
    const auto angle = [&] {
        const auto at = sim.read(PLAIT_FIELD_POSITION);
        return std::atan2(at[32], -at[33]);
    };
    run(sim, 10);
    const float begin = angle();
    run(sim, 20);
    EXPECT_NEAR(angle() - begin, speed * 20 / 60, 0.02 * speed * 20 / 60);
}

TEST_P(State, RestoredStateHasTheSameHashAndTheSameFuture) {
    const auto groom = make_groom(tuft(6, 7));
    plait::Sim a(context, groom, busy());
    stir(a);
    const auto saved = a.save();
    const uint64_t hash = a.hash();
    plait::Sim b(context, groom, busy());
    b.restore(saved);
    EXPECT_EQ(b.hash(), hash);
    EXPECT_EQ(b.save(), saved);
    run(a, 10);
    run(b, 10);
    EXPECT_EQ(a.describe().steps, b.describe().steps);
    // `reference` keeps doubles and a snapshot floats: there the futures differ by rounding.
    EXPECT_LT(largest_difference(a.read(PLAIT_FIELD_POSITION), b.read(PLAIT_FIELD_POSITION)),
              GetParam() == "opencl" ? 1e-30f : 1e-4f);
}

// The first roots say where its hair is, and drag none of it there.
TEST_P(State, ASnapshotFromBeforeTheFirstStepIsAFreshSim) {
    const auto groom = make_groom(tuft(6, 7));
    const auto saved = plait::Sim(context, groom, busy()).save();
    plait::Sim fresh(context, groom, busy()), restored(context, groom, busy()),
        stirred(context, groom, busy());
    stir(stirred);
    for (plait::Sim* sim : {&restored, &stirred})
        sim->restore(saved);
    for (plait::Sim* sim : {&fresh, &restored, &stirred}) {
        sim->set_roots(head_at({1, 0.5f, 0}));
        run(*sim, 5);
    }
    const auto x = fresh.read(PLAIT_FIELD_POSITION);
    const float most = GetParam() == "opencl" ? 1e-30f : 1e-5f;
    EXPECT_LT(largest_difference(restored.read(PLAIT_FIELD_POSITION), x), most);
    EXPECT_LT(largest_difference(stirred.read(PLAIT_FIELD_POSITION), x), most);
}

// Where only time has passed before a reset, the first roots after it say where the hair is. Where roots or a teleport
// put the head, it is there still, and the next roots move it.
TEST_P(State, AResetForgetsTimeButNotWhereTheHeadIs) {
    const auto groom = make_groom(tuft(6, 7));
    const auto near = head_at({1, 0.5f, 0}), there = head_at({1.02f, 0.5f, 0});
    const auto after = [&](const std::function<void(plait::Sim&)>& put, bool resets) {
        plait::Sim sim(context, groom, busy());
        put(sim);
        if (resets) {
            run(sim, 3);
            sim.reset();
        }
        sim.set_roots(there);
        run(sim, 5);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    const auto nowhere = [](plait::Sim&) {};
    const auto roots = [&](plait::Sim& sim) { sim.set_roots(near); };
    const auto teleport = [&](plait::Sim& sim) { sim.teleport(near); };
    const float most = GetParam() == "opencl" ? 1e-30f : 1e-5f;
    EXPECT_LT(largest_difference(after(nowhere, true), after(nowhere, false)), most);
    const auto moved = after(roots, true);
    EXPECT_LT(largest_difference(after(teleport, true), moved), most);
    EXPECT_GT(largest_difference(after(nowhere, true), moved), 1e-3f);
}

// Refused with a sentence, and nothing has changed.
void expect_refused(plait::Sim& sim, const std::vector<unsigned char>& bytes,
                    const std::string& what) {
    const plait_result result = plait_sim_restore(sim, bytes.data(), bytes.size());
    EXPECT_TRUE(result == PLAIT_BAD_DATA || result == PLAIT_UNSUPPORTED) << what << ": " << result;
    EXPECT_EQ(std::string(plait_last_error()).rfind("plait_sim_restore: snapshot: ", 0), 0u)
        << what << ": " << plait_last_error();
}

TEST_P(State, ASnapshotWithAnyByteDamagedIsRefused) {
    plait::Sim sim(context, make_groom(tuft(6, 7)), busy());
    stir(sim);
    const auto saved = sim.save();
    const uint64_t hash = sim.hash();
    for (size_t at = 0; at < saved.size(); ++at)
        for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
            auto damaged = saved;
            damaged[at] = static_cast<unsigned char>(damaged[at] ^ flip);
            expect_refused(sim, damaged, "byte " + std::to_string(at));
        }
    EXPECT_EQ(sim.hash(), hash);
    EXPECT_EQ(sim.measure().nonfinite, 0u);
    sim.restore(saved);
    EXPECT_EQ(sim.hash(), hash);
}

TEST_P(State, ASnapshotDamagedAnyHowIsRefused) {
    plait::Sim sim(context, make_groom(tuft(6, 7)), busy());
    stir(sim);
    const auto saved = sim.save();
    const uint64_t hash = sim.hash();
    std::mt19937 random(7);
    const auto below = [&](size_t end) { return random() % end; };
    for (int i = 0; i < 5000; ++i) {
        auto damaged = saved;
        const size_t at = below(saved.size()), other = below(saved.size());
        const size_t length = std::min(1 + below(64), saved.size() - std::max(at, other));
        switch (i % 5) {
        case 0: // cut
            damaged.resize(at);
            break;
        case 1: // longer
            damaged.insert(damaged.begin() + static_cast<long>(at), length, 0);
            break;
        case 2: // a run of it elsewhere
            std::copy_n(saved.begin() + static_cast<long>(other), length,
                        damaged.begin() + static_cast<long>(at));
            break;
        case 3: // a run of anything
            for (size_t k = at; k < at + length; ++k)
                damaged[k] = static_cast<unsigned char>(random());
            break;
        default: // two values exchanged
            std::swap_ranges(damaged.begin() + static_cast<long>(at / 4 * 4),
                             damaged.begin() + static_cast<long>(at / 4 * 4 + 4),
                             damaged.begin() + static_cast<long>(other / 4 * 4));
        }
        if (damaged != saved)
            expect_refused(sim, damaged, "round " + std::to_string(i));
    }
    EXPECT_EQ(sim.hash(), hash);
}

TEST_P(State, ASnapshotSaysWhatIsWrongWithIt) {
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    const auto saved = sim.save();
    const auto said = [&](std::vector<unsigned char> bytes, const char* part) {
        EXPECT_NE(plait_sim_restore(sim, bytes.data(), bytes.size()), PLAIT_OK);
        EXPECT_NE(std::string(plait_last_error()).find(part), std::string::npos)
            << plait_last_error();
    };
    said({1, 2, 3}, "3 bytes, the header takes");
    auto bytes = saved;
    bytes[0] = 'x';
    said(bytes, "begins with");
    bytes = saved;
    bytes[4] = 2;
    said(bytes, "version 2, this library reads version 1");
    bytes = saved;
    bytes.at(bytes.size() - 1) ^= 1; // at: GCC 14 takes back() for a write past an empty vector
    said(bytes, "damaged or cut");
}

// A block that this library does not know, or knows in another version, was written by another plait.
TEST_P(State, ASnapshotWithBlocksOfAnotherVersionIsRefused) {
    plait::Sim sim(context, make_groom(tuft(6, 7)), busy());
    stir(sim);
    const auto saved = sim.save();
    const uint64_t hash = sim.hash();
    const auto refused = [&](std::vector<unsigned char> bytes, plait_result result,
                             const char* part) {
        forged::sign(bytes);
        EXPECT_EQ(plait_sim_restore(sim, bytes.data(), bytes.size()), result) << part;
        EXPECT_NE(std::string(plait_last_error()).find(part), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(sim.hash(), hash);
    };
    const auto hair = static_cast<long>(forged::find_block(saved, "hair"));
    const auto frame = static_cast<long>(forged::find_block(saved, "fram"));
    const auto bodies = static_cast<long>(forged::find_block(saved, "body"));
    auto bytes = saved;
    bytes[static_cast<size_t>(hair)] = 'b';
    refused(bytes, PLAIT_UNSUPPORTED, "which this library does not know");
    bytes = saved;
    bytes[static_cast<size_t>(hair) + forged::version_at] = 2;
    refused(bytes, PLAIT_UNSUPPORTED, "the block hair has version 2, this library reads version 1");
    bytes = saved;
    bytes.erase(bytes.begin() + frame, bytes.begin() + bodies);
    refused(bytes, PLAIT_BAD_DATA, "it has no block frame");
    bytes = saved;
    bytes.insert(bytes.begin() + bodies, saved.begin() + frame, saved.begin() + bodies);
    refused(bytes, PLAIT_BAD_DATA, "the block frame is not in its place");
    bytes = saved;
    bytes[static_cast<size_t>(frame) + forged::bytes_at] = 4;
    refused(bytes, PLAIT_BAD_DATA, "the block frame has 4 bytes");
    bytes = saved;
    bytes.insert(bytes.begin() + bodies, 4, 0);
    bytes[static_cast<size_t>(frame) + forged::bytes_at] += 4;
    refused(bytes, PLAIT_BAD_DATA, "the block frame has 4 bytes more than it needs");
}

TEST_P(State, SnapshotsOfAnotherGroomAreRefusedByName) {
    plait::Sim six(context, make_groom(tuft(6, 7)));
    plait::Sim five(context, make_groom(tuft(5, 7)));
    const auto saved = six.save();
    EXPECT_EQ(plait_sim_restore(five, saved.data(), saved.size()), PLAIT_INVALID_ARGUMENT);
    const std::string text = plait_last_error();
    EXPECT_NE(text.find("6 guides of 7"), std::string::npos) << text;
    EXPECT_NE(text.find("5 of 7"), std::string::npos) << text;
}

TEST_P(State, SnapshotsOfAnotherGroomOfAsManyStrandsAreRefused) {
    Strands strands = tuft(6, 7);
    plait::Sim one(context, make_groom(strands));
    strands[4][6][2] += 0.001f;
    plait::Sim other(context, make_groom(strands));
    const auto saved = one.save();
    const uint64_t hash = other.hash();
    EXPECT_EQ(plait_sim_restore(other, saved.data(), saved.size()), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("another groom"), std::string::npos)
        << plait_last_error();
    EXPECT_EQ(other.hash(), hash);
}

TEST_P(State, SnapshotsWithStrandsOfOtherSettingsRestore) {
    Strands strands = tuft(6, 7);
    strands[2].resize(3);
    const auto groom = make_groom(strands);
    plait::Sim a(context, groom), b(context, groom);
    run(a, 3);
    take_substeps(a, {3, 1, 2, 3, 1, 4});
    run(a, 3);
    const auto saved = a.save(), plain = b.save();
    b.restore(saved);
    EXPECT_EQ(substeps_of(b), substeps_of(a));
    EXPECT_EQ(b.hash(), a.hash());
    b.restore(plain);
    EXPECT_EQ(b.save(), plain);
}

TEST_P(State, WrittenPositionsAreReadBackAndKeepTheirMass) {
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    auto p = sim.read(PLAIT_FIELD_POSITION);
    const auto mass = p;
    for (size_t i = 0; i < p.size(); ++i)
        p[i] = static_cast<float>(i) * 0.25f;
    sim.write(PLAIT_FIELD_POSITION, p);
    const auto back = sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < p.size(); ++i)
        EXPECT_EQ(back[i], i % 4 == 3 ? mass[i] : p[i]);
}

// Curls hang in one sim, and their places are written into another, which has them from the groom: there they
// hang as well, though their twist, which nobody wrote, is another than the groom's.
TEST_P(State, HairWrittenWhereItHungHangsThere) {
    Strands curls;
    for (int s = 0; s < 4; ++s) {
        Strand& strand = curls.emplace_back();
        for (int i = 0; i < 24; ++i) {
            const float angle = 0.6f * static_cast<float>(i + s);
            strand.push_back({0.006f * static_cast<float>(i), 0.01f * std::cos(angle),
                              0.01f * std::sin(angle) + 0.05f * static_cast<float>(s)});
        }
    }
    const plait::Groom groom = make_groom(curls);
    plait::SimDesc desc;
    desc.params.drag = 20;
    plait::Sim hung(context, groom, desc), fresh(context, groom, desc);
    run(hung, 240);
    const auto there = hung.read(PLAIT_FIELD_POSITION);
    ASSERT_GT(largest_difference(there, fresh.read(PLAIT_FIELD_POSITION)), 0.03f);
    fresh.write(PLAIT_FIELD_POSITION, there);
    fresh.write(PLAIT_FIELD_VELOCITY, std::vector<float>(there.size()));
    float most = 0;
    for (int i = 0; i < 30; ++i) {
        run(fresh, 1);
        most = std::max(most, largest_difference(fresh.read(PLAIT_FIELD_POSITION), there));
    }
    EXPECT_LT(most, 1e-4f);
}

TEST_P(State, WrittenVelocityIsReadBack) {
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    std::vector<float> v(2 * 4 * 4, 0.0f);
    v[4 * 3] = 2;
    v[4 * 6 + 1] = -1;
    sim.write(PLAIT_FIELD_VELOCITY, v);
    EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_VELOCITY), v), 2e-5f);
}

// Rows past a tip are the tip's, as of positions.
TEST_P(State, VelocitiesPastTheTipAreTheTips) {
    plait::Sim sim(context, make_groom({tuft(1, 9)[0], tuft(1, 5)[0]}), busy());
    run(sim, 10);
    const auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
    const size_t row = velocity.size() / 4 / 2;
    for (size_t i = 5; i < row; ++i)
        for (size_t k = 0; k < 4; ++k)
            EXPECT_EQ(velocity[4 * (row + i) + k], velocity[4 * (row + 4) + k]) << i;
    EXPECT_NE(velocity[4 * (row + 4) + 1], 0);
}

TEST_P(State, ValuesOutsideTheirRangeAreRefusedWithTheirIndex) {
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    const uint64_t hash = sim.hash();
    const auto refused = [&](plait_field field, float value, const char* part) {
        std::vector<float> p(2 * 4 * 4, 0.0f);
        p[4 * 5 + 1] = value;
        EXPECT_EQ(plait_sim_write(sim, field, p.data(), p.size() * 4), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(part), std::string::npos)
            << plait_last_error();
    };
    refused(PLAIT_FIELD_POSITION, NAN, "position[5].y is nan, range is [-1e+06, 1e+06]");
    refused(PLAIT_FIELD_POSITION, 1.1e6f, "position[5].y");
    refused(PLAIT_FIELD_POSITION_PREV, -INFINITY, "position[5].y is -inf");
    refused(PLAIT_FIELD_VELOCITY, 1.1e4f, "velocity[5].y is 11000, range is [-10000, 10000]");
    EXPECT_EQ(sim.hash(), hash);
    std::vector<float> p = sim.read(PLAIT_FIELD_POSITION);
    p[3] = NAN; // w is not read
    sim.write(PLAIT_FIELD_POSITION, p);
    EXPECT_EQ(sim.hash(), hash);
}

} // namespace
