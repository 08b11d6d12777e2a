// Contact of the baselines, as plait-lab runs them: friction against the closed form of an incline,
// and nothing comes through a bar. That they fall and bend as they should:
// tests/accuracy/baselines.cpp.
#include "common/json_reader.hpp"
#include "measured.hpp"
#include "methods/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>

using lab::Json;
using plait::test::measured;

namespace {

class BaselineContact : public testing::TestWithParam<std::string> {
  protected:
    static double value(const char* file, const Json& overrides = Json::object()) {
        const lab::Model& model = *lab::find_model(GetParam());
        const lab::Scene scene = lab::read_scene(std::string(PLAIT_SCENES "/") + file, overrides);
        return measured(file, GetParam().c_str(), setting_of(model, scene), overrides).value;
    }

  private:
    // In one substep cosserat slides at a quarter of what friction lets it, and chain lets a bar through.
    static lab::Setting setting_of(const lab::Model& model, const lab::Scene& scene) {
        if (model.label == "chain" || model.label == "cosserat")
            return {4, model.label == "chain" ? 1u : 2u, false};
        return default_setting(model, scene);
    }
};

std::vector<std::string> baselines() {
    std::vector<std::string> labels;
    for (const lab::Model& model : lab::models())
        if (model.baseline())
            labels.push_back(model.label);
    return labels;
}
INSTANTIATE_TEST_SUITE_P(All, BaselineContact, testing::ValuesIn(baselines()),
                         [](const auto& named) { return named.param; });

// A degree less than its friction holds: 0.0001 to 0.008 L/s, where a degree more makes 0.2.
TEST_P(BaselineContact, holds_on_an_incline) {
    const Json less{{"gravity", {0, -9.444041, -2.654466}},
                    {"duration", 2},
                    {"measure", {{{"metric", "tip_speed"}, {"from", 1}, {"to", 2}}}}};
    EXPECT_LT(value("incline.json", less), 0.01);
}

// Ten degrees more: its acceleration over the closed form's, less 1.
TEST_P(BaselineContact, slides_as_fast_as_friction_lets_it) {
    EXPECT_LT(std::abs(value("incline.json")), 0.05);
}

TEST_P(BaselineContact, keeps_off_a_bar_that_moves_its_diameter_a_step) {
    EXPECT_EQ(value("tunnel.json"), 0.0);
}

} // namespace
