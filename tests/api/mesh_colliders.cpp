// Colliders that are meshes: hair stays out of them, rests as it was groomed, and pays nothing where
// there are none.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>

namespace {

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

plait::SimDesc desc_of() {
    plait::SimDesc desc;
    return desc;
}

constexpr std::array<double, 3> head = {0.08, 0.1, 0.09}; // m, half axes

ShapeMesh head_mesh() {
    return ellipsoid_mesh(head[0], head[1], head[2], 32, 20);
}

// About how far a point is outside of the head, m.
double outside(const float* p) {
    const double x = double(p[0]) / head[0], y = double(p[1]) / head[1], z = double(p[2]) / head[2];
    const double size = std::sqrt(x * x + y * y + z * z);
    const double slope = std::sqrt(x * x / (head[0] * head[0]) + y * y / (head[1] * head[1]) +
                                   z * z / (head[2] * head[2]));
    return (size - 1) * size / slope;
}

// Strands on the upper half, laid along it from their roots on, 1 mm inside to 4 mm outside.
Strands groom_on_head(size_t strands, size_t vertices) {
    Strands groom;
    for (size_t s = 0; s < strands; ++s) {
        const double around = full_turn * 0.618 * double(s),
                     down = 0.2 + 0.8 * double(s) / double(strands);
        Strand strand;
        for (size_t i = 0; i < vertices; ++i) {
            const double b = down + 0.09 * double(i);
            const double out = 1 + (double(i) * 0.003 - 0.012 + 0.004 * std::sin(3.0 * double(i)));
            strand.push_back({static_cast<float>(out * head[0] * std::sin(b) * std::cos(around)),
                              static_cast<float>(out * head[1] * std::cos(b)),
                              static_cast<float>(out * head[2] * std::sin(b) * std::sin(around))});
        }
        groom.push_back(strand);
    }
    return groom;
}

class MeshColliders : public OnBackend {};
ON_EVERY_BACKEND(MeshColliders);

TEST_P(MeshColliders, HairFallsOnAMeshAndStaysOutside) {
    const auto mesh = make_mesh(head_mesh());
    Strands above;
    for (int i = 0; i < 6; ++i)
        above.push_back(curl({-0.13f, 0.12f, -0.03f + 0.012f * static_cast<float>(i)}, 14));
    auto desc = desc_of();
    desc.substeps = 2;
    plait::Sim sim(context, make_groom(above), desc);
    auto collider = plait_collider_mesh_desc_defaults();
    collider.margin = 1e-3f;
    sim.create_collider(mesh, collider);
    run(sim, GetParam() == "reference" ? 40 : 120);
    const auto p = sim.read(PLAIT_FIELD_POSITION);
    double least = 1;
    for (size_t i = 0; i < p.size(); i += 4)
        least = std::min(least, outside(&p[i]));
    EXPECT_GT(least, -1.5e-3); // the ball of triangles lies within
    EXPECT_LT(least, 3e-3);
}

// Against the same hair without a mesh: at 1.6 m float32 moves it by itself.
TEST_P(MeshColliders, HairAtRestIsNotPushed) {
    const auto mesh = make_mesh(head_mesh());
    const auto groom = make_groom(groom_on_head(9, 12));
    const double length = double(groom.describe().mean_length);
    const auto pose = head_at({0.3f, 1.6f, -0.2f}, {0.1826f, 0.3651f, 0.5477f, 0.7303f});
    for (const bool moved : {false, true}) {
        auto desc = desc_of();
        std::fill_n(desc.params.gravity, 3, 0.0f);
        const auto rested = [&](bool with) {
            plait::Sim sim(context, groom, desc);
            auto collider = plait_collider_mesh_desc_defaults();
            if (moved) {
                sim.teleport(pose);
                collider.pose = pose.head;
            }
            if (with)
                sim.create_collider(mesh, collider);
            run(sim, GetParam() == "reference" ? 20 : 100);
            return sim.read(PLAIT_FIELD_POSITION);
        };
        const auto with = rested(true), without = rested(false);
        EXPECT_LT(double(largest_difference(with, without)), 1e-6 * length)
            << (moved ? "moved" : "");
        const auto groomed = groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
        double most = 0; // off the groom, which the reference keeps to the last digit
        for (size_t i = 0; i < groomed.size() && !moved; ++i)
            most = std::max(most, double(std::abs(with[i / 3 * 4 + i % 3] - groomed[i])));
        EXPECT_LT(most, GetParam() == "reference" ? 1e-6 * length : 5e-5);
    }
}

// And without a clearance it is: the margin is farther out than the hair.
TEST_P(MeshColliders, WithoutClearanceItIs) {
    const auto mesh = make_mesh(head_mesh());
    plait::SimDesc desc;
    std::fill_n(desc.params.gravity, 3, 0.0f);
    plait::Sim sim(context, make_groom(groom_on_head(9, 12)), desc);
    auto collider = plait_collider_mesh_desc_defaults();
    collider.margin = 2e-3f;
    collider.clearance = 0;
    sim.create_collider(mesh, collider);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    run(sim, 20);
    EXPECT_GT(largest_difference(sim.read(PLAIT_FIELD_POSITION), before), 5e-4f);
}

TEST_P(MeshColliders, WhatIsFarOrGoneChangesNoBit) {
    const auto mesh = make_mesh(head_mesh());
    const auto positions = [&](int what) {
        plait::Sim sim(context, make_groom(tuft(3, 9)), desc_of());
        auto near = smooth_collider();
        near.pose.t[0] = 0.05f;
        near.pose.t[1] = -0.16f;
        near.capsule.radius_a = near.capsule.radius_b = 0.05f;
        sim.create_collider(near);
        if (what > 0) {
            auto far = plait_collider_mesh_desc_defaults();
            far.pose.t[1] = 5;
            const auto id = sim.create_collider(mesh, far);
            if (what > 1)
                sim.destroy_collider(id);
        }
        run(sim, 12);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    const auto none = positions(0);
    EXPECT_EQ(positions(1), none) << "far";
    EXPECT_EQ(positions(2), none) << "gone";
}

TEST_P(MeshColliders, NothingIsScheduledWithoutThem) {
    auto desc = plait_context_desc_defaults();
    const std::string backend = GetParam();
    desc.backend = backend.c_str();
    desc.profile = 1;
    const plait::Context profiled(desc);
    plait::Sim sim(profiled, make_groom(tuft(3, 9)));
    const auto none = stages_of(sim);
    const auto bytes = sim.describe().device_bytes;
    const auto id = sim.create_collider(make_mesh(head_mesh()));
    sim.take_launches();
    run(sim, 2);
    const auto with = launched_stages(sim);
    EXPECT_EQ(std::ranges::count(with, "mesh_field"), 2);
    EXPECT_GT(sim.describe().device_bytes, bytes);
    sim.destroy_collider(id);
    for (const auto& [stage, calls] : none)
        EXPECT_NE(stage, "mesh_field");
    sim.take_launches();
    run(sim, 2);
    EXPECT_EQ(std::ranges::count(launched_stages(sim), "mesh_field"), 0);
}

TEST_P(MeshColliders, SeveralAtOnceMoveAndPushHair) {
    const auto mesh = make_mesh(head_mesh());
    plait::Sim sim(context, make_groom(tuft(4, 9)));
    auto desc = plait_collider_mesh_desc_defaults();
    std::vector<plait_collider_id> ids;
    for (const float side : {-1.0f, 1.0f}) {
        desc.pose.t[0] = 0.08f;
        desc.pose.t[2] = 0.3f * side;
        ids.push_back(sim.create_collider(mesh, desc));
    }
    for (int i = 1; i <= 20; ++i) // from both sides towards the hair
        for (size_t k = 0; k < 2; ++k) {
            desc.pose.t[2] = (0.3f - 0.009f * static_cast<float>(i)) * (k == 0 ? -1.0f : 1.0f);
            sim.set_collider_pose(ids[k], desc.pose);
            if (k == 1)
                sim.step(frame);
        }
    const auto p = sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < p.size(); i += 4)
        for (const float z : {-0.12f, 0.12f}) {
            const float own[3] = {p[i] - 0.08f, p[i + 1], p[i + 2] - z};
            EXPECT_GT(outside(own), -2e-3) << "vertex " << i / 4;
        }
}

TEST_P(MeshColliders, SnapshotsHoldThem) {
    const auto groom = make_groom(groom_on_head(5, 10));
    plait::Sim sim(context, groom, desc_of()), other(context, groom, desc_of());
    {
        const auto mesh = make_mesh(head_mesh());
        auto desc = plait_collider_mesh_desc_defaults();
        desc.cells = 24;
        sim.destroy_collider(sim.create_collider(mesh, desc));
        const auto id = sim.create_collider(mesh, desc);
        desc.pose.t[0] = 0.01f;
        sim.set_collider_pose(id, desc.pose);
    }
    run(sim, 5);
    const auto bytes = sim.save();
    sim.restore(bytes); // the reference has more digits than a snapshot
    other.restore(bytes);
    EXPECT_EQ(other.save(), bytes);
    EXPECT_EQ(other.colliders().size(), 1u);
    run(sim, 5);
    run(other, 5);
    EXPECT_EQ(sim.hash(), other.hash());
    plait::Sim plain(context, groom, desc_of());
    sim.restore(plain.save()); // and none
    EXPECT_TRUE(sim.colliders().empty());
    EXPECT_EQ(sim.hash(), plain.hash());
    run(sim, 2);
}

TEST_P(MeshColliders, AreDescribedListedAndKeepTheirShape) {
    const auto mesh = make_mesh(head_mesh());
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    auto desc = plait_collider_mesh_desc_defaults();
    desc.friction = 0.7f;
    desc.pose.t[2] = 0.4f;
    const auto ball = sim.create_collider(smooth_collider());
    const auto id = sim.create_collider(mesh, desc);
    EXPECT_EQ(sim.colliders().size(), 2u);
    const auto info = sim.describe_collider(id);
    EXPECT_EQ(info.kind, PLAIT_COLLIDER_KIND_MESH);
    EXPECT_EQ(info.friction, 0.7f);
    EXPECT_EQ(info.pose.t[2], 0.4f);
    const auto shape = smooth_collider();
    EXPECT_EQ(plait_collider_set_shape(sim, id, &shape), PLAIT_INVALID_STATE);
    sim.destroy_collider(ball);
    run(sim, 2);
    sim.destroy_collider(id);
    EXPECT_EQ(plait_collider_set_pose(sim, id, &desc.pose), PLAIT_NOT_FOUND);
    run(sim, 2);
}

TEST_P(MeshColliders, WhatCannotBeIsRefused) {
    const auto closed = make_mesh(head_mesh()), open = make_mesh(sheet_mesh(0.1));
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    const auto refused = [&](plait_sim* of, const plait::Mesh& mesh,
                             const plait_collider_mesh_desc& desc, const std::string& part) {
        plait_collider_id id{};
        const plait_result code = plait_collider_create_mesh(of, mesh, &desc, &id);
        EXPECT_EQ(id.value, 0u);
        EXPECT_NE(std::string(plait_last_error()).find(part), std::string::npos)
            << plait_last_error();
        return code;
    };
    auto desc = plait_collider_mesh_desc_defaults();
    EXPECT_EQ(refused(sim, open, desc, "4 open edges"), PLAIT_INVALID_ARGUMENT);
    desc.two_sided = 1;
    sim.destroy_collider(sim.create_collider(open, desc));
    desc.cells = 7;
    EXPECT_EQ(refused(sim, closed, desc, "cells is 7, range is [8, 256]"), PLAIT_INVALID_ARGUMENT);
    desc = plait_collider_mesh_desc_defaults();
    desc.margin = 0.06f;
    EXPECT_EQ(refused(sim, closed, desc, "margin is 0.06, range is [0, 0.05]"),
              PLAIT_INVALID_ARGUMENT);
    desc = plait_collider_mesh_desc_defaults();
    desc.friction = NAN;
    EXPECT_EQ(refused(sim, closed, desc, "friction is nan"), PLAIT_INVALID_ARGUMENT);
    desc = plait_collider_mesh_desc_defaults();
    desc.clearance = 2;
    EXPECT_EQ(refused(sim, closed, desc, "clearance is 2"), PLAIT_INVALID_ARGUMENT);
    desc = plait_collider_mesh_desc_defaults();
    desc.pose.q[3] = 2;
    EXPECT_EQ(refused(sim, closed, desc, "quaternion norm"), PLAIT_INVALID_ARGUMENT);
    desc = plait_collider_mesh_desc_defaults();
    plait::Sim parity(context, make_groom(tuft(2, 6)), tressfx_desc());
    EXPECT_EQ(refused(parity, closed, desc, "tressfx"), PLAIT_INVALID_STATE);
    EXPECT_TRUE(sim.colliders().empty() && parity.colliders().empty());
    auto kind = smooth_collider();
    kind.kind = PLAIT_COLLIDER_KIND_MESH;
    plait_collider_id id{};
    EXPECT_EQ(plait_collider_create(sim, &kind, &id), PLAIT_INVALID_ARGUMENT);
}

} // namespace
