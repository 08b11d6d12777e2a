// Bodies of hair that is larger or smaller than its groom: what goes along, what keeps its size.
#include "mesh_shapes.hpp"
#include "scale_scenes.hpp"

#include <algorithm>
#include <limits>

namespace {

using namespace scaled;

class ScaleOfBodies : public OnBackend {};
ON_EVERY_BACKEND(ScaleOfBodies);

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

float nearest(const std::vector<float>& hair, Point centre) {
    float least = std::numeric_limits<float>::max();
    for (size_t i = 0; i < hair.size(); i += 4)
        least = std::min(least, std::hypot(hair[i] - centre[0], hair[i + 1] - centre[1],
                                           hair[i + 2] - centre[2]));
    return least;
}

// Hair that falls on a sphere: it is as far from the centre as the radius is in the world then.
TEST_P(ScaleOfBodies, BodiesAreAsLargeAsTheRootsUnlessTheyKeepTheirSize) {
    for (const plait_model model : models)
        for (const float own : {0.0f, 1.0f, 2.5f})
            for (const float scale : {1.0f, 3.0f, 0.5f}) {
                Scene scene(context, model, scale, [](plait::SimDesc& desc) {
                    desc.follows_per_guide = 0;
                    desc.params.gravity[1] = -9.81f;
                    desc.tressfx.global_stiffness = desc.tressfx.local_stiffness = 0;
                });
                auto desc = smooth_collider();
                desc.capsule.radius_a = desc.capsule.radius_b = 0.3f;
                desc.scale = own;
                const float radius = 0.3f * (own == 0 ? scale : own);
                const Point centre = {place[0] + 0.1f * scale, place[1] - 0.02f * scale - radius,
                                      place[2]};
                desc.pose = pose_at(centre);
                const auto id = scene.sim.create_collider(desc);
                EXPECT_EQ(scene.sim.describe_collider(id).scale, own);
                EXPECT_EQ(scene.sim.describe_collider(id).pose.t[1], centre[1]);
                run(scene.sim, 60);
                const float least = nearest(scene.sim.read(PLAIT_FIELD_POSITION), centre);
                EXPECT_NEAR(least, radius, 1e-3f * scale)
                    << "model " << model << ", scale " << scale << ", of the body " << own;
            }
}

TEST_P(ScaleOfBodies, ABodyThatGoesWithTheHeadStaysAtItWhileItGrows) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 1), stays(context, PLAIT_MODEL_ARTICULATED, 1);
    auto desc = ball(); // whose place is said by its pose
    const Point beside = {0.09f, -0.06f, 0.0f};
    std::fill_n(desc.capsule.a, 3, 0.0f);
    std::fill_n(desc.capsule.b, 3, 0.0f);
    const auto at = [&](float scale) {
        return pose_at({place[0] + scale * beside[0], place[1] + scale * beside[1], place[2]});
    };
    desc.pose = at(1);
    const auto id = scene.sim.create_collider(desc);
    stays.sim.create_collider(desc);
    run(scene.sim, 60);
    run(stays.sim, 60);
    for (int step = 1; step <= 30; ++step) {
        const float scale = 1 + 0.1f * static_cast<float>(step);
        if (step % 2 == 0) // in either order
            scene.sim.set_collider_pose(id, at(scale));
        scene.resize(scale);
        if (step % 2 == 1)
            scene.sim.set_collider_pose(id, at(scale));
        scene.sim.step(frame);
        stays.sim.step(frame);
        ASSERT_LT(largest_difference(scene.hair(), stays.hair()), 2e-5f) << step;
    }
}

// A box under the hair: rigid, bent by positions that have the scale in them, and as a hull.
TEST_P(ScaleOfBodies, MeshesAndHullsGoAlong) {
    const auto mesh = make_mesh(box_mesh(0.08, 0.02, 0.06));
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (const char* kind : {"field", "nearest", "posed", "hull"}) {
        const std::string name = kind;
        std::vector<float> expected;
        for (const float scale : {1.0f, 4.0f}) {
            Scene scene(context, PLAIT_MODEL_ARTICULATED, scale);
            scene.move_away();
            const Point under = {scene.at[0] + 0.1f * scale, scene.at[1] - 0.06f * scale,
                                 scene.at[2]};
            plait_collider_id id{};
            if (name == "hull") {
                auto desc = plait_collider_hull_desc_defaults();
                desc.margin = 0.002f;
                desc.pose = pose_at(under);
                id = scene.sim.create_hull(mesh, desc);
            } else {
                auto desc = plait_collider_mesh_desc_defaults();
                desc.form = name == "field" ? PLAIT_MESH_FORM_FIELD : PLAIT_MESH_FORM_NEAREST;
                desc.pose = pose_at(under);
                id = scene.sim.create_collider(mesh, desc);
            }
            for (int step = 1; step <= 60; ++step) {
                if (name == "posed") {
                    std::vector<float> posed = rest;
                    for (size_t i = 0; i < posed.size(); ++i)
                        posed[i] *=
                            scale * (i % 3 == 1 ? 1 + 0.005f * static_cast<float>(step) : 1);
                    scene.sim.set_collider_positions(id, plait::view(posed, 3));
                }
                scene.sim.step(frame);
            }
            if (scale == 1)
                expected = scene.hair();
            EXPECT_LT(largest_difference(scene.hair(), expected), 1e-4f * length) << kind;
        }
    }
}

// Positions that were set stay, as large as the roots are.
TEST_P(ScaleOfBodies, AMeshThatBendsGrowsWithItsHead) {
    const auto mesh = make_mesh(box_mesh(0.08, 0.02, 0.06));
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (const bool poses : {false, true}) {
        Scene scene(context, PLAIT_MODEL_ARTICULATED, 1),
            stays(context, PLAIT_MODEL_ARTICULATED, 1);
        auto desc = plait_collider_mesh_desc_defaults();
        desc.form = PLAIT_MESH_FORM_NEAREST;
        const auto under = [&](float scale) {
            return pose_at({place[0] + 0.1f * scale, place[1] - 0.06f * scale, place[2]});
        };
        desc.pose = under(1);
        const auto id = scene.sim.create_collider(mesh, desc),
                   other = stays.sim.create_collider(mesh, desc);
        scene.sim.set_collider_positions(id, plait::view(rest, 3));
        stays.sim.set_collider_positions(other, plait::view(rest, 3));
        run(scene.sim, 60);
        run(stays.sim, 60);
        for (int step = 1; step <= 20; ++step) {
            const float scale = 1 + 0.05f * static_cast<float>(step);
            std::vector<float> posed = rest;
            for (float& x : posed)
                x *= scale;
            if (poses)
                scene.sim.set_collider_positions(id, plait::view(posed, 3));
            scene.resize(scale);
            scene.sim.set_collider_pose(id, under(scale));
            scene.sim.step(frame);
            stays.sim.step(frame);
            ASSERT_LT(largest_difference(scene.hair(), stays.hair()), 2e-5f) << step;
        }
    }
}

} // namespace
