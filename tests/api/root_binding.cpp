// Roots that are bound to the triangles of a mesh: where they are, how they turn, what is said of them.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <functional>

namespace {

using Point = std::array<double, 3>;
using Bend = std::function<Point(const Point&)>;

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

std::vector<float> bent(const plait::Mesh& mesh, const Bend& bend) {
    std::vector<float> positions;
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (size_t i = 0; i < rest.size(); i += 3)
        for (const double c : bend({double(rest[i]), double(rest[i + 1]), double(rest[i + 2])}))
            positions.push_back(static_cast<float>(c));
    return positions;
}

plait_roots roots_on(const std::vector<float>& positions) {
    auto roots = plait_roots_defaults();
    roots.mesh_positions = plait::view(positions, 3);
    return roots;
}

// Hair that stands on the ellipsoid of half axes .08, .1, .09 m, its roots up to 2 mm above it.
Strands hair_on_ellipsoid() {
    Strands strands;
    for (int s = 0; s < 12; ++s) {
        const double a = 2.4 * s, b = 0.3 + 0.1 * s, lift = 1 + 0.002 * s;
        const Point n = {std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)};
        Strand strand;
        for (int i = 0; i < 8; ++i) {
            const double out = lift + 0.1 * i;
            strand.push_back({static_cast<float>(0.08 * out * n[0]),
                              static_cast<float>(0.1 * out * n[1]),
                              static_cast<float>(0.09 * out * n[2])});
        }
        strands.push_back(strand);
    }
    return strands;
}

class RootBinding : public OnBackend {};
ON_EVERY_BACKEND(RootBinding);

TEST_P(RootBinding, ARigidMeshCarriesHairAsTheHeadDoes) {
    const auto mesh = make_mesh(ellipsoid_mesh(0.08, 0.1, 0.09, 24, 16));
    const auto groom = make_groom(hair_on_ellipsoid());
    const float half = std::sqrt(0.5f);
    const auto head = head_at({0.3f, -0.1f, 0.2f}, {0, 0, half, half});
    const auto positions = bent(mesh, [](const Point& p) {
        return Point{0.3 - p[1], -0.1 + p[0], 0.2 + p[2]};
    });
    for (const plait_model model : {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED}) {
        plait::SimDesc desc;
        desc.model = model;
        plait::Sim bound(context, groom, desc), held(context, groom, desc);
        bound.bind_roots(mesh);
        bound.teleport(roots_on(positions));
        held.teleport(head);
        EXPECT_LT(
            largest_difference(bound.read(PLAIT_FIELD_POSITION), held.read(PLAIT_FIELD_POSITION)),
            2e-6f)
            << "model " << model;
    }
}

// In the plane y = 0, twice as long along x and leaning by 30 degrees about it.
TEST_P(RootBinding, ARootKeepsItsPlaceAndItsHeightOnWhatStretchesAndTurns) {
    const auto mesh = make_mesh(sheet_mesh(0.1));
    const double lean = full_turn / 12, c = std::cos(lean), s = std::sin(lean);
    const auto lies = [&](const Point& p) {
        return Point{2 * p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]};
    };
    Strands strands;
    for (int k = 0; k < 6; ++k) {
        const float x = -0.08f + 0.03f * static_cast<float>(k),
                    z = 0.02f * static_cast<float>(k) - 0.05f;
        strands.push_back({{x, 0.003f, z}, {x, 0.023f, z}, {x, 0.043f, z}});
    }
    plait::SimDesc desc;
    std::fill_n(desc.params.gravity, 3, 0.0f);
    plait::Sim sim(context, make_groom(strands), desc);
    sim.bind_roots(mesh);
    sim.teleport(roots_on(bent(mesh, lies)));
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    for (size_t k = 0; k < strands.size(); ++k) {
        const auto& root = strands[k][0];
        const Point expected = lies({double(root[0]), double(root[1]), double(root[2])});
        const float* at = &x[4 * 3 * k];
        for (size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(double(at[i]), expected[i], 1e-6) << "root " << k;
        EXPECT_NEAR(double(at[4] - at[0]), 0, 1e-6) << "hair turns with the normal, unsheared";
        EXPECT_NEAR(double(at[5] - at[1]), 0.02 * c, 1e-6);
        EXPECT_NEAR(double(at[6] - at[2]), 0.02 * s, 1e-6);
    }
    // on the way the head moves all of it
    const auto positions = bent(mesh, lies);
    auto roots = roots_on(positions);
    roots.head.t[0] = 0.5f;
    sim.teleport(roots);
    EXPECT_NEAR(double(sim.read(PLAIT_FIELD_POSITION)[0]), double(x[0]) + 0.5, 1e-6);
}

TEST_P(RootBinding, SaysWhereEachRootIs) {
    const auto mesh = make_mesh(sheet_mesh(0.1)); // two triangles
    const auto positions = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    const auto triangles = mesh.read<uint32_t>(PLAIT_MESH_FIELD_TRIANGLES);
    const Strands strands = {{{0.05f, 0.004f, -0.02f}, {0.05f, 0.02f, -0.02f}},
                             {{-0.03f, -0.002f, 0.06f}, {-0.03f, -0.02f, 0.06f}},
                             {{0.13f, 0, 0}, {0.13f, 0.02f, 0}}}; // 3 cm beside it
    std::vector<std::string> said;
    auto desc = plait_context_desc_defaults();
    const std::string backend = GetParam();
    desc.backend = backend.c_str();
    desc.log = [](plait_log_level, const char* text, void* to) {
        static_cast<std::vector<std::string>*>(to)->push_back(text);
    };
    desc.log_user = &said;
    const plait::Context logged(desc);
    plait::Sim sim(logged, make_groom(strands));
    said.clear();
    const auto places = sim.bind_roots(mesh);
    ASSERT_EQ(places.size(), strands.size());
    for (size_t k = 0; k < places.size(); ++k) {
        const auto& place = places[k];
        EXPECT_NEAR(double(place.weights[0] + place.weights[1] + place.weights[2]), 1, 1e-6);
        Point at{};
        for (size_t corner = 0; corner < 3; ++corner)
            for (size_t i = 0; i < 3; ++i)
                at[i] += double(place.weights[corner]) *
                         double(positions[3 * triangles[3 * place.triangle + corner] + i]);
        EXPECT_NEAR(at[0], std::min(double(strands[k][0][0]), 0.1), 1e-6);
        EXPECT_NEAR(at[2], double(strands[k][0][2]), 1e-6);
    }
    EXPECT_NEAR(std::abs(double(places[0].height)), 0.004, 1e-6);
    EXPECT_NEAR(double(places[0].height), -2 * double(places[1].height), 1e-6) << "on either side";
    EXPECT_NEAR(double(places[1].distance), 0.002, 1e-6);
    EXPECT_NEAR(double(places[2].distance), 0.03, 1e-6);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("1 of 3 roots are more than 1 cm"), std::string::npos) << said[0];
    EXPECT_NE(said[0].find("guide 2 0.03 m"), std::string::npos) << said[0];
}

// A tube of 5 cm that bends by 60 degrees to and fro, and hair that grows on it and lies over it.
TEST_P(RootBinding, HairGrowsOnWhatBendsAndStaysOutside) {
    constexpr double radius = 0.05, half = 0.15;
    ShapeMesh shape = revolved_mesh(24, 16, false, [&](double u, double v) {
        return Point{radius * std::cos(full_turn * u), half * (2 * v - 1),
                     -radius * std::sin(full_turn * u)};
    });
    const uint32_t low = shape.add(0, -half, 0), high = shape.add(0, half, 0);
    for (uint32_t u = 0; u < 24; ++u) {
        shape.triangles.push_back({low, (u + 1) % 24, u});
        shape.triangles.push_back({high, 16 * 24 + u, 16 * 24 + (u + 1) % 24});
    }
    const auto mesh = make_mesh(shape);
    Strands strands;
    const bool reference = GetParam() == "reference";
    for (int s = 0; s < (reference ? 6 : 48); ++s) {
        const double a = 2.4 * s, y = -0.1 + 0.2 * ((s * 7) % 48) / 48.0;
        Strand strand;
        for (int i = 0; i < 12; ++i) // out, and down along it
            strand.push_back(
                {static_cast<float>((radius + 0.012 * std::min(i, 3)) * std::cos(a)),
                 static_cast<float>(y - 0.012 * std::max(i - 3, 0)),
                 static_cast<float>(-(radius + 0.012 * std::min(i, 3)) * std::sin(a))});
        strands.push_back(strand);
    }
    for (const plait_model model : {PLAIT_MODEL_ARTICULATED}) {
        plait::SimDesc desc;
        desc.model = model;
        desc.substeps = 2;
        plait::Sim sim(context, make_groom(strands), desc);
        auto collider = plait_collider_mesh_desc_defaults();
        collider.form = PLAIT_MESH_FORM_NEAREST;
        collider.margin = 1e-3f;
        const auto id = sim.create_collider(mesh, collider);
        sim.bind_roots(mesh);
        size_t deep = 0, all = 0;
        double off = 0;
        for (int f = 1; f <= (reference ? 30 : 120); ++f) {
            const double angle = full_turn / 6 * std::sin(full_turn * f / 120.0) + 1e-4;
            const double r = 2 * half / angle;
            const auto positions = bent(mesh, [&](const Point& p) {
                const double a = angle * (p[1] + half) / (2 * half);
                return Point{r * (1 - std::cos(a)) + p[0] * std::cos(a),
                             r * std::sin(a) - half - p[0] * std::sin(a), p[2]};
            });
            sim.set_roots(roots_on(positions));
            sim.set_collider_positions(id, plait::view(positions, 3));
            sim.step(frame);
            const auto x = sim.read(PLAIT_FIELD_POSITION);
            for (size_t k = 0; k < x.size(); k += 4) {
                const double px = double(x[k]) - r, py = double(x[k + 1]) + half;
                const double a = std::atan2(py, -px) * (angle > 0 ? 1 : -1);
                const double out =
                    std::hypot(std::hypot(px, py) - std::abs(r), double(x[k + 2])) - radius;
                const bool root = k / 4 % 12 == 0;
                if (root) // what a chord of the tube lies below its arc is .5 mm
                    off = std::max(off, std::abs(out));
                else if (a > 0.05 * std::abs(angle) && a < 0.95 * std::abs(angle)) {
                    deep += out < -1.5e-3;
                    ++all;
                }
            }
        }
        EXPECT_LT(off, 6e-4) << "model " << model << ": roots stay on it";
        EXPECT_LE(double(deep), 1e-3 * double(all)) << "model " << model;
        EXPECT_LT(double(sim.measure().max_stretch), 0.02) << "model " << model;
    }
}

// A snapshot holds where roots are and are going; what they are bound to is bound again.
TEST_P(RootBinding, GoesOnFromASnapshot) {
    const auto mesh = make_mesh(ellipsoid_mesh(0.08, 0.1, 0.09, 24, 16));
    const auto groom = make_groom(hair_on_ellipsoid());
    plait::Sim sim(context, groom), other(context, groom);
    sim.bind_roots(mesh);
    other.bind_roots(mesh);
    const auto go_on = [&](plait::Sim& each, int first, int last) {
        for (int f = first; f < last; ++f) {
            const double swell = 1 + 0.1 * std::sin(0.2 * f);
            const auto positions = bent(mesh, [&](const Point& p) {
                return Point{swell * p[0], p[1], p[2]};
            });
            each.set_roots(roots_on(positions));
            each.step(0.9 * frame); // what waits is between two places
        }
    };
    go_on(sim, 0, 6);
    const auto bytes = sim.save();
    sim.restore(bytes); // the reference has more digits than a snapshot
    go_on(sim, 6, 12);
    other.restore(bytes);
    go_on(other, 6, 12);
    EXPECT_EQ(sim.hash(), other.hash());
}

TEST_P(RootBinding, IsReleasedAndBoundAgain) {
    const auto mesh = make_mesh(ellipsoid_mesh(0.08, 0.1, 0.09, 24, 16));
    plait::Sim sim(context, make_groom(hair_on_ellipsoid()));
    const auto bytes = sim.describe().device_bytes;
    auto positions = bent(mesh, [](const Point& p) { return Point{p[0] + 0.1, p[1], p[2]}; });
    const auto roots = roots_on(positions);
    EXPECT_EQ(plait_sim_set_roots(sim, &roots), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("bound to no mesh"), std::string::npos);
    sim.bind_roots(mesh);
    EXPECT_GT(sim.describe().device_bytes, bytes);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    positions.resize(positions.size() - 3);
    const auto few = roots_on(positions);
    EXPECT_EQ(plait_sim_set_roots(sim, &few), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("the roots are bound to has"), std::string::npos)
        << plait_last_error();
    positions[4] = NAN;
    const auto broken = roots_on(positions);
    EXPECT_EQ(plait_sim_set_roots(sim, &broken), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("mesh_positions[1]: coordinate is nan"),
              std::string::npos)
        << plait_last_error();
    plait_root_place place;
    EXPECT_EQ(plait_sim_bind_roots(sim, mesh, &place, 1), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), before) << "what is refused changes nothing";
    sim.free_roots();
    EXPECT_EQ(plait_sim_set_roots(sim, &roots), PLAIT_INVALID_ARGUMENT);
    sim.bind_roots(mesh);
    positions = bent(mesh, [](const Point& p) { return Point{p[0] + 0.1, p[1], p[2]}; });
    sim.teleport(roots_on(positions));
    EXPECT_NEAR(double(sim.read(PLAIT_FIELD_POSITION)[0]), double(before[0]) + 0.1, 1e-4);
    for (float& c : positions) // a mesh that has collapsed
        c = 0.1f;
    sim.set_roots(roots_on(positions));
    run(sim, 3);
    for (const float c : sim.read(PLAIT_FIELD_POSITION))
        EXPECT_TRUE(std::isfinite(c));
}

} // namespace
