// Colliders that are convex hulls: that of a box's corners is the box, one that moves carries hair, and
// what is no convex body is refused with what is wrong with it.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

class Hulls : public OnBackend {
  protected:
    bool is_reference() const { return GetParam() == "reference"; }
};
ON_EVERY_BACKEND(Hulls);

constexpr plait_model models[] = {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED};
constexpr double half[3] = {0.05, 0.02, 0.06}; // m

plait::SimDesc desc_of(plait_model model) {
    plait::SimDesc desc;
    desc.model = model;
    desc.substeps = 2;
    return desc;
}

// Turns about an axis of its own and moves: at frame i.
plait_pose pose_at(int i) {
    const float a = 0.006f * static_cast<float>(i);
    return {{0.36f * std::sin(a), 0.48f * std::sin(a), 0.8f * std::sin(a), std::cos(a)},
            {0.0002f * static_cast<float>(i), -0.06f, 0.0001f * static_cast<float>(i)}};
}

// Positions after so many frames of strands that fall onto what turns and moves.
template <typename Add> std::vector<float> after(plait::Sim& sim, int frames, const Add& add) {
    const plait_collider_id id = add(sim, pose_at(0));
    for (int i = 1; i <= frames; ++i) {
        sim.set_collider_pose(id, pose_at(i));
        sim.step(frame);
    }
    return sim.read(PLAIT_FIELD_POSITION);
}

// The same distance, normal and surface: until rounding decides where a vertex goes.
TEST_P(Hulls, OfABoxIsTheBox) {
    const auto mesh = make_mesh(box_mesh(half[0], half[1], half[2]));
    Strands strands;
    for (int s = 0; s < 6; ++s)
        strands.push_back(curl({-0.06f, 0.0f, -0.03f + 0.012f * static_cast<float>(s)}, 12));
    for (const plait_model model : models) {
        plait::Sim with_box(context, make_groom(strands), desc_of(model));
        plait::Sim with_hull(context, make_groom(strands), desc_of(model));
        plait::Sim with_none(context, make_groom(strands), desc_of(model));
        // from the tenth on, float32 decides otherwise of one vertex, by 0.05 mm
        const int frames = model == PLAIT_MODEL_ARTICULATED && !is_reference() ? 9 : 20;
        const auto on_box = after(with_box, frames, [](plait::Sim& sim, const plait_pose& pose) {
            auto box = smooth_collider();
            box.kind = PLAIT_COLLIDER_KIND_BOX;
            box.friction = 0.3f;
            for (size_t k = 0; k < 3; ++k)
                box.box.half_extents[k] = static_cast<float>(half[k]);
            box.pose = pose;
            return sim.create_collider(box);
        });
        const auto on_hull = after(with_hull, frames, [&](plait::Sim& sim, const plait_pose& pose) {
            auto hull = plait_collider_hull_desc_defaults();
            hull.pose = pose;
            return sim.create_hull(mesh, hull);
        });
        const auto free = after(with_none, frames, [&](plait::Sim& sim, const plait_pose&) {
            auto far = smooth_collider();
            far.capsule.a[1] = far.capsule.b[1] = 100;
            return sim.create_collider(far);
        });
        float most = 0, met = 0;
        for (size_t i = 0; i < on_box.size(); ++i) {
            most = std::max(most, std::abs(on_box[i] - on_hull[i]));
            met = std::max(met, std::abs(on_box[i] - free[i]));
        }
        EXPECT_LT(most, 1e-6f) << "model " << model;
        EXPECT_GT(met, 5e-3f) << "model " << model << " does not meet it";
    }
}

TEST_P(Hulls, AreDescribedAndKeepTheirShape) {
    plait::Sim sim(context, make_groom({curl({0, 0, 0}, 8)}), desc_of(PLAIT_MODEL_ARTICULATED));
    ShapeMesh shape = box_mesh(half[0], half[1], half[2]);
    for (auto& p : shape.positions)
        p[0] += 0.25f;
    auto hull = plait_collider_hull_desc_defaults();
    hull.margin = 0.01f;
    hull.friction = 0.7f;
    const auto id = sim.create_hull(make_mesh(shape), hull);
    const auto desc = sim.describe_collider(id);
    EXPECT_EQ(desc.kind, PLAIT_COLLIDER_KIND_HULL);
    EXPECT_EQ(desc.friction, 0.7f);
    EXPECT_EQ(desc.box.rounding, 0.01f);
    EXPECT_NEAR(desc.box.centre[0], 0.25f, 1e-6f);
    for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(desc.box.half_extents[k], half[k], 1e-6);
    const auto box = smooth_collider();
    EXPECT_EQ(plait_collider_set_shape(sim, id, &box), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("is a hull"), std::string::npos);
    EXPECT_EQ(plait_collider_create(sim, &desc, nullptr), PLAIT_INVALID_ARGUMENT);
}

// One restored goes on as it was, and several hulls do not take each other's faces.
TEST_P(Hulls, AreSaved) {
    const auto block = make_mesh(box_mesh(half[0], half[1], half[2]));
    const auto ball = make_mesh(ellipsoid_mesh(0.03, 0.02, 0.03, 8, 6));
    Strands strands;
    for (int s = 0; s < 4; ++s)
        strands.push_back(curl({-0.06f, 0.0f, -0.03f + 0.012f * static_cast<float>(s)}, 10));
    const auto make = [&] {
        return plait::Sim(context, make_groom(strands), desc_of(PLAIT_MODEL_ARTICULATED));
    };
    plait::Sim first = make(), second = make();
    auto gone = first.create_hull(ball);
    auto desc = plait_collider_hull_desc_defaults();
    desc.pose = pose_at(0);
    const auto id = first.create_hull(block, desc);
    desc.pose.t[0] = 0.1f;
    first.create_hull(ball, desc);
    first.destroy_collider(gone);
    run(first, 5);
    first.set_collider_pose(id, pose_at(3));
    const auto bytes = first.save();
    second.restore(bytes);
    EXPECT_EQ(first.hash(), second.hash());
    run(first, 5);
    run(second, 5);
    if (!is_reference()) { // whose float64 a snapshot rounds
        EXPECT_EQ(first.hash(), second.hash());
    }
    const auto on = first.read(PLAIT_FIELD_POSITION), too = second.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < on.size(); ++i)
        EXPECT_NEAR(on[i], too[i], 1e-5);
}

// ---- what is refused ---------------------------------------------------------------------------

std::string refused(plait::Sim& sim, const ShapeMesh& shape,
                    const plait_collider_hull_desc& desc = plait_collider_hull_desc_defaults()) {
    const auto mesh = make_mesh(shape);
    plait_collider_id id{};
    EXPECT_EQ(plait_collider_create_hull(sim, mesh, &desc, &id), PLAIT_INVALID_ARGUMENT);
    return plait_last_error();
}

bool says(const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos;
}

TEST_P(Hulls, SayWhatIsWrongWithAMesh) {
    plait::Sim sim(context, make_groom({curl({0, 0, 0}, 8)}), desc_of(PLAIT_MODEL_ARTICULATED));
    ShapeMesh open = box_mesh(0.1, 0.1, 0.1);
    open.triangles.pop_back();
    EXPECT_TRUE(says(refused(sim, open), "has 3 open edges")) << plait_last_error();

    ShapeMesh dented = box_mesh(0.1, 0.1, 0.1);
    dented.positions[7] = {0.02f, 0.02f, 0.02f};
    EXPECT_TRUE(says(refused(sim, dented), "is not convex: at the edge between the vertices"))
        << plait_last_error();

    ShapeMesh two = box_mesh(0.1, 0.1, 0.1), other = box_mesh(0.1, 0.1, 0.1);
    for (auto& p : other.positions)
        p[0] += 0.5f;
    two.add_mesh(other);
    EXPECT_TRUE(says(refused(sim, two), "is not convex: vertex")) << plait_last_error();

    EXPECT_TRUE(says(refused(sim, box_mesh(0.1, 1e-5, 0.1)), "is flat")) << plait_last_error();
    EXPECT_TRUE(says(refused(sim, box_mesh(2e3, 0.1, 0.1)), "range is (0, 2000] m"))
        << plait_last_error();
    const ShapeMesh ball = ellipsoid_mesh(0.1, 0.1, 0.1, 32, 24);
    EXPECT_TRUE(says(refused(sim, ball), "has more than 256 faces")) << plait_last_error();
    auto coarse = plait_collider_hull_desc_defaults();
    coarse.tolerance = 0.02f;
    EXPECT_NO_THROW(sim.create_hull(make_mesh(ball), coarse));

    auto desc = plait_collider_hull_desc_defaults();
    const ShapeMesh good = box_mesh(0.1, 0.1, 0.1);
    desc.margin = -1;
    EXPECT_TRUE(says(refused(sim, good, desc), "margin is -1")) << plait_last_error();
    desc = plait_collider_hull_desc_defaults();
    desc.friction = 11;
    EXPECT_TRUE(says(refused(sim, good, desc), "friction is 11")) << plait_last_error();
    desc = plait_collider_hull_desc_defaults();
    desc.tolerance = 0;
    EXPECT_TRUE(says(refused(sim, good, desc), "tolerance is 0")) << plait_last_error();
    desc = plait_collider_hull_desc_defaults();
    desc.pose.t[1] = INFINITY;
    EXPECT_TRUE(says(refused(sim, good, desc), "desc->pose")) << plait_last_error();
    EXPECT_EQ(sim.colliders().size(), 1u); // that of the coarse ball
}

// A slightly dented face, of triangles a tenth of the tolerance off their plane, is one face that holds
// all of them.
TEST_P(Hulls, TakeTrianglesOfOnePlaneTogether) {
    plait::Sim sim(context, make_groom({curl({0, 0, 0}, 8)}), desc_of(PLAIT_MODEL_ARTICULATED));
    ShapeMesh shape = box_mesh(0.1, 0.1, 0.1);
    shape.positions[7][0] += 3e-6f;
    EXPECT_NO_THROW(sim.create_hull(make_mesh(shape)));
    auto strict = plait_collider_hull_desc_defaults();
    strict.tolerance = 1e-6f;
    shape.positions[7] = {0.0999f, 0.0999f, 0.1f};
    EXPECT_TRUE(says(refused(sim, shape, strict), "is not convex")) << plait_last_error();
}

} // namespace
