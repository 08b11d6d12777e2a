// What comes in is taken for what it is, or said: diameters, axes, which end is the root, units,
// mirrored skins.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

namespace {

bool has(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

// ---- diameters ----------------------------------------------------------------------------------

// A .hair file of two strands with this thickness in its header and no array of them.
std::string hair_file(float thickness) {
    const std::string path =
        (std::filesystem::temp_directory_path() / "plait_imports.hair").string();
    std::string bytes(128, '\0');
    const uint32_t words[] = {2, 6, 2, 2}; // strands, points, flags, segments
    std::memcpy(bytes.data(), "HAIR", 4);
    std::memcpy(bytes.data() + 4, words, sizeof words);
    std::memcpy(bytes.data() + 20, &thickness, sizeof thickness);
    const float points[] = {0, 0, 0, 10, 0, 0, 20, 0, 0, 0, 1, 0, 10, 1, 0, 20, 1, 0};
    bytes.append(reinterpret_cast<const char*>(points), sizeof points);
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

plait_groom_info load_hair(float thickness, float scale) {
    auto options = plait_import_options_defaults();
    options.scale = scale;
    return plait::Groom::load(hair_file(thickness), options).describe();
}

TEST(Imports, AThicknessOfOneInTheHeaderOfHairIsNotGiven) {
    EXPECT_EQ(load_hair(1.0f, 0.01f).has_thickness, 0u);
    EXPECT_EQ(load_hair(1.0f, 1e-3f).has_thickness, 0u);
    EXPECT_EQ(load_hair(0.008f, 0.01f).has_thickness, 1u); // 80 um
    EXPECT_EQ(load_hair(0.008f, 0.01f).thickness_unlikely, 0u);
    EXPECT_EQ(load_hair(0.5f, 0.01f).thickness_unlikely, 2u); // 5 mm
}

plait::Groom thick(const std::vector<float>& thickness) {
    const GroomArrays arrays(tuft(3, 8));
    auto desc = arrays.desc();
    desc.thickness = plait::view(thickness);
    return plait::Groom(desc);
}

TEST(Imports, ADiameterThatIsNoHairsIsSaidAndNotUsedForAir) {
    const auto blown = [](const plait::Groom& groom) {
        const plait::Context context = make_context("reference");
        plait::Sim sim(context, groom);
        auto wind = plait_wind_desc_defaults();
        wind.velocity[2] = 2;
        sim.set_wind(wind);
        run(sim, 20);
        return std::pair(sim.read(PLAIT_FIELD_POSITION), std::string(sim.describe().warning));
    };
    const auto none = blown(make_groom(tuft(3, 8)));
    const auto metres = blown(thick({1, 1, 1})), some = blown(thick({1, 80e-6f, 5e-6f}));
    EXPECT_EQ(metres.first, none.first);
    EXPECT_EQ(some.first, blown(thick({80e-6f, 80e-6f, 80e-6f})).first);
    EXPECT_EQ(none.second, "");
    EXPECT_TRUE(has(metres.second, "3 of 3 strands are not as thick as hair, 10 um to 1 mm (strand "
                                   "0: 1 m)"))
        << metres.second;
    EXPECT_TRUE(has(some.second, "2 of 3 strands")) << some.second;
    EXPECT_EQ(thick({1, 80e-6f, 5e-6f}).describe().warning, some.second);
}

// ---- axes ---------------------------------------------------------------------------------------

Strand imported(const Strand& strand, const plait_import_options& options) {
    const plait::Groom groom(GroomArrays({strand}).desc(), options);
    const auto p = groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
    Strand list;
    for (size_t i = 0; i < p.size(); i += 3)
        list.push_back({p[i], p[i + 1], p[i + 2]});
    return list;
}

TEST(Imports, AxesOfTheUsualPrograms) {
    const Strand strand = {{0, 0, 0}, {1, 2, 3}};
    auto options = plait_import_options_defaults();
    const std::pair<plait_axes, Point> expected[] = {{PLAIT_AXES_Y_UP, {1, 2, 3}},
                                                     {PLAIT_AXES_Z_UP, {1, 3, -2}},
                                                     {PLAIT_AXES_Y_UP_LEFT_HANDED, {1, 2, -3}},
                                                     {PLAIT_AXES_Z_UP_LEFT_HANDED, {1, 3, 2}}};
    for (const auto& [axes, tip] : expected) {
        options.axes = axes;
        EXPECT_EQ(imported(strand, options)[1], tip) << axes;
    }
}

TEST(Imports, ThenATurnAndAnOffset) {
    const Strand strand = {{0, 0, 0}, {100, 0, 0}};
    auto options = plait_import_options_defaults();
    options.scale = 0.01f;
    const float half = std::sqrt(0.5f);
    options.pose = {{0, 0, half, half}, {0, 1.5f, 0.25f}}; // x to y
    const Strand placed = imported(strand, options);
    EXPECT_EQ(placed[0], (Point{0, 1.5f, 0.25f}));
    EXPECT_NEAR(placed[1][0], 0, 1e-6f);
    EXPECT_NEAR(placed[1][1], 2.5f, 1e-6f);
}

TEST(Imports, OptionsOutsideTheirRangeAreNamed) {
    const GroomArrays arrays(tuft(2, 4));
    const auto refused = [&](const auto& change) {
        auto options = plait_import_options_defaults();
        change(options);
        const auto desc = arrays.desc();
        plait_groom* groom = nullptr;
        EXPECT_EQ(plait_groom_create(&desc, &options, &groom), PLAIT_INVALID_ARGUMENT);
        return std::string(plait_last_error());
    };
    using O = plait_import_options;
    EXPECT_TRUE(has(refused([](O& o) { o.axes = static_cast<plait_axes>(4); }),
                    "options->axes is 4, range is [0, 3]"));
    EXPECT_TRUE(has(refused([](O& o) { o.root_end = static_cast<plait_root_end>(3); }),
                    "options->root_end is 3, range is [0, 2]"));
    EXPECT_TRUE(has(refused([](O& o) { o.pose.q[3] = 2; }), "options->pose: quaternion norm is 2"));
}

// Faces still look outward where axes are reflected.
TEST(Imports, MeshesComeByTheSameAxes) {
    const ShapeMesh box = box_mesh(0.1, 0.2, 0.3);
    auto desc = plait_mesh_desc_defaults();
    desc.positions = plait::view(box.positions);
    desc.triangles = plait::view(box.triangles);
    auto options = plait_import_options_defaults();
    for (const auto axes : {PLAIT_AXES_Y_UP, PLAIT_AXES_Z_UP, PLAIT_AXES_Y_UP_LEFT_HANDED,
                            PLAIT_AXES_Z_UP_LEFT_HANDED}) {
        options.axes = axes;
        const plait::Mesh mesh(desc, options);
        EXPECT_GT(mesh.describe().volume, 0) << axes;
        EXPECT_EQ(mesh.describe().repairs_total, 0u) << axes;
    }
}

// ---- roots --------------------------------------------------------------------------------------

// On a ball, roots by a spiral, each strand leaving along the normal and bent a little.
Strands fur(size_t count, float radius, float reach) {
    Strands strands;
    for (size_t i = 0; i < count; ++i) {
        const float y = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        const float a = 2.39996f * static_cast<float>(i), r = std::sqrt(1 - y * y);
        const Point n = {r * std::cos(a), y, r * std::sin(a)};
        Strand strand;
        for (size_t k = 0; k < 6; ++k) {
            const float s = static_cast<float>(k) / 5 * reach, at = radius + 0.9f * s;
            strand.push_back({n[0] * at + 0.4f * s * s / reach, n[1] * at - 0.3f * s, n[2] * at});
        }
        strands.push_back(strand);
    }
    return strands;
}

// So many of a hundred are stored from tip to root, more or less.
bool is_reversed(size_t strand, size_t of_hundred) {
    return strand * (strand + 13) * 7919 % 10007 < 10007 * of_hundred / 100;
}

Strands partly_reversed(Strands strands, size_t of_hundred) {
    for (size_t i = 0; i < strands.size(); ++i)
        if (is_reversed(i, of_hundred))
            std::ranges::reverse(strands[i]);
    return strands;
}

TEST(Imports, ARootThatTheOtherStrandsContradictIsWarnedOf) {
    const Strands right = fur(3000, 0.1f, 0.04f);
    EXPECT_EQ(make_groom(right).describe().roots_contradicted, 0u);
    EXPECT_STREQ(make_groom(right).describe().warning, "");
    for (const size_t share : {size_t{1}, size_t{10}, size_t{30}}) {
        double reversed = 0;
        for (size_t i = 0; i < right.size(); ++i)
            reversed += is_reversed(i, share);
        const auto info = make_groom(partly_reversed(right, share)).describe();
        EXPECT_NEAR(double(info.roots_contradicted), reversed, 0.2 * reversed) << share;
        EXPECT_TRUE(has(info.warning, "stored from tip to root")) << info.warning;
    }
}

// Tips of short fur that is combed flat lie among the roots of others.
TEST(Imports, ShortFurIsNotCalledStoredFromTipToRoot) {
    for (const float length : {0.005f, 0.01f, 0.02f}) {
        std::mt19937 dice(7);
        std::normal_distribution<float> normal;
        Strands combed(3000, Strand(4));
        for (Strand& strand : combed) {
            Point n = {normal(dice), normal(dice), normal(dice)};
            const float size = std::hypot(n[0], n[1], n[2]);
            for (float& of : n)
                of /= size;
            const Point along = {n[0], n[1] - 2, n[2]};
            const float stretch = std::hypot(along[0], along[1], along[2]);
            for (size_t k = 0; k < strand.size(); ++k)
                for (size_t i = 0; i < 3; ++i)
                    strand[k][i] =
                        0.1f * n[i] + length / 3 * static_cast<float>(k) * along[i] / stretch;
        }
        EXPECT_EQ(make_groom(combed).describe().roots_contradicted, 0u) << length << " m";
    }
}

TEST(Imports, StrandsAreTurnedAroundWhereAsked) {
    const Strands right = fur(3000, 0.1f, 0.04f);
    const auto expected = make_groom(right).read<float>(PLAIT_GROOM_FIELD_POSITIONS);
    auto options = plait_import_options_defaults();
    options.root_end = PLAIT_ROOT_END_AGREED;
    for (const size_t share : {size_t{0}, size_t{1}, size_t{10}, size_t{30}}) {
        const plait::Groom mended(GroomArrays(partly_reversed(right, share)).desc(), options);
        const auto x = mended.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
        size_t wrong = 0;
        for (size_t i = 0; i < x.size(); i += 18)
            wrong += x[i] != expected[i];
        EXPECT_LE(wrong, share < 30 ? 0u : 30u) << share;
    }
    options.root_end = PLAIT_ROOT_END_LAST;
    Strands turned = right;
    for (Strand& strand : turned)
        std::ranges::reverse(strand);
    EXPECT_EQ(
        plait::Groom(GroomArrays(turned).desc(), options).read<float>(PLAIT_GROOM_FIELD_POSITIONS),
        expected);
}

// All of them reversed alike: no strand tells of another, but the head does.
TEST(Imports, AHeadContradictsRootsThatAreFartherFromItThanTheTips) {
    std::string log;
    auto context_desc = plait_context_desc_defaults();
    context_desc.backend = "reference";
    context_desc.log = [](plait_log_level, const char* text, void* user) {
        *static_cast<std::string*>(user) += text;
    };
    context_desc.log_user = &log;
    const plait::Context context(context_desc);
    const ShapeMesh box = box_mesh(0.2, 0.1, 0.2);
    auto desc = plait_mesh_desc_defaults();
    desc.positions = plait::view(box.positions);
    desc.triangles = plait::view(box.triangles);
    for (const bool turned : {false, true}) {
        Strands strands = {{{0, 0.1f, 0}, {0, 0.15f, 0}, {0.02f, 0.2f, 0}},
                           {{0.1f, 0.1f, 0}, {0.1f, 0.15f, 0}, {0.12f, 0.2f, 0}}};
        for (Strand& strand : strands)
            if (turned)
                std::ranges::reverse(strand);
        plait::Sim sim(context, make_groom(strands));
        log.clear();
        sim.bind_roots(plait::Mesh(desc));
        EXPECT_EQ(has(log, "of 2 the tip is nearer to it than the root"), turned) << log;
    }
}

// ---- units --------------------------------------------------------------------------------------

TEST(Imports, ABearIsLargeAndItsHairShort) {
    const auto info = make_groom(fur(48000, 0.89f, 0.04f)).describe();
    EXPECT_NEAR(info.mean_length, 0.04f, 0.01f);
    EXPECT_EQ(info.likely_scale, 1);
    EXPECT_STREQ(info.warning, "");
    auto options = plait_import_options_defaults();
    for (const auto& [unit, scale] : {std::pair{100.0f, 0.01f}, {1000.0f, 0.001f}}) {
        options.scale = unit;
        const plait::Groom groom(GroomArrays(fur(500, 0.89f, 0.04f)).desc(), options);
        EXPECT_EQ(groom.describe().likely_scale, scale) << unit;
        EXPECT_TRUE(has(groom.describe().warning, "scale 0.0")) << groom.describe().warning;
    }
}

// ---- mirrors ------------------------------------------------------------------------------------

TEST(Imports, WhatOfAFileIsNoHairIsSaidWithTheFile) {
    const std::string path = testing::TempDir() + "far.obj";
    std::ofstream(path) << "v 0 0 0\nv 1e30 0 0\nl 1 2\n";
    try {
        plait::Groom::load(path);
        FAIL() << "was read";
    } catch (const plait::Error& error) {
        EXPECT_NE(std::string(error.what()).find(path + ": no strand can be kept"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Imports, AMirroredSkinIsRefused) {
    const plait::Context context = make_context("reference");
    const GroomArrays arrays(tuft(2, 4));
    const std::vector<uint32_t> bones(8, 0);
    const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0};
    auto desc = arrays.desc();
    desc.bone_indices = {bones.data(), 2, 16};
    desc.bone_weights = {weights.data(), 2, 16};
    plait::Sim sim(context, plait::Groom(desc));
    const float mirror[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    auto roots = plait_roots_defaults();
    roots.bones = {mirror, 1, 0};
    EXPECT_EQ(plait_sim_set_roots(sim.get(), &roots), PLAIT_INVALID_ARGUMENT);
    EXPECT_TRUE(has(plait_last_error(), "bones[0] mirrors: its determinant is -1"))
        << plait_last_error();
}

} // namespace
