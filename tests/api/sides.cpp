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
                float lowest = 1;
                for (int i = 0; i < (is_reference() ? 60 : 240); ++i) {
                    sim.step(frame);
                    const auto x = sim.read(PLAIT_FIELD_POSITION);
                    for (size_t k = 1; k < x.size(); k += 4)
                        lowest = std::min(lowest, x[k]);
                }
                EXPECT_GT(sim.read(PLAIT_FIELD_POSITION)[4 * count - 3], -1e-4f)
                    << count << " vertices from " << height << " m, form " << form;
                EXPECT_GT(lowest, -0.02f * 0.2f / static_cast<float>(count - 1))
                    << count << " vertices from " << height << " m, form " << form; // for a moment
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
            auto pose = smooth_collider().pose;
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
    auto pose = smooth_collider().pose;
    pose.t[1] = 1;
    sim.set_collider_pose(id, pose);
    sim.teleport(head_at({0, 1, 0})); // it goes along
    run(sim, 40);
    for (size_t k = 1; k < x.size() / 2; k += 4)
        EXPECT_GT(sim.read(PLAIT_FIELD_POSITION)[k], 1 - 2e-3f);
}

// ---- inside ------------------------------------------------------------------------------------

ShapeMesh octahedron_of(int halvings, double radius) {
    std::vector<std::array<double, 3>> points = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                                 {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    std::vector<std::array<uint32_t, 3>> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int i = 0; i < halvings; ++i) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        std::vector<std::array<uint32_t, 3>> halved;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), 0u);
            if (!is_new)
                return place->second;
            std::array<double, 3> p{};
            for (size_t k = 0; k < 3; ++k)
                p[k] = points[a][k] + points[b][k];
            const double size = std::hypot(p[0], p[1], p[2]);
            for (double& c : p)
                c /= size;
            points.push_back(p);
            return place->second = static_cast<uint32_t>(points.size() - 1);
        };
        for (const auto& [a, b, c] : faces) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            halved.insert(halved.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = halved;
    }
    ShapeMesh mesh;
    for (const auto& p : points)
        mesh.add(radius * p[0], radius * p[1], radius * p[2]);
    mesh.triangles = faces;
    return mesh;
}

// The faces of a convex mesh, as planes.
class Faces {
  public:
    explicit Faces(const ShapeMesh& mesh) {
        for (const auto& [a, b, c] : mesh.triangles) {
            const auto& p = mesh.positions[a];
            std::array<double, 3> u{}, v{};
            for (size_t k = 0; k < 3; ++k) {
                u[k] = double(mesh.positions[b][k]) - double(p[k]);
                v[k] = double(mesh.positions[c][k]) - double(p[k]);
            }
            const std::array<double, 3> n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                             u[0] * v[1] - u[1] * v[0]};
            const double size = std::hypot(n[0], n[1], n[2]);
            planes_.push_back({n[0] / size, n[1] / size, n[2] / size,
                               (n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / size});
        }
    }

    // m, above the highest.
    double outside(const std::array<double, 3>& p) const {
        double most = -1;
        for (const auto& n : planes_)
            most = std::max(most, n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - n[3]);
        return most;
    }

  private:
    std::vector<std::array<double, 4>> planes_; // unit normal, how far from the origin
};

// A head that turns at 2 Hz by 40 degrees to and fro and sets off at 3 m/s after a second, from one step to
// the next.
plait_pose driven(int step) {
    plait_pose pose = smooth_collider().pose;
    const double a = 0.35 * std::sin(full_turn * 2 * step / 60), t = std::max(0, step - 60) * frame;
    pose.q[1] = static_cast<float>(std::sin(a));
    pose.q[3] = static_cast<float>(std::cos(a));
    pose.t[0] = static_cast<float>(3 * t);
    return pose;
}

// Head and collider are there at the step's end.
void step_to(plait::Sim& sim, plait_collider_id id, const plait_pose& pose) {
    auto roots = plait_roots_defaults();
    roots.head = pose;
    sim.set_roots(roots);
    sim.set_collider_pose(id, pose);
    sim.step(frame);
}

// In the head's frame.
std::array<double, 3> own_of(const plait_pose& pose, const float* x) {
    const double c = 1 - 2 * double(pose.q[1]) * double(pose.q[1]),
                 s = 2 * double(pose.q[1]) * double(pose.q[3]);
    const double p = double(x[0]) - double(pose.t[0]), r = double(x[2]);
    return {c * p - s * r, double(x[1]), s * p + c * r};
}

// Strands of 20 cm, from roots on a ball of 5 cm.
Strands in_a_hood(size_t number) {
    Strands strands;
    for (size_t s = 0; s < number; ++s) {
        const double h = 1 - 1.6 * (double(s) + 0.5) / double(number), az = 2.39996 * double(s);
        const double r = std::sqrt(1 - h * h);
        Strand strand;
        for (int i = 0; i < 16; ++i) { // wound around it
            const double out = 0.05 + 0.02 * std::min(1.0, i / 4.0), a = az + 0.19 * i;
            strand.push_back({static_cast<float>(out * r * std::cos(a)),
                              static_cast<float>(out * h - 0.002 * i),
                              static_cast<float>(out * r * std::sin(a))});
        }
        strands.push_back(strand);
    }
    return strands;
}

TEST_P(Sides, HairStaysInsideOfAHoodThatTurnsAndSetsOff) {
    const size_t number = is_reference() ? 12 : 200;
    const auto groom = make_groom(in_a_hood(number));
    const ShapeMesh ball = octahedron_of(2, 0.1);
    const Faces faces(ball);
    for (const plait_collider_kind kind :
         {PLAIT_COLLIDER_KIND_CAPSULE, PLAIT_COLLIDER_KIND_BOX, PLAIT_COLLIDER_KIND_HULL}) {
        plait::Sim sim(context, groom);
        plait_collider_id id{};
        if (kind == PLAIT_COLLIDER_KIND_HULL) {
            auto desc = plait_collider_hull_desc_defaults();
            desc.inward = 1;
            desc.margin = 1e-3f;
            id = sim.create_hull(make_mesh(ball), desc);
        } else {
            auto desc = smooth_collider();
            desc.kind = kind;
            desc.inward = 1;
            desc.friction = 0.2f;
            desc.capsule.a[1] = desc.box.centre[1] = -0.02f;
            desc.capsule.b[1] = 0.02f;
            desc.capsule.radius_a = desc.capsule.radius_b = 0.085f;
            desc.box.half_extents[0] = desc.box.half_extents[1] = desc.box.half_extents[2] = 0.085f;
            desc.box.rounding = 0; // two faces hold a vertex in an edge
            id = sim.create_collider(desc);
        }
        EXPECT_EQ(sim.describe_collider(id).inward, 1u);
        const auto outside = [&](const std::array<double, 3>& p) {
            if (kind == PLAIT_COLLIDER_KIND_CAPSULE)
                return std::hypot(p[0], p[1] - std::clamp(p[1], -0.02, 0.02), p[2]) - 0.085;
            if (kind == PLAIT_COLLIDER_KIND_BOX) {
                const double y = p[1] + 0.02;
                return std::hypot(std::max(std::abs(p[0]) - 0.085, 0.0),
                                  std::max(std::abs(y) - 0.085, 0.0),
                                  std::max(std::abs(p[2]) - 0.085, 0.0));
            }
            return faces.outside(p);
        };
        double worst = -1;
        for (int i = 1; i <= (is_reference() ? 90 : 240); ++i) {
            const plait_pose pose = driven(i);
            step_to(sim, id, pose);
            const auto x = sim.read(PLAIT_FIELD_POSITION);
            for (size_t k = 0; k < x.size(); k += 4)
                worst = std::max(worst, outside(own_of(pose, &x[k])));
        }
        EXPECT_LT(worst, 2e-3) << "kind " << kind;
        RecordProperty("outside_mm_" + std::to_string(kind), std::to_string(worst * 1e3));
    }
}

// Strands of 35 cm in a box 20 cm high lie on its bottom and in its edges: in those a vertex would belong to one
// face and the other in turn.
TEST_P(Sides, HairInABoxComesToRest) {
    const double spacing = 0.35 / 15;
    Strands strands;
    for (size_t s = 0; s < (is_reference() ? 40 : 200); ++s) {
        const double h = 1 - (double(s) + 0.5) / 100, az = 2.39996 * double(s);
        const double r = 0.08 * std::sqrt(1 - h * h / 4);
        Strand strand;
        for (int i = 0; i < 16; ++i)
            strand.push_back(
                {float(r * std::cos(az)), float(0.04 * h - spacing * i), float(r * std::sin(az))});
        strands.push_back(strand);
    }
    const auto groom = make_groom(strands);
    plait::Sim sim(context, groom);
    auto desc = smooth_collider();
    desc.kind = PLAIT_COLLIDER_KIND_BOX;
    desc.inward = 1;
    desc.friction = 0.2f;
    for (float& half : desc.box.half_extents)
        half = 0.12f;
    desc.box.centre[1] = -0.06f;
    sim.create_collider(desc);
    for (int i = 0; i < 400; ++i)
        sim.step(frame);
    double farthest = 0; // m, in a frame
    auto before = sim.read(PLAIT_FIELD_POSITION);
    for (int i = 0; i < 60; ++i) {
        sim.step(frame);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < x.size(); ++k)
            farthest = std::max(farthest, std::abs(double(x[k]) - double(before[k])));
        before = x;
    }
    EXPECT_LT(farthest, 1e-4);
    RecordProperty("farthest_mm", std::to_string(farthest * 1e3));
}

// Hair hangs in a collar or a sleeve, an open tube: what is in it stays in it.
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
    plait::Sim sim(context, make_groom(strands));
    const auto id = sim.create_collider(mesh, sheet_desc());
    double worst = -1;
    for (int i = 1; i <= (is_reference() ? 90 : 240); ++i) {
        const plait_pose pose = driven(i);
        step_to(sim, id, pose);
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

// Form FIELD has no memory of sides.
TEST(SheetOfAField, SaysThatItKeepsNoSides) {
    std::string said;
    auto desc = plait_context_desc_defaults();
    desc.backend = "reference";
    desc.log_user = &said;
    desc.log = [](plait_log_level level, const char* text, void* user) {
        if (level == PLAIT_LOG_LEVEL_WARNING)
            static_cast<std::string*>(user)->append(text);
    };
    plait::Context context(desc);
    plait::Sim sim(context, make_groom({level(8, 0.05f)}));
    const auto mesh = make_mesh(sheet_mesh(0.3));
    auto sheet = sheet_desc();
    sim.create_collider(mesh, sheet);
    EXPECT_EQ(said, "");
    sheet.form = PLAIT_MESH_FORM_FIELD;
    sim.create_collider(mesh, sheet);
    EXPECT_NE(said.find("of form FIELD keeps no hair on its side"), std::string::npos) << said;
}

TEST_P(Sides, InwardIsZeroOrOne) {
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    auto desc = smooth_collider();
    desc.inward = 2;
    plait_collider_id id{};
    EXPECT_EQ(plait_collider_create(sim, &desc, &id), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("inward is 2, range is [0, 1]"),
              std::string::npos)
        << plait_last_error();
}

// ---- a hard shake ------------------------------------------------------------------------------

// Strands of 25 cm on a ball of 9 cm: each leaves along the normal and bends to hang beside the ball.
Strands on_a_ball(int number, int every) {
    Strands strands;
    for (int s = 0; s < number; s += every) {
        const double h = 1 - 1.15 * (s + 0.5) / number, az = 2.39996 * s, r = std::sqrt(1 - h * h);
        const std::array<double, 3> normal = {r * std::cos(az), h, r * std::sin(az)};
        std::array<double, 3> x{};
        for (size_t k = 0; k < 3; ++k)
            x[k] = 0.09 * normal[k];
        Strand strand;
        constexpr double fine = 0.25 / 15 / 50;
        for (int i = 0; i < 15 * 50 + 1; ++i) {
            if (i % 50 == 0)
                strand.push_back(
                    {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])});
            const double share = std::min(1.0, i * fine / 0.06),
                         u = share * share * (3 - 2 * share);
            const double out = std::hypot(x[0], x[1], x[2]), up = -x[1] / out;
            const double near = up < 0 ? std::clamp((0.11 - out) / 0.01, 0.0, 1.0) : 0;
            std::array<double, 3> along{};
            for (size_t k = 0; k < 3; ++k) {
                const double down = (k == 1 ? -1 : 0) - near * up * x[k] / out;
                const double aside = k == 1 ? 0 : 1e-3 * normal[k] / std::max(r, 1e-9);
                along[k] = (1 - u) * normal[k] + u * (down + aside);
            }
            const double size = std::hypot(along[0], along[1], along[2]);
            for (size_t k = 0; k < 3; ++k)
                x[k] += fine * along[k] / size;
        }
        strands.push_back(strand);
    }
    return strands;
}

// A ball of 9 cm with a margin of 1 mm, of friction 0.2.
plait_collider_id head_of(plait::Sim& sim, const std::string& body, const plait::Mesh& mesh) {
    if (body == "sphere") {
        auto desc = smooth_collider();
        desc.capsule.radius_a = desc.capsule.radius_b = 0.091f;
        desc.friction = 0.2f;
        return sim.create_collider(desc);
    }
    if (body == "hull") {
        auto desc = plait_collider_hull_desc_defaults();
        desc.margin = 1e-3f;
        desc.friction = 0.2f;
        return sim.create_hull(mesh, desc);
    }
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = body == "field" ? PLAIT_MESH_FORM_FIELD : PLAIT_MESH_FORM_NEAREST;
    desc.margin = 1e-3f;
    desc.friction = 0.2f;
    return sim.create_collider(mesh, desc);
}

// m, of any vertex but roots, under the ball's faces or in the sphere, that have gone by `way` along x.
double deepest_in(plait::Sim& sim, const std::string& body, const Faces& ball, double way) {
    double deepest = -1;
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    for (size_t k = 0; k < x.size(); k += 4)
        if (k % 64 != 0) {
            const std::array<double, 3> p = {double(x[k]) - way, double(x[k + 1]),
                                             double(x[k + 2])};
            deepest = std::max(deepest, body == "sphere" ? 0.09 - std::hypot(p[0], p[1], p[2])
                                                         : -ball.outside(p));
        }
    return deepest;
}

// A hood that is a sheet: a dome over an open cylinder of 12 cm, around a ball and hair of 25 cm.
ShapeMesh hood_mesh(double radius) {
    return revolved_mesh(64, 40, false, [=](double u, double v) {
        const double a = full_turn * u, b = full_turn / 4 * std::clamp(2.5 * v, 0.01, 1.0);
        return std::array<double, 3>{radius * std::sin(b) * std::cos(a),
                                     v < 0.4 ? radius * std::cos(b) : 0.4 - v,
                                     -radius * std::sin(b) * std::sin(a)};
    });
}

// No farther out than `most`, in a dome over a cylinder.
void press_in(Strands& strands, double most) {
    for (Strand& strand : strands)
        for (auto& p : strand) {
            const bool dome = p[1] > 0;
            const double out = std::hypot(double(p[0]), dome ? double(p[1]) : 0, double(p[2]));
            for (size_t k = 0; k < 3 && out > most; ++k)
                p[k] *= k == 1 && !dome ? 1 : static_cast<float>(most / out);
        }
}

TEST_P(Sides, HairStaysInsideOfAHoodThatIsASheet) {
    constexpr double radius = 0.12;
    Strands strands = on_a_ball(600, is_reference() ? 100 : 1);
    press_in(strands, radius - 0.004);
    const auto mesh = make_mesh(hood_mesh(radius));
    plait::Sim sim(context, make_groom(strands));
    const auto hood = sim.create_collider(mesh, sheet_desc()), head = head_of(sim, "sphere", mesh);
    double worst = -1;
    for (int i = 1; i <= (is_reference() ? 90 : 240); ++i) {
        auto roots = plait_roots_defaults();
        roots.head = driven(i);
        sim.set_roots(roots);
        sim.set_collider_pose(hood, roots.head);
        sim.set_collider_pose(head, roots.head);
        sim.step(frame);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < x.size(); k += 4) {
            const auto p = own_of(roots.head, &x[k]);
            worst = std::max(worst, std::hypot(p[0], std::max(p[1], 0.0), p[2]) - radius);
        }
    }
    EXPECT_LT(worst, 2e-3);
    RecordProperty("outside_mm", std::to_string(worst * 1e3));
}

// The default model at one substep, under 5 cm to and fro at 1.7 Hz: no strand is deeper than half a
// millimetre in a sphere, a hull or a mesh. The margin is 1 mm.
TEST_P(Sides, AHardShakePushesNoHairIntoTheHead) {
    const bool few =
        is_reference() || PLAIT_TEST_SEEDS < 24; // the sanitizers: measuring takes minutes
    const auto groom = make_groom(on_a_ball(1000, few ? 25 : 1));
    const ShapeMesh ball = octahedron_of(2, 0.09);
    const Faces faces(ball);
    const auto mesh = make_mesh(ball);
    for (const std::string body : {"sphere", "hull", "field", "nearest"}) {
        plait::Sim sim(context, groom);
        const plait_collider_id id = head_of(sim, body, mesh);
        double deepest = -1; // m, under the faces, or the ball
        for (int i = 1; i <= (is_reference() ? 150 : 480); ++i) {
            const double t = std::max(0.0, i / 60.0 - 1), s = std::min(1.0, 2 * t);
            const double way = 0.05 * std::sin(full_turn * 1.7 * t) * s * s * (3 - 2 * s);
            auto roots = plait_roots_defaults();
            roots.head.t[0] = static_cast<float>(way);
            sim.set_roots(roots);
            sim.set_collider_pose(id, roots.head);
            sim.step(frame);
            deepest = std::max(deepest, deepest_in(sim, body, faces, way));
        }
        EXPECT_LT(deepest, 5e-4) << body;
        RecordProperty("deepest_mm_" + body, std::to_string(deepest * 1e3));
    }
}

// Strands of 25 cm from the faces of a cube: out, sideways to beyond its edge, then down.
Strands on_a_cube(double half_size, size_t number) {
    Strands strands;
    for (size_t s = 0; s < number; ++s) {
        const double h = 1 - 1.15 * (double(s) + 0.5) / double(number), az = 2.39996 * double(s);
        const double r = std::sqrt(1 - h * h), way[3] = {r * std::cos(az), h, r * std::sin(az)};
        const size_t face = static_cast<size_t>(
            std::max_element(way, way + 3,
                             [](double a, double b) { return std::abs(a) < std::abs(b); }) -
            way);
        std::array<double, 3> x{};
        for (size_t k = 0; k < 3; ++k)
            x[k] = half_size * way[k] / std::abs(way[face]);
        Strand strand;
        for (int i = 0; i < 16; ++i) {
            strand.push_back({float(x[0]), float(x[1]), float(x[2])});
            const bool over = std::max(std::abs(x[0]), std::abs(x[2])) < half_size + 0.012;
            if (i == 0)
                x[face] += std::copysign(0.25 / 15, way[face]);
            else if (over)
                x = {x[0] + way[0] / r * 0.25 / 15, x[1], x[2] + way[2] / r * 0.25 / 15};
            else
                x[1] -= 0.25 / 15;
        }
        strands.push_back(strand);
    }
    return strands;
}

// A vertex that its segment carries round a sharp edge is in another face than the one it was pressed to.
TEST_P(Sides, SharpEdgesKeepHairOut) {
    const double half_size = 0.08;
    const auto groom = make_groom(on_a_cube(half_size, is_reference() ? 60 : 500));
    for (const bool turns : {true, false}) {
        plait::Sim sim(context, groom);
        auto desc = smooth_collider();
        desc.kind = PLAIT_COLLIDER_KIND_BOX;
        desc.friction = 0.2f;
        for (float& half : desc.box.half_extents)
            half = float(half_size);
        const plait_collider_id id = sim.create_collider(desc);
        double deepest = -1;
        for (int i = 1; i <= (is_reference() ? 120 : 200); ++i) {
            plait_pose pose = driven(turns ? i : 0);
            pose.t[0] = static_cast<float>(turns ? 0 : 3 * std::max(0, i - 60) * frame);
            step_to(sim, id, pose);
            const auto x = sim.read(PLAIT_FIELD_POSITION);
            for (size_t k = 0; k < x.size(); k += 4) {
                const auto p = own_of(pose, &x[k]);
                if (k % 64 != 0) // but roots
                    deepest = std::max(
                        deepest,
                        half_size - std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}));
            }
        }
        EXPECT_LT(deepest, 5e-4) << (turns ? "turns" : "sets off");
        RecordProperty(turns ? "turns_mm" : "sets_off_mm", std::to_string(deepest * 1e3));
    }
}

// A head that sets off with 5 g to 5 m/s and turns to and fro, drawn at any rate: no vertex is drawn deeper
// than a millimetre in the head where it is drawn.
TEST_P(Sides, NoHairIsDrawnInTheHeadAtAnyRateOfFrames) {
    const std::vector<std::vector<double>> rates = {{1 / 24.0},  {1 / 30.0},  {1 / 48.0},
                                                    {1 / 60.0},  {1 / 90.0},  {1 / 120.0},
                                                    {1 / 144.0}, {1 / 240.0}, {0.004, 0.03, 0.011}};
    const auto groom = make_groom(on_a_ball(1000, 20));
    auto ball = smooth_collider();
    ball.capsule.radius_a = ball.capsule.radius_b = 0.091f;
    for (const auto& rate : rates) {
        plait::Sim sim(context, groom);
        const plait_collider_id id = sim.create_collider(ball);
        double time = 0, deepest = -1, moved = 0;
        for (size_t f = 0; time < 1; ++f) {
            const double dt = rate[f % rate.size()];
            time += dt;
            const double s = std::min(1.0, 2 * time), eased = s * s * (3 - 2 * s);
            const double turn = 2 * eased * std::sin(6 * time);
            auto roots = plait_roots_defaults();
            roots.head = {
                {0, static_cast<float>(std::sin(turn / 2)), 0,
                 static_cast<float>(std::cos(turn / 2))},
                {static_cast<float>(time < 0.1 ? 25 * time * time : 5 * time - 0.25), 0, 0}};
            sim.set_roots(roots);
            sim.set_collider_pose(id, roots.head);
            sim.step(dt);
            const auto x = sim.read(PLAIT_FIELD_POSITION);
            for (size_t k = 0; k < x.size(); k += 4) {
                if (k % 64 == 0)
                    continue;
                const double out = std::hypot(double(x[k]) - double(roots.head.t[0]),
                                              double(x[k + 1]), double(x[k + 2]));
                deepest = std::max(deepest, 0.09 - out);
            }
            moved = double(x[60]);
        }
        EXPECT_LT(deepest, 1e-3) << 1 / rate[0] << " frames a second";
        EXPECT_GT(moved, 4) << "hair goes along";
        RecordProperty("deepest_mm_at_" + std::to_string(std::lround(1 / rate[0])),
                       std::to_string(deepest * 1e3));
    }
}

// A head that goes at 5 m/s from one frame to the next leaves no vertex deeper than half a millimetre in what is
// drawn of it.
TEST_P(Sides, AHeadThatSetsOffAtOnceTakesItsHairAlong) {
    const auto groom = make_groom(on_a_ball(1000, is_reference() ? 20 : 4));
    const ShapeMesh ball = octahedron_of(2, 0.09);
    const Faces faces(ball);
    const auto mesh = make_mesh(ball);
    for (const std::string body : {"sphere", "hull", "field", "nearest"})
        for (const double rate : {30.0, 60.0}) {
            plait::Sim sim(context, groom);
            const plait_collider_id id = head_of(sim, body, mesh);
            double deepest = -1;
            for (int f = 1; f < rate; ++f) {
                const double way = 5 * std::max(0.0, f / rate - 0.5);
                auto roots = plait_roots_defaults();
                roots.head.t[0] = static_cast<float>(way);
                sim.set_roots(roots);
                sim.set_collider_pose(id, roots.head);
                sim.step(1 / rate);
                deepest = std::max(deepest, deepest_in(sim, body, faces, way));
            }
            EXPECT_LT(deepest, 5e-4) << body << " at " << rate << " frames a second";
            RecordProperty("deepest_mm_" + body, std::to_string(deepest * 1e3));
        }
}

// ---- put elsewhere -----------------------------------------------------------------------------

// A ball set from one side of hair to the other sweeps it; one that is placed does not touch it.
TEST_P(Sides, WhatIsPlacedTakesNoWay) {
    const auto largest_way = [&](bool place, plait_collider_kind kind) {
        plait::SimDesc desc;
        std::fill_n(desc.params.gravity, 3, 0.0f);
        plait::Sim sim(context, make_groom(tuft(3, 9)), desc);
        plait_pose pose = smooth_collider().pose, to = pose;
        pose.t[0] = to.t[0] = 0.1f;
        pose.t[1] = -0.1f;
        to.t[1] = 0.15f;
        plait_collider_id id{};
        if (kind == PLAIT_COLLIDER_KIND_MESH) {
            auto collider = sheet_desc();
            collider.pose = pose;
            id = sim.create_collider(make_mesh(sheet_mesh(0.2)), collider);
        } else {
            auto collider = smooth_collider();
            collider.kind = kind;
            collider.pose = pose;
            collider.capsule.radius_a = collider.capsule.radius_b = 0.06f;
            std::fill_n(collider.box.half_extents, 3, 0.06f);
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
    plait::SimDesc desc;
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
