// The scenes that come with plait: what each sets is read, and changes the hair.
#include "assimp.hpp"
#include "common/json_reader.hpp"
#include "run.hpp"
#include "scene/motion.hpp"
#include "support.hpp"

#include <algorithm>

namespace {

using simulate::Json;

constexpr const char* names[] = {"ball", "bust",  "clumps", "curls", "fan", "fringe",
                                 "hand", "stone", "table",  "walk",  "wet", "windy"};

Json document(const std::string& name) {
    std::ifstream file(std::string(PLAIT_SCENES "/") + name + ".json");
    return Json::parse(file, nullptr, true, true);
}

class Scenes : public testing::TestWithParam<const char*> {
  protected:
    struct Ran {
        uint64_t hash;
        std::vector<std::string> warnings;
    };
    // A short run of few strands of the document, whose files are where the scenes are.
    static Ran run(Json scene) {
        const bool follows = scene.contains("guides");
        scene["strands"] = follows ? 1000 : 200;
        if (follows)
            scene["guides"] = 60;
        scene["seconds"] = 0.2;
        scene["settle"] = 0.05;
        std::filesystem::current_path(PLAIT_SCENES);
        simulate::Scene made = simulate::make_scene("", scene);
        const simulate::Figure figure = make_figure(made);
        simulate::Simulation simulation(made, figure);
        const auto motion = simulate::make_motion(made.body ? "still" : made.motion);
        const auto measured = simulation.run(*motion, {}, "");
        return {measured.hash, simulation.take_warnings()};
    }
};

INSTANTIATE_TEST_SUITE_P(Names, Scenes, testing::ValuesIn(names),
                         [](const auto& name) { return std::string(name.param); });

TEST_P(Scenes, EveryParameterChangesTheHash) {
    const Json scene = document(GetParam());
    const std::string text = scene.dump();
    if (text.find(".obj") != text.npos || text.find(".gltf") != text.npos) { // a mesh
        SKIP_WITHOUT_ASSIMP();
    }
    const Ran whole = run(scene);
    EXPECT_TRUE(whole.warnings.empty()) << whole.warnings.front();
    for (const char* of : {"params", "wind"}) {
        const Json given = scene.value(of, Json::object());
        for (const auto& [key, value] : given.items()) {
            Json without = scene;
            without[of].erase(key);
            EXPECT_NE(run(without).hash, whole.hash) << of << "." << key;
        }
    }
}

// All of them are looked at, but those for grooms of others.
TEST(SceneFiles, AreAllTested) {
    for (const auto& entry : std::filesystem::directory_iterator(PLAIT_SCENES)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".json" && !document(name).contains("made_for")) {
            EXPECT_NE(std::ranges::find(names, name), std::end(names)) << name;
        }
    }
}

} // namespace
