// Drag and friction of strands of one sim, each by the scales of its material.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstddef>

namespace {

constexpr size_t vertices = 13;
constexpr float length = 0.3f; // m
constexpr float g = 9.81f;     // m/s^2

plait::SimDesc desc_of() {
    plait::SimDesc desc;
    return desc;
}

// One per scale, the first strand of the first and so on.
std::vector<plait_material> of_drag(const std::vector<float>& scales) {
    std::vector<plait_material> list(scales.size(), plait_material_defaults());
    for (size_t i = 0; i < list.size(); ++i)
        list[i].drag_scale = scales[i];
    return list;
}
std::vector<plait_material> of_friction(const std::vector<float>& scales) {
    std::vector<plait_material> list(scales.size(), plait_material_defaults());
    for (size_t i = 0; i < list.size(); ++i)
        list[i].friction_scale = scales[i];
    return list;
}

// Strand i is of material i modulo their number.
void give(plait_sim* sim, const std::vector<plait_material>& list, size_t strands) {
    std::vector<uint32_t> of(strands);
    for (size_t i = 0; i < strands; ++i)
        of[i] = static_cast<uint32_t>(i % list.size());
    ASSERT_EQ(plait_sim_set_materials(sim, list.data(), list.size(), plait::view(of)), PLAIT_OK)
        << plait_last_error();
}

// Level along x from (0, 0, z).
Strand level(float z) {
    Strand strand;
    for (size_t i = 0; i < vertices; ++i)
        strand.push_back({length * static_cast<float>(i) / static_cast<float>(vertices - 1), 0, z});
    return strand;
}

Strands level_ones(size_t count) {
    Strands strands;
    for (size_t i = 0; i < count; ++i)
        strands.push_back(level(0.1f * static_cast<float>(i)));
    return strands;
}

Point tip_of(const std::vector<float>& positions, size_t strand) {
    const float* x = &positions[4 * (vertices * (strand + 1) - 1)];
    return {x[0], x[1], x[2]};
}

std::vector<float> strand_of(const std::vector<float>& positions, size_t strand) {
    const auto first = positions.begin() + static_cast<std::ptrdiff_t>(4 * strand * vertices);
    return {first, first + static_cast<std::ptrdiff_t>(4 * vertices)};
}

class MaterialScales : public OnBackend {};
ON_EVERY_BACKEND(MaterialScales);

// ---- drag ------------------------------------------------------------------------------------

// To the bit, as powers of two are exact: of scales from 0 to 8 beside one another, and of the params'.
TEST_P(MaterialScales, DragIsThatOfASimWithSoManyTimesTheParams) {
    const std::vector<float> scales{0, 1, 0.5f, 8};
    for (const uint32_t bdf2 : {0u, 1u}) {
        auto desc = desc_of();
        desc.params.bdf2 = bdf2;
        desc.params.drag = 2;
        plait::Sim mixed(context, make_groom(tuft(5, vertices)), desc);
        auto list = of_drag(scales);
        list.push_back(plait_material_defaults());
        give(mixed, list, 5);
        run(mixed, 20);
        const auto positions = mixed.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < 5; ++i) {
            desc.params.drag = 2 * (i < scales.size() ? scales[i] : 1);
            plait::Sim alone(context, make_groom(tuft(5, vertices)), desc);
            run(alone, 20);
            EXPECT_LE(largest_difference(strand_of(positions, i),
                                         strand_of(alone.read(PLAIT_FIELD_POSITION), i)),
                      0)
                << "BDF2 " << bdf2 << ", strand " << i;
        }
    }
}

// Roots that fall as fast as hair of scale 2 does under its drag, at g/2c: that hair stays level. On
// one of scale 1 half of its weight is left, and on one of scale 0 all of it: level cantilevers, whose
// tips sag by q l^4/8EI.
TEST_P(MaterialScales, HairOfItsTerminalSpeedFeelsNoLoad) {
    constexpr float drag = 20, speed = g / (2 * drag);
    const std::vector<float> scales{2, 1, 0};
    auto list = of_drag(scales);
    for (plait_material& material : list)
        material.bend_stiffness = 1e-5f;
    const double sag = 5e-6 * double(g) * std::pow(double(length), 4) / (8 * 1e-5);
    auto desc = desc_of();
    desc.params.drag = drag;
    plait::Sim sim(context, make_groom(level_ones(3)), desc);
    give(sim, list, 3);
    std::vector<float> velocity(size_t{4} * vertices * 3, 0.0f);
    for (size_t i = 1; i < velocity.size(); i += 4)
        velocity[i] = -speed;
    sim.write(PLAIT_FIELD_VELOCITY, velocity);
    float fallen = 0;
    for (int i = 1; i <= 180; ++i) {
        fallen = speed * static_cast<float>(i) / 60;
        sim.set_roots(head_at({0, -fallen, 0}));
        run(sim, 1);
    }
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    const auto below = [&](size_t i) { return double(-fallen - tip_of(positions, i)[1]); };
    EXPECT_NEAR(below(0), 0, 0.002 * sag);
    EXPECT_NEAR(below(1), 0.5 * sag, 0.02 * sag);
    EXPECT_GT(below(2), 0.8 * sag); // swings on without drag
}

// By the same air, of so many times the density: shares are powers of two again.
TEST_P(MaterialScales, WindDragsByThem) {
    auto desc = desc_of();
    desc.params.drag = 0;
    auto wind = plait_wind_desc_defaults();
    wind.shelter = 0;
    wind.velocity[0] = -2;
    wind.velocity[2] = 3;
    const auto blown = [&](float density) {
        plait::Sim sim(context, make_groom(tuft(4, vertices)), desc);
        wind.air_density = density;
        sim.set_wind(wind);
        run(sim, 20);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    plait::Sim mixed(context, make_groom(tuft(4, vertices)), desc);
    wind.air_density = 1;
    mixed.set_wind(wind);
    give(mixed, of_drag({1, 0, 4, 0.5f}), 4);
    run(mixed, 20);
    const auto positions = mixed.read(PLAIT_FIELD_POSITION);
    const auto one = blown(1), four = blown(4), half = blown(0.5f);
    plait::Sim calm(context, make_groom(tuft(4, vertices)), desc);
    run(calm, 20);
    const auto none = calm.read(PLAIT_FIELD_POSITION);
    const std::vector<float>* expected[] = {&one, &none, &four, &half};
    for (size_t i = 0; i < 4; ++i)
        EXPECT_LE(largest_difference(strand_of(positions, i), strand_of(*expected[i], i)),
                  i == 1 ? 5e-6f : 0)
            << "strand " << i;
    EXPECT_GT(largest_difference(strand_of(one, 1), strand_of(none, 1)), 0.02f)
        << ": there is no wind to feel";
}

// ---- friction --------------------------------------------------------------------------------

enum class Slope { plane, box, field, nearest };

// A face at y = 0 of friction 0.5.
void add_slope(plait::Sim& sim, Slope slope) {
    if (slope == Slope::plane || slope == Slope::box) {
        auto desc = smooth_collider();
        desc.kind = slope == Slope::plane ? PLAIT_COLLIDER_KIND_PLANE : PLAIT_COLLIDER_KIND_BOX;
        desc.friction = 0.5f;
        if (slope == Slope::plane) {
            const Point up{0, 1, 0};
            std::copy(up.begin(), up.end(), desc.plane.normal);
        } else {
            const Point centre{0, -0.05f, 0}, half{0.6f, 0.05f, 0.6f};
            std::copy(centre.begin(), centre.end(), desc.box.centre);
            std::copy(half.begin(), half.end(), desc.box.half_extents);
        }
        (void)sim.create_collider(desc);
        return;
    }
    const ShapeMesh shape = box_mesh(0.6, 0.05, 0.6);
    auto mesh = plait_mesh_desc_defaults();
    mesh.positions = {shape.positions.data(), shape.positions.size(), 0};
    mesh.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = slope == Slope::field ? PLAIT_MESH_FORM_FIELD : PLAIT_MESH_FORM_NEAREST;
    desc.margin = 0;
    desc.friction = 0.5f;
    desc.pose.t[1] = -0.05f;
    (void)sim.create_collider(plait::Mesh(mesh), desc);
}

// Strands across a slope of tan 0.5, that of friction. Held hair creeps by 5e-4 of its length a second
// (ADR 14), and one that bends by 1e-10 N m^2 holds nothing by itself.
TEST_P(MaterialScales, HairSlidesDownASlopeWhereItsFrictionIsLessThanItsTangent) {
    const float across = 1 / std::sqrt(1.25f), down = 0.5f * across;
    auto list = of_friction({0.7f, 1.3f, 0, 1});
    for (plait_material& material : list)
        material.bend_stiffness = 1e-10f;
    for (const Slope slope : {Slope::plane, Slope::box, Slope::field, Slope::nearest}) {
        auto desc = desc_of();
        desc.params.gravity[1] = -g * across;
        desc.params.gravity[2] = -g * down;
        desc.params.drag = 0;
        plait::Sim sim(context, make_groom(level_ones(2)), desc);
        add_slope(sim, slope);
        give(sim, {list[0], list[1]}, 2);
        run(sim, 30);
        const auto positions = sim.read(PLAIT_FIELD_POSITION);
        const auto slid = [&](size_t i) {
            return 0.1f * static_cast<float>(i) - tip_of(positions, i)[2];
        };
        EXPECT_GT(slid(0), 0.02f) << static_cast<int>(slope);
        EXPECT_LT(std::abs(slid(1)), 1e-3f) << static_cast<int>(slope);
    }
}

// To the bit, where both are exact.
TEST_P(MaterialScales, FrictionIsThatOfAColliderWithSoManyTimesTheCoefficient) {
    const auto lies = [&](float scale, float friction) {
        plait::Sim sim(context, make_groom(tuft(3, vertices)), desc_of());
        auto ball = smooth_collider();
        const Point centre{0.1f, -0.08f, 0};
        std::copy(centre.begin(), centre.end(), ball.capsule.a);
        std::copy(centre.begin(), centre.end(), ball.capsule.b);
        ball.capsule.radius_a = ball.capsule.radius_b = 0.06f;
        ball.friction = friction;
        (void)sim.create_collider(ball);
        give(sim, of_friction({scale}), 3);
        run(sim, 40);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    const auto rough = lies(1, 0.5f);
    EXPECT_EQ(lies(4, 0.125f), rough);
    EXPECT_GT(largest_difference(lies(0, 0.5f), rough), 1e-3f);
    EXPECT_EQ(lies(0, 0.5f), lies(1, 0));
}

// ---- as every field of a material --------------------------------------------------------------

TEST_P(MaterialScales, OutsideTheirRangesAreRefused) {
    plait::Sim sim(context, make_groom(tuft(2, 6)), desc_of());
    const auto refused = [&](float plait_material::*field, float value) {
        std::vector<plait_material> list(2, plait_material_defaults());
        list[1].*field = value;
        const std::vector<uint32_t> of{0, 1};
        EXPECT_EQ(plait_sim_set_materials(sim, list.data(), list.size(), plait::view(of)),
                  PLAIT_INVALID_ARGUMENT);
        return std::string(plait_last_error());
    };
    EXPECT_NE(refused(&plait_material::drag_scale, -0.5f)
                  .find("materials[1].drag_scale is -0.5, range is [0, 100]"),
              std::string::npos);
    EXPECT_NE(refused(&plait_material::drag_scale, 101).find("drag_scale is 101"),
              std::string::npos);
    EXPECT_NE(refused(&plait_material::friction_scale, NAN)
                  .find("materials[1].friction_scale is nan, range is [0, 100]"),
              std::string::npos);
    EXPECT_NE(refused(&plait_material::friction_scale, 101).find("friction_scale is 101"),
              std::string::npos);
}

// Structs of a plait.h without them end earlier: 1, as of the params.
TEST_P(MaterialScales, AreOneInAnOlderHeaderAndOfTheParams) {
    auto desc = desc_of();
    desc.params.drag = 3;
    const auto dragged = [&](const plait_material* material) {
        desc.materials = material;
        desc.material_count = material ? 1 : 0;
        plait::Sim sim(context, make_groom(tuft(3, 8)), desc);
        run(sim, 10);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    plait_material old = plait_material_defaults();
    old.line_density = desc.material.line_density;
    old.bend_stiffness = desc.material.bend_stiffness;
    old.stretch_stiffness = desc.material.stretch_stiffness;
    old.twist_stiffness = desc.material.twist_stiffness;
    old.section_ratio = desc.material.section_ratio;
    const auto of_params = dragged(nullptr);
    EXPECT_EQ(dragged(&old), of_params);
    old.struct_size = offsetof(plait_material, drag_scale);
    old.drag_scale = old.friction_scale = NAN; // beyond it
    EXPECT_EQ(dragged(&old), of_params);
}

// From the next step on, and through a switch of substeps.
TEST_P(MaterialScales, ChangeWhileTheSimRunsAndGoAlongThroughASwitch) {
    auto desc = desc_of();
    desc.params.drag = 4;
    const std::vector<plait_material> list = of_drag({4, 0});
    plait::Sim changed(context, make_groom(tuft(4, vertices)), desc);
    run(changed, 5);
    give(changed, list, 4);
    plait_sim_reset(changed);
    run(changed, 10);
    const auto expected = changed.read(PLAIT_FIELD_POSITION);

    plait::Sim switched(context, make_groom(tuft(4, vertices)), desc);
    give(switched, list, 4);
    run(switched, 5);
    take_substeps(switched, {2, 2, 2, 2});
    run(switched, 1);
    take_substeps(switched, {1, 1, 1, 1});
    plait_sim_reset(switched);
    run(switched, 10);
    EXPECT_EQ(switched.read(PLAIT_FIELD_POSITION), expected);
    EXPECT_GT(largest_difference(strand_of(expected, 0), strand_of(expected, 1)), 0.02f);
}

} // namespace
