// Capsules that stand for a mesh.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <cstring>
#include <numbers>

namespace {

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

// Around z, a ball of `a` at 0 and one of `b` at `length`, without its two poles.
ShapeMesh cone_mesh(double a, double b, double length) {
    const double tilt = std::asin((a - b) / length);
    return revolved_mesh(64, 96, false, [=](double u, double v) -> std::array<double, 3> {
        const double first = tilt - std::numbers::pi / 2 + 0.02, last = std::numbers::pi / 2 - 0.02;
        // a third of the rows each: the ball at 0, the side, the ball at `length`
        const double third = 3 * v;
        const double angle = third < 1   ? first + third * (tilt - first)
                             : third < 2 ? tilt
                                         : tilt + (third - 2) * (last - tilt);
        const double share = third < 1 ? 0 : third < 2 ? third - 1 : 1;
        const double radius = a + share * (b - a);
        const double away = radius * std::cos(angle);
        return {away * std::cos(2 * std::numbers::pi * u),
                away * std::sin(2 * std::numbers::pi * u),
                share * length + radius * std::sin(angle)};
    });
}

double rms_of(const plait::Mesh& mesh, size_t count) {
    auto info = plait_mesh_fit_info_defaults();
    mesh.fit(count, &info);
    EXPECT_LE(info.rms, info.percentile_99);
    EXPECT_LE(info.percentile_99, info.greatest);
    return info.rms;
}

TEST(MeshFit, FindsTheCapsuleThatAMeshIs) {
    const auto mesh = make_mesh(cone_mesh(0.05, 0.02, 0.2));
    auto info = plait_mesh_fit_info_defaults();
    plait_capsule found = mesh.fit(1, &info).front();
    EXPECT_LT(info.greatest, 2e-4);
    if (found.radius_a < found.radius_b) {
        std::swap(found.radius_a, found.radius_b);
        std::swap(found.a, found.b);
    }
    EXPECT_NEAR(found.radius_a, 0.05, 2e-4);
    EXPECT_NEAR(found.radius_b, 0.02, 2e-4);
    for (const size_t i : {0, 1, 2}) {
        EXPECT_NEAR(found.a[i], 0, 2e-4);
        EXPECT_NEAR(found.b[i], i == 2 ? 0.2 : 0, 4e-4);
    }
}

// Of a head with neck and shoulders; and the same each time.
TEST(MeshFit, MoreCapsulesComeNearerToAHead) {
    plait_mesh* loaded = nullptr;
    if (plait_mesh_load(PLAIT_SOURCE_DIR "/assets/head.obj", nullptr, &loaded) == PLAIT_UNSUPPORTED)
        GTEST_SKIP() << "built without assimp";
    plait_mesh_destroy(loaded);
    const auto head = plait::Mesh::load(PLAIT_SOURCE_DIR "/assets/head.obj");
    EXPECT_LT(rms_of(head, 4), 7.5e-3);
    EXPECT_LT(rms_of(head, 8), 4.7e-3);
    EXPECT_LT(rms_of(head, 16), 2.9e-3);
    EXPECT_LT(rms_of(head, 32), 1.6e-3);
    const auto once = head.fit(4), again = head.fit(4);
    EXPECT_EQ(std::memcmp(once.data(), again.data(), once.size() * sizeof once.front()), 0);
}

TEST(MeshFit, CapsulesAreColliders) {
    const auto capsules = make_mesh(box_mesh(0.1, 0.2, 0.3)).fit(5);
    plait::Context context;
    plait::Sim sim(context, make_groom(tuft(3, 8)));
    for (const auto& capsule : capsules) {
        plait_collider_id id;
        auto desc = plait_collider_desc_defaults();
        desc.capsule = capsule;
        EXPECT_EQ(plait_collider_create(sim.get(), &desc, &id), PLAIT_OK) << plait_last_error();
    }
}

TEST(MeshFit, RefusesWhatItCannotFill) {
    const auto mesh = make_mesh(box_mesh(0.1, 0.2, 0.3));
    std::vector<plait_capsule> room(2);
    EXPECT_EQ(plait_mesh_fit(mesh.get(), room.data(), 0, nullptr), PLAIT_INVALID_ARGUMENT);
    EXPECT_STREQ(plait_last_error(), "plait_mesh_fit: count is 0, range is [1, 64]");
    EXPECT_EQ(plait_mesh_fit(mesh.get(), room.data(), 65, nullptr), PLAIT_INVALID_ARGUMENT);
    plait_mesh_fit_info none{};
    EXPECT_EQ(plait_mesh_fit(mesh.get(), room.data(), 2, &none), PLAIT_INVALID_ARGUMENT);
}

// A single triangle, and more capsules than it has corners.
TEST(MeshFit, ASheetIsFittedToo) {
    ShapeMesh sheet;
    sheet.add(0, 0, 0);
    sheet.add(0.1, 0, 0);
    sheet.add(0, 0.1, 0);
    sheet.triangles.push_back({0, 1, 2});
    auto info = plait_mesh_fit_info_defaults();
    for (const plait_capsule& capsule : make_mesh(sheet).fit(8, &info)) {
        EXPECT_GT(capsule.radius_a, 0);
        EXPECT_GT(capsule.radius_b, 0);
        EXPECT_TRUE(std::isfinite(capsule.a[0] + capsule.b[1]));
    }
    EXPECT_LT(info.rms, 0.02);
}

} // namespace
