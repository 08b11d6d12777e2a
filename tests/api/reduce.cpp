// One groom over several sims that meet in the grid alone, as over several processes.
#include "barrier.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <thread>

namespace {

// Parts that step in threads of their own and add up their sums.
class Meeting {
  public:
    explicit Meeting(size_t parts) : sums_(parts), all_(parts) {}

    struct Seat {
        Meeting* meeting;
        size_t part;
    };
    static int add(int64_t* sums, size_t count, void* user) {
        const Seat& seat = *static_cast<Seat*>(user);
        Meeting& all = *seat.meeting;
        all.sums_[seat.part].assign(sums, sums + count);
        all.all_.arrive_and_wait();
        std::fill_n(sums, count, int64_t{0});
        for (const std::vector<int64_t>& of : all.sums_)
            for (size_t i = 0; i < count; ++i)
                sums[i] += of[i];
        all.all_.arrive_and_wait();
        return 0;
    }

  private:
    std::vector<std::vector<int64_t>> sums_;
    Barrier all_;
};

int add_nothing(int64_t*, size_t, void*) {
    return 0;
}

plait::SimDesc desc_of_parts(plait_model model, plait_tent_form tent = PLAIT_TENT_FORM_VOXEL) {
    plait::SimDesc desc;
    desc.model = model;
    desc.substeps = 2;
    desc.grid.on = true;
    desc.grid.tent = tent;
    desc.grid.diffuse_factor = 0.5f; // so that brakes show
    desc.grid.edge = 1;
    std::fill_n(desc.grid.origin, 3, -0.5f);
    return desc;
}

// Some calls take two fixed steps; the head swings.
void swing(plait::Sim& sim, int frames) {
    for (int i = 1; i <= frames; ++i) {
        sim.set_roots(head_at({0.05f * std::sin(0.6f * static_cast<float>(i)), 0, 0}));
        sim.step(i % 10 == 0 ? 2 * frame : frame);
    }
}

// Every vertex after 50 frames.
std::vector<float> swung(const std::string& backend, const Strands& strands,
                         const plait::SimDesc& desc, plait_reduce_fn reduce, void* user) {
    const plait::Context context = make_context(backend);
    plait::Sim sim(context, make_groom(strands), desc);
    auto body = plait_collider_desc_defaults(); // which hair falls on and is held by
    body.capsule.a[0] = body.capsule.b[0] = 0.1f;
    body.capsule.a[1] = -0.08f;
    body.capsule.b[1] = 0.3f;
    body.capsule.radius_a = body.capsule.radius_b = 0.05f;
    sim.create_collider(body);
    sim.set_reduce(reduce, user);
    swing(sim, 50);
    return sim.read(PLAIT_FIELD_POSITION);
}

constexpr size_t strands = 24, row = 16, floats = 4 * row;

// Longer and longer, so that those of parts are not as long in the mean.
Strands hair() {
    Strands all;
    for (size_t i = 0; i < strands; ++i) {
        const float at = static_cast<float>(i);
        all.push_back(curl({0, 0.01f * at, 0}, row, 0.01f + 0.001f * at, 0.5f * at));
    }
    return all;
}

// Strand i in part i % parts, or by runs of neighbours; put back in the groom's order.
std::vector<float> swung_in_parts(const std::string& backend, size_t parts, bool runs,
                                  const plait::SimDesc& desc, bool meet) {
    const auto part_of = [&](size_t i) { return runs ? i * parts / strands : i % parts; };
    const Strands all = hair();
    Meeting meeting(parts);
    std::vector<std::vector<float>> made(parts);
    std::vector<std::thread> threads;
    for (size_t part = 0; part < parts; ++part)
        threads.emplace_back([&, part] {
            Strands own;
            for (size_t i = 0; i < strands; ++i)
                if (part_of(i) == part)
                    own.push_back(all[i]);
            Meeting::Seat seat{&meeting, part};
            made[part] = swung(backend, own, desc, meet ? Meeting::add : add_nothing, &seat);
        });
    for (std::thread& thread : threads)
        thread.join();
    std::vector<float> positions;
    std::vector<size_t> taken(parts);
    for (size_t i = 0; i < strands; ++i) {
        const std::vector<float>& from = made[part_of(i)];
        const auto first = static_cast<std::ptrdiff_t>(floats * taken[part_of(i)]++);
        positions.insert(positions.end(), from.begin() + first, from.begin() + first + floats);
    }
    return positions;
}

size_t strands_that_differ(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    size_t count = 0;
    for (size_t i = 0; i < strands; ++i)
        count += std::memcmp(&a[i * floats], &b[i * floats], floats * sizeof(float)) != 0;
    return count;
}

class Reduce : public OnBackend {};
ON_EVERY_BACKEND(Reduce);

TEST_P(Reduce, GivesTheBitsOfOneSimForAnyPartsAndNoneWithout) {
    for (const plait_model model : {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_TRESSFX})
        for (const plait_tent_form tent : {PLAIT_TENT_FORM_VOXEL, PLAIT_TENT_FORM_TRILINEAR}) {
            SCOPED_TRACE(testing::Message() << "model " << model << ", tent " << tent);
            const plait::SimDesc desc = desc_of_parts(model, tent);
            const auto one = swung(GetParam(), hair(), desc, add_nothing, nullptr);
            for (const size_t parts : {2u, 3u})
                for (const bool runs : {false, true}) {
                    SCOPED_TRACE(testing::Message() << parts << " parts, runs: " << runs);
                    const auto met = swung_in_parts(GetParam(), parts, runs, desc, true);
                    EXPECT_EQ(strands_that_differ(one, met), 0u);
                }
            const auto apart = swung_in_parts(GetParam(), 2, true, desc, false);
            EXPECT_GT(strands_that_differ(one, apart), strands / 4);
        }
}

// What a part cannot know by itself: where the middle is, which air and eddies depend on.
TEST_P(Reduce, GoesByTheCubeOfAllParts) {
    const Strands all = tuft(strands, row);
    const auto of = [&](const Strands& own, void* seat) {
        plait::Sim sim(context, make_groom(own), desc_of_parts(PLAIT_MODEL_ARTICULATED));
        sim.set_reduce(add_nothing, seat);
        auto params = sim.params();
        params.air_with_head = 1;
        params.drag = 3;
        sim.set_params(params);
        auto wind = plait_wind_desc_defaults();
        wind.turbulence = 2;
        wind.shelter = 0;
        wind.diameter = 7e-5f;
        plait::check(plait_sim_set_wind(sim.get(), &wind));
        auto grid = desc_of_parts(PLAIT_MODEL_ARTICULATED).grid;
        grid.diffuse_factor = 1; // brakes nothing: strands are alone, but for the cube
        sim.set_grid(&grid);
        for (int i = 1; i <= 20; ++i) {
            const float half = 0.1f * static_cast<float>(i);
            sim.set_roots(head_at({}, {0, std::sin(half), 0, std::cos(half)}));
            sim.step(frame);
        }
        return sim.read(PLAIT_FIELD_POSITION);
    };
    const auto one = of(all, nullptr);
    const auto first = of({all.begin(), all.begin() + 5}, nullptr);
    EXPECT_TRUE(std::equal(first.begin(), first.end(), one.begin()));
}

TEST_P(Reduce, ASimWithoutHasItsOwnBitsAgain) {
    const auto after = [&](plait_reduce_fn reduce) {
        plait::Sim sim(context, make_groom(hair()), desc_of_parts(PLAIT_MODEL_ARTICULATED));
        const auto begin = sim.save();
        sim.set_reduce(reduce, nullptr);
        swing(sim, 10);
        sim.set_reduce(nullptr, nullptr);
        sim.restore(begin);
        swing(sim, 20);
        return sim.hash();
    };
    EXPECT_EQ(after(add_nothing), after(nullptr));
}

double sum_of_lengths() {
    double sum = 0;
    for (const Strand& strand : tuft(strands, row))
        for (size_t i = 1; i < strand.size(); ++i)
            sum += std::hypot(double(strand[i][0]) - double(strand[i - 1][0]),
                              double(strand[i][1]) - double(strand[i - 1][1]),
                              double(strand[i][2]) - double(strand[i - 1][2]));
    return sum;
}

struct Calls {
    size_t count = 0, sums = 0;
    int64_t hair = 0;
    size_t fails_at = 0; // which call; 0: none does
    std::vector<const Calls*>* order = nullptr;
};
int count_calls(int64_t* sums, size_t count, void* user) {
    Calls& calls = *static_cast<Calls*>(user);
    ++calls.count;
    calls.sums = count;
    calls.hair = 0;
    for (size_t i = 0; i < count; i += 5)
        calls.hair += sums[i];
    if (calls.order)
        calls.order->push_back(&calls);
    return calls.count == calls.fails_at ? 7 : 0;
}

TEST_P(Reduce, IsCalledOncePerFixedStepWithFiveSumsAVoxel) {
    plait::Sim sim(context, make_groom(tuft(strands, row)),
                   desc_of_parts(PLAIT_MODEL_ARTICULATED, PLAIT_TENT_FORM_TRILINEAR));
    Calls calls;
    sim.set_reduce(count_calls, &calls); // adds up the strands' lengths
    EXPECT_EQ(calls.count, 1u);
    EXPECT_EQ(calls.sums, 2u);
    EXPECT_NEAR(std::ldexp(static_cast<double>(calls.hair), -20), sum_of_lengths(), 1e-4);
    sim.step(0);
    EXPECT_EQ(calls.count, 1u);
    sim.step(3 * frame);
    EXPECT_EQ(calls.count, 4u);
    EXPECT_EQ(calls.sums, 5u * 8 * 8 * 8);
    EXPECT_EQ(sim.measure().grid_outside, 0u); // so that the weights are those of all vertices
    const double weight = std::ldexp(static_cast<double>(calls.hair), -24); // of 1
    EXPECT_NEAR(weight / (strands * row), 1, 1e-4);
    sim.set_grid(nullptr);
    sim.step(frame);
    EXPECT_EQ(calls.count, 4u);
    calls.fails_at = 5;
    EXPECT_EQ(plait_sim_set_reduce(sim.get(), count_calls, &calls), PLAIT_CANCELLED);
    EXPECT_NE(std::string(plait_last_error()).find("returned 7 in adding up lengths"),
              std::string::npos)
        << plait_last_error();
}

TEST_P(Reduce, ThatFailsEndsTheStepAndASnapshotGoesOn) {
    plait::Sim sim(context, make_groom(tuft(strands, row)), desc_of_parts(PLAIT_MODEL_ARTICULATED));
    Calls calls;
    sim.set_reduce(count_calls, &calls);
    swing(sim, 8);
    const auto saved = sim.save();
    sim.restore(saved); // which rounds what the reference computes with
    swing(sim, 15);
    const auto undisturbed = sim.read(PLAIT_FIELD_POSITION);
    sim.restore(saved);
    calls.fails_at = calls.count + 5;
    int failed = 0;
    for (int i = 1; i <= 5; ++i) {
        sim.set_roots(head_at({0.05f * std::sin(0.6f * static_cast<float>(i)), 0, 0}));
        const plait_result result = plait_sim_step(sim.get(), frame);
        if (result == PLAIT_OK)
            continue;
        failed = i;
        EXPECT_EQ(result, PLAIT_CANCELLED);
        EXPECT_NE(std::string(plait_last_error()).find("returned 7 in fixed step 12,"),
                  std::string::npos)
            << plait_last_error();
    }
    EXPECT_EQ(failed, 5);
    EXPECT_EQ(sim.measure().nonfinite, 0u);
    sim.restore(saved);
    swing(sim, 15);
    EXPECT_EQ(largest_difference(undisturbed, sim.read(PLAIT_FIELD_POSITION)), 0);
}

TEST_P(Reduce, OfSimsThatStepTogetherAreCalledInTheirOrder) {
    const plait::SimDesc desc = desc_of_parts(PLAIT_MODEL_ARTICULATED);
    std::vector<const Calls*> order;
    Calls calls[2];
    std::vector<plait::Sim> sims;
    for (Calls& of : calls) {
        of.order = &order;
        sims.emplace_back(context, make_groom(tuft(strands, row)), desc);
        sims.back().set_reduce(count_calls, &of);
        sims.back().set_roots(head_at({0.02f, 0, 0}));
    }
    plait::Sim alone(context, make_groom(tuft(strands, row)), desc);
    alone.set_reduce(add_nothing, nullptr);
    alone.set_roots(head_at({0.02f, 0, 0}));
    alone.step(2 * frame);
    order.clear(); // of the calls that added up lengths
    plait_sim* const list[] = {sims[0].get(), sims[1].get()};
    plait::check(plait_context_step(context.get(), list, 2, 2 * frame));
    EXPECT_EQ(order, (std::vector<const Calls*>{&calls[0], &calls[0], &calls[1], &calls[1]}));
    EXPECT_EQ(sims[0].hash(), alone.hash());
    EXPECT_EQ(sims[1].hash(), alone.hash());
}

// What a sim must not have, each before and after the call; and what it has stays.
class ReduceRefuses : public OnBackend {
  protected:
    void expect(plait_result result, plait_result code, const char* sentence) {
        EXPECT_EQ(result, code) << sentence;
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
    }
    plait::Sim make(const plait::SimDesc& desc) const {
        return plait::Sim(context, make_groom(tuft(4, 8)), desc);
    }
};
ON_EVERY_BACKEND(ReduceRefuses);

TEST_P(ReduceRefuses, GridsThatPartsCannotShare) {
    const struct {
        const char* sentence;
        void (*change)(plait_grid_desc&);
    } grids[] = {{"form is 0 (slots)", [](auto& grid) { grid.form = PLAIT_GRID_FORM_SLOTS; }},
                 {"edge is 0", [](auto& grid) { grid.edge = 0; }},
                 {"in_world is 1", [](auto& grid) { grid.in_world = 1; }}};
    for (const auto& [sentence, change] : grids) {
        plait::SimDesc desc = desc_of_parts(PLAIT_MODEL_ARTICULATED);
        plait::Sim good = make(desc);
        good.set_reduce(add_nothing, nullptr);
        change(desc.grid);
        plait::Sim bad = make(desc);
        expect(plait_sim_set_reduce(bad.get(), add_nothing, nullptr), PLAIT_INVALID_ARGUMENT,
               sentence);
        expect(plait_sim_set_grid(good.get(), &desc.grid), PLAIT_INVALID_ARGUMENT, sentence);
        good.step(frame);
        bad.step(frame);
        bad.set_grid(nullptr);
        bad.set_reduce(add_nothing, nullptr); // of no grid: parts do not meet
    }
}

TEST_P(ReduceRefuses, WhatElseActsBetweenStrands) {
    plait::Sim sim = make(desc_of_parts(PLAIT_MODEL_ARTICULATED));
    const auto volume = plait_volume_desc_defaults();
    const auto contact = plait_strand_contact_desc_defaults();
    auto wind = plait_wind_desc_defaults();
    sim.set_volume(&volume);
    expect(plait_sim_set_reduce(sim.get(), add_nothing, nullptr), PLAIT_INVALID_STATE, "volume");
    sim.set_volume(nullptr);
    sim.set_strand_contact(&contact);
    expect(plait_sim_set_reduce(sim.get(), add_nothing, nullptr), PLAIT_INVALID_STATE,
           "strand contact");
    sim.set_strand_contact(nullptr);
    plait::check(plait_sim_set_wind(sim.get(), &wind));
    expect(plait_sim_set_reduce(sim.get(), add_nothing, nullptr), PLAIT_INVALID_STATE, "shelter");
    plait::check(plait_sim_set_wind(sim.get(), nullptr));
    sim.set_reduce(add_nothing, nullptr);
    expect(plait_sim_set_volume(sim.get(), &volume), PLAIT_INVALID_STATE, "volume");
    expect(plait_sim_set_strand_contact(sim.get(), &contact), PLAIT_INVALID_STATE,
           "strand contact");
    expect(plait_sim_set_wind(sim.get(), &wind), PLAIT_INVALID_STATE, "shelter");
    wind.shelter = 0;
    plait::check(plait_sim_set_wind(sim.get(), &wind));
    sim.step(frame);
}

TEST_P(ReduceRefuses, Levels) {
    const plait::Groom groom = make_groom(tuft(40, 8));
    auto of = plait_levels_desc_defaults();
    of.groom = groom.get();
    of.level_count = 1;
    of.guides[0] = 8;
    plait_levels* levels = nullptr;
    ASSERT_EQ(plait_levels_create(&of, &levels), PLAIT_OK) << plait_last_error();
    plait::SimDesc desc = desc_of_parts(PLAIT_MODEL_ARTICULATED);
    desc.levels = levels;
    plait::Sim sim(context, groom, desc);
    plait_levels_destroy(levels);
    expect(plait_sim_set_reduce(sim.get(), add_nothing, nullptr), PLAIT_INVALID_STATE, "levels");
}

} // namespace
