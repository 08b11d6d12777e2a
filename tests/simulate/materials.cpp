// Materials of a scene: what a file says of them, which strands take which, and that they act there
// and nowhere else.
#include "common/json_reader.hpp"
#include "run.hpp"
#include "support.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

using simulate::Json;
using simulate::MaterialChoice;
using simulate::Scene;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class SceneMaterials : public TemporaryFolder {
  protected:
    Scene read(const std::string& text) const {
        return simulate::make_scene(write("scene.json", text), Json::object());
    }
    std::string refusal(const std::string& text) const {
        return refusal_of([&] { read(text); });
    }
    // 6 strands, level, whose roots are at x = 0, 1, ... cm.
    simulate::GroomHandle comb() const {
        std::vector<float> positions;
        for (int strand = 0; strand < 6; ++strand)
            for (int vertex = 0; vertex < 9; ++vertex)
                for (const float value :
                     {0.01f * static_cast<float>(strand), 0.0f, 0.02f * static_cast<float>(vertex)})
                    positions.push_back(value);
        plait_groom_desc desc = plait_groom_desc_defaults();
        desc.positions = {positions.data(), positions.size() / 3, 0};
        desc.vertices_per_strand = 9;
        plait_groom* groom = nullptr;
        common::check(plait_groom_create(&desc, nullptr, &groom));
        return simulate::GroomHandle(groom);
    }
    std::vector<uint32_t> taken(const std::string& materials, uint64_t seed = 1) const {
        const Scene scene = read(R"({"materials": )" + materials + "}");
        return strand_materials(scene.materials, comb().get(), seed);
    }
    std::string refused(const std::string& materials) const {
        return refusal_of([&] { taken(materials); });
    }
};

TEST_F(SceneMaterials, say_every_field) {
    const Scene scene = read(R"({"materials": [{"name": "fringe", "line_density": 1e-5,
        "bend_stiffness": 2e-8, "stretch_stiffness": 3, "twist_stiffness": 4e-8, "section_ratio": 2,
        "curl": 0.5, "clamp_stiffness": 0, "drag_scale": 3, "friction_scale": 0.25, "stiffness_ramp": [1, 0.8, 0.5, 0.1],
        "density_ramp": [1, 1, 2, 3]}]})");
    ASSERT_EQ(scene.materials.size(), 1u);
    const plait_material& m = scene.materials[0].material;
    EXPECT_EQ(scene.materials[0].name, "fringe");
    EXPECT_FLOAT_EQ(m.line_density, 1e-5f);
    EXPECT_FLOAT_EQ(m.bend_stiffness, 2e-8f);
    EXPECT_FLOAT_EQ(m.stretch_stiffness, 3.0f);
    EXPECT_FLOAT_EQ(m.twist_stiffness, 4e-8f);
    EXPECT_FLOAT_EQ(m.section_ratio, 2.0f);
    EXPECT_FLOAT_EQ(m.curl, 0.5f);
    EXPECT_FLOAT_EQ(m.clamp_stiffness, 0.0f);
    EXPECT_FLOAT_EQ(m.drag_scale, 3.0f);
    EXPECT_FLOAT_EQ(m.friction_scale, 0.25f);
    EXPECT_THAT(m.stiffness_ramp, ElementsAre(1.0f, 0.8f, 0.5f, 0.1f));
    EXPECT_THAT(m.density_ramp, ElementsAre(1.0f, 1.0f, 2.0f, 3.0f));
}

TEST_F(SceneMaterials, are_as_the_params_where_they_say_nothing) {
    const Scene scene = read(R"({"materials": [{"name": "as all"}], "params": {"line_density": 7e-6,
        "stiffness_ramp": [1, 0.8, 0.6, 0.4], "twist_stiffness": 3e-9}})");
    const plait_material& m = scene.materials[0].material;
    EXPECT_FLOAT_EQ(m.line_density, 7e-6f);
    EXPECT_FLOAT_EQ(m.bend_stiffness, scene.sim.material.bend_stiffness) << "the hairstyle's";
    EXPECT_FLOAT_EQ(m.twist_stiffness, 3e-9f);
    EXPECT_FLOAT_EQ(m.stiffness_ramp[1], 0.8f);
    EXPECT_FLOAT_EQ(m.stiffness_ramp[3], 0.4f);
    EXPECT_FLOAT_EQ(m.density_ramp[3], 1.0f);
    EXPECT_TRUE(read("{}").materials.empty());
}

TEST_F(SceneMaterials, are_refused_with_place_value_and_range) {
    EXPECT_THAT(refusal("{\"materials\": [{\"name\": \"a\",\n \"curl\": 5}]}"),
                HasSubstr("scene.json:2: materials[0].curl is 5, outside [0.0,4.0]"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "stiffness_ramp": [1, 2, 3]}]})"),
                HasSubstr("materials[0].stiffness_ramp is [1,2,3], not a list of 4 numbers"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "density_ramp": [1, 1, 1, 0]}]})"),
                HasSubstr("materials[0].density_ramp[3] is 0, outside [0.001,1000.0]"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "bend_stifness": 0}]})"),
                AllOf(HasSubstr("materials[0].bend_stifness"), HasSubstr("\"bend_stiffness\"")));
    EXPECT_THAT(refusal(R"({"materials": [{"curl": 1}]})"),
                HasSubstr("materials[0].name is missing"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a"}, {"name": "a"}]})"),
                HasSubstr("materials[1].name is \"a\", as that of a material before"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "share": 1.5}]})"),
                HasSubstr("materials[0].share is 1.5, outside [0.0,1.0]"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "roots": {"at": [0, 0, 0]}}]})"),
                HasSubstr("materials[0].roots.radius is missing"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "strands": [[5, 2]]}]})"),
                HasSubstr("materials[0].strands[0] is [5,2], whose first"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "strands": [3, -1]}]})"),
                HasSubstr("materials[0].strands[1] is -1"));
    EXPECT_THAT(refusal(R"({"materials": [{"name": "a", "strands": 3}]})"),
                HasSubstr("materials[0].strands is 3, not a list"));
    EXPECT_THAT(refusal(R"({"model": "tressfx", "materials": [{"name": "a"}]})"),
                HasSubstr("materials are given"));
}

TEST_F(SceneMaterials, go_to_ranges_of_strands) {
    EXPECT_THAT(taken(R"([{"name": "a", "strands": [[1, 2], 5]}])"),
                ElementsAre(1u, 0u, 0u, 1u, 1u, 0u));
    EXPECT_THAT(taken(R"([{"name": "a"}])"), Each(0u)) << "all, where nothing is said";
    EXPECT_THAT(refused(R"([{"name": "a", "strands": [[1, 6]]}])"),
                AllOf(HasSubstr("scene.json:1: materials[0].strands has 6"), HasSubstr("[0,5]")));
}

TEST_F(SceneMaterials, go_to_regions_of_roots) {
    EXPECT_THAT(taken(R"([{"name": "a", "roots": {"at": [0.02, 0, 0], "radius": 0.011}}])"),
                ElementsAre(1u, 0u, 0u, 0u, 1u, 1u));
    EXPECT_THAT(refused(R"([{"name": "a", "roots": {"at": [1, 0, 0], "radius": 0.01}}])"),
                HasSubstr("materials[0] (\"a\") is of no strand"));
}

TEST_F(SceneMaterials, of_two_that_name_a_strand_the_last_has_it) {
    EXPECT_THAT(taken(R"([{"name": "a"}, {"name": "b", "strands": [[2, 5]],
                           "roots": {"at": [0.02, 0, 0], "radius": 0.011}}])"),
                ElementsAre(0u, 0u, 1u, 1u, 0u, 0u));
}

TEST_F(SceneMaterials, go_to_a_share_of_what_they_name) {
    const Scene scene = read(R"({"groom": "short", "strands": 3000, "materials": [
        {"name": "a", "strands": [[0, 1999]], "share": 0.25}]})");
    Scene copy = scene;
    const simulate::Figure figure = make_figure(copy);
    const auto first = strand_materials(scene.materials, figure.groom.get(), 1);
    const auto again = strand_materials(scene.materials, figure.groom.get(), 1);
    const auto other = strand_materials(scene.materials, figure.groom.get(), 2);
    EXPECT_NEAR(static_cast<double>(std::ranges::count(first, 0u)), 500, 60); // three deviations
    EXPECT_EQ(std::count(first.begin() + 2000, first.end(), 0u), 0);
    EXPECT_EQ(first, again);
    EXPECT_NE(first, other) << "the seed draws";
}

// Without grid and colliders, so that nothing couples strands.
TEST_F(SceneMaterials, act_on_their_strands_alone) {
    const auto fallen = [&](const std::string& materials) {
        Scene scene = read(R"({"groom": "short", "strands": 30, "seconds": 0.3, "motion": "still",
            "grid": "off", "sag_free": "off", "colliders": [], "materials": )" +
                           materials + "}");
        const simulate::Figure figure = make_figure(scene);
        simulate::Simulation simulation(scene, figure);
        std::vector<float> positions;
        simulation.run(*simulate::make_motion("still"),
                       {{[&](uint32_t frame) { return frame + 1 == scene.frames(); },
                         [&](const simulate::Shot& shot) {
                             positions.assign(shot.positions.begin(), shot.positions.end());
                         }}},
                       "");
        return std::pair{positions, simulation.row()};
    };
    const auto [plain, row] = fallen("[]");
    const auto [with, same_row] =
        fallen(R"([{"name": "limp", "strands": [[10, 19]], "bend_stiffness": 0}])");
    ASSERT_EQ(plain.size(), with.size());
    for (size_t strand = 0; strand < 30; ++strand) {
        float most = 0;
        for (size_t i = 4 * row * strand; i < 4 * row * (strand + 1); ++i)
            most = std::max(most, std::abs(plain[i] - with[i]));
        if (strand >= 10 && strand < 20)
            EXPECT_GT(most, 1e-3f) << strand;
        else
            EXPECT_EQ(most, 0.0f) << strand;
    }
}

} // namespace
