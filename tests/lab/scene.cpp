// Scenes of the laboratory: what they set, and how they are refused.
#include "scene/scene.hpp"
#include "accuracy/rows.hpp"
#include "common/json_reader.hpp"

#include "simulate/support.hpp"

#include <gmock/gmock.h>

#include <cmath>

using lab::Json;
using lab::Scene;
using lab::Vec3;
using testing::AllOf;
using testing::HasSubstr;

namespace {

class LabScene : public TemporaryFolder {
  protected:
    Scene read(const std::string& text, const Json& overrides = Json::object()) const {
        return lab::read_scene(write("scene.json", text), overrides);
    }
    std::string refusal(const std::string& text, const Json& overrides = Json::object()) const {
        return refusal_of([&] { read(text, overrides); });
    }
};

TEST_F(LabScene, empty_one_is_a_hair) {
    const Scene scene = read("{}");
    ASSERT_EQ(scene.strands.size(), 1u);
    EXPECT_EQ(scene.strands[0].segments, 16u);
    EXPECT_EQ(scene.model, "articulated") << "the library's default";
    EXPECT_EQ(scene.frames(), 120u);
    EXPECT_DOUBLE_EQ(scene.material.bend_stiffness, 4.7e-9);
}

TEST_F(LabScene, gamma_sets_the_bend_stiffness) {
    const Scene scene = read(R"({"strand": {"length": 0.2}, "gravity": [0, -5, 0],
        "material": {"line_density": 1e-4, "gamma": 40}})");
    EXPECT_NEAR(scene.material.bend_stiffness, 1e-4 * 5 * 0.008 / 40, 1e-18);
    EXPECT_NEAR(scene.gamma(), 40, 1e-9);
    EXPECT_TRUE(std::isinf(read(R"({"material": {"gamma": "limp"}})").gamma()));
}

TEST_F(LabScene, natural_units_are_of_length_and_gravity) {
    const Scene scene = read(R"({"strand": {"length": 2}, "gravity": [0, -8, 0], "rate": 20,
        "time_unit": "natural", "drag": 3, "duration": 10, "settle": 4})");
    EXPECT_NEAR(scene.unit_time, 0.5, 1e-12); // sqrt(2/8)
    EXPECT_NEAR(scene.rate, 40, 1e-9);
    EXPECT_NEAR(scene.drag, 6, 1e-9);
    EXPECT_EQ(scene.frames(), 200u);
    EXPECT_EQ(scene.settle_frames(), 80u);
}

TEST_F(LabScene, overrides_win) {
    Json set;
    lab::set_path(set, "strand.segments", 5);
    lab::set_path(set, "rate", 144);
    const Scene scene = read(R"({"strand": {"segments": 9, "length": 1}})", set);
    EXPECT_EQ(scene.strands[0].segments, 5u);
    EXPECT_EQ(scene.length(), 1);
    EXPECT_EQ(scene.rate, 144);
}

TEST_F(LabScene, any_clamp_helix_and_number_of_segments) {
    for (const uint32_t segments : {1u, 2u, 17u, 255u}) {
        const Scene scene = read(
            R"({"strand": {"segments": )" + std::to_string(segments) +
            R"(, "length": 0.5, "angle": -37, "curvature": 9, "torsion": 4, "aim": "segment"}})");
        const auto x = rest_shape(scene.strands[0], 1, true);
        ASSERT_EQ(x.size(), segments + 1);
        const Vec3 first = (x[1] - x[0]).normalized();
        EXPECT_NEAR(std::atan2(first.y(), first.x()), -37 * lab::pi / 180, 1e-12);
        for (size_t i = 1; i < x.size(); ++i)
            EXPECT_NEAR((x[i] - x[i - 1]).norm(), 0.5 / segments, 1e-14);
    }
}

// Chords of a helix: vertices at one distance from an axis, turning evenly and advancing evenly.
TEST_F(LabScene, helix_has_its_radius_and_pitch) {
    const Scene scene = read(R"({"strand": {"segments": 200, "length": 1, "aim": "axis",
        "direction": [0, 0, -1], "curvature": 18, "torsion": 5}})");
    const auto x = rest_shape(scene.strands[0], 1, true);
    const double turn = std::hypot(18, 5), radius = 18 / (turn * turn);
    EXPECT_NEAR(x.back().z(), -5 / turn, 1e-9);
    Vec3 centre = Vec3::Zero();
    for (size_t i = 0; i + 1 < x.size(); ++i)
        centre += x[i] / static_cast<double>(x.size() - 1);
    EXPECT_NEAR(std::hypot(x[0].x() + radius, x[0].y()), radius, 1e-9);
    EXPECT_NEAR(std::hypot(x[77].x() + radius, x[77].y()), radius, 1e-4);
    const Vec3 a = x[1] - x[0], b = x[2] - x[1], c = x[3] - x[2];
    EXPECT_GT(a.cross(b).dot(c), 0); // positive torsion is right-handed
}

TEST_F(LabScene, curls_bend_where_they_are_told) {
    const Scene scene = read(R"({"strand": {"angle": 0, "curvature": 5, "towards": [0, 1, 0]}})");
    const auto x = rest_shape(scene.strands[0], 1, true);
    EXPECT_GT(x[3].y(), 1e-4);
    EXPECT_NEAR(x.back().z(), 0, 1e-12);
}

// The first chord of a bent strand is half a segment along the curve, and so turned by half of what
// a segment bends: however many segments, the clamp stays where it is.
TEST_F(LabScene, tangents_are_the_curves_where_it_begins) {
    for (const uint32_t segments : {4u, 32u})
        for (const std::string towards : {"", R"(, "towards": [0, 1, 0])"}) {
            const std::string strand =
                R"({"strand": {"length": 0.5, "angle": 0, "curvature": 6, "segments": )" +
                std::to_string(segments) + towards;
            const auto x = rest_shape(read(strand + "}}").strands[0], 1, true);
            const Vec3 first = (x[1] - x[0]).normalized();
            EXPECT_NEAR(std::acos(first.x()), 0.5 * 6 * 0.5 / segments, 1e-7) << segments;
            if (!towards.empty()) {
                EXPECT_GT(first.y(), 0);
                EXPECT_NEAR(first.z(), 0, 1e-12);
            }
            const auto y = rest_shape(read(strand + R"(, "aim": "segment"}})").strands[0], 1, true);
            EXPECT_NEAR((y[1] - y[0]).normalized().x(), 1, 1e-12);
        }
    // A helix: its tangent makes the same angle with the axis everywhere.
    const Scene scene = read(R"({"strand": {"segments": 200, "length": 1, "direction": [1, 0, 0],
        "towards": [0, 1, 0], "curvature": 18, "torsion": 5}})");
    const auto x = rest_shape(scene.strands[0], 1, true);
    EXPECT_LT(((x[1] - x[0]).normalized() - Vec3(1, 0.5 * 18 / 200, 0)).norm(), 2e-3);
}

TEST_F(LabScene, motions_add_up) {
    const Scene scene = read(R"({"motion": [
        {"type": "place", "offset": [1, 2, 3]},
        {"type": "sine", "direction": [0, 0, 2], "acceleration_g": 10, "frequency": 2, "to": 1},
        {"type": "accelerate", "direction": [1, 0, 0], "acceleration": 4, "to": 0.5}]})");
    const double omega = 4 * lab::pi;
    const lab::Pose pose = scene.motion.at(0.125); // a quarter of the sine
    EXPECT_NEAR(pose.t.z(), 3 + 10 * lab::standard_gravity / (omega * omega), 1e-12);
    EXPECT_NEAR(pose.t.x(), 1 + 0.5 * 4 * 0.125 * 0.125, 1e-12);
    EXPECT_NEAR(scene.motion.at(1.5).t.x(), 1 + 0.5 * 4 * 0.25 + 2 * 1.0, 1e-12);
    EXPECT_NEAR(scene.motion.at(7).t.z(), 3, 1e-9);
}

TEST_F(LabScene, keyframes_and_teleports) {
    const Scene scene = read(R"({"motion": [
        {"type": "keyframes", "keys": [{"time": 0}, {"time": 2, "position": [4, 0, 0], "rotation": [0, 90, 0]}]},
        {"type": "teleport", "time": 1, "offset": [0, 5, 0]}]})");
    EXPECT_NEAR(scene.motion.at(0.5).t.x(), 1, 1e-12);
    EXPECT_NEAR(scene.motion.at(0.5).t.y(), 0, 1e-12);
    EXPECT_NEAR(scene.motion.at(1.0).t.y(), 5, 1e-12);
    const Vec3 turned = scene.motion.at(2).q * Vec3::UnitZ();
    EXPECT_NEAR(turned.x(), 1, 1e-12);
    EXPECT_TRUE(scene.motion.teleports(0.9, 1.0));
    EXPECT_FALSE(scene.motion.teleports(1.0, 1.1));
}

TEST_F(LabScene, bundles_are_copies_in_a_line_or_over_a_disc) {
    const Scene line = read(R"({"bundle": {"count": 4, "line": [0, 0, 0.5]}})");
    ASSERT_EQ(line.strands.size(), 4u);
    EXPECT_NEAR(line.strands[3].root.z(), 1.5, 1e-12);
    const Scene disc =
        read(R"({"strand": {"root": [1, 2, 3]}, "bundle": {"count": 50, "radius": 0.1}})");
    ASSERT_EQ(disc.strands.size(), 50u);
    for (const lab::Strand& strand : disc.strands) {
        EXPECT_LE((strand.root - Vec3(1, 2, 3)).norm(), 0.1 + 1e-12);
        EXPECT_DOUBLE_EQ(strand.root.y(), 2);
    }
}

TEST_F(LabScene, settles_in_a_gravity_of_its_own) {
    EXPECT_EQ(read(R"({"gravity": [0, -5, 0]})").settle_gravity.y(), -5);
    EXPECT_EQ(read(R"({"settle_gravity": [1, -9, 0]})").settle_gravity.x(), 1);
}

TEST_F(LabScene, refusals_name_line_key_value_and_range) {
    EXPECT_THAT(refusal("{\n \"strand\": {\n  \"segments\": 300 }}"),
                AllOf(HasSubstr("scene.json:3: strand.segments is 300"), HasSubstr("[1,255]")));
    EXPECT_THAT(refusal("{\n\n \"material\": {\"gamma\": -1}}"),
                AllOf(HasSubstr("scene.json:3: material.gamma is -1"), HasSubstr("outside")));
    EXPECT_THAT(refusal(R"({"strand": {"lenght": 1}})"), HasSubstr("nearest is \"length\""));
    EXPECT_THAT(refusal(R"({"modell": "rod"})"), HasSubstr("nearest is \"model\""));
    EXPECT_THAT(refusal(R"({"model": "rood"})"), HasSubstr("nearest is \"rod\""));
    EXPECT_THAT(refusal(R"({"measure": [{"metric": "rms_eror"}]})"),
                AllOf(HasSubstr("measure[0].metric"), HasSubstr("\"rms_error\"")));
    EXPECT_THAT(refusal("{}", {{"rate", "fast"}}), HasSubstr("command line: rate is \"fast\""));
}

TEST_F(LabScene, refusals_of_what_contradicts_itself) {
    EXPECT_THAT(refusal(R"({"material": {"gamma": 1, "bend_stiffness": 1}})"),
                HasSubstr("one of the two"));
    EXPECT_THAT(refusal(R"({"gravity": [0,0,0], "material": {"gamma": 1}})"),
                HasSubstr("needs gravity"));
    EXPECT_THAT(refusal(R"({"gravity": [0,0,0], "time_unit": "natural"})"),
                HasSubstr("without gravity"));
    EXPECT_THAT(refusal(R"({"strand": {}, "strands": []})"), HasSubstr("one of the two"));
    EXPECT_THAT(refusal(R"({"strand": {"direction": [0,0,0]}})"), HasSubstr("no direction"));
    EXPECT_THAT(refusal(R"({"strand": {"angle": 1, "direction": [1,0,0]}})"),
                HasSubstr("one of the two"));
    EXPECT_THAT(refusal(R"({"strand": {"direction": [1,0,0], "towards": [2,0,0]}})"),
                HasSubstr("towards"));
    EXPECT_THAT(refusal(R"({"strand": {"points": [[0,0,0],[1,"a",0]]}})"), HasSubstr("points[1]"));
    EXPECT_THAT(refusal(R"({"duration": 1e6})"), HasSubstr("steps at this rate"));
    EXPECT_THAT(refusal(R"({"motion": [{"type": "sine"}]})"),
                HasSubstr("motion[0].acceleration_g is missing"));
    EXPECT_THAT(refusal(R"({"motion": [{"type": "jump"}]})"), HasSubstr("teleport"));
    EXPECT_THAT(refusal(R"({"motion": [{"type": "turn", "degrees": 3}]})"),
                HasSubstr("motion[0].to is missing"));
    EXPECT_THAT(refusal(R"({"colliders": [{"a": [0,0,0]}]})"), HasSubstr("radius_a is missing"));
    EXPECT_THAT(refusal(R"({"colliders": [{"plane": {"point": [0,0,0]}}]})"),
                HasSubstr("colliders[0].plane.normal is missing"));
    EXPECT_THAT(refusal(R"({"colliders": [{"plane": {"normal": [0,0,0]}}]})"),
                HasSubstr("shorter than 1e-6"));
    EXPECT_THAT(refusal(R"({"colliders": [{"box": {"half_extents": [1,-1,1]}}]})"),
                HasSubstr("box.half_extents"));
    EXPECT_THAT(
        refusal(R"({"colliders": [{"box": {"half_extents": [1,1,1], "orientation": [1,0,0,1]}}]})"),
        HasSubstr("unit quaternion"));
    EXPECT_THAT(
        refusal(
            R"({"colliders": [{"box": {"half_extents": [1,1,1]}, "plane": {"normal": [0,1,0]}}]})"),
        HasSubstr("one of the two"));
    EXPECT_THAT(refusal(R"({"colliders": [{"box": {"half_extents": [1,1,1]}, "a": [0,0,0]}]})"),
                HasSubstr("colliders[0].a"));
    EXPECT_THAT(refusal(R"({"reference": {}})"), HasSubstr("reference.table is missing"));
    EXPECT_THAT(refusal(R"({"measure": [{"metric": "tilt", "strand": 1}]})"),
                HasSubstr("measure[0].strand is 1"));
    EXPECT_THAT(refusal(R"({"measure": [{"metric": "swing_error", "strand": 0}]})"),
                HasSubstr("measure[0].strand chooses nothing"));
    EXPECT_THAT(refusal("{ nothing"), HasSubstr("line 1"));
}

TEST(LabScenes, of_the_repository_are_valid) {
    size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PLAIT_SCENES)) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "accuracy" ||
            entry.path().stem() == "charts" || entry.path().stem() == "features")
            continue;
        EXPECT_NO_THROW(lab::read_scene(entry.path().string(), Json::object())) << entry.path();
        ++seen;
    }
    EXPECT_GE(seen, 10u);
}

TEST(LabScenes, of_the_accuracy_table_are_valid) {
    const auto rows = lab::read_rows(PLAIT_SCENES "/accuracy.json");
    EXPECT_GE(rows.size(), 20u);
    for (const lab::Row& row : rows)
        for (const lab::Variant& variant : row.variants)
            EXPECT_NO_THROW(lab::scene_of(row, variant)) << row.id << " " << variant.name;
}

} // namespace
