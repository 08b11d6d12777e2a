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
    // Every parameter, in the order of the list.
    static std::vector<Values> all(const plait::Sim& of) {
        std::vector<Values> values;
        for (const plait_param_info& info : plait::params_list())
            values.push_back(of.param(info.name));
        return values;
    }
    static plait::SimDesc with_all() {
        plait::SimDesc desc;
        desc.grid.on = desc.volume.on = desc.strand_contact.on = desc.wetness.on = true;
        desc.acceleration.on = true;
        return desc;
    }
    plait_result set(const char* name, const Values& values) {
        return plait_sim_set_param(sim, name, values.data(), values.size());
    }

    plait::Context context = make_context("reference");
    plait::Sim sim{context, make_groom(tuft(2, 4)), with_all()};
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

TEST_F(ParamByName, EveryFieldIsWrittenAndReadBack) {
    const auto list = plait::params_list();
    plait::SimDesc parity;
    parity.model = PLAIT_MODEL_TRESSFX;
    plait::Sim tressfx(context, make_groom(tuft(2, 4)), parity);
    const auto before = all(sim), before_of_tressfx = all(tressfx);
    for (size_t i = 0; i < list.size(); ++i) {
        const plait_param_info& info = list[i];
        if (std::string(info.name) == "grid_form") // which volume needs
            continue;
        const bool of_tressfx = std::string(info.feature) == "tressfx";
        plait::Sim& own = of_tressfx ? tressfx : sim;
        const Values old = own.param(info.name);
        ASSERT_EQ(old.size(), info.count) << info.name;
        EXPECT_EQ(old[0], info.default_value[0]) << info.name;
        auto expected = of_tressfx ? before_of_tressfx : before;
        expected[i] = some_values(info);
        ASSERT_NE(expected[i], old) << info.name;
        own.set_param(info.name, some_values(info));
        EXPECT_EQ(all(own), expected) << info.name;
        own.set_param(info.name, old);
    }
    EXPECT_EQ(all(sim), before);
    EXPECT_EQ(all(tressfx), before_of_tressfx);
}

TEST_F(ParamByName, EndsOfRangesAndSlidersAreTaken) {
    for (const plait_param_info& info : plait::params_list())
        for (const double value : {info.least, info.slider_least, info.slider_most, info.most}) {
            if (std::string(info.feature) == "tressfx" || std::string(info.name) == "grid_form" ||
                (info.least_excluded && value == info.least))
                continue;
            const Values old = sim.param(info.name);
            EXPECT_EQ(set(info.name, Values(info.count, value)), PLAIT_OK) << plait_last_error();
            EXPECT_EQ(static_cast<float>(sim.param(info.name).back()), static_cast<float>(value))
                << info.name;
            sim.set_param(info.name, old);
        }
}

TEST_F(ParamByName, OfAFeatureThatIsOffIsRefused) {
    plait::Sim plain(context, make_groom(tuft(2, 4)));
    const double value = 1;
    EXPECT_EQ(plait_sim_set_param(plain, "grid_edge", &value, 1), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error())
                  .find("grid_edge belongs to grid, which is off: plait_sim_set_grid"),
              std::string::npos)
        << plait_last_error();
    plain.set_grid(nullptr);
    const auto grid = plait_grid_desc_defaults();
    plain.set_grid(&grid);
    plain.set_param("grid_edge", {1});
    EXPECT_EQ(plain.param("grid_edge"), Values{1});
    plain.set_grid(nullptr);
    EXPECT_EQ(plain.param("grid_edge"), Values{0}) << "the default";
}

TEST_F(ParamByName, OfSeveralMaterialsNoneIsMeant) {
    const std::vector<plait_material> two(2, plait_material_defaults());
    const std::vector<uint32_t> of{0, 1};
    plait::check(plait_sim_set_materials(sim, two.data(), 2, plait::view(of)));
    EXPECT_EQ(set("bend_stiffness", {1e-8}), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("2 materials"), std::string::npos);
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
    EXPECT_EQ(sim.param("line_density"), Values{double(1e-9f)});
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
        {"strand_contact_radius",
         {0},
         PLAIT_INVALID_ARGUMENT,
         "strand_contact_radius is 0, range is (0, 0.1]"},
        {"gravity",
         {0, 0, 2e4},
         PLAIT_INVALID_ARGUMENT,
         "gravity[2] is 20000, range is [-10000, 10000]"},
        {"gravity", {0, NAN, 0}, PLAIT_INVALID_ARGUMENT, "gravity[1] is nan"},
        {"gravity", {-9.81}, PLAIT_INVALID_ARGUMENT, "count is 1, gravity needs 3"},
        {"gravity", {}, PLAIT_INVALID_ARGUMENT, "count is 0, gravity needs 3"},
        {"drag", {1, 2}, PLAIT_INVALID_ARGUMENT, "count is 2, drag needs 1"},
        {"acceleration_values", {1}, PLAIT_INVALID_ARGUMENT, "acceleration_values needs 16"},
        {"iterations",
         {1.5},
         PLAIT_INVALID_ARGUMENT,
         "iterations is 1.5, range is the whole numbers in [0, 64]"},
        {"iterations", {-1}, PLAIT_INVALID_ARGUMENT, "iterations is -1, range is [0, 64]"},
        {"iterations", {65}, PLAIT_INVALID_ARGUMENT, "iterations is 65, range is [0, 64]"},
        {"iterations", {4294967297.0}, PLAIT_INVALID_ARGUMENT, "range is [0, 64]"},
        {"iterations", {NAN}, PLAIT_INVALID_ARGUMENT, "iterations is nan, range is [0, 64]"},
        {"bdf2", {4294967294.0}, PLAIT_INVALID_ARGUMENT, "range is [0, 1]"},
        {"grid_tent", {3}, PLAIT_INVALID_ARGUMENT, "grid_tent is 3, range is [0, 1]"},
        {"grid_tent", {-1}, PLAIT_INVALID_ARGUMENT, "grid_tent is -1, range is [0, 1]"},
        {"grid_tent",
         {0.5},
         PLAIT_INVALID_ARGUMENT,
         "grid_tent is 0.5, range is the whole numbers in [0, 1]"},
        {"grid_form", {0}, PLAIT_INVALID_STATE, "volume needs sums of all hair"},
        {"bend_stifness",
         {1},
         PLAIT_NOT_FOUND,
         "no parameter is called \"bend_stifness\"; plait_params_list names them all"},
        {"Drag", {1}, PLAIT_NOT_FOUND, "no parameter is called \"Drag\""},
        {"tip_ness", {1}, PLAIT_NOT_FOUND, "no parameter is called \"tip_ness\""},
        {"struct_size", {1}, PLAIT_NOT_FOUND, "no parameter is called \"struct_size\""},
        {"", {1}, PLAIT_NOT_FOUND, "no parameter is called \"\""},
    };
    const auto before = all(sim);
    for (const Refused& refused : list) {
        EXPECT_EQ(set(refused.name, refused.values), refused.code) << refused.message;
        const std::string text = plait_last_error();
        EXPECT_EQ(text.find("plait_sim_set_param: "), 0u) << text;
        EXPECT_NE(text.find(refused.message), std::string::npos) << text;
        EXPECT_EQ(all(sim), before) << text;
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
    const double value = 1e-8;
    EXPECT_EQ(plait_sim_set_param(tressfx, "bend_stiffness", &value, 1), PLAIT_INVALID_STATE);
    EXPECT_EQ(set("damping", {0.5}), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("reads no parameter of TressFX"),
              std::string::npos)
        << plait_last_error();
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
        sim.set_param("bdf2", {0});
    });
    const uint64_t all = hash_after([](plait::Sim& sim) {
        auto params = sim.params();
        params.gravity[0] = 1;
        params.gravity[1] = -3;
        params.gravity[2] = 0.5f;
        params.bdf2 = 0;
        sim.set_params(params);
        auto material = plait_material_defaults();
        material.bend_stiffness = 2e-8f;
        sim.set_material(material);
    });
    EXPECT_EQ(by_name, all);
    EXPECT_NE(by_name, hash_after([](plait::Sim&) {}));
}

} // namespace
