// Single parameters by their names: each is written and read, and refused as all of them are.
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

namespace {

using Values = std::vector<double>;

class ParamByName : public testing::Test {
  protected:
    bool are(const plait_sim_params& expected) const {
        const plait_sim_params now = sim.params();
        const auto* const bytes = reinterpret_cast<const unsigned char*>(&now);
        return std::equal(bytes, bytes + sizeof now,
                          reinterpret_cast<const unsigned char*>(&expected));
    }
    plait_result set(const char* name, const Values& values) {
        return plait_sim_set_param(sim, name, values.data(), values.size());
    }

    plait::Context context = make_context("reference");
    plait::Sim sim{context, make_groom(tuft(2, 4))};
};

// Other values than the default: of floats ones that differ, between the ends of the slider.
Values some_values(const plait_param_info& info) {
    Values values;
    for (uint32_t i = 0; i < info.count; ++i) {
        const double share = (i + 0.85) / info.count;
        const double value = info.slider_least + share * (info.slider_most - info.slider_least);
        values.push_back(double(static_cast<float>(value)));
    }
    if (info.kind != PLAIT_PARAM_KIND_FLOAT)
        values = {info.default_value[0] == info.most ? info.least : info.most};
    return values;
}

void put(plait_sim_params& params, const plait_param_info& info, const Values& values) {
    auto* const at = reinterpret_cast<unsigned char*>(&params) + info.offset;
    for (uint32_t i = 0; i < info.count; ++i) {
        const auto number = static_cast<float>(values[i]);
        const auto whole = static_cast<uint32_t>(values[i]);
        std::memcpy(
            at + 4 * i,
            info.kind == PLAIT_PARAM_KIND_FLOAT ? static_cast<const void*>(&number) : &whole, 4);
    }
}

TEST_F(ParamByName, EveryFieldIsWrittenAndReadBack) {
    for (const plait_param_info& info : plait::params_list()) {
        if (std::string(info.name) == "volume") // needs it
            sim.set_param("interhair", {PLAIT_INTERHAIR_EXACT});
        const plait_sim_params before = sim.params();
        const Values old = sim.param(info.name);
        ASSERT_EQ(old.size(), info.count) << info.name;
        EXPECT_EQ(old[0], info.default_value[0]) << info.name;
        plait_sim_params expected = before;
        put(expected, info, some_values(info));
        ASSERT_FALSE(are(expected)) << info.name;
        sim.set_param(info.name, some_values(info));
        EXPECT_TRUE(are(expected)) << info.name;
        EXPECT_EQ(sim.param(info.name), some_values(info)) << info.name;
        sim.set_param(info.name, old);
        EXPECT_TRUE(are(before)) << info.name;
    }
}

TEST_F(ParamByName, EndsOfRangesAndSlidersAreTaken) {
    for (const plait_param_info& info : plait::params_list())
        for (const double value : {info.least, info.slider_least, info.slider_most, info.most}) {
            if (std::string(info.name) == "volume" || (info.least_excluded && value == info.least))
                continue;
            EXPECT_EQ(set(info.name, Values(info.count, value)), PLAIT_OK) << plait_last_error();
            EXPECT_EQ(static_cast<float>(sim.param(info.name).back()), static_cast<float>(value))
                << info.name;
            sim.set_params(plait_sim_params_defaults());
        }
}

TEST_F(ParamByName, TheChoiceOfTheModelIsAValueToo) {
    EXPECT_EQ(sim.param("bdf2"), Values{4294967295.0});
    sim.set_param("bdf2", {0});
    EXPECT_EQ(sim.params().bdf2, 0u);
    sim.set_param("bdf2", {4294967295.0});
    EXPECT_EQ(sim.params().bdf2, PLAIT_BDF2_OF_MODEL);
    EXPECT_EQ(set("iterations", {4294967295.0}), PLAIT_INVALID_ARGUMENT);
}

TEST_F(ParamByName, AFloatIsRounded) {
    sim.set_param("drag", {0.1});
    EXPECT_EQ(sim.param("drag"), Values{double(0.1f)});
    sim.set_param("line_density", {1e-9}); // of which float32 makes less
    EXPECT_EQ(sim.params().line_density, 1e-9f);
}

struct Refused {
    const char* name;
    Values values;
    plait_result code;
    const char* message;
};

TEST_F(ParamByName, WhatIsRefusedIsNamedAndChangesNothing) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    const Refused list[] = {
        {"drag", {-1}, PLAIT_INVALID_ARGUMENT, "drag is -1, range is [0, 10000]"},
        {"drag", {NAN}, PLAIT_INVALID_ARGUMENT, "drag is nan, range is [0, 10000]"},
        {"drag", {inf}, PLAIT_INVALID_ARGUMENT, "drag is inf, range is [0, 10000]"},
        {"drag", {1e300}, PLAIT_INVALID_ARGUMENT, "drag is 1e+300, range is [0, 10000]"},
        {"strand_radius", {0}, PLAIT_INVALID_ARGUMENT, "strand_radius is 0, range is (0, 0.1]"},
        {"gravity",
         {0, 0, 2e4},
         PLAIT_INVALID_ARGUMENT,
         "gravity[2] is 20000, range is [-10000, 10000]"},
        {"gravity", {0, NAN, 0}, PLAIT_INVALID_ARGUMENT, "gravity[1] is nan"},
        {"gravity", {-9.81}, PLAIT_INVALID_ARGUMENT, "count is 1, gravity needs 3"},
        {"gravity", {}, PLAIT_INVALID_ARGUMENT, "count is 0, gravity needs 3"},
        {"drag", {1, 2}, PLAIT_INVALID_ARGUMENT, "count is 2, drag needs 1"},
        {"accelerate_values", {1}, PLAIT_INVALID_ARGUMENT, "accelerate_values needs 16"},
        {"iterations",
         {1.5},
         PLAIT_INVALID_ARGUMENT,
         "iterations is 1.5, range is the whole numbers in [0, 64]"},
        {"iterations", {-1}, PLAIT_INVALID_ARGUMENT, "iterations is -1, range is [0, 64]"},
        {"iterations", {65}, PLAIT_INVALID_ARGUMENT, "iterations is 65, range is [0, 64]"},
        {"iterations", {4294967297.0}, PLAIT_INVALID_ARGUMENT, "range is [0, 64]"},
        {"iterations", {NAN}, PLAIT_INVALID_ARGUMENT, "iterations is nan, range is [0, 64]"},
        {"bdf2", {4294967294.0}, PLAIT_INVALID_ARGUMENT, "range is [0, 1]"},
        {"interhair", {3}, PLAIT_INVALID_ARGUMENT, "interhair is 3, range is [0, 2]"},
        {"interhair", {-1}, PLAIT_INVALID_ARGUMENT, "interhair is -1, range is [0, 2]"},
        {"interhair",
         {0.5},
         PLAIT_INVALID_ARGUMENT,
         "interhair is 0.5, range is the whole numbers in [0, 2]"},
        {"volume", {1}, PLAIT_INVALID_ARGUMENT, "volume needs interhair 2"},
        {"bend_stifness",
         {1},
         PLAIT_NOT_FOUND,
         "no parameter is called \"bend_stifness\"; plait_params_list names them all"},
        {"Drag", {1}, PLAIT_NOT_FOUND, "no parameter is called \"Drag\""},
        {"tip_ness", {1}, PLAIT_NOT_FOUND, "no parameter is called \"tip_ness\""},
        {"struct_size", {1}, PLAIT_NOT_FOUND, "no parameter is called \"struct_size\""},
        {"", {1}, PLAIT_NOT_FOUND, "no parameter is called \"\""},
    };
    const plait_sim_params before = sim.params();
    for (const Refused& refused : list) {
        EXPECT_EQ(set(refused.name, refused.values), refused.code) << refused.message;
        const std::string text = plait_last_error();
        EXPECT_EQ(text.find("plait_sim_set_param: "), 0u) << text;
        EXPECT_NE(text.find(refused.message), std::string::npos) << text;
        EXPECT_TRUE(are(before)) << text;
    }
}

TEST_F(ParamByName, ALongNameIsCutInTheMessage) {
    size_t count = 0;
    EXPECT_EQ(plait_sim_get_param(sim, std::string(100'000, 'x').c_str(), nullptr, &count),
              PLAIT_NOT_FOUND);
    EXPECT_LT(std::strlen(plait_last_error()), 200u);
}

TEST_F(ParamByName, ReadingIsAList) {
    size_t count = 99;
    ASSERT_EQ(plait_sim_get_param(sim, "gravity", nullptr, &count), PLAIT_OK);
    EXPECT_EQ(count, 3u);
    Values values(5, 7);
    count = 2;
    ASSERT_EQ(plait_sim_get_param(sim, "gravity", values.data(), &count), PLAIT_OK);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(values, (Values{0, double(-9.81f), 7, 7, 7}));
    count = 5;
    ASSERT_EQ(plait_sim_get_param(sim, "gravity", values.data(), &count), PLAIT_OK);
    EXPECT_EQ(count, 3u);
    EXPECT_EQ(values, (Values{0, double(-9.81f), 0, 7, 7}));
}

TEST_F(ParamByName, TheModelsRefuseWhatTheyRefuseOfAll) {
    plait::Sim tressfx(context, make_groom(tuft(2, 4)), tressfx_desc());
    const double on = 1;
    EXPECT_EQ(plait_sim_set_param(tressfx, "strand_contact", &on, 1), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("strand_contact is 1 (on)"), std::string::npos)
        << plait_last_error();
    EXPECT_EQ(tressfx.param("strand_contact"), Values{0});
}

class ParamByNameOn : public OnBackend {
  protected:
    uint64_t hash_after(const std::function<void(plait::Sim&)>& change) {
        plait::Sim sim(context, make_groom(tuft(3, 8)));
        run(sim, 5);
        change(sim);
        run(sim, 10);
        return sim.hash();
    }
};
ON_EVERY_BACKEND(ParamByNameOn);

TEST_P(ParamByNameOn, HairMovesAsByAllParameters) {
    const uint64_t by_name = hash_after([](plait::Sim& sim) {
        sim.set_param("gravity", {1, -3, 0.5});
        sim.set_param("bend_stiffness", {2e-8});
        sim.set_param("interhair", {PLAIT_INTERHAIR_EXACT});
        sim.set_param("bdf2", {0});
    });
    const uint64_t all = hash_after([](plait::Sim& sim) {
        auto params = sim.params();
        params.gravity[0] = 1;
        params.gravity[1] = -3;
        params.gravity[2] = 0.5f;
        params.bend_stiffness = 2e-8f;
        params.interhair = PLAIT_INTERHAIR_EXACT;
        params.bdf2 = 0;
        sim.set_params(params);
    });
    EXPECT_EQ(by_name, all);
    EXPECT_NE(by_name, hash_after([](plait::Sim&) {}));
}

} // namespace
