// Contact that knows its side: sheets, shapes that hair stays inside of, hard shakes, and colliders that are
// put elsewhere without a way.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <map>

namespace {

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

plait_collider_mesh_desc sheet_desc() {
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = PLAIT_MESH_FORM_NEAREST;
    desc.two_sided = 1;
    return desc;
}

Strand level(size_t count, float height) {
    Strand strand;
    for (size_t i = 0; i < count; ++i)
        strand.push_back(
            {-0.1f + 0.2f * static_cast<float>(i) / static_cast<float>(count - 1), height, 0.013f});
    return strand;
}

class Sides : public OnBackend {
  protected:
    bool is_reference() const { return GetParam() == "reference"; }
};
ON_EVERY_BACKEND(Sides);

// ---- sheets ------------------------------------------------------------------------------------

// A level strand falls on a sheet and stays on it.
TEST_P(Sides, WhatFallsOnASheetStaysOnIt) {
    const auto mesh = make_mesh(sheet_mesh(0.3));
    for (const plait_mesh_form form : {PLAIT_MESH_FORM_FIELD, PLAIT_MESH_FORM_NEAREST})
        for (const size_t count : {2u, 4u, 8u, 16u})
            for (const float height :
                 {0.02f, 0.035f, 0.05f, 0.06f, 0.08f, 0.1f, 0.12f, 0.135f, 0.15f}) {
                plait::Sim sim(context, make_groom({level(count, height)}));
                auto desc = sheet_desc();
                desc.form = form;
                if (form == PLAIT_MESH_FORM_FIELD && count == 2)
                    continue; // a segment as long as the sheet is from its edge: the grid ends first
                sim.create_collider(mesh, desc);
                for (int i = 0; i < (is_reference() ? 60 : 240); ++i) {
                    sim.step(frame);
                }
                EXPECT_GT(sim.read(PLAIT_FIELD_POSITION)[4 * count - 3], -1e-4f)
                    << count << " vertices from " << height << " m, form " << form;
            }
}

// And one that moves up and down, turns and bends under it.
TEST_P(Sides, SheetsThatMoveTurnAndBendKeepTheirHair) {
    ShapeMesh shape;
    constexpr int n = 12;
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n; ++k)
            shape.add(-0.3 + 0.6 * i / n, 0, -0.3 + 0.6 * k / n);
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t k = 0; k < n; ++k) {
            const uint32_t a = i * (n + 1) + k, b = a + n + 1;
            shape.add_quad(a, a + 1, b + 1, b);
        }
    const auto mesh = make_mesh(shape);
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (const int moves : {0, 1, 2}) { // up and down, by turning about z, by bending
        plait::Sim sim(context, make_groom({level(8, 0.05f), level(16, 0.03f)}));
        const auto id = sim.create_collider(mesh, sheet_desc());
        double deepest = 0;
        for (int i = 1; i <= (is_reference() ? 60 : 240); ++i) {
            const double s = std::sin(full_turn * 2 * i / 60);
            auto pose = plait_collider_desc_defaults().pose;
            pose.t[1] = moves == 0 ? static_cast<float>(0.02 * s) : 0;
            pose.q[2] = moves == 1 ? static_cast<float>(std::sin(0.05 * s)) : 0;
            pose.q[3] = moves == 1 ? static_cast<float>(std::cos(0.05 * s)) : 1;
            auto positions = rest;
            const auto bulge = [&](double x) {
                return moves == 2 ? 0.02 * s * std::cos(8 * x) : 0;
            };
            for (size_t k = 0; k < positions.size(); k += 3)
                positions[k + 1] += static_cast<float>(bulge(double(positions[k])));
            sim.set_collider_pose(id, pose);
            sim.set_collider_positions(id, plait::view(positions, 3));
            sim.step(frame);
            const auto x = sim.read(PLAIT_FIELD_POSITION);
            for (size_t k = 0; k < x.size(); k += 4) {
                const double a = 2 * std::asin(double(pose.q[2]));
                const double own = -std::sin(a) * double(x[k]) +
                                   std::cos(a) * (double(x[k + 1]) - double(pose.t[1]));
                deepest = std::max(deepest, bulge(double(x[k])) - own);
            }
        }
        EXPECT_LT(deepest, 2e-3) << "moves " << moves; // facets are .5 mm below the bulge
    }
}

// What goes round its rim is on the other side by right: nothing pulls it back through.
TEST_P(Sides, WhatGoesRoundARimIsOnTheOtherSide) {
    ShapeMesh shape = sheet_mesh(0.1);
    const auto mesh = make_mesh(shape);
    plait::Sim sim(context, make_groom({level(16, 0.02f)}));
    auto roots = plait_roots_defaults();
    sim.create_collider(mesh, sheet_desc());
    run(sim, 10);
    for (int i = 1; i <= 60; ++i) { // aside and beyond the rim, down, and back under it
        const float s = static_cast<float>(i) / 60;
        roots.head.t[2] = 0.25f * std::min(1.0f, 3 * s) - 0.2f * std::max(0.0f, 3 * s - 2);
        roots.head.t[1] = -0.2f * std::clamp(3 * s - 1, 0.0f, 1.0f);
        sim.set_roots(roots);
        sim.step(frame);
    }
    run(sim, is_reference() ? 20 : 120);
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    for (size_t k = 1; k < x.size(); k += 4)
        EXPECT_LT(x[k], -0.1f);
}

TEST_P(Sides, SnapshotsTeleportsAndWritesKeepThem) {
    const auto mesh = make_mesh(sheet_mesh(0.3));
    const auto groom = make_groom({level(4, 0.02f), level(8, 0.0f)}); // one lies in it
    plait::Sim sim(context, groom), other(context, groom);
    const auto id = sim.create_collider(mesh, sheet_desc());
    run(sim, 40);
    const auto bytes = sim.save();
    other.restore(bytes);
    sim.restore(bytes);
    EXPECT_EQ(other.save(), bytes);
    run(sim, 10);
    run(other, 10);
    EXPECT_EQ(sim.hash(), other.hash());
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    sim.write(PLAIT_FIELD_POSITION, x); // what was read
    sim.destroy_collider(sim.create_collider(mesh, sheet_desc()));
    auto pose = plait_collider_desc_defaults().pose;
    pose.t[1] = 1;
    sim.set_collider_pose(id, pose);
    sim.teleport(head_at({0, 1, 0})); // it goes along
    run(sim, 40);
    for (size_t k = 1; k < x.size() / 2; k += 4)
        EXPECT_GT(sim.read(PLAIT_FIELD_POSITION)[k], 1 - 2e-3f);
}

// ---- inside ------------------------------------------------------------------------------------

// A head that turns at 2 Hz by 40 degrees to and fro and sets off at 3 m/s after a second: from one step to
// the next, or within a tenth of a second.
plait_pose driven(int step, bool at_once) {
    plait_pose pose = plait_collider_desc_defaults().pose;
    const double a = 0.35 * std::sin(full_turn * 2 * step / 60), t = std::max(0, step - 60) * frame;
    pose.q[1] = static_cast<float>(std::sin(a));
    pose.q[3] = static_cast<float>(std::cos(a));
    pose.t[0] = static_cast<float>(at_once ? 3 * t : t < 0.1 ? 15 * t * t : 3 * t - 0.15);
    return pose;
}

// In the head's frame.
std::array<double, 3> own_of(const plait_pose& pose, const float* x) {
    const double c = 1 - 2 * double(pose.q[1]) * double(pose.q[1]),
                 s = 2 * double(pose.q[1]) * double(pose.q[3]);
    const double p = double(x[0]) - double(pose.t[0]), r = double(x[2]);
    return {c * p - s * r, double(x[1]), s * p + c * r};
}

// Hair hangs in a collar or a sleeve, an open tube: what is in it stays in it. (A wall that comes by as much as the
// tube is wide in one substep leaves it 28 mm outside for a moment: a substep knows a sheet by one plane of each
// vertex.)
TEST_P(Sides, HairStaysInsideOfASleeveThatTurnsAndSetsOff) {
    constexpr double radius = 0.05, low = -0.2, high = 0.2;
    const auto mesh = make_mesh(revolved_mesh(24, 16, false, [](double u, double v) {
        return std::array<double, 3>{radius * std::cos(full_turn * u), low + (high - low) * v,
                                     -radius * std::sin(full_turn * u)};
    }));
    Strands strands;
    for (int s = 0; s < (is_reference() ? 6 : 60); ++s) {
        const double a = 2.39996 * s, r = 0.035 * std::sqrt((s + 0.5) / 60);
        Strand strand;
        for (int i = 0; i < 16; ++i)
            strand.push_back({static_cast<float>(r * std::cos(a)), static_cast<float>(-0.01 * i),
                              static_cast<float>(r * std::sin(a))});
        strands.push_back(strand);
    }
    auto desc = plait_sim_desc_defaults();
    desc.substeps = 2;
    plait::Sim sim(context, make_groom(strands), desc);
    const auto id = sim.create_collider(mesh, sheet_desc());
    double worst = -1;
    for (int i = 1; i <= (is_reference() ? 90 : 240); ++i) {
        const plait_pose pose = driven(i, false);
        auto roots = plait_roots_defaults();
        roots.head = pose;
        sim.set_roots(roots);
        sim.set_collider_pose(id, pose);
        sim.step(frame);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < x.size(); k += 4) {
            const auto p = own_of(pose, &x[k]);
            if (p[1] > low && p[1] < high)
                worst = std::max(worst, std::hypot(p[0], p[2]) - radius);
        }
    }
    EXPECT_LT(worst, 2e-3);
    RecordProperty("outside_mm", std::to_string(worst * 1e3));
}

TEST_P(Sides, InwardIsZeroOrOne) {
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    auto desc = plait_collider_desc_defaults();
    desc.inward = 2;
    plait_collider_id id{};
    EXPECT_EQ(plait_collider_create(sim, &desc, &id), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("inward is 2, range is [0, 1]"),
              std::string::npos)
        << plait_last_error();
}

// ---- put elsewhere -----------------------------------------------------------------------------

// A ball set from one side of hair to the other sweeps it; one that is placed does not touch it.
TEST_P(Sides, WhatIsPlacedTakesNoWay) {
    const auto largest_way = [&](bool place, plait_collider_kind kind) {
        auto desc = plait_sim_desc_defaults();
        std::fill_n(desc.params.gravity, 3, 0.0f);
        plait::Sim sim(context, make_groom(tuft(3, 9)), desc);
        plait_pose pose = plait_collider_desc_defaults().pose, to = pose;
        pose.t[0] = to.t[0] = 0.1f;
        pose.t[1] = -0.1f;
        to.t[1] = 0.15f;
        plait_collider_id id{};
        if (kind == PLAIT_COLLIDER_KIND_MESH) {
            auto collider = sheet_desc();
            collider.pose = pose;
            id = sim.create_collider(make_mesh(sheet_mesh(0.2)), collider);
        } else {
            auto collider = plait_collider_desc_defaults();
            collider.kind = kind;
            collider.pose = pose;
            collider.radius_a = collider.radius_b = 0.06f;
            std::fill_n(collider.half_extents, 3, 0.06f);
            id = sim.create_collider(collider);
        }
        run(sim, 3);
        const auto before = sim.read(PLAIT_FIELD_POSITION);
        place ? sim.place_collider(id, to) : sim.set_collider_pose(id, to);
        EXPECT_EQ(sim.describe_collider(id).pose.t[1], to.t[1]);
        run(sim, 3);
        return largest_difference(sim.read(PLAIT_FIELD_POSITION), before);
    };
    for (const plait_collider_kind kind :
         {PLAIT_COLLIDER_KIND_CAPSULE, PLAIT_COLLIDER_KIND_BOX, PLAIT_COLLIDER_KIND_MESH}) {
        EXPECT_LT(largest_way(true, kind), 1e-5f) << "kind " << kind;
        EXPECT_GT(largest_way(false, kind), 5e-3f) << "kind " << kind;
    }
    plait::Sim sim(context, make_groom(tuft(1, 4)));
    const plait_pose pose = plait_roots_defaults().head;
    EXPECT_EQ(plait_collider_place(sim, {77}, &pose), PLAIT_NOT_FOUND);
}

// Positions that were set are there at once, too.
TEST_P(Sides, PlacedMeshesAreWhereTheirVerticesWereSet) {
    auto desc = plait_sim_desc_defaults();
    std::fill_n(desc.params.gravity, 3, 0.0f);
    plait::Sim sim(context, make_groom(tuft(3, 9)), desc);
    const auto mesh = make_mesh(sheet_mesh(0.2));
    auto collider = sheet_desc();
    collider.pose.t[1] = -0.1f;
    const auto id = sim.create_collider(mesh, collider);
    run(sim, 3);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    auto positions = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (size_t k = 1; k < positions.size(); k += 3)
        positions[k] += 0.25f; // past the hair
    sim.set_collider_positions(id, plait::view(positions, 3));
    sim.place_collider(id, collider.pose);
    run(sim, 3);
    EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), before), 1e-5f);
}

} // namespace
