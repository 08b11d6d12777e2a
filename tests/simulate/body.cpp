// A body that its animation moves: keys, bones, and what is said about a file that does not fit.
#include "scene/body.hpp"
#include "assimp.hpp"
#include "support.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

using namespace simulate;
using Eigen::Quaternionf, Eigen::Vector3f;
using testing::AllOf;
using testing::HasSubstr;

namespace {

Quaternionf about_y(float angle) {
    return Quaternionf(Eigen::AngleAxisf(angle, Vector3f::UnitY()));
}

TEST(Keys, are_joined_by_lines_and_held_outside) {
    const std::vector<Key<Vector3f>> keys{{1, {0, 0, 0}}, {2, {4, 0, 0}}, {4, {4, 8, 0}}};
    EXPECT_EQ(sample(keys, 0), Vector3f(0, 0, 0));
    EXPECT_EQ(sample(keys, 1), Vector3f(0, 0, 0));
    EXPECT_EQ(sample(keys, 1.25f), Vector3f(1, 0, 0));
    EXPECT_EQ(sample(keys, 2), Vector3f(4, 0, 0));
    EXPECT_EQ(sample(keys, 3.5f), Vector3f(4, 6, 0));
    EXPECT_EQ(sample(keys, 9), Vector3f(4, 8, 0));
}

TEST(Keys, of_turns_go_the_shorter_way_at_an_even_rate) {
    Quaternionf to = about_y(1.6f);
    to.coeffs() *= -1; // the same turn
    const std::vector<Key<Quaternionf>> keys{{0, about_y(0)}, {1, to}};
    for (const float time : {0.0f, 0.25f, 0.5f, 1.0f})
        EXPECT_NEAR(sample(keys, time).angularDistance(about_y(1.6f * time)), 0, 1e-3) << time;
}

class BodyOfCharacter : public TemporaryFolder {
  protected:
    BodyChoice choice() const {
        BodyChoice choice;
        choice.mesh.file = PLAIT_SCENES "/../character.gltf";
        choice.mesh.place = "scene.json:3: body.file";
        choice.mesh.desc.form = PLAIT_MESH_FORM_NEAREST;
        choice.animation_place = "scene.json:3: body.animation";
        choice.bone_place = "scene.json:3: body.bone";
        return choice;
    }
};

float angle_of(const plait_pose& pose) {
    return 2 * std::acos(std::min(1.0f, std::abs(pose.q[3]))) * 180 / std::numbers::pi_v<float>;
}

TEST_F(BodyOfCharacter, moves_as_its_animation_says) {
    SKIP_WITHOUT_ASSIMP();
    const Body body(choice(), true);
    EXPECT_EQ(body.motion(), "walk of character.gltf");
    const auto& rest = body.mesh().shape.vertices;
    const auto at = [&](float time) { return body.positions(time); };
    ASSERT_EQ(at(0).size(), rest.size());
    for (size_t i = 0; i < rest.size(); ++i) // it begins at rest
        EXPECT_LT((Vector3f(at(0)[i].data()) - rest[i]).norm(), 1e-6f) << i;
    EXPECT_NEAR(angle_of(body.head(0)), 0, 1e-3);
    // The neck's share and the head's of half a turn whose tangent is 0.36, each by its own.
    const double expected =
        2 * (std::atan(0.35 * 0.36) + std::atan(0.65 * 0.36)) * 180 / std::numbers::pi;
    EXPECT_NEAR(angle_of(body.head(1.1f)), expected, 0.1) << "to one side";
    EXPECT_GT(body.head(1.1f).q[1], 0);
    EXPECT_NEAR(angle_of(body.head(2.2f)), expected, 0.1) << "to the other";
    EXPECT_LT(body.head(2.2f).q[1], 0);
    EXPECT_NEAR(body.head(0.25f).t[1], 0.02, 1e-3) << "lifted by a step";
}

TEST_F(BodyOfCharacter, begins_again_after_its_end) {
    SKIP_WITHOUT_ASSIMP();
    const Body body(choice(), true);
    for (const float time : {0.3f, 1.1f, 2.7f}) {
        const plait_pose once = body.head(time), again = body.head(time + 8);
        for (int k = 0; k < 4; ++k)
            EXPECT_NEAR(once.q[k], again.q[k], 1e-4);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(once.t[k], again.t[k], 1e-5);
    }
}

// What is the head bone's alone, where hair grows, goes rigidly with it; the shoulders stay.
TEST_F(BodyOfCharacter, carries_the_scalp_with_the_head) {
    SKIP_WITHOUT_ASSIMP();
    const Body body(choice(), true);
    const auto& rest = body.mesh().shape;
    const float time = 1.1f;
    const plait_pose head = body.head(time);
    const Quaternionf turn(head.q[3], head.q[0], head.q[1], head.q[2]);
    const auto posed = body.positions(time);
    size_t scalp = 0, shoulders = 0;
    for (size_t i = 0; i < posed.size(); ++i) {
        const Vector3f p(posed[i].data()), from = rest.vertices[i];
        if (rest.scalp[i] > 0) {
            ++scalp;
            EXPECT_LT((turn * from + Vector3f(head.t) - p).norm(), 1e-5f) << i;
        }
        if (from.y() < -0.26f) {
            ++shoulders;
            EXPECT_LT(std::hypot(p.x() - from.x(), p.z() - from.z()), 1e-5f) << i;
        }
    }
    EXPECT_GT(scalp, 100u);
    EXPECT_GT(shoulders, 50u);
}

TEST_F(BodyOfCharacter, is_scaled_with_its_motion) {
    SKIP_WITHOUT_ASSIMP();
    BodyChoice twice = choice();
    twice.mesh.scale = 2;
    const Body body(choice(), true), large(twice, true);
    const auto a = body.positions(1.1f), b = large.positions(1.1f);
    for (size_t i = 0; i < a.size(); ++i)
        EXPECT_LT((2 * Vector3f(a[i].data()) - Vector3f(b[i].data())).norm(), 1e-5f);
    EXPECT_NEAR(large.head(0.25f).t[1], 0.04, 2e-3);
}

TEST_F(BodyOfCharacter, is_refused_where_the_file_has_no_such_thing) {
    SKIP_WITHOUT_ASSIMP();
    const auto refusal = [](const BodyChoice& choice) {
        return refusal_of([&] { Body(choice, true); });
    };
    BodyChoice bad = choice();
    bad.animation = 1u;
    EXPECT_THAT(refusal(bad), AllOf(HasSubstr("scene.json:3: body.animation is 1, range is [0, 0]"),
                                    HasSubstr("character.gltf")));
    bad.animation = std::string("wlak");
    EXPECT_THAT(refusal(bad), HasSubstr("the nearest is \"walk\""));
    bad = choice();
    bad.bone = "haed";
    EXPECT_THAT(refusal(bad), AllOf(HasSubstr("scene.json:3: body.bone is \"haed\""),
                                    HasSubstr("the nearest is \"head\"")));
    bad.bone = "HEAD";
    EXPECT_EQ(refusal(bad), "no refusal");
    bad = choice();
    bad.mesh.file = PLAIT_SCENES "/../head.obj";
    EXPECT_THAT(refusal(bad), HasSubstr("has no animation"));
    bad.mesh.file = PLAIT_SCENES "/../nobody.gltf";
    EXPECT_THAT(refusal(bad), AllOf(HasSubstr("scene.json:3: body.file"), HasSubstr("nobody")));
}

} // namespace
