// What is said about a groom's size, and what follows from it.
#include "scene/loaded.hpp"
#include "assimp.hpp"
#include "common/json_reader.hpp"
#include "support.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using simulate::Figure;
using simulate::Json;
using simulate::Scene;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

class Loaded : public TemporaryFolder {
  protected:
    // 40 strands of 5 vertices on a ball of 10 cm, 24 cm long, straight outwards; in `unit` metres.
    std::string ball_of_hair(float unit, const std::string& name) const {
        std::vector<float> positions;
        for (int strand = 0; strand < 40; ++strand)
            for (int vertex = 0; vertex < 5; ++vertex) {
                const auto up = 1.0f - static_cast<float>(strand) / 60.0f;
                const auto turn = 2.4f * static_cast<float>(strand);
                const float out = std::sqrt(1.0f - up * up);
                const float from_middle = 0.1f + 0.06f * static_cast<float>(vertex);
                for (const float value : {out * std::cos(turn), up, out * std::sin(turn)})
                    positions.push_back(from_middle * value / unit);
            }
        plait_groom_desc desc = plait_groom_desc_defaults();
        desc.positions = {positions.data(), positions.size() / 3, 0};
        desc.vertices_per_strand = 5;
        plait_groom* groom = nullptr;
        common::check(plait_groom_create(&desc, nullptr, &groom));
        const common::GroomHandle handle(groom);
        common::check(plait_groom_save(groom, path(name).c_str()));
        return path(name);
    }

    static Scene scene_of(const Json& keys) { return simulate::make_scene("", keys); }
};

TEST_F(Loaded, says_what_is_there) {
    Scene scene = scene_of({{"groom", ball_of_hair(1.0f, "metres.tfx")}});
    const Figure figure = make_figure(scene);
    const std::string line = loaded_line(scene, figure);
    EXPECT_THAT(line, HasSubstr("40 strands of 5 vertices, 200 in all"));
    EXPECT_THAT(line, HasSubstr("0.24 m long on average"));
    EXPECT_THAT(line, HasSubstr("a sphere of 0.1 m fitted under the roots"));
    EXPECT_THAT(size_warnings(scene, figure), IsEmpty());
    EXPECT_THAT(loaded_line(scene, figure), testing::Not(HasSubstr("scale")));
}

TEST_F(Loaded, draws_the_meshes_that_it_is_to_draw) {
    SKIP_WITHOUT_ASSIMP();
    for (const bool drawn : {true, false}) {
        Scene scene =
            scene_of({{"groom", ball_of_hair(1.0f, "metres.tfx")},
                      {"meshes", {{{"file", PLAIT_SCENES "/../head.obj"}, {"drawn", drawn}}}}});
        const Figure figure = make_figure(scene);
        EXPECT_EQ(figure.meshes.size(), 1u);
        EXPECT_EQ(figure.solids.triangles.size(), drawn ? 18564u : 0u);
        EXPECT_EQ(figure.posed_solids({{0, 0, 0, 1}, {0, 0, 0}}, 0).empty(), !drawn);
    }
}

// A head in metres under hair in metres, read as if it were in centimetres.
TEST_F(Loaded, warns_of_a_mesh_that_no_hair_reaches) {
    SKIP_WITHOUT_ASSIMP();
    const auto warnings_at = [&](float scale) {
        Scene scene =
            scene_of({{"groom", ball_of_hair(1.0f, "metres.tfx")},
                      {"meshes",
                       {{{"file", write("cube.obj", "v 1 0 0\nv 1.2 0 0\nv 1 0.2 0\nv 1 0 0.2\n"
                                                    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")},
                         {"scale", scale}}}}});
        return size_warnings(scene, make_figure(scene));
    };
    EXPECT_THAT(warnings_at(0.3f), IsEmpty());
    ASSERT_EQ(warnings_at(100).size(), 1u);
    EXPECT_THAT(warnings_at(100)[0],
                testing::AllOf(HasSubstr("meshes[0].file: "),
                               HasSubstr("cube.obj is 20 x 20 x 20 m large and 99.69 m away"),
                               HasSubstr("is its scale, 100, right?")));
}

// The comparison's rows of TressFX have the capsules.
TEST_F(Loaded, hair_on_the_mannequin_collides_with_its_meshes) {
    Scene scene = scene_of({{"groom", "long"}, {"strands", 50}});
    const Figure figure = make_figure(scene);
    EXPECT_THAT(loaded_line(scene, figure), HasSubstr("; 3 meshes of "));
    EXPECT_THAT(loaded_line(scene, figure), HasSubstr(" triangles, the mannequin's"));
    ASSERT_EQ(figure.meshes.size(), 3u);
    EXPECT_EQ(figure.meshes[0].head_share, 1);
    EXPECT_EQ(figure.meshes[1].head_share, 0.5f);
    EXPECT_EQ(figure.meshes[2].head_share, 0);
    EXPECT_EQ(figure.solids.triangles.size(), figure.head.triangles.size()) << "drawn once";
    EXPECT_THAT(figure.colliders, IsEmpty());
    EXPECT_EQ(figure.stand_ins.size(), 14u);
    EXPECT_TRUE(figure.neck);
    EXPECT_THAT(size_warnings(scene, figure), IsEmpty());
}

TEST_F(Loaded, or_with_its_capsules) {
    Scene scene = scene_of({{"groom", "long"}, {"strands", 50}, {"mannequin", "capsules"}});
    const Figure figure = make_figure(scene);
    EXPECT_THAT(loaded_line(scene, figure), HasSubstr("; 14 colliders of the mannequin"));
    EXPECT_THAT(figure.meshes, IsEmpty());
    EXPECT_EQ(figure.colliders.size(), 14u);
    EXPECT_THAT(figure.stand_ins, IsEmpty());
}

TEST_F(Loaded, hair_on_a_ball_has_the_ball_for_its_head) {
    Scene scene = scene_of({{"groom", "ball"}, {"strands", 50}});
    const Figure figure = make_figure(scene);
    EXPECT_THAT(loaded_line(scene, figure), HasSubstr("; a ball of 0.1 m"));
    ASSERT_EQ(figure.colliders.size(), 1u);
    EXPECT_EQ(figure.colliders[0].shape.capsule.radius_a, 0.1f);
    EXPECT_TRUE(figure.colliders[0].moves_with_head);
    EXPECT_FALSE(figure.neck);
    ASSERT_EQ(figure.head.vertices.size(), figure.head.scalp.size());
    for (size_t v = 0; v < figure.head.vertices.size(); ++v) {
        ASSERT_NEAR(figure.head.vertices[v].norm(), 0.1f, 1e-6f);
        ASSERT_EQ(figure.head.scalp[v] > 0, figure.head.vertices[v].y() > 0.0497571f) << v;
    }
    EXPECT_THAT(size_warnings(scene, figure), IsEmpty());
}

TEST_F(Loaded, some_strands_are_simulated_and_the_others_follow) {
    Scene all = scene_of({{"groom", ball_of_hair(1.0f, "hair.tfx")}, {"guides", 40}});
    const Figure whole = make_figure(all);
    EXPECT_EQ(whole.follows, nullptr) << "there is none to follow";
    EXPECT_EQ(whole.simulated_strands(), 40u);

    Scene scene = scene_of({{"groom", ball_of_hair(1.0f, "hair.tfx")}, {"guides", 7}});
    const Figure figure = make_figure(scene);
    EXPECT_EQ(figure.info.strands, 40u);
    EXPECT_EQ(figure.simulated_strands(), 7u);
    EXPECT_THAT(loaded_line(scene, figure), HasSubstr("of which 7 are simulated"));
    std::vector<uint32_t> numbers(40);
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::vector<uint32_t> guides = figure.of_simulated(numbers);
    EXPECT_EQ(guides.size(), 7u);
    std::ranges::sort(guides);
    EXPECT_EQ(std::ranges::adjacent_find(guides), guides.end()) << "each its own strand";
    EXPECT_TRUE(figure.of_simulated({}).empty()) << "no materials";
}

TEST_F(Loaded, a_level_says_how_many_are_simulated) {
    const std::string file = ball_of_hair(1.0f, "hair.tfx"); // of 40 strands
    for (const auto& [level, guides] : {std::pair{0u, 40u}, {1u, 8u}}) {
        Scene scene = scene_of({{"groom", file}, {"level", level}});
        EXPECT_EQ(make_figure(scene).simulated_strands(), guides);
    }
    EXPECT_THAT(refusal_of([&] {
                    Scene scene = scene_of({{"groom", file}, {"level", 2}});
                    make_figure(scene);
                }),
                HasSubstr("level 2 has no guides"));
    EXPECT_THAT(refusal_of([] { scene_of({{"level", 6}}); }), HasSubstr("level is 6"));
    EXPECT_THAT(refusal_of([] { scene_of({{"level", 1}, {"guides", 5}}); }), HasSubstr("guides"));
    EXPECT_THAT(refusal_of([] {
                    scene_of({{"level", 1}, {"follows_per_guide", 3}});
                }),
                HasSubstr("follows_per_guide"));
}

TEST_F(Loaded, a_budget_chooses_levels_by_itself) {
    const Scene scene = scene_of({{"budget", 4.5}, {"crowd", 7}});
    EXPECT_FLOAT_EQ(scene.crowd.budget_ms, 4.5f);
    EXPECT_EQ(scene.crowd.heads, 7u);
    EXPECT_EQ(scene_of({{"budget", 4}}).crowd.heads, 1u);
    const auto refusal = [](const Json& keys) { return refusal_of([&] { scene_of(keys); }); };
    EXPECT_THAT(refusal({{"budget", 0}}), HasSubstr("budget is 0, outside [0.01,10000.0]"));
    EXPECT_THAT(refusal({{"budget", 4}, {"crowd", 1001}}), HasSubstr("crowd is 1001"));
    EXPECT_THAT(refusal({{"crowd", 3}}), HasSubstr("no budget"));
    const std::pair<const char*, Json> others[] = {
        {"level", 1},   {"switch", "1:2"}, {"guides", 5},       {"follows_per_guide", 3},
        {"cache", "x"}, {"replay", "x"},   {"model", "tressfx"}};
    for (const auto& [other, value] : others)
        EXPECT_THAT(refusal({{"budget", 4}, {other, value}}),
                    AllOf(HasSubstr("budget is given, and "),
                          HasSubstr(value == "tressfx" ? "tressfx" : other)));
    EXPECT_THAT(refusal({{"budget", 4}, {"crowd", 2}, {"profile", true}}),
                HasSubstr("crowd is given, and profile"));
}

TEST_F(Loaded, guides_that_cannot_be_are_refused) {
    const std::string file = ball_of_hair(1.0f, "hair.tfx");
    EXPECT_THAT(refusal_of([&] {
                    Scene scene = scene_of({{"groom", file}, {"guides", 41}});
                    make_figure(scene);
                }),
                HasSubstr("guides is 41"));
    EXPECT_THAT(refusal_of([] { scene_of({{"guides", 0}}); }), HasSubstr("guides is 0"));
    EXPECT_THAT(refusal_of([] {
                    scene_of({{"guides", 5}, {"follows_per_guide", 3}});
                }),
                HasSubstr("follows_per_guide"));
}

TEST_F(Loaded, centimetres_are_noticed_and_named) {
    const std::string file = ball_of_hair(0.01f, "centimetres.tfx");
    Scene scene = scene_of({{"groom", file}});
    const auto warnings = size_warnings(scene, make_figure(scene));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(warnings[0], HasSubstr("24 m long on average"));
    EXPECT_THAT(warnings[0], HasSubstr("--scale 0.01 (or --scale auto) makes that 0.24 m"));
}

TEST_F(Loaded, auto_finds_the_unit) {
    for (const float unit : {1.0f, 0.01f, 0.001f}) {
        Scene scene = scene_of({{"groom", ball_of_hair(unit, "hair.tfx")}, {"scale", "auto"}});
        const Figure figure = make_figure(scene);
        EXPECT_FLOAT_EQ(scene.groom.scale, unit);
        EXPECT_NEAR(figure.info.mean_length, 0.24f, 1e-4f);
        EXPECT_THAT(size_warnings(scene, figure), IsEmpty());
    }
}

TEST_F(Loaded, drawn_hair_and_camera_follow_the_groom) {
    Scene metres = scene_of({{"groom", ball_of_hair(1.0f, "a.tfx")}});
    Scene centimetres = scene_of({{"groom", ball_of_hair(0.01f, "b.tfx")}});
    const Figure small = make_figure(metres), large = make_figure(centimetres);
    EXPECT_NEAR(large.size / small.size, 100.0f, 0.1f);
    EXPECT_GT(small.size, 0.5f);
    EXPECT_LT(small.size, 2.0f);

    Scene loose = scene_of({{"strands", 400}}),
          braid = scene_of({{"groom", "braid"}, {"strands", 400}});
    const Figure front = make_figure(loose), back = make_figure(braid);
    EXPECT_LT(std::abs(front.azimuth), 90.0f);
    EXPECT_GT(std::abs(back.azimuth), 90.0f) << "a braid hangs behind";
    EXPECT_NEAR(front.size, 1.0f, 0.05f);
    Scene asked = scene_of({{"groom", "braid"}, {"strands", 400}, {"camera", {{"azimuth", 10}}}});
    EXPECT_FLOAT_EQ(make_figure(asked).azimuth, 10.0f);
}

// A capsule that is moved 1 m along x and a quarter about its own middle.
TEST(Hand, is_where_its_keyframes_put_it) {
    simulate::Collider collider{plait_collider_desc_defaults(), false, {}};
    collider.shape.capsule.a[1] = 1.0f, collider.shape.capsule.b[1] = 1.0f;
    collider.shape.capsule.a[0] = -0.1f, collider.shape.capsule.b[0] = 0.1f;
    collider.shape.capsule.radius_a = collider.shape.capsule.radius_b = 0.03f;
    collider.keyframes = {{0.0f, {}}, {1.0f, {}}};
    collider.keyframes[1].head.x = 1.0f;
    collider.keyframes[1].head.yaw = 90.0f;
    const simulate::Hand hand(collider);
    EXPECT_EQ(hand.pose(0.0f).t[0], 0.0f);
    const plait_pose end = hand.pose(1.0f);
    // Its end a goes from (-0.1, 1, 0) to (1, 1, 0.1): yaw turns -x to +z.
    EXPECT_NEAR(end.q[1], std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(end.q[3], std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(end.t[0], 1.0f, 1e-6f); // the middle lies on the axis of the turn
    EXPECT_NEAR(end.t[1], 0.0f, 1e-6f);
    for (const Eigen::Vector3f& p : hand.mesh().vertices) {
        const float along = std::clamp(p.x(), -0.1f, 0.1f);
        EXPECT_NEAR((p - Eigen::Vector3f(along, 1.0f, 0.0f)).norm(), 0.03f, 1e-5f);
    }
}

// All of its mesh is on the surface, and the triangles, seen from outside, hold its volume.
TEST(Hand, is_drawn_as_a_box) {
    for (const float rounding : {0.0f, 0.02f}) {
        simulate::Collider collider{plait_collider_desc_defaults(), false, {}};
        collider.shape.kind = PLAIT_COLLIDER_KIND_BOX;
        collider.shape.box.centre[0] = 0.5f;
        collider.shape.box.half_extents[1] = 0.05f;
        collider.shape.box.rounding = rounding;
        collider.shape.box.orientation[2] = 0.6f, collider.shape.box.orientation[3] = 0.8f;
        collider.keyframes = {{0.0f, {}}};
        const simulate::Hand hand(collider);
        const Eigen::Quaternionf turn(0.8f, 0.0f, 0.0f, 0.6f);
        const Eigen::Vector3f centre(0.5f, 0.0f, 0.0f), half(collider.shape.box.half_extents);
        for (const Eigen::Vector3f& p : hand.mesh().vertices) {
            const Eigen::Vector3f d = (turn.conjugate() * (p - centre)).cwiseAbs() - half;
            EXPECT_NEAR(d.cwiseMax(0.0f).norm(), rounding, 1e-6f);
        }
        double volume = 0;
        for (const auto& [a, b, c] : hand.mesh().triangles) {
            const auto at = [&](uint32_t k) -> Eigen::Vector3f {
                return hand.mesh().vertices[k] - centre;
            };
            volume += double(at(a).dot(at(b).cross(at(c)))) / 6;
        }
        const double r = double(rounding), x = 0.2, y = 0.1, z = 0.2, pi = 3.14159265358979;
        const double whole = x * y * z + 2 * r * (x * y + y * z + z * x) +
                             pi * r * r * (x + y + z) + 4 * pi / 3 * r * r * r;
        EXPECT_NEAR(volume, whole, 0.003 * whole) << "rounding " << rounding;
    }
}

TEST(Hand, is_drawn_as_a_square_of_a_plane) {
    simulate::Collider collider{plait_collider_desc_defaults(), false, {}};
    collider.shape.kind = PLAIT_COLLIDER_KIND_PLANE;
    collider.shape.plane.point[1] = -0.2f;
    collider.shape.plane.normal[0] = 3.0f, collider.shape.plane.normal[1] = 4.0f;
    collider.keyframes = {{0.0f, {}}};
    const simulate::Hand hand(collider);
    const Eigen::Vector3f point(0.0f, -0.2f, 0.0f), normal(0.6f, 0.8f, 0.0f);
    const auto& v = hand.mesh().vertices;
    for (const Eigen::Vector3f& p : v)
        EXPECT_NEAR(normal.dot(p - point), 0.0f, 1e-6f);
    for (const auto& [a, b, c] : hand.mesh().triangles)
        EXPECT_NEAR((v[b] - v[a]).cross(v[c] - v[a]).normalized().dot(normal), 1.0f, 1e-5f);
}

} // namespace
