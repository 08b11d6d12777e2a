// Colliders that are meshes of form NEAREST, whose vertices the caller moves: hair stays out of them as
// they bend, and sticks to what stretches and turns under it.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <functional>

namespace {

using Bend = std::function<std::array<double, 3>(const std::array<double, 3>&)>;

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

plait_collider_mesh_desc nearest_desc() {
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = PLAIT_MESH_FORM_NEAREST;
    return desc;
}

plait::SimDesc desc_of() {
    plait::SimDesc desc;
    return desc;
}

std::vector<float> bent(const std::vector<float>& rest, const Bend& bend) {
    std::vector<float> positions;
    for (size_t i = 0; i < rest.size(); i += 3)
        for (const double c : bend({double(rest[i]), double(rest[i + 1]), double(rest[i + 2])}))
            positions.push_back(static_cast<float>(c));
    return positions;
}

class BendingMeshes : public OnBackend {
  protected:
    bool is_reference() const { return GetParam() == "reference"; }
};
ON_EVERY_BACKEND(BendingMeshes);

// ---- a tube that bends -------------------------------------------------------------------------

constexpr double tube_radius = 0.05, tube_half = 0.2; // m, along y

ShapeMesh tube_mesh() {
    ShapeMesh mesh = revolved_mesh(16, 12, false, [](double u, double v) {
        return std::array<double, 3>{tube_radius * std::cos(full_turn * u), tube_half * (2 * v - 1),
                                     -tube_radius * std::sin(full_turn * u)};
    });
    const uint32_t low = mesh.add(0, -tube_half, 0), high = mesh.add(0, tube_half, 0);
    for (uint32_t u = 0; u < 16; ++u) {
        mesh.triangles.push_back({low, (u + 1) % 16, u});
        mesh.triangles.push_back({high, 12 * 16 + u, 12 * 16 + (u + 1) % 16});
    }
    return mesh;
}

// Along an arc that turns by `angle` from end to end, in the plane of x and y, from the lower end on.
std::array<double, 3> along_arc(const std::array<double, 3>& p, double angle) {
    const double s = p[1] + tube_half, a = angle * s / (2 * tube_half);
    const double radius = std::abs(angle) > 1e-6 ? 2 * tube_half / angle : 0;
    const double x = radius != 0 ? radius * (1 - std::cos(a)) : 0,
                 y = radius != 0 ? radius * std::sin(a) : s;
    return {x + p[0] * std::cos(a), y - tube_half - p[0] * std::sin(a), p[2]};
}

// m: how far a point is outside of the bent tube but for its ends.
double outside_of_arc(const float* p, double angle) {
    const double radius = 2 * tube_half / angle;
    const double x = double(p[0]) - radius, y = double(p[1]) + tube_half;
    const double a = std::atan2(y, -x) * (angle > 0 ? 1 : -1);
    if (a < 0.1 * std::abs(angle) || a > 0.9 * std::abs(angle))
        return 1;
    return std::hypot(std::hypot(x, y) - radius, double(p[2])) - tube_radius;
}

// Hair lies over a tube as it bends by a right angle in a second. What a chord of the tube is below
// its arc, R (1 - cos 11 deg), counts as the tube.
TEST_P(BendingMeshes, HairStaysOutsideOfWhatBends) {
    const auto mesh = make_mesh(tube_mesh());
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    Strands strands;
    for (int s = 0; s < (is_reference() ? 4 : 24); ++s)
        strands.push_back(
            curl({-0.12f, -0.1f + 0.2f * static_cast<float>(s) / 24, 0.06f}, 14, 0.02f, 0.4f));
    auto desc = desc_of();
    desc.substeps = 2;
    desc.params.gravity[1] = 0;
    desc.params.gravity[2] = -9.81f; // onto its side
    plait::Sim sim(context, make_groom(strands), desc);
    auto collider = nearest_desc();
    collider.margin = 1e-3f;
    const auto id = sim.create_collider(mesh, collider);
    size_t deep = 0, all = 0, near = 0;
    double worst = 1;
    for (int i = 1; i <= 90; ++i) {
        const double angle = full_turn / 4 * std::min(1.0, i / 60.0);
        const auto positions = bent(rest, [&](const auto& p) { return along_arc(p, angle); });
        sim.set_collider_positions(id, plait::view(positions, 3));
        sim.step(frame);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < x.size(); k += 4) {
            const double out = outside_of_arc(&x[k], angle);
            const double chord = tube_radius * (1 - std::cos(full_turn / 32));
            worst = std::min(worst, out + chord);
            deep += out < -chord - 1e-3;
            near += out < 5e-3;
            ++all;
        }
    }
    EXPECT_LE(double(deep), 1e-3 * double(all));
    EXPECT_GT(double(near), 0.02 * double(all));
    RecordProperty("worst_mm", std::to_string(worst * 1e3));
    RecordProperty("deep", static_cast<int>(deep));
}

// ---- skin that stretches and turns under hair --------------------------------------------------

constexpr double hair_length = 0.2, hair_height = 1e-3; // m, along x from above the origin

// Patch of skin in the plane y = 0, closed below.
ShapeMesh skin_mesh() {
    ShapeMesh mesh;
    constexpr uint32_t along = 24, across = 10;
    const auto add_grid = [&](double y) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (uint32_t i = 0; i <= along; ++i)
            for (uint32_t k = 0; k <= across; ++k)
                mesh.add(-0.05 + 0.3 * i / along, y, -0.05 + 0.1 * k / across);
        return first;
    };
    const uint32_t top = add_grid(0), low = add_grid(-0.02), row = across + 1;
    for (uint32_t i = 0; i < along; ++i)
        for (uint32_t k = 0; k < across; ++k) {
            const uint32_t a = top + i * row + k, b = low + i * row + k;
            mesh.add_quad(a, a + 1, a + row + 1, a + row);
            mesh.add_quad(b, b + row, b + row + 1, b + 1);
        }
    const auto wall = [&](uint32_t from, uint32_t step, uint32_t count, bool turned) {
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t a = from + i * step, b = a + step, d = low - top;
            turned ? mesh.add_quad(a, b, b + d, a + d) : mesh.add_quad(a, a + d, b + d, b);
        }
    };
    wall(top, row, along, true);
    wall(top + across, row, along, false);
    wall(top, 1, across, false);
    wall(top + along * row, 1, across, true);
    return mesh;
}

// At a share of the way: hair's place goes 5 mm aside at the tip, the skin stretches by half across it
// and leans by 15 degrees about the hair; nothing moves along it.
std::array<double, 3> moved_skin(const std::array<double, 3>& p, double share) {
    const double x = std::clamp(p[0] / hair_length, 0.0, 1.0), bend = x * x * (3 - 2 * x);
    const double lean = share * full_turn / 24;
    const double z = (1 + 0.5 * share) * p[2] + share * 0.005 * bend;
    const double y = p[1] - hair_height;
    return {p[0], hair_height + y * std::cos(lean) - z * std::sin(lean),
            y * std::sin(lean) + z * std::cos(lean)};
}

// m, the largest distance of a vertex from its place on the skin after it moved for 2 s.
double strayed(plait::Context& context, float friction) {
    constexpr int steps = 120;
    constexpr auto height = static_cast<float>(hair_height);
    Strand strand;
    for (int i = 0; i < 17; ++i)
        strand.push_back({static_cast<float>(hair_length) * static_cast<float>(i) / 16, height, 0});
    auto desc = desc_of();
    desc.material.bend_stiffness = 1e-11f;
    desc.params.drag = 2;
    plait::Sim sim(context, make_groom({strand}), desc);
    const auto mesh = make_mesh(skin_mesh());
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    auto collider = nearest_desc();
    collider.margin = height;
    collider.friction = friction;
    const auto id = sim.create_collider(mesh, collider);
    run(sim, 10);
    const auto from = sim.read(PLAIT_FIELD_POSITION);
    for (int i = 1; i <= steps; ++i) {
        const auto positions =
            bent(rest, [&](const auto& p) { return moved_skin(p, double(i) / steps); });
        sim.set_collider_positions(id, plait::view(positions, 3));
        sim.step(frame);
    }
    run(sim, 10);
    const auto to = sim.read(PLAIT_FIELD_POSITION);
    double most = 0;
    for (size_t i = 4; i < to.size(); i += 4) {
        const auto place =
            moved_skin({double(from[i]), double(from[i + 1]), double(from[i + 2])}, 1);
        most = std::max(most, std::hypot(double(to[i]) - place[0], double(to[i + 1]) - place[1],
                                         double(to[i + 2]) - place[2]));
    }
    return most;
}

TEST_P(BendingMeshes, HairSticksToSkinThatStretchesAndTurns) {
    EXPECT_LT(strayed(context, 1.5f), 1e-3 * hair_length);
    EXPECT_GT(strayed(context, 0.0f), 3e-3);
}

// ---- as with any mesh --------------------------------------------------------------------------

TEST_P(BendingMeshes, HairAtRestIsNotPushed) {
    const auto mesh = make_mesh(ellipsoid_mesh(0.08, 0.1, 0.09, 32, 20));
    Strands strands; // 1 mm inside to 4 mm outside
    for (int s = 0; s < 9; ++s) {
        Strand strand;
        for (int i = 0; i < 12; ++i) {
            const double a = 2.4 * s, b = 0.3 + 0.08 * s + 0.09 * i;
            const double out = 1 + 0.003 * i - 0.012 + 0.004 * std::sin(3.0 * i);
            strand.push_back({static_cast<float>(out * 0.08 * std::sin(b) * std::cos(a)),
                              static_cast<float>(out * 0.1 * std::cos(b)),
                              static_cast<float>(out * 0.09 * std::sin(b) * std::sin(a))});
        }
        strands.push_back(strand);
    }
    const auto groom = make_groom(strands);
    const double length = double(groom.describe().mean_length);
    auto desc = desc_of();
    std::fill_n(desc.params.gravity, 3, 0.0f);
    const auto rested = [&](bool with) {
        plait::Sim sim(context, groom, desc);
        if (with)
            sim.create_collider(mesh, nearest_desc());
        run(sim, is_reference() ? 10 : 100);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    EXPECT_LT(double(largest_difference(rested(true), rested(false))), 1e-6 * length);
}

TEST_P(BendingMeshes, WhatIsFarOrGoneChangesNoBit) {
    const auto mesh = make_mesh(tube_mesh());
    const auto positions = [&](int what) {
        plait::Sim sim(context, make_groom(tuft(3, 9)), desc_of());
        if (what > 0) {
            auto far = nearest_desc();
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

TEST_P(BendingMeshes, NothingIsScheduledWithoutThem) {
    auto desc = plait_context_desc_defaults();
    const std::string backend = GetParam();
    desc.backend = backend.c_str();
    desc.profile = 1;
    const plait::Context profiled(desc);
    plait::Sim sim(profiled, make_groom(tuft(3, 9)));
    const auto mesh = make_mesh(tube_mesh());
    using Counts = std::array<ptrdiff_t, 2>;
    const auto launched = [&] {
        sim.take_launches();
        run(sim, 2);
        const auto stages = launched_stages(sim);
        return Counts{std::ranges::count(stages, "mesh_field"),
                      std::ranges::count(stages, "mesh_nearest")};
    };
    for (const auto id : {sim.create_collider(mesh), sim.create_collider(mesh)})
        sim.destroy_collider(id); // what lists colliders keeps the room of two
    const auto bytes = sim.describe().device_bytes;
    EXPECT_EQ(launched(), (Counts{0, 0}));
    const auto id = sim.create_collider(mesh, nearest_desc());
    EXPECT_EQ(launched(), (Counts{0, 2}));
    EXPECT_GT(sim.describe().device_bytes, bytes);
    const auto other = sim.create_collider(mesh);
    EXPECT_EQ(launched(), (Counts{2, 2}));
    sim.destroy_collider(id);
    EXPECT_EQ(launched(), (Counts{2, 0}));
    sim.destroy_collider(other);
    EXPECT_EQ(launched(), (Counts{0, 0}));
    EXPECT_EQ(sim.describe().device_bytes, bytes);
}

TEST_P(BendingMeshes, SnapshotsHoldThemInTheMiddleOfTheirWay) {
    const auto mesh = make_mesh(tube_mesh());
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    const auto groom = make_groom(tuft(3, 9));
    plait::Sim sim(context, groom, desc_of()), other(context, groom, desc_of());
    auto desc = nearest_desc();
    desc.pose.t[0] = 0.1f;
    desc.pose.t[1] = -0.1f;
    const auto id = sim.create_collider(mesh, desc);
    run(sim, 2);
    for (int i = 1; i <= 3; ++i) {
        const auto positions = bent(rest, [&](const auto& p) { return along_arc(p, 0.1 * i); });
        sim.set_collider_positions(id, plait::view(positions, 3));
        sim.step(0.9 * frame); // what waits is between two places
    }
    const auto bytes = sim.save();
    sim.restore(bytes); // the reference has more digits than a snapshot
    other.restore(bytes);
    EXPECT_EQ(other.save(), bytes);
    run(sim, 5);
    run(other, 5);
    EXPECT_EQ(sim.hash(), other.hash());
    const auto positions = bent(rest, [&](const auto& p) { return along_arc(p, 0.5); });
    for (plait::Sim* each : {&sim, &other}) {
        each->set_collider_positions(each->colliders().front(), plait::view(positions, 3));
        run(*each, 2);
    }
    EXPECT_EQ(sim.hash(), other.hash());
    for (const size_t cut : {size_t{1}, bytes.size() / 3, bytes.size() / 2})
        EXPECT_NE(plait_sim_restore(sim, bytes.data(), bytes.size() - cut), PLAIT_OK);
}

// What jumps leaves hair alone: it was there all the time. A reset does the same.
TEST_P(BendingMeshes, TeleportAndResetTakeNoWay) {
    const auto mesh = make_mesh(tube_mesh());
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    auto desc = desc_of();
    std::fill_n(desc.params.gravity, 3, 0.0f);
    plait::Sim sim(context, make_groom(tuft(3, 9)), desc);
    auto collider = nearest_desc();
    collider.pose.t[0] = 0.5f; // beyond the tips
    const auto id = sim.create_collider(mesh, collider);
    run(sim, 2);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    const auto positions = bent(rest, [](const auto& p) { // to this side of the roots
        return std::array<double, 3>{p[0] - 1, p[1], p[2]};
    });
    sim.set_collider_positions(id, plait::view(positions, 3));
    sim.teleport(head_at({0, 0, 0}));
    run(sim, 2);
    EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), before), 1e-4f);
    sim.reset();
    run(sim, 2);
    EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), before), 1e-4f);
}

TEST_P(BendingMeshes, WhatCannotBeIsRefused) {
    const auto closed = make_mesh(tube_mesh()), open = make_mesh(sheet_mesh(0.1));
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    const auto says = [](plait_result code, plait_result expected, const std::string& part) {
        EXPECT_EQ(code, expected);
        EXPECT_NE(std::string(plait_last_error()).find(part), std::string::npos)
            << plait_last_error();
    };
    auto desc = nearest_desc();
    plait_collider_id id{};
    says(plait_collider_create_mesh(sim, open, &desc, &id), PLAIT_INVALID_ARGUMENT, "4 open edges");
    desc.form = static_cast<plait_mesh_form>(2);
    says(plait_collider_create_mesh(sim, closed, &desc, &id), PLAIT_INVALID_ARGUMENT,
         "form is 2, range is [0, 1]");
    EXPECT_TRUE(sim.colliders().empty());
    desc = nearest_desc();
    desc.two_sided = 1;
    const auto sheet = sim.create_collider(open, desc);
    const auto ball = sim.create_collider(smooth_collider());
    const auto field = sim.create_collider(closed);
    std::vector<float> positions(12, 0.1f);
    auto view = plait::view(positions, 3);
    says(plait_collider_set_positions(sim, ball, &view), PLAIT_INVALID_STATE, "has no vertices");
    says(plait_collider_set_positions(sim, field, &view), PLAIT_INVALID_STATE, "FIELD");
    says(plait_collider_set_positions(sim, {77}, &view), PLAIT_NOT_FOUND, "not in this sim");
    view.count = 3;
    says(plait_collider_set_positions(sim, sheet, &view), PLAIT_INVALID_ARGUMENT,
         "positions.count is 3, the mesh has 4 vertices");
    view.count = 4;
    positions[7] = NAN;
    says(plait_collider_set_positions(sim, sheet, &view), PLAIT_INVALID_ARGUMENT,
         "positions[2]: coordinate is nan, range is [-1e6, 1e6] m");
    positions[7] = 2e6f;
    says(plait_collider_set_positions(sim, sheet, &view), PLAIT_INVALID_ARGUMENT, "positions[2]");
    std::fill(positions.begin(), positions.end(), 0.1f); // a mesh of no size is met by nothing
    sim.set_collider_positions(sheet, view);
    run(sim, 3);
    for (const float c : sim.read(PLAIT_FIELD_POSITION))
        EXPECT_TRUE(std::isfinite(c));
    EXPECT_EQ(sim.describe_collider(sheet).kind, PLAIT_COLLIDER_KIND_MESH);
}

// A seam's two vertices become one: sources says where the caller finds it.
TEST(BentMesh, SourcesSayWhichVertexWasWhich) {
    ShapeMesh shape = sheet_mesh(0.1);
    shape.positions.insert(shape.positions.begin(), {9, 9, 9}); // of no triangle
    for (auto& t : shape.triangles)
        for (uint32_t& corner : t)
            ++corner;
    const uint32_t shared = shape.triangles[0][0];
    const auto at = shape.positions[shared];
    shape.positions.push_back(at);
    for (uint32_t& corner : shape.triangles[1])
        corner = corner == shared ? 5 : corner;
    const auto mesh = make_mesh(shape);
    EXPECT_EQ(mesh.describe().repairs[PLAIT_MESH_REPAIR_WELDED_VERTEX], 1u);
    const auto sources = mesh.read<uint32_t>(PLAIT_MESH_FIELD_SOURCES);
    EXPECT_EQ(sources, (std::vector<uint32_t>{1, 2, 3, 4}));
    const auto positions = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (size_t i = 0; i < sources.size(); ++i)
        for (size_t k = 0; k < 3; ++k)
            EXPECT_EQ(positions[3 * i + k], shape.positions[sources[i]][k]);
}

} // namespace
