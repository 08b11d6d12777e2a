// Scene files: what they set, and how they are refused.
#include "scene/scene.hpp"
#include "common/json_reader.hpp"
#include "common/params_reader.hpp"
#include "scene/inputs.hpp"
#include "support.hpp"

#include <gmock/gmock.h>

#include <set>

using simulate::Json;
using simulate::Scene;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

class SceneFile : public TemporaryFolder {
  protected:
    Scene read(const std::string& text, const Json& command_line = Json::object()) const {
        return simulate::make_scene(write("scene.json", text), command_line);
    }

    std::string refusal(const std::string& text, const Json& command_line = Json::object()) const {
        return refusal_of([&] { read(text, command_line); });
    }
};

TEST_F(SceneFile, empty_one_is_the_default_scene) {
    const Scene scene = read("{}");
    EXPECT_EQ(scene.groom.name, "long");
    EXPECT_EQ(scene.groom.style.strands, 10000u);
    EXPECT_EQ(scene.groom.style.vertices, 16u);
    EXPECT_EQ(scene.frames(), 240u);
    EXPECT_STREQ(common::grid_name(scene.sim), "exact");
    EXPECT_FALSE(scene.colliders.has_value());
}

TEST_F(SceneFile, a_key_that_is_none_gets_a_sensible_one_or_none) {
    const auto of_params = [&](const char* key) {
        return refusal(R"({"params": {")" + std::string(key) + "\": 1}}");
    };
    EXPECT_THAT(of_params("gravty"), HasSubstr("no known key; the nearest is \"gravity\""));
    EXPECT_THAT(of_params("friction"), HasSubstr("no known key; there is \"friction_scale\""));
    EXPECT_THAT(of_params("stiffness"), HasSubstr("\"bend_stiffness\""));
    EXPECT_TRUE(of_params("preset").ends_with("params.preset is no known key"))
        << of_params("preset");
    EXPECT_THAT(refusal(R"({"preset": 1})"), Not(HasSubstr("nearest")));
    EXPECT_THAT(refusal(R"({"sead": 1})"), HasSubstr("the nearest is \"seed\""));
}

TEST_F(SceneFile, keeps_what_a_run_goes_on_from) {
    EXPECT_EQ(read("{}").restart_every, 0u);
    EXPECT_EQ(read(R"({"resume": true})").restart_every, 100u);
    EXPECT_EQ(read(R"({"resume": true, "restart_every": 7})").restart_every, 7u);
    EXPECT_THAT(refusal(R"({"restart_every": 0})"), HasSubstr("restart_every is 0"));
    EXPECT_THAT(refusal(R"({"restart_every": 5, "budget": 4})"),
                HasSubstr("restart_every is given, and budget, too: levels that go by the clock"));
    EXPECT_THAT(refusal(R"({"resume": true, "profile": true})"),
                HasSubstr("resume is given, and profile, too"));
    EXPECT_THAT(refusal(R"({"resume": true, "trace": "t.json"})"), HasSubstr("and trace, too"));
    EXPECT_THAT(refusal(R"({"resume": true, "replay": "a.cache"})"), HasSubstr("and replay, too"));
}

TEST_F(SceneFile, tells_what_differs_between_two_runs) {
    const auto of = [&](const char* text) {
        return Json::parse(read(text, {{"resume", true}}).inputs);
    };
    write("a.csv", "time,yaw\n0,0\n1,30\n");
    const Json was = of(R"({"seconds": 2, "motion": "a.csv", "params": {"gravity": [0,-9,0]}})");
    EXPECT_THAT(simulate::differences(was, was), testing::IsEmpty());
    EXPECT_THAT(
        simulate::differences(was, of(R"({"seconds": 3.5, "motion": "a.csv", "strands": 5})")),
        testing::ElementsAre("params is not given, was {\"gravity\":[0,-9,0]}",
                             "seconds is 3.5, was 2", "strands is 5, was not given"));
    write("a.csv", "time,yaw\n0,0\n1,31\n");
    EXPECT_THAT(
        simulate::differences(
            was, of(R"({"seconds": 2, "motion": "a.csv", "params": {"gravity": [0,-8,0]}})")),
        testing::ElementsAre("params.gravity is [0,-8,0], was [0,-9,0]",
                             "what the file of motion holds is another"));
}

TEST_F(SceneFile, has_parameters_of_the_tressfx_beside) {
    const Scene scene = read(R"({"tressfx": {"global_stiffness": 0.1}})");
    EXPECT_FLOAT_EQ(scene.tressfx.global_stiffness, 0.1f);
    EXPECT_EQ(scene.tressfx.length_iterations, 20u);
    EXPECT_EQ(scene.sim.tressfx.global_stiffness, 0);
    EXPECT_EQ(read(R"({"model": "tressfx"})").sim.tressfx.length_iterations, 20u);
    EXPECT_THAT(refusal(R"({"model": "tressfx", "tressfx": {}})"), HasSubstr("tressfx"));
}

TEST_F(SceneFile, says_how_a_file_lies) {
    const Scene scene = read(R"({"groom": "a.tfx", "axes": "z_up", "root_end": "agreed"})");
    EXPECT_EQ(scene.groom.axes, PLAIT_AXES_Z_UP);
    EXPECT_EQ(scene.groom.root_end, PLAIT_ROOT_END_AGREED);
    EXPECT_THAT(refusal(R"({"axes": "z_up"})"), HasSubstr("is for files"));
    EXPECT_THAT(refusal(R"({"scale": 2})"), HasSubstr("scale is for files; \"long\" is generated"));
    EXPECT_THAT(refusal(R"({"groom": "a.tfx", "axes": "x_up"})"), HasSubstr("not one of y_up"));
}

TEST_F(SceneFile, outputs_have_a_file_each_in_a_folder_that_is_there) {
    EXPECT_THAT(refusal(R"({"json": "a.json", "trace": "b/../a.json"})"),
                HasSubstr("which json writes, too"));
    EXPECT_THAT(refusal(R"({"out": "o", "cache": "o/stats.json"})"),
                HasSubstr("which out writes, too"));
    EXPECT_THAT(refusal(R"({"json": "/no/such/a.json"})"),
                HasSubstr("in a folder that is not there"));
    EXPECT_THAT(read(R"({"out": "o", "json": "o/a.json"})").json, HasSubstr("o/a.json"));
}

TEST_F(SceneFile, a_radius_of_follows_that_are_not_there_is_refused) {
    EXPECT_THAT(refusal(R"({"follow_radius": 0.01})"), HasSubstr("follows_per_guide is 0"));
    read(R"({"follow_radius": 0.01, "follows_per_guide": 2})");
    read(R"({"follow_radius": 0.01, "groom": "dreadlocks"})");
}

TEST_F(SceneFile, nested_beyond_reason_is_refused_at_once) {
    const std::string deep(20000, '[');
    EXPECT_THAT(refusal("{\"groom\": " + deep), HasSubstr("nested more than 100 deep"));
}

TEST_F(SceneFile, a_text_that_the_file_system_would_cut_short_is_refused) {
    EXPECT_THAT(refusal(R"({"out": "here\u0000there"})"),
                HasSubstr(R"("here\u0000there" has the character 0)"));
}

TEST_F(SceneFile, a_number_beyond_all_is_refused_with_the_file) {
    EXPECT_THAT(refusal(R"({"seconds": 1e999})"), AllOf(HasSubstr(".json: "), HasSubstr("1e999")));
}

TEST_F(SceneFile, says_of_which_program_a_file_is_and_other_keys_win) {
    const Scene unreal = read(R"({"groom": "a.abc", "program": "unreal"})");
    EXPECT_EQ(unreal.groom.axes, PLAIT_AXES_Z_UP_LEFT_HANDED);
    EXPECT_EQ(unreal.groom.scale, 0.01f);
    const Scene own =
        read(R"({"groom": "a.abc", "program": "maya", "axes": "z_up", "scale": 0.5})");
    EXPECT_EQ(own.groom.axes, PLAIT_AXES_Z_UP);
    EXPECT_EQ(own.groom.scale, 0.5f);
    EXPECT_THAT(refusal(R"({"program": "maya"})"), HasSubstr("is for files"));
    EXPECT_THAT(refusal(R"({"groom": "a.abc", "program": "word"})"),
                HasSubstr("not one of blender"));
}

TEST_F(SceneFile, a_body_without_animation_is_refused) {
    EXPECT_THAT(refusal(R"({"body": {"file": "rat.tfxmesh"}})"),
                AllOf(HasSubstr("body.file is"), HasSubstr(".tfxmesh holds no animation"),
                      HasSubstr("allowed are .gltf and .glb")));
}

TEST_F(SceneFile, has_wind) {
    EXPECT_FALSE(read("{}").wind.has_value());
    const Scene scene = read(R"({"seed": 9, "wind": {"velocity": [1, 2, -3], "turbulence": 0.5,
        "octaves": 4, "gusts": 0.2}})");
    ASSERT_TRUE(scene.wind.has_value());
    EXPECT_FLOAT_EQ(scene.wind->velocity[2], -3);
    EXPECT_FLOAT_EQ(scene.wind->turbulence, 0.5f);
    EXPECT_EQ(scene.wind->octaves, 4u);
    EXPECT_FLOAT_EQ(scene.wind->gusts, 0.2f);
    EXPECT_FLOAT_EQ(scene.wind->scale, 0.5f);
    EXPECT_EQ(scene.wind->seed, 9u);
    EXPECT_THAT(refusal(R"({"wind": {"octaves": 9}})"), HasSubstr("wind.octaves"));
    EXPECT_THAT(refusal(R"({"wind": {"speed": 9}})"), HasSubstr("wind.speed"));
    EXPECT_THAT(refusal(R"({"model": "tressfx", "wind": {}})"), HasSubstr("tressfx"));
}

TEST_F(SceneFile, has_wetness) {
    EXPECT_TRUE(read("{}").wetness.empty());
    EXPECT_EQ(read(R"({"wetness": 0.5})").wetness, std::vector<float>{0.5f});
    write("wet.txt", "0 0.25\n1 0.5\n");
    EXPECT_EQ(read(R"({"wetness": "wet.txt"})").wetness, (std::vector<float>{0, 0.25f, 1, 0.5f}));
    EXPECT_FLOAT_EQ(
        read(R"({"wetness": 1, "params": {"wetness_drying_time": 4}})").sim.wetness.drying_time, 4);
    EXPECT_THAT(refusal(R"({"params": {"wetness_drying_time": 4}})"),
                HasSubstr("params.wetness_drying_time is of wetness, which is off"));
    EXPECT_THAT(refusal(R"({"wetness": 1.5})"), HasSubstr("wetness"));
    EXPECT_THAT(refusal(R"({"wetness": true})"), HasSubstr("wetness"));
    EXPECT_THAT(refusal(R"({"wetness": "none.txt"})"), HasSubstr("none.txt"));
    write("wrong.txt", "0 0.5 2\n");
    EXPECT_THAT(refusal(R"({"wetness": "wrong.txt"})"), HasSubstr("number 2 is 2, range is [0,1]"));
    write("words.txt", "0 wet\n");
    EXPECT_THAT(refusal(R"({"wetness": "words.txt"})"), HasSubstr("number 1 is wet"));
    EXPECT_THAT(refusal(R"({"model": "tressfx", "wetness": 1})"), HasSubstr("tressfx"));
}

TEST_F(SceneFile, has_meshes) {
    const Scene scene = read(R"({"meshes": [{"file": "a.obj", "scale": 0.01, "margin": 0.002,
        "friction": 0.1, "cells": 64, "two_sided": true, "moves_with_head": false}]})");
    ASSERT_EQ(scene.meshes.size(), 1u);
    const simulate::MeshChoice& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.file, path("a.obj"));
    EXPECT_FLOAT_EQ(mesh.scale, 0.01f);
    EXPECT_FLOAT_EQ(mesh.desc.margin, 0.002f);
    EXPECT_FLOAT_EQ(mesh.desc.friction, 0.1f);
    EXPECT_EQ(mesh.desc.cells, 64u);
    EXPECT_EQ(mesh.desc.two_sided, 1u);
    EXPECT_FALSE(scene.head_is_mesh());
    EXPECT_TRUE(read(R"({"meshes": [{"file": "a.obj"}]})").head_is_mesh());
    EXPECT_THAT(refusal(R"({"meshes": [{}]})"), HasSubstr("meshes[0].file"));
    EXPECT_THAT(refusal(R"({"meshes": [{"file": "a.obj", "cells": 7}]})"),
                AllOf(HasSubstr("meshes[0].cells"), HasSubstr("7"), HasSubstr("[8,256]")));
    EXPECT_THAT(refusal(R"({"meshes": [{"file": "a.obj", "thin": 1}]})"), HasSubstr("thin"));
    EXPECT_THAT(refusal(R"({"meshes": [{"file": "a.obj", "form": "nearest", "cells": 64}]})"),
                HasSubstr("only a field has cells"));
    EXPECT_THAT(refusal(R"({"meshes": [{"file": "a.obj", "form": "hull", "two_sided": true}]})"),
                HasSubstr("form hull, too"));
    EXPECT_THAT(refusal(R"({"model": "tressfx", "meshes": [{"file": "a.obj"}]})"),
                HasSubstr("tressfx"));
}

TEST_F(SceneFile, hair_collides_with_the_mannequins_meshes_or_its_capsules) {
    EXPECT_TRUE(read("{}").mannequin_is_meshes());
    EXPECT_TRUE(read(R"({"mannequin": "meshes"})").mannequin_is_meshes());
    EXPECT_FALSE(read(R"({"mannequin": "capsules"})").mannequin_is_meshes());
    EXPECT_FALSE(read(R"({"colliders": []})").mannequin_is_meshes());
    EXPECT_FALSE(read(R"({"groom": "ball"})").mannequin_is_meshes());
    EXPECT_FALSE(read(R"({"model": "tressfx"})").mannequin_is_meshes());
    EXPECT_FALSE(read(R"({"meshes": [{"file": "a.obj"}]})").mannequin_is_meshes());
    EXPECT_TRUE(
        read(R"({"meshes": [{"file": "a.obj", "moves_with_head": false}]})").mannequin_is_meshes());
    EXPECT_THAT(refusal(R"({"mannequin": "spheres"})"),
                AllOf(HasSubstr("mannequin"), HasSubstr("spheres"), HasSubstr("capsules")));
    EXPECT_THAT(refusal(R"({"groom": "ball", "mannequin": "meshes"})"),
                AllOf(HasSubstr("mannequin"), HasSubstr("ball")));
    EXPECT_THAT(refusal(R"({"mannequin": "capsules", "colliders": []})"),
                AllOf(HasSubstr("mannequin"), HasSubstr("take its place")));
    EXPECT_THAT(refusal(R"({"mannequin": "meshes", "model": "tressfx"})"),
                AllOf(HasSubstr("mannequin"), HasSubstr("tressfx")));
}

TEST_F(SceneFile, meshes_have_a_form) {
    EXPECT_EQ(read(R"({"meshes": [{"file": "a.obj"}]})").meshes[0].desc.form,
              PLAIT_MESH_FORM_FIELD);
    EXPECT_EQ(read(R"({"meshes": [{"file": "a.obj", "form": "nearest"}]})").meshes[0].desc.form,
              PLAIT_MESH_FORM_NEAREST);
    const Scene hull =
        read(R"({"meshes": [{"file": "a.obj", "form": "hull", "tolerance": 0.01}]})");
    EXPECT_TRUE(hull.meshes[0].hull);
    EXPECT_FLOAT_EQ(hull.meshes[0].tolerance, 0.01f);
    EXPECT_THAT(refusal(R"({"meshes": [{"file": "a.obj", "tolerance": 0.01}]})"),
                HasSubstr("tolerance"));
    EXPECT_THAT(refusal(R"({"body": {"file": "a.gltf", "form": "hull"}})"),
                HasSubstr("does not bend"));
    EXPECT_THAT(refusal(R"({"meshes": [{"file": "a.obj", "form": "nearst"}]})"),
                AllOf(HasSubstr("meshes[0].form"), HasSubstr("nearst"), HasSubstr("nearest")));
}

TEST_F(SceneFile, has_a_body) {
    EXPECT_FALSE(read("{}").body.has_value());
    const Scene scene = read(R"({"body": {"file": "a.gltf", "form": "nearest", "animation": 2,
        "bone": "Head", "scale": 0.01, "margin": 0.001, "friction": 0.1}})");
    ASSERT_TRUE(scene.body.has_value());
    EXPECT_EQ(scene.body->mesh.file, path("a.gltf"));
    EXPECT_EQ(scene.body->mesh.desc.form, PLAIT_MESH_FORM_NEAREST);
    EXPECT_FLOAT_EQ(scene.body->mesh.scale, 0.01f);
    EXPECT_FLOAT_EQ(scene.body->mesh.desc.friction, 0.1f);
    EXPECT_EQ(scene.body->animation, simulate::AnimationChoice(2u));
    EXPECT_EQ(scene.body->bone, "Head");
    EXPECT_TRUE(scene.head_is_mesh());
    EXPECT_EQ(read(R"({"body": {"file": "a.gltf", "animation": "run"}})").body->animation,
              simulate::AnimationChoice("run"));
    EXPECT_EQ(read(R"({"body": {"file": "a.gltf"}})").body->bone, "head");
    EXPECT_EQ(read(R"({"body": {"file": "a.gltf"}})").body->roots, simulate::Carrier::Bone);
    EXPECT_EQ(read(R"({"body": {"file": "a.gltf", "roots": "skin"}})").body->roots,
              simulate::Carrier::Skin);
    EXPECT_THAT(refusal(R"({"body": {"file": "a.gltf", "roots": "bones"}})"),
                AllOf(HasSubstr("body.roots"), HasSubstr("bone")));
    EXPECT_THAT(refusal(R"({"body": {}})"), HasSubstr("body.file"));
    EXPECT_THAT(refusal(R"({"body": {"file": "a.gltf", "form": "field"}})"),
                AllOf(HasSubstr("scene.json:1: body.form"), HasSubstr("does not bend")));
    EXPECT_THAT(refusal(R"({"body": {"file": "a.gltf", "animation": -1}})"),
                AllOf(HasSubstr("body.animation"), HasSubstr("-1")));
    EXPECT_THAT(refusal(R"({"body": {"file": "a.gltf", "bones": 1}})"),
                AllOf(HasSubstr("body.bones"), HasSubstr("\"bone\"")));
    EXPECT_THAT(refusal(R"({"body": {"file": "a.gltf"}, "motion": "walk"})"),
                AllOf(HasSubstr("motion"), HasSubstr("animation moves the head")));
    EXPECT_THAT(refusal(R"({"model": "tressfx", "body": {"file": "a.gltf"}})"),
                HasSubstr("tressfx"));
}

TEST_F(SceneFile, sets_what_it_says) {
    const Scene scene = read(R"({
        "groom": "curly", "strands": 300, "vertices": 24, "seed": 7, "style": {"curl_radius": 0.02},
        "rate": 120, "seconds": 0.5, "substeps": 4,
        "params": {"groom": 0.25, "gravity": [0, -3.7, 1], "follow_form": "published"},
        "colliders": [{"a": [1, 2, 3], "radius_a": 0.5}],
        "camera": {"azimuth": -40, "target": [0, 1.5, 0]},
        "picture": {"width": 100, "hair_tip": [0.1, 0.2, 0.3]}, "pictures": false})");
    EXPECT_EQ(scene.groom.style.strands, 300u);
    EXPECT_EQ(scene.groom.style.vertices, 24u);
    EXPECT_EQ(scene.groom.style.seed, 7u);
    EXPECT_EQ(scene.groom.style.curl_radius, 0.02);
    EXPECT_EQ(scene.frames(), 60u);
    EXPECT_EQ(scene.sim.substeps, 4u);
    EXPECT_FLOAT_EQ(scene.sim.step, 1.0f / 120.0f);
    EXPECT_FLOAT_EQ(scene.sim.params.groom, 0.25f);
    EXPECT_FLOAT_EQ(scene.sim.params.gravity[1], -3.7f);
    EXPECT_EQ(scene.sim.params.follow_form, PLAIT_FOLLOW_FORM_PUBLISHED);
    ASSERT_EQ(scene.colliders->size(), 1u);
    EXPECT_FLOAT_EQ((*scene.colliders)[0].shape.capsule.b[2], 3.0f); // a sphere
    EXPECT_FLOAT_EQ((*scene.colliders)[0].shape.capsule.radius_b, 0.5f);
    EXPECT_FLOAT_EQ((*scene.camera.target)[1], 1.5f);
    EXPECT_FLOAT_EQ((*scene.pictures.hair_tip)[2], 0.3f);
    EXPECT_FALSE(scene.pictures.wanted);
}

TEST_F(SceneFile, yields_to_the_command_line) {
    const Scene scene = read(R"({"strands": 300, "seconds": 1})", {{"strands", 50}});
    EXPECT_EQ(scene.groom.style.strands, 50u);
    EXPECT_EQ(scene.seconds, 1.0f);
}

TEST_F(SceneFile, paths_are_relative_to_it) {
    EXPECT_EQ(read(R"({"groom": "hair/a.tfx"})").groom.name, path("hair/a.tfx"));
    EXPECT_EQ(read("{}", {{"groom", "hair/a.tfx"}}).groom.name, "hair/a.tfx");
}

TEST_F(SceneFile, unknown_keys_name_the_nearest) {
    EXPECT_THAT(refusal(R"({"strand": 5})"),
                AllOf(HasSubstr("scene.json"), HasSubstr("\"strands\"")));
    EXPECT_THAT(refusal(R"({"params": {"gravty": [0, 0, 0]}})"),
                AllOf(HasSubstr("params.gravty"), HasSubstr("\"gravity\"")));
    EXPECT_THAT(refusal(R"({"colliders": [{"a": [0, 0, 0], "radius_a": 1, "frction": 1}]})"),
                AllOf(HasSubstr("colliders[0].frction"), HasSubstr("\"friction\"")));
}

// The parser would keep the last and say nothing.
TEST_F(SceneFile, a_key_stands_once_in_its_object) {
    EXPECT_THAT(refusal("{\"rate\": 60,\n \"seconds\": 1,\n \"rate\": 30}"),
                HasSubstr("scene.json:3: rate stands here again, after line 1"));
    EXPECT_THAT(refusal("{\"params\": {\"drag\": 1,\n \"drag\": 1}}"),
                HasSubstr("scene.json:2: params.drag stands here again, after line 1"));
    EXPECT_THAT(refusal(R"({"colliders": [{"a": [0, 0, 0], "radius_a": 1},
        {"a": [0, 0, 0], "a": [0, 0, 0], "radius_a": 1}]})"),
                HasSubstr("scene.json:2: colliders[1].a stands here again"));
    EXPECT_EQ(read(R"({"colliders": [{"a": [0, 0, 0], "radius_a": 1}, {"a": [0, 0, 0],
        "radius_a": 2}]})")
                  .colliders->size(),
              2u);
}

TEST_F(SceneFile, scale_is_a_number_or_auto) {
    EXPECT_FLOAT_EQ(read(R"({"groom": "a.tfx", "scale": 0.01})").groom.scale, 0.01f);
    EXPECT_TRUE(read(R"({"groom": "a.tfx", "scale": "auto"})").groom.scale_by_size);
    EXPECT_THAT(refusal(R"({"scale": "cm"})"), HasSubstr("neither a number nor \"auto\""));
    EXPECT_THAT(refusal(R"({"scale": 0})"), HasSubstr("scale is 0"));
}

TEST_F(SceneFile, the_model_is_the_librarys_default) {
    EXPECT_EQ(read("{}").sim.model, plait::SimDesc().model);
}

TEST_F(SceneFile, colliders_are_planes_and_boxes_too) {
    const Scene scene = read(R"({"colliders": [
        {"plane": {"point": [0, -1, 0], "normal": [0, 3, 0]}, "friction": 0.5},
        {"box": {"centre": [1, 2, 3], "half_extents": [0.5, 0.1, 0], "rounding": 0.01,
                 "orientation": [0, 0.6, 0, 0.8]}, "moves_with_head": false}]})");
    const plait_collider_desc& plane = (*scene.colliders)[0].shape;
    EXPECT_EQ(plane.kind, PLAIT_COLLIDER_KIND_PLANE);
    EXPECT_FLOAT_EQ(plane.plane.point[1], -1.0f);
    EXPECT_FLOAT_EQ(plane.plane.normal[1], 3.0f);
    EXPECT_FLOAT_EQ(plane.friction, 0.5f);
    const plait_collider_desc& box = (*scene.colliders)[1].shape;
    EXPECT_EQ(box.kind, PLAIT_COLLIDER_KIND_BOX);
    EXPECT_FLOAT_EQ(box.box.centre[2], 3.0f);
    EXPECT_FLOAT_EQ(box.box.half_extents[1], 0.1f);
    EXPECT_FLOAT_EQ(box.box.rounding, 0.01f);
    EXPECT_FLOAT_EQ(box.box.orientation[3], 0.8f);
    EXPECT_FALSE((*scene.colliders)[1].moves_with_head);
}

TEST_F(SceneFile, moving_colliders_have_keyframes) {
    const Scene scene = read(R"({"moving_colliders": [{"a": [0, 1, 0], "radius_a": 0.03,
        "keyframes": [{"time": 0, "x": 1}, {"time": 0.5, "y": 2, "yaw": 90}]}]})");
    ASSERT_EQ(scene.moving_colliders.size(), 1u);
    EXPECT_FALSE(scene.colliders.has_value()) << "they come beside the others";
    ASSERT_EQ(scene.moving_colliders[0].keyframes.size(), 2u);
    EXPECT_FLOAT_EQ(scene.moving_colliders[0].keyframes[1].head.yaw, 90.0f);
    EXPECT_THAT(refusal(R"({"moving_colliders": [{"a": [0, 1, 0], "radius_a": 0.03}]})"),
                HasSubstr("moving_colliders[0].keyframes no keyframes"));
    EXPECT_THAT(refusal(R"({"moving_colliders": [{"a": [0, 1, 0], "radius_a": 0.03,
        "keyframes": [{"time": 1}, {"time": 1}]}]})"),
                HasSubstr("does not come after"));
}

TEST_F(SceneFile, values_are_refused_with_place_value_and_range) {
    EXPECT_THAT(refusal(R"({"substeps": 0})"),
                AllOf(HasSubstr("scene.json:1: substeps is 0"), HasSubstr("[1,1000]")));
    EXPECT_THAT(refusal(R"({"params": {"stiffness_ramp": [1, 2, 3]}})"),
                HasSubstr("not a list of 4 numbers"));
    EXPECT_THAT(refusal(R"({"params": {"gravity": [0, -20000, 0]}})"),
                AllOf(HasSubstr("params.gravity[1] is -20000"), HasSubstr("10000")));
    EXPECT_THAT(refusal(R"({"model": "tressfx", "params": {"wind": [0, 1]}})"),
                HasSubstr("a list of 3 numbers"));
    EXPECT_THAT(refusal(R"({"params": {"damping": 1}})"),
                HasSubstr("params.damping is of tressfx, which is off, or not one of the model's"));
    EXPECT_THAT(refusal(R"({"rate": 59.94})"), HasSubstr("not a whole number"));
    EXPECT_THAT(refusal(R"({"seed": -1})"), HasSubstr("seed is -1"));
    EXPECT_THAT(refusal(R"({"grid": "exakt"})"), HasSubstr("off, slots, exact"));
    EXPECT_THAT(refusal(R"({"style": {"lift": 3}})"), HasSubstr("lift"));
    EXPECT_THAT(refusal(R"({"colliders": [{"a": [0, 0, 0]}]})"),
                HasSubstr("colliders[0].radius_a is missing"));
    EXPECT_THAT(refusal(R"([1])"), HasSubstr("not an object"));
}

TEST_F(SceneFile, detail_is_of_strands_that_follow) {
    const Scene scene = read(R"({"guides": 50, "seed": 7,
        "detail": {"clump": [0, 0.5, 1, 1], "clumps": 9, "frizz_length": 0.03}})");
    ASSERT_TRUE(scene.detail);
    EXPECT_FLOAT_EQ(scene.detail->clump[1], 0.5f);
    EXPECT_EQ(scene.detail->clumps, 9u);
    EXPECT_FLOAT_EQ(scene.detail->frizz_length, 0.03f);
    EXPECT_EQ(scene.detail->seed, 7u);
    EXPECT_FALSE(read("{}").detail);
    EXPECT_THAT(refusal(R"({"detail": {}})"), HasSubstr("no strand follows"));
    EXPECT_THAT(refusal(R"({"compare_detail": [{"name": "plain"}]})"),
                HasSubstr("no strand follows"));
    EXPECT_THAT(refusal(R"({"guides": 50, "detail": {"clump": [0, 0, 0, 2]}})"),
                AllOf(HasSubstr("clump[3] is 2"), HasSubstr("1")));
    EXPECT_THAT(refusal(R"({"guides": 50, "detail": {"clumb": 1}})"), HasSubstr("clumb"));
    EXPECT_THAT(refusal(R"({"guides": 50, "compare_detail": [{"curl": [0, 0, 0, 0]}]})"),
                HasSubstr("name"));
}

TEST_F(SceneFile, what_falls_freely_settles_and_what_is_held_up_is_in_balance) {
    for (const char* groom : {"long", "curly"}) {
        const Scene scene = read(R"({"groom": ")" + std::string(groom) + R"("})");
        EXPECT_EQ(scene.sim.sag_free, PLAIT_SAG_FREE_OFF) << groom;
        EXPECT_GT(scene.settle, 0.0f) << groom;
    }
    for (const char* groom : {"braid", "short", "a.tfx"}) {
        const Scene scene = read(R"({"groom": ")" + std::string(groom) + R"("})");
        EXPECT_EQ(scene.sim.sag_free, PLAIT_SAG_FREE_STIFFEN) << groom;
        EXPECT_EQ(scene.settle, 0.0f) << groom;
    }
    EXPECT_EQ(read(R"({"groom": "braid", "model": "tressfx"})").sim.sag_free, PLAIT_SAG_FREE_OFF);
    EXPECT_EQ(read(R"({"settle": 0.5})").settle, 0.5f);
    EXPECT_THAT(refusal(R"({"settle": -1})"), AllOf(HasSubstr("settle"), HasSubstr("[0.0,60.0]")));
}

TEST_F(SceneFile, the_command_line_is_blamed_for_its_own) {
    EXPECT_THAT(refusal("{}", {{"strands", 0}}), HasSubstr("command line: strands is 0"));
}

TEST_F(SceneFile, grooms_are_styles_or_files) {
    EXPECT_THAT(refusal(R"({"groom": "lonng"})"), HasSubstr("long, braid, curly, short"));
    EXPECT_THAT(refusal(R"({"groom": "a.tfx", "style": {}})"), HasSubstr("a.tfx"));
}

TEST_F(SceneFile, syntax_errors_name_line_and_column) {
    EXPECT_THAT(refusal("{\n \"rate\": }"), AllOf(HasSubstr("scene.json"), HasSubstr("line 2")));
}

TEST_F(SceneFile, that_is_made_for_a_groom_says_which_and_where_it_is) {
    const std::string text = R"({
        "made_for": {"groom": "a.tfx", "from": "https://example.org/hair"}})";
    EXPECT_THAT(refusal(text), AllOf(HasSubstr("scene.json:2: made_for"), HasSubstr("a.tfx"),
                                     HasSubstr("https://example.org/hair"), HasSubstr("--groom")));
    EXPECT_EQ(read(text, {{"groom", "b.tfx"}}).groom.name, "b.tfx");
    EXPECT_EQ(read(text, {{"groom", "curly"}}).groom.name, "curly") << "whoever asks for it";
    EXPECT_THAT(refusal(R"({"made_for": {"groom": "a.tfx"}})"), HasSubstr("made_for.from"));
    EXPECT_THAT(refusal(R"({"made_for": {"groom": "a.tfx", "from": "b", "at": 1}})"),
                HasSubstr("made_for.at"));
    EXPECT_THAT(refusal(R"({"made_for": "a.tfx"})"), HasSubstr("made_for"));
}

// With the groom that they are made for, and refused without.
TEST(SceneFiles, of_the_repository_are_valid) {
    std::set<std::string> refused;
    size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PLAIT_SCENES)) {
        const std::string file = entry.path().string();
        const std::string refusal = refusal_of([&] { simulate::make_scene(file, Json::object()); });
        if (refusal != "no refusal") {
            EXPECT_THAT(refusal, AllOf(HasSubstr("made_for"), HasSubstr("https://")));
            EXPECT_NO_THROW(simulate::make_scene(file, {{"groom", "groom.tfx"}})) << file;
            refused.insert(entry.path().filename().string());
        }
        ++seen;
    }
    EXPECT_EQ(refused, (std::set<std::string>{"ratboy.json", "sintel.json"}));
    EXPECT_GT(seen, refused.size());
}

} // namespace
