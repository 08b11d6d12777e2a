// Strands that change their model while the sim runs.
#include "faulty.hpp"
#include "forged.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>

namespace {

class Models : public OnBackend {};
ON_EVERY_BACKEND(Models);

constexpr plait_model chain = PLAIT_MODEL_CHAIN, cosserat = PLAIT_MODEL_COSSERAT,
                      rod = PLAIT_MODEL_ROD, articulated = PLAIT_MODEL_ARTICULATED;
constexpr size_t strands = 37, vertices = 9; // no whole number of tiles

plait_sim_desc desc_of(plait_model model) {
    auto desc = plait_sim_desc_defaults();
    desc.model = model;
    return desc;
}

// Neighbours differ; every model is there.
std::vector<plait_model> mixed(size_t count = strands) {
    std::vector<plait_model> models;
    for (size_t i = 0; i < count; ++i)
        models.push_back(std::array{chain, cosserat, rod, articulated, rod}[i % 5]);
    return models;
}

Strands ragged() {
    Strands groom = tuft(strands, vertices);
    for (size_t i = 0; i < strands; i += 3)
        groom[i].resize(vertices - i % 5);
    return groom;
}

// Floats of one strand.
std::vector<float> row(const std::vector<float>& field, size_t strand) {
    const auto from = field.begin() + static_cast<std::ptrdiff_t>(4 * vertices * strand);
    return {from, from + 4 * vertices};
}

// Everything that reaches a strand: a moving head, a collider, a teleport, a push, new material.
// `between` is called before every step with its number.
template <typename Between> void live(plait::Sim& sim, const Between& between) {
    auto collider = plait_collider_desc_defaults();
    collider.radius_a = collider.radius_b = 0.05f;
    collider.friction = 0.3f;
    collider.pose.t[0] = 0.08f;
    collider.pose.t[1] = -0.12f;
    const auto id = sim.create_collider(collider);
    for (int i = 0; i < 24; ++i) {
        between(i);
        const float t = static_cast<float>(i) / 60;
        sim.set_roots(head_at({0.1f * std::sin(9 * t), 0, 0}));
        collider.pose.t[0] += 0.002f;
        sim.set_collider_pose(id, collider.pose);
        if (i == 8)
            sim.teleport(head_at({1, 2, 3}, {0, 0.6f, 0, 0.8f}));
        if (i == 16) {
            auto params = sim.params();
            params.bend_stiffness *= 2;
            params.line_density *= 1.5f;
            sim.set_params(params);
        }
        if (i == 12) {
            auto v = sim.read(PLAIT_FIELD_VELOCITY);
            for (size_t k = 2; k < v.size(); k += 4)
                v[k] += 0.1f;
            sim.write(PLAIT_FIELD_VELOCITY, v);
        }
        sim.step(frame);
    }
}

constexpr auto nothing = [](int) {};
constexpr size_t settings_size =
    4 * sizeof(uint32_t); // of a strand, in a snapshot; the model first

TEST_P(Models, AreThatOfTheSimUntilTheyAreSet) {
    plait::Sim sim(context, make_groom(tuft(4, 5)), desc_of(rod));
    EXPECT_EQ(sim.models(), std::vector<plait_model>(4, rod));
    const std::vector<plait_model> models = {rod, articulated, cosserat, chain};
    sim.set_models(models);
    EXPECT_EQ(sim.models(), models);
    sim.reset();
    sim.set_params(sim.params());
    run(sim, 2);
    EXPECT_EQ(sim.models(), models);
    std::vector<plait_model> got(5, PLAIT_MODEL_TRESSFX);
    size_t count = 3;
    EXPECT_EQ(plait_sim_get_models(sim, got.data(), &count), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("*count is 3, the sim has 4 guides"),
              std::string::npos)
        << plait_last_error();
    EXPECT_EQ(got, std::vector<plait_model>(5, PLAIT_MODEL_TRESSFX));
    count = 5;
    ASSERT_EQ(plait_sim_get_models(sim, got.data(), &count), PLAIT_OK);
    EXPECT_EQ(count, 4u);
    EXPECT_EQ(got,
              (std::vector<plait_model>{rod, articulated, cosserat, chain, PLAIT_MODEL_TRESSFX}));
}

TEST_P(Models, ThatCannotBeAreRefusedByStrandValueAndRange) {
    plait::Sim sim(context, make_groom(tuft(4, 5)), desc_of(cosserat));
    run(sim, 2);
    const uint64_t hash = sim.hash();
    const auto refused = [&](const std::vector<plait_model>& models, const char* sentence) {
        EXPECT_EQ(plait_sim_set_models(sim, models.data(), models.size()), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
    };
    refused({cosserat, rod, PLAIT_MODEL_TRESSFX, rod}, "models[2] is 0, range is [1, 4]");
    std::vector<plait_model> wild(4, rod);
    const int number = -7;
    std::memcpy(static_cast<void*>(&wild[3]), &number, sizeof number);
    refused(wild, "models[3] is -7, range is [1, 4]");
    refused({rod, rod, rod}, "count is 3, the sim has 4 guides");
    EXPECT_EQ(plait_sim_set_models(sim, nullptr, 4), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(sim.hash(), hash);
    EXPECT_EQ(sim.models(), std::vector<plait_model>(4, cosserat));
}

TEST_P(Models, OfTheParityModelDoNotSwitch) {
    plait::Sim sim(context, make_groom(tuft(2, 5)), desc_of(PLAIT_MODEL_TRESSFX));
    const std::vector<plait_model> models = {rod, rod};
    EXPECT_EQ(plait_sim_set_models(sim, models.data(), 2), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("model 0 (tressfx)"), std::string::npos)
        << plait_last_error();
    EXPECT_EQ(sim.models(), std::vector<plait_model>(2, PLAIT_MODEL_TRESSFX));
}

// Bit for bit what it would be in a sim all of its model, whatever its neighbours are.
TEST_P(Models, AStrandDoesNotDependOnItsNeighbours) {
    const auto groom = make_groom(ragged());
    for (const uint32_t bdf2 : {0u, 1u}) {
        auto desc = desc_of(cosserat);
        desc.params.bdf2 = bdf2;
        plait::Sim sim(context, groom, desc);
        sim.set_models(mixed());
        live(sim, nothing);
        const auto got = sim.read(PLAIT_FIELD_POSITION);
        const auto got_before = sim.read(PLAIT_FIELD_POSITION_PREV);
        for (const plait_model model : {chain, cosserat, rod, articulated}) {
            desc.model = model;
            plait::Sim alone(context, groom, desc);
            live(alone, nothing);
            const auto expected = alone.read(PLAIT_FIELD_POSITION);
            const auto before = alone.read(PLAIT_FIELD_POSITION_PREV);
            for (size_t i = 0; i < strands; ++i) {
                if (mixed()[i] != model)
                    continue;
                EXPECT_EQ(row(got, i), row(expected, i)) << i << " of model " << model;
                EXPECT_EQ(row(got_before, i), row(before, i)) << i << " of model " << model;
            }
        }
    }
}

// The others change at every step; it never does.
TEST_P(Models, AStrandDoesNotNoticeThatOthersSwitch) {
    const auto groom = make_groom(ragged());
    auto desc = desc_of(cosserat);
    desc.params.bdf2 = 1;
    plait::Sim quiet(context, groom, desc), busy(context, groom, desc);
    live(quiet, nothing);
    live(busy, [&](int step) {
        std::vector<plait_model> models(strands);
        for (size_t i = 0; i < strands; ++i)
            models[i] = i % 7 == 3 ? cosserat
                                   : std::array{rod, articulated, cosserat}[(i + size_t(step)) % 3];
        busy.set_models(models);
    });
    const auto expected = quiet.read(PLAIT_FIELD_POSITION), got = busy.read(PLAIT_FIELD_POSITION);
    for (size_t i = 3; i < strands; i += 7)
        EXPECT_EQ(row(got, i), row(expected, i)) << i;
    EXPECT_NE(row(got, 4), row(expected, 4));
    EXPECT_EQ(busy.stats().nonfinite, 0u);
}

TEST_P(Models, NothingThatIsSeenMovesAtTheSwitch) {
    auto desc = desc_of(cosserat);
    desc.follows_per_guide = 1;
    plait::Sim sim(context, make_groom(ragged()), desc);
    run(sim, 5);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    const auto velocity = sim.read(PLAIT_FIELD_VELOCITY), tangent = sim.read(PLAIT_FIELD_TANGENT);
    for (const auto& models : {mixed(), std::vector<plait_model>(strands, chain), mixed()}) {
        sim.set_models(models);
        EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), before);
        EXPECT_EQ(sim.read(PLAIT_FIELD_VELOCITY), velocity);
        EXPECT_EQ(sim.read(PLAIT_FIELD_TANGENT), tangent);
    }
}

TEST_P(Models, ASimOfOneModelTakesTheStagesOfThatModel) {
    using Stages = std::vector<std::pair<std::string, uint64_t>>;
    plait::Sim sim(context, make_groom(tuft(6, 5)), desc_of(cosserat));
    const Stages of_cosserat = {{"roots", 3}, {"cosserat", 3}, {"lane_unpack", 3}};
    EXPECT_EQ(stages_of(sim), of_cosserat);
    const uint64_t bytes = sim.stats().device_bytes;
    sim.set_models({cosserat, rod, chain, rod, chain, chain});
    const Stages of_all = {
        {"roots", 3}, {"chain", 3}, {"cosserat", 3}, {"rod", 3}, {"lane_unpack", 9}};
    EXPECT_EQ(stages_of(sim), of_all);
    sim.set_models(std::vector<plait_model>(6, rod));
    const Stages of_rod = {{"roots", 3}, {"rod", 3}, {"lane_unpack", 3}};
    EXPECT_EQ(stages_of(sim), of_rod);
    EXPECT_EQ(sim.stats().device_bytes, bytes);
}

TEST_P(Models, SettingThemAsTheyAreDoesNothing) {
    plait::Sim sim(context, make_groom(tuft(6, 5)), desc_of(cosserat));
    sim.set_models(mixed(6));
    run(sim, 3);
    const uint64_t hash = sim.hash();
    sim.stage_times(true);
    sim.set_models(mixed(6));
    EXPECT_TRUE(sim.stage_times().empty());
    EXPECT_EQ(sim.hash(), hash);
}

TEST_P(Models, AreSavedAndRestoredWithTheState) {
    const auto groom = make_groom(ragged());
    auto desc = desc_of(cosserat);
    desc.substeps = 2;
    plait::Sim a(context, groom, desc), b(context, groom, desc);
    const auto of_one_model = a.save();
    run(a, 3);
    a.set_models(mixed());
    run(a, 3);
    const auto saved = a.save();
    EXPECT_NE(a.hash(), b.hash());
    b.restore(saved);
    EXPECT_EQ(b.models(), mixed());
    EXPECT_EQ(b.hash(), a.hash());
    EXPECT_EQ(b.save(), saved);
    run(a, 5);
    run(b, 5);
    EXPECT_LT(largest_difference(a.read(PLAIT_FIELD_POSITION), b.read(PLAIT_FIELD_POSITION)),
              GetParam() == "opencl" ? 1e-30f : 1e-4f); // `reference` saves floats of its doubles
    b.restore(of_one_model);
    EXPECT_EQ(b.models(), std::vector<plait_model>(strands, cosserat));
    EXPECT_EQ(b.save(), of_one_model);
}

TEST_P(Models, OfASnapshotThatCannotBeAreRefused) {
    plait::Sim sim(context, make_groom(tuft(6, 5)), desc_of(cosserat));
    sim.set_models(mixed(6));
    run(sim, 3);
    const auto saved = sim.save();
    const uint64_t hash = sim.hash();
    for (const uint32_t model : {0u, 5u, 0xffffffffu}) {
        auto damaged = saved;
        std::memcpy(&damaged[forged::header_size + 2 * settings_size], &model, sizeof model);
        forged::sign(damaged);
        EXPECT_EQ(plait_sim_restore(sim, damaged.data(), damaged.size()), PLAIT_BAD_DATA);
        EXPECT_NE(std::string(plait_last_error()).find("strand 2: model is"), std::string::npos)
            << plait_last_error();
    }
    EXPECT_EQ(sim.hash(), hash);
}

TEST_P(Models, AResetSimIsAsNewlySwitched) {
    const auto groom = make_groom(ragged());
    plait::Sim a(context, groom, desc_of(cosserat)), b(context, groom, desc_of(cosserat));
    a.set_models(mixed());
    run(a, 7);
    a.reset();
    b.set_models(mixed());
    EXPECT_EQ(a.read(PLAIT_FIELD_POSITION), b.read(PLAIT_FIELD_POSITION));
    run(a, 7);
    run(b, 7);
    EXPECT_EQ(a.read(PLAIT_FIELD_POSITION), b.read(PLAIT_FIELD_POSITION));
}

// ---- failures -----------------------------------------------------------------------------------

template <typename Attempt>
void fail_each_buffer(plait::Sim& sim, const Attempt& attempt, int at_least) {
    Faults& faults = faulty();
    const int buffers = faults.live_buffers;
    const uint64_t hash = sim.hash();
    const auto models = sim.models();
    int refused = 0;
    for (plait_result result = PLAIT_OUT_OF_MEMORY; result != PLAIT_OK; ++refused) {
        ASSERT_LT(refused, 100);
        faults.fail_create_after = refused;
        result = attempt();
        faults.fail_create_after = -1;
        if (result == PLAIT_OK)
            break;
        EXPECT_EQ(result, PLAIT_OUT_OF_MEMORY);
        EXPECT_EQ(faults.live_buffers, buffers);
        EXPECT_EQ(sim.models(), models);
        EXPECT_EQ(sim.hash(), hash);
    }
    EXPECT_GE(refused, at_least);
}

TEST(ModelFaults, ASwitchThatFailsChangesNothing) {
    faulty();
    const auto context = make_context("faulty");
    const auto groom = make_groom(tuft(6, 5));
    auto desc = desc_of(cosserat);
    desc.params.bdf2 = 1;
    plait::Sim sim(context, groom, desc), untouched(context, groom, desc);
    run(sim, 3);
    run(untouched, 3);
    const auto all = mixed(6);
    auto attempts = [&] { return plait_sim_set_models(sim, all.data(), all.size()); };
    fail_each_buffer(sim, attempts, 30);
    EXPECT_EQ(sim.models(), all);
    untouched.set_models(all);
    run(sim, 3);
    run(untouched, 3);
    EXPECT_EQ(sim.hash(), untouched.hash());
}

} // namespace
