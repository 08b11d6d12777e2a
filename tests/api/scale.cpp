// Hair that is larger or smaller than its groom: what keeps its shape, what goes along, what is refused.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace {

constexpr plait_model models[] = {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_TRESSFX};
constexpr size_t strands = 4, vertices = 12;
constexpr float length = 0.22f; // m, of a strand
const Point place = {0.4f, 1.1f, -0.3f};

plait_roots roots_at(float scale, Point t = place) {
    auto roots = head_at(t);
    roots.scale = scale;
    return roots;
}

plait_pose pose_at(Point t = place) {
    return {{0, 0, 0, 1}, {t[0], t[1], t[2]}};
}

// Under the hair, of which some comes to lie on it.
plait_collider_desc ball(Point at = place) {
    auto desc = smooth_collider();
    desc.capsule.a[0] = desc.capsule.b[0] = 0.09f;
    desc.capsule.a[1] = desc.capsule.b[1] = -0.06f;
    desc.capsule.b[2] = 0.03f;
    desc.capsule.radius_a = desc.capsule.radius_b = 0.05f;
    desc.pose = pose_at(at);
    return desc;
}

// Hair on a head at `place`, before its first step; roots are set.
struct Scene {
    using Change = std::function<void(plait::SimDesc&)>;
    Scene(const plait::Context& context, plait_model model, float of, const Change& change = {})
        : scale(of), sim(make(context, model, change)) {
        sim.set_roots(roots_at(scale, at));
    }
    // On a head that is so many times as far from the origin, too: the same to the bit, where that is a
    // power of two.
    void move_away() {
        for (float& x : at)
            x *= scale;
        sim.teleport(roots_at(scale, at));
    }
    static plait::Sim make(const plait::Context& context, plait_model model, const Change& change) {
        plait::SimDesc desc;
        desc.model = model;
        desc.keep_last_frame = 1;
        desc.follows_per_guide = 2;
        if (model == PLAIT_MODEL_TRESSFX) { // whose hair stretches, and is braked against the world
            desc.params.gravity[1] = -1;
            desc.tressfx.vsp_coeff = 0;
        } else {
            desc.params.drag = 4;
        }
        if (change)
            change(desc);
        return plait::Sim(context, make_groom(tuft(strands, vertices)), desc);
    }
    // Of all strands, seen from the head and in its size.
    std::vector<float> hair() const {
        auto own = sim.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < own.size(); ++i)
            if (i % 4 < 3)
                own[i] = (own[i] - at[i % 4]) / scale;
        return own;
    }
    void resize(float to) {
        scale = to;
        sim.set_roots(roots_at(to, at));
    }

    float scale;
    Point at = place; // of the head
    plait::Sim sim;
};

class Scale : public OnBackend {};
ON_EVERY_BACKEND(Scale);

void add_wind(plait::Sim& sim, plait_model model) {
    if (model == PLAIT_MODEL_TRESSFX) {
        auto desc = plait_tressfx_desc_defaults();
        desc.wind[0] = -0.5f;
        desc.wind[2] = 0.8f;
        sim.set_tressfx(&desc);
        return;
    }
    auto wind = plait_wind_desc_defaults();
    wind.velocity[0] = -0.5f;
    wind.velocity[2] = 0.8f;
    sim.set_wind(wind);
}

TEST_P(Scale, AtRestHairHasTheSameShape) {
    for (const plait_model model : models) {
        std::vector<float> expected;
        for (const float scale : {1.0f, 0.1f, 8.0f}) {
            Scene scene(context, model, scale);
            scene.move_away();
            scene.sim.create_collider(ball(scene.at));
            add_wind(scene.sim, model);
            run(scene.sim, 150);
            const auto hair = scene.hair();
            if (scale == 1)
                expected = hair;
            EXPECT_LT(largest_difference(hair, expected), 1e-4f * length)
                << "model " << model << " at " << scale;
            EXPECT_FLOAT_EQ(scene.sim.describe().scale, scale);
        }
    }
}

// The grid, volume and eddies go along; the eddies' places are the groom's, too.
TEST_P(Scale, GridAndAirGoAlong) {
    std::vector<float> expected;
    for (const float scale : {1.0f, 4.0f}) {
        Scene scene(context, PLAIT_MODEL_ARTICULATED, scale,
                    [](plait::SimDesc& desc) { desc.grid.on = true; });
        auto wind = plait_wind_desc_defaults();
        wind.velocity[2] = 1;
        scene.sim.set_wind(wind);
        run(scene.sim, 40);
        if (scale == 1)
            expected = scene.hair();
        EXPECT_LT(largest_difference(scene.hair(), expected), 1e-4f * length) << scale;
    }
}

TEST_P(Scale, AHeadThatMovesSoManyTimesAsFarMovesHairAlike) {
    const auto at = [](int step, float scale) {
        const float angle = 0.12f * static_cast<float>(step);
        return Point{scale * 0.06f * std::sin(angle), scale * 0.03f * (1 - std::cos(angle)), 0};
    };
    for (const plait_model model : models) {
        Scene one(context, model, 1), other(context, model, 8);
        for (Scene* scene : {&one, &other}) {
            scene->at = at(0, scene->scale);
            scene->sim.teleport(roots_at(scene->scale, scene->at));
            scene->sim.create_collider(ball(scene->at));
        }
        for (int step = 0; step < 60; ++step) {
            for (Scene* scene : {&one, &other}) {
                scene->at = at(step, scene->scale);
                scene->sim.set_roots(roots_at(scene->scale, scene->at));
                for (const plait_collider_id id : scene->sim.colliders())
                    scene->sim.set_collider_pose(id, pose_at(scene->at));
                scene->sim.step(frame);
            }
            ASSERT_LT(largest_difference(one.hair(), other.hair()), 2e-5f)
                << "model " << model << ", step " << step;
        }
        const auto slow = one.sim.read(PLAIT_FIELD_VELOCITY);
        auto fast = other.sim.read(PLAIT_FIELD_VELOCITY);
        for (float& v : fast)
            v /= 8;
        EXPECT_LT(largest_difference(slow, fast), 2e-3f);
        EXPECT_NEAR(other.sim.measure().max_speed / 8, one.sim.measure().max_speed, 2e-3f);
    }
}

// At once, and over half a second, in the air and on a body; beside hair whose scale stays.
TEST_P(Scale, ChangesWithoutAJump) {
    for (const plait_model model : models)
        for (const bool body : {false, true})
            for (const int frames : {1, 30}) {
                Scene scene(context, model, 1), stays(context, model, 1);
                for (Scene* each : {&scene, &stays}) {
                    if (body)
                        each->sim.create_collider(ball());
                    run(each->sim, 90);
                }
                for (int step = 1; step <= frames + (body ? 0 : 20); ++step) {
                    if (step <= frames)
                        scene.resize(1 + static_cast<float>(step) / static_cast<float>(frames));
                    scene.sim.step(frame);
                    stays.sim.step(frame);
                    // on a body hair still slides, and what is rounded anew tells later
                    ASSERT_LT(largest_difference(scene.hair(), stays.hair()), body ? 2e-5f : 1e-5f)
                        << "model " << model << ", " << frames << " frames, step " << step;
                    const auto hair = scene.sim.read(PLAIT_FIELD_POSITION);
                    const auto rest = scene.sim.read(PLAIT_FIELD_REST);
                    for (size_t strand = 0; strand < strands; ++strand)
                        for (size_t k = 0; k < 3; ++k) {
                            const size_t root = 4 * vertices * strand + k;
                            ASSERT_NEAR(hair[root], place[k] + scene.scale * rest[root], 1e-6f);
                        }
                }
            }
}

TEST_P(Scale, ATeleportAndAStepOfNoTimeTakeItAtOnce) {
    for (const plait_model model : models) {
        Scene scene(context, model, 1);
        run(scene.sim, 30);
        const auto before = scene.hair();
        scene.scale = 3;
        scene.at = {-7, 2, 5};
        scene.sim.teleport(roots_at(3, scene.at));
        EXPECT_LT(largest_difference(scene.hair(), before), 2e-6f);
        EXPECT_EQ(scene.sim.read(PLAIT_FIELD_POSITION),
                  scene.sim.read(PLAIT_FIELD_POSITION_LAST_FRAME));
        scene.resize(0.5f);
        scene.sim.step(0);
        EXPECT_LT(largest_difference(scene.hair(), before), 4e-6f);
    }
}

// A twentieth of the frames end between two steps.
TEST_P(Scale, HairBetweenStepsHasThePresentScale) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 1);
    for (int step = 1; step <= 40; ++step) {
        scene.resize(1 + 0.02f * static_cast<float>(step));
        scene.sim.step(0.7 * frame);
        const auto hair = scene.hair();
        const auto rest = scene.sim.read(PLAIT_FIELD_REST);
        for (size_t strand = 0; strand < strands && step > 1; ++strand)
            for (size_t k = 0; k < 3; ++k)
                ASSERT_NEAR(hair[4 * vertices * strand + k], rest[4 * vertices * strand + k], 1e-6f)
                    << step;
    }
}

float nearest(const std::vector<float>& hair, Point centre) {
    float least = std::numeric_limits<float>::max();
    for (size_t i = 0; i < hair.size(); i += 4)
        least = std::min(least, std::hypot(hair[i] - centre[0], hair[i + 1] - centre[1],
                                           hair[i + 2] - centre[2]));
    return least;
}

// Hair that falls on a sphere: it is as far from the centre as the radius is in the world then.
TEST_P(Scale, BodiesAreAsLargeAsTheRootsUnlessTheyKeepTheirSize) {
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

TEST_P(Scale, ABodyThatGoesWithTheHeadStaysAtItWhileItGrows) {
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

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

// A box under the hair: rigid, bent by positions that have the scale in them, and as a hull.
TEST_P(Scale, MeshesAndHullsGoAlong) {
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
TEST_P(Scale, AMeshThatBendsGrowsWithItsHead) {
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

TEST_P(Scale, RootsOnAMeshHaveTheirPlaceOnIt) {
    const auto mesh = make_mesh(box_mesh(0.05, 0.1, 0.1));
    auto posed = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (float& x : posed)
        x *= 3;
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 3);
    scene.sim.bind_roots(mesh);
    auto roots = roots_at(3);
    roots.mesh_positions = plait::view(posed, 3);
    scene.sim.teleport(roots);
    const auto hair = scene.hair(), rest = scene.sim.read(PLAIT_FIELD_REST);
    for (size_t i = 0; i < rest.size(); ++i)
        EXPECT_NEAR(hair[i], rest[i], 1e-5f);
}

TEST_P(Scale, AMirroredMeshIsRefused) {
    const auto mesh = make_mesh(ellipsoid_mesh(0.08, 0.1, 0.09, 24, 16));
    Strands around;
    for (const Point n : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{-0.6f, 0.8f, 0}})
        around.push_back(
            {{0.08f * n[0], 0.1f * n[1], 0.09f * n[2]}, {0.1f * n[0], 0.12f * n[1], 0.11f * n[2]}});
    plait::Sim sim(context, make_groom(around));
    sim.bind_roots(mesh);
    auto posed = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    auto roots = plait_roots_defaults();
    for (const float mirror : {1.0f, -1.0f}) {
        for (size_t i = 0; i < posed.size(); i += 3)
            posed[i] *= mirror;
        roots.mesh_positions = plait::view(posed, 3);
        EXPECT_EQ(plait_sim_set_roots(sim.get(), &roots),
                  mirror > 0 ? PLAIT_OK : PLAIT_INVALID_ARGUMENT);
    }
    EXPECT_NE(std::string(plait_last_error()).find("mesh_positions mirror the mesh"),
              std::string::npos)
        << plait_last_error();
}

TEST_P(Scale, PinsInTheWorldAreWhereTheyAre) {
    for (const float scale : {1.0f, 4.0f}) {
        Scene scene(context, PLAIT_MODEL_ARTICULATED, scale, [](plait::SimDesc&) {});
        plait_pin pin{};
        pin.vertex = vertices - 1;
        pin.frame = PLAIT_PIN_FRAME_WORLD;
        pin.stiffness = PLAIT_PIN_HELD;
        const Point hand = {place[0] + 0.1f * scale, place[1] + 0.05f * scale, place[2]};
        std::ranges::copy(hand, pin.target);
        scene.sim.set_pins({pin});
        run(scene.sim, 60);
        const auto hair = scene.sim.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(hair[4 * (vertices - 1) + k], hand[k], 1e-3f * scale);
    }
}

// A train that brakes, and is not felt.
TEST_P(Scale, AFrameCarriesHairAtAnyScale) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 1), stays(context, PLAIT_MODEL_ARTICULATED, 1);
    auto train = plait_frame_desc_defaults();
    run(stays.sim, 30);
    for (int step = 0; step < 30; ++step) {
        scene.sim.set_frame(train);
        scene.sim.step(frame);
    }
    float way = 0;
    for (int step = 1; step <= 30; ++step) {
        way += 0.01f * static_cast<float>(step % 10);
        scene.at[0] = place[0] + way;
        train.pose = pose_at({way, 0, 0});
        if (step % 2)
            scene.sim.set_frame(train);
        scene.resize(step < 10 ? 1 : 3);
        if (step % 2 == 0)
            scene.sim.set_frame(train);
        scene.sim.step(frame);
        stays.sim.step(frame);
        ASSERT_LT(largest_difference(scene.hair(), stays.hair()), 2e-5f) << step;
    }
}

TEST_P(Scale, WhatIsReadMayBeWritten) {
    for (const plait_model model : models) {
        Scene scene(context, model, 3);
        run(scene.sim, 10);
        const auto state = scene.sim.save();
        const auto before = scene.sim.hash();
        auto hair = scene.sim.read(PLAIT_FIELD_POSITION);
        hair.resize(4 * strands * vertices);
        scene.sim.write(PLAIT_FIELD_POSITION, hair);
        scene.sim.write(PLAIT_FIELD_POSITION_PREV, scene.sim.read(PLAIT_FIELD_POSITION_PREV));
        if (model == PLAIT_MODEL_TRESSFX) { // others find velocities again but for rounding
            EXPECT_EQ(scene.sim.hash(), before);
        }
        hair[4 * 5] += 0.3f; // m, a vertex put elsewhere
        scene.sim.write(PLAIT_FIELD_POSITION, hair);
        EXPECT_NEAR(scene.sim.read(PLAIT_FIELD_POSITION)[4 * 5], hair[4 * 5], 1e-6f);
        const std::vector<float> velocity(4 * strands * vertices, 1.5f);
        scene.sim.write(PLAIT_FIELD_VELOCITY, velocity);
        const auto moves = scene.sim.read(PLAIT_FIELD_VELOCITY);
        for (size_t i = 0; i < velocity.size(); ++i)
            EXPECT_NEAR(moves[i], i % 4 < 3 ? 1.5f : 0.0f, 2e-3f);
        const auto box = scene.sim.read(PLAIT_FIELD_BOUNDS);
        const auto now = scene.sim.read(PLAIT_FIELD_POSITION);
        float greatest = now[0];
        for (size_t i = 0; i < now.size(); i += 4)
            greatest = std::max(greatest, now[i]);
        EXPECT_EQ(box[4], greatest);
        scene.sim.restore(state);
        EXPECT_EQ(scene.sim.hash(), before);
    }
}

TEST_P(Scale, GoesOnFromASnapshot) {
    for (const plait_model model : models) {
        Scene scene(context, model, 1);
        scene.sim.create_collider(ball());
        run(scene.sim, 20);
        scene.resize(0.25f);
        run(scene.sim, 5);
        const auto state = scene.sim.save();
        Scene other(context, model, 1);
        other.scale = 0.25f;
        other.sim.restore(state);
        EXPECT_EQ(other.sim.describe().scale, 0.25f);
        EXPECT_EQ(other.sim.hash(), scene.sim.hash());
        run(scene.sim, 5);
        run(other.sim, 5);
        if (GetParam() == "reference") { // in float64, of which snapshots hold float32
            EXPECT_LT(largest_difference(other.hair(), scene.hair()), 1e-5f);
            continue;
        }
        EXPECT_EQ(other.sim.read(PLAIT_FIELD_POSITION), scene.sim.read(PLAIT_FIELD_POSITION));
        EXPECT_EQ(other.sim.hash(), scene.sim.hash());
    }
}

TEST_P(Scale, OfOneTakesNoStageAndAnotherOne) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 1,
                [](plait::SimDesc& desc) { desc.keep_last_frame = 0; });
    const auto has = [&] {
        for (const auto& [stage, calls] : stages_of(scene.sim))
            if (stage == "last_frame" && calls > 0)
                return true;
        return false;
    };
    EXPECT_FALSE(has());
    scene.resize(2);
    EXPECT_TRUE(has());
}

struct Skinned {
    explicit Skinned(const plait::Context& context) : sim(make(context)) {}
    static plait::Sim make(const plait::Context& context) {
        const GroomArrays arrays(tuft(2, 5));
        const std::vector<uint32_t> indices = {0, 1, 2, 0, 1, 0, 2, 0};
        const std::vector<float> weights = {1, 0, 0, 0, 0.5f, 0.25f, 0.25f, 0};
        auto desc = arrays.desc();
        desc.bone_indices = plait::view(indices, 4);
        desc.bone_weights = plait::view(weights, 4);
        return plait::Sim(context, plait::Groom(desc));
    }
    plait_result set(const std::array<float, 3>& of_bone, float scale = 1) {
        bones.assign(36, 0.0f);
        for (size_t bone = 0; bone < 3; ++bone)
            for (size_t k = 0; k < 3; ++k)
                bones[12 * bone + 5 * k] = bone == 1 ? of_bone[k] : all;
        for (size_t bone = 0; bone < 3; ++bone)
            for (size_t k = 0; k < 3; ++k)
                bones[12 * bone + 4 * k + 3] = at[k];
        roots = plait_roots_defaults();
        roots.bones = plait::view(bones, 12);
        roots.scale = scale;
        return plait_sim_set_roots(sim.get(), &roots);
    }
    float all = 1; // of the other bones
    Point at = {0, 0, 0};
    std::vector<float> bones;
    plait_roots roots{};
    plait::Sim sim;
};

TEST_P(Scale, BonesThatScaleAlikeScaleHair) {
    Skinned skinned(context);
    skinned.all = 8;
    ASSERT_EQ(skinned.set({8, 8, 8}), PLAIT_OK) << plait_last_error();
    EXPECT_EQ(skinned.sim.describe().scale, 8);
    auto rest = skinned.sim.read(PLAIT_FIELD_REST);
    for (size_t i = 0; i < rest.size(); ++i)
        rest[i] *= i % 4 < 3 ? 8.0f : 0.0f;
    auto hair = skinned.sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 3; i < hair.size(); i += 4)
        hair[i] = 0;
    EXPECT_LT(largest_difference(hair, rest), 1e-5f);
    ASSERT_EQ(skinned.set({8, 8, 8}, 0.5f), PLAIT_OK);
    EXPECT_EQ(skinned.sim.describe().scale, 4);
    skinned.all = 1.0f + 1e-6f; // a rotation that is rounded
    ASSERT_EQ(skinned.set({1, 1, 1}), PLAIT_OK);
    EXPECT_EQ(skinned.sim.describe().scale, 1);
}

// Far from the origin, by skinning matrices of the world.
TEST_P(Scale, ASkinThatGrowsInTheWorldThrowsNoHair) {
    Skinned scene(context), stays(context);
    scene.at = stays.at = {5, 1, -3};
    scene.set({1, 1, 1});
    stays.set({1, 1, 1});
    run(scene.sim, 60);
    run(stays.sim, 60);
    for (int step = 1; step <= 30; ++step) {
        scene.all = 1 + 0.1f * static_cast<float>(std::min(step, 20));
        if (step > 20) {
            scene.at[0] += 0.02f * scene.all;
            stays.at[0] += 0.02f;
        }
        scene.set({scene.all, scene.all, scene.all});
        stays.set({1, 1, 1});
        scene.sim.step(frame);
        stays.sim.step(frame);
        auto hair = scene.sim.read(PLAIT_FIELD_POSITION),
             other = stays.sim.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < hair.size(); ++i)
            if (i % 4 < 3) {
                hair[i] = (hair[i] - scene.at[i % 4]) / scene.all;
                other[i] -= stays.at[i % 4];
            }
        ASSERT_LT(largest_difference(hair, other), 2e-5f) << step;
    }
}

TEST_P(Scale, AMirroredSkinIsRefusedAndAnUnevenOneWarnedOf) {
    std::vector<std::string> said;
    auto desc = plait_context_desc_defaults();
    const std::string backend = GetParam();
    desc.backend = backend.c_str();
    desc.log_user = &said;
    desc.log = [](plait_log_level level, const char* text, void* user) {
        if (level >= PLAIT_LOG_LEVEL_WARNING)
            static_cast<std::vector<std::string>*>(user)->emplace_back(text);
    };
    const plait::Context own(desc);
    Skinned skinned(own);
    said.clear();
    EXPECT_EQ(skinned.set({-1, 1, 1}), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("bones[1] mirrors"), std::string::npos);
    ASSERT_EQ(skinned.set({1, 1.5f, 1}), PLAIT_OK);
    EXPECT_EQ(skinned.sim.describe().scale, 1) << "most bones are not scaled";
    ASSERT_EQ(skinned.set({1, 1.5f, 1}), PLAIT_OK);
    ASSERT_EQ(said.size(), 1u) << "said once";
    EXPECT_NE(said[0].find("bones[1] scales by 1.5, 1 and 1 along its axes, bones together by 1"),
              std::string::npos)
        << said[0];
}

TEST_P(Scale, WhatIsNoneIsRefused) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 2);
    run(scene.sim, 3);
    const auto before = scene.sim.hash();
    for (const float scale : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(), 9e-4f, 1001.0f}) {
        const auto roots = roots_at(scale);
        EXPECT_EQ(plait_sim_set_roots(scene.sim.get(), &roots), PLAIT_INVALID_ARGUMENT) << scale;
        EXPECT_NE(std::string(plait_last_error()).find("roots->scale is"), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(plait_sim_teleport(scene.sim.get(), &roots), PLAIT_INVALID_ARGUMENT) << scale;
        auto body = ball();
        body.scale = scale;
        plait_collider_id id{};
        if (scale != 0) {
            EXPECT_EQ(plait_collider_create(scene.sim.get(), &body, &id), PLAIT_INVALID_ARGUMENT);
            EXPECT_NE(std::string(plait_last_error()).find("scale is"), std::string::npos);
        }
    }
    EXPECT_EQ(scene.sim.hash(), before) << "what is refused changes nothing";
    Skinned skinned(context);
    skinned.all = 8;
    EXPECT_EQ(skinned.set({8, 8, 8}, 500), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("times that of roots->bones is 4000"),
              std::string::npos)
        << plait_last_error();
}

} // namespace
