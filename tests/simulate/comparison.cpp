// What a run is set beside: TressFX alone and with the thesis's own inter-hair step, by its own
// hash and its own rule, whatever the run uses.
#include "comparison.hpp"
#include "common/json_reader.hpp"
#include "common/params_reader.hpp"
#include "support.hpp"

using simulate::Json;
using simulate::Scene;
using simulate::Variant;

namespace {

class Comparison : public TemporaryFolder {
  protected:
    Scene read(const std::string& text) const {
        return simulate::make_scene(write("scene.json", text), Json::object());
    }
    std::vector<Variant> beside(const std::string& text) const {
        return simulate::variants_beside(read(text));
    }
};

void expect_thesis(const plait::SimDesc& sim) {
    EXPECT_EQ(sim.model, PLAIT_MODEL_TRESSFX);
    EXPECT_EQ(sim.sag_free, PLAIT_SAG_FREE_OFF);
    EXPECT_STREQ(common::grid_name(sim), "slots");
    EXPECT_EQ(sim.grid.slot_hash, PLAIT_SLOT_HASH_RULE_THESIS);
    EXPECT_EQ(sim.grid.diffuse_rule, PLAIT_DIFFUSE_RULE_THESIS);
}

TEST_F(Comparison, is_with_tressfx_and_with_the_thesis) {
    for (const char* step : {"off", "slots", "exact"}) {
        const Scene scene = read(std::string(R"({"grid": ")") + step + "\"}");
        const std::vector<Variant> variants = simulate::variants_beside(scene);
        ASSERT_EQ(variants.size(), 2u) << step;
        EXPECT_EQ(variants[0].label, "TressFX");
        EXPECT_EQ(variants[0].of(scene).sim.model, PLAIT_MODEL_TRESSFX);
        EXPECT_FALSE(variants[0].of(scene).sim.grid.on);
        EXPECT_EQ(variants[1].label, "TressFX + inter-hair step of the thesis");
        expect_thesis(variants[1].of(scene).sim);
    }
}

// By itself `slots` is plait's: its hash and its rule.
TEST_F(Comparison, leaves_the_run_as_it_is) {
    const plait::SimDesc sim = read(R"({"model": "tressfx", "grid": "slots"})").sim;
    EXPECT_EQ(sim.grid.slot_hash, PLAIT_SLOT_HASH_RULE_PCG);
    EXPECT_EQ(sim.grid.diffuse_rule, PLAIT_DIFFUSE_RULE_FLOORED);
    EXPECT_EQ(simulate::label_of(sim), "TressFX + inter-hair step (slots)");
}

TEST_F(Comparison, leaves_out_what_the_run_is) {
    const auto alone = beside(R"({"model": "tressfx", "grid": "off"})");
    ASSERT_EQ(alone.size(), 1u);
    expect_thesis(alone[0].sim);
    EXPECT_EQ(beside(R"({"model": "tressfx", "grid": "slots"})").size(), 2u);
    const auto thesis = beside(R"({"model": "tressfx", "grid": "slots",
        "params": {"grid_slot_hash": "thesis", "grid_diffuse_rule": "thesis"}})");
    ASSERT_EQ(thesis.size(), 1u);
    EXPECT_EQ(thesis[0].label, "TressFX");
}

// TressFX has no volume; the run without it stands beside it.
TEST_F(Comparison, is_with_the_run_without_volume) {
    const Scene scene = read(R"({"groom": "ball", "volume": true})");
    EXPECT_EQ(simulate::label_of(scene.sim), "articulated + volume");
    EXPECT_EQ(simulate::short_label_of(scene.sim), "articulated + volume");
    const std::vector<Variant> variants = simulate::variants_beside(scene);
    ASSERT_EQ(variants.size(), 3u);
    for (const Variant& variant : variants)
        EXPECT_FALSE(variant.sim.volume.on) << variant.label;
    EXPECT_EQ(variants[2].label, "articulated + inter-hair step (exact)");
    EXPECT_EQ(variants[2].sim.model, PLAIT_MODEL_ARTICULATED);
    EXPECT_STREQ(common::grid_name(variants[2].sim), "exact");
}

TEST_F(Comparison, of_wet_hair_is_with_dry_hair) {
    const Scene scene = read(R"({"wetness": 1, "volume": true})");
    EXPECT_EQ(simulate::label_of(scene), "articulated + volume, wet");
    const std::vector<Variant> variants = simulate::variants_beside(scene);
    ASSERT_EQ(variants.size(), 1u);
    EXPECT_EQ(variants[0].label, "articulated + volume, dry");
    EXPECT_TRUE(variants[0].of(scene).wetness.empty());
    EXPECT_TRUE(variants[0].sim.volume.on);
}

// Detail after the simulation: its rows take the place of TressFX's, and the run's own says what it has.
TEST_F(Comparison, is_with_other_details_where_the_scene_has_them) {
    const Scene scene =
        read(R"({"guides": 50, "detail": {"clump": [0, 0.5, 1, 1], "frizz": [0, 0, 0, 0.001]},
        "compare_detail": [{"name": "plain"}, {"name": "curls", "curl": [0, 0.001, 0.002, 0.003], "curl_pitch": 0.03}]})");
    EXPECT_EQ(simulate::label_of(scene), simulate::label_of(scene.sim) + " + clumps, frizz");
    const std::vector<Variant> variants = simulate::variants_beside(scene);
    ASSERT_EQ(variants.size(), 2u);
    EXPECT_EQ(variants[0].label, "plain");
    EXPECT_EQ(variants[1].label, "curls");
    EXPECT_EQ(variants[1].of(scene).sim.model, scene.sim.model);
    ASSERT_TRUE(variants[1].of(scene).detail);
    EXPECT_EQ(variants[1].of(scene).detail->curl[3], 0.003f);
    EXPECT_EQ(variants[1].of(scene).detail->curl_pitch, 0.03f);
    EXPECT_EQ(variants[1].of(scene).detail->clump[3], 0);
    EXPECT_EQ(simulate::label_of(read("{}")), simulate::label_of(read("{}").sim));
}

// What holds a braid together is the run's, not the thesis's; what the scene gives is both's.
TEST_F(Comparison, brakes_as_the_thesis_unless_the_scene_says_otherwise) {
    const Scene braid = read(R"({"groom": "braid"})");
    const plait_grid_desc thesis = simulate::variants_beside(braid)[1].sim.grid;
    EXPECT_LT(braid.sim.grid.diffuse_factor, thesis.diffuse_factor);
    EXPECT_EQ(thesis.diffuse_ratio, 2.0f);
    EXPECT_EQ(thesis.diffuse_factor, 0.9f);
    const Scene asked = read(R"({"groom": "braid", "params": {"grid_diffuse_ratio": 3}})");
    EXPECT_EQ(asked.sim.grid.diffuse_ratio, 3.0f);
    EXPECT_EQ(simulate::variants_beside(asked)[1].sim.grid.diffuse_ratio, 3.0f);
}

TEST_F(Comparison, says_what_tressfx_is_set_to) {
    const std::string text = simulate::tressfx_settings(read("{}"));
    EXPECT_EQ(text, "TressFX with 20 length iterations, local shape 0.9 in 2 iterations, global "
                    "shape 0.3 over 0.3 of a strand");
}

} // namespace
