// What a strand is made of: fibres, flat sections, scales per strand.
#include "stability/one_strand.hpp"

#include <plait/plait_offline.h>

namespace plait::test {
namespace {

TEST(Fibre, gives_the_stiffness_of_its_section) {
    plait_material material = plait_material_defaults();
    material.curl = 0.5f;
    plait_fibre fibre = plait_fibre_defaults();
    PLAIT_EXPECT(plait_material_set_fibre(&material, &fibre));
    EXPECT_FLOAT_EQ(material.line_density, 5.0029863e-6f);    // 1300 pi r^2
    EXPECT_FLOAT_EQ(material.bend_stiffness, 4.7143524e-9f);  // E pi/4 r^4
    EXPECT_FLOAT_EQ(material.twist_stiffness, 3.5357643e-9f); // G pi/2 r^4
    EXPECT_FLOAT_EQ(material.section_ratio, 1.0f);
    EXPECT_EQ(material.curl, 0.5f);
    fibre.flatness = 0.5f;
    PLAIT_EXPECT(plait_material_set_fibre(&material, &fibre));
    EXPECT_FLOAT_EQ(material.line_density, 2.5014932e-6f);
    EXPECT_FLOAT_EQ(material.bend_stiffness, 4.7143524e-9f / 8); // a b^3
    EXPECT_FLOAT_EQ(material.section_ratio, 4.0f);
    EXPECT_FLOAT_EQ(material.twist_stiffness,
                    3.5357643e-9f * 2 * 0.125f / 1.25f); // 2 a^3 b^3/(a^2+b^2)
    fibre.radius = -1.0f;
    const plait_material before = material;
    EXPECT_EQ(plait_material_set_fibre(&material, &fibre), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("radius is -1"), std::string::npos);
    EXPECT_EQ(material.line_density, before.line_density);
}

// 0.1 m, level, curled a little upwards in the plane of x and y.
std::vector<Vec3> curled() {
    std::vector<Vec3> points;
    for (uint32_t i = 0; i < 17; ++i) {
        const float s = static_cast<float>(i) / 16.0f;
        points.push_back({0.1f * s, 0.005f * s * s, 0.0f});
    }
    return points;
}

plait::SimDesc desc_of(float scale, float ratio, size_t axis) {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_ARTICULATED;
    plait_sim_params& p = desc.params;
    p.drag = 20.0f;
    desc.material.bend_stiffness *= scale;
    desc.material.section_ratio = ratio;
    p.gravity[1] = 0.0f;
    p.gravity[axis] = -9.81f;
    return desc;
}

float sag(const plait::SimDesc& desc, size_t axis) {
    OneStrand strand(curled(), desc);
    const float start = strand.tip()[axis];
    strand.run(5.0);
    return start - strand.tip()[axis];
}

TEST(Section, flat_hair_bends_by_its_own_stiffness_in_the_plane_of_its_curl) {
    const float round = sag(desc_of(1, 1, 1), 1);
    EXPECT_GT(round, 0.02f);
    EXPECT_NEAR(sag(desc_of(1, 4, 1), 1), round, 1e-4f);
}

TEST(Section, and_by_the_other_one_across) {
    const float stiff = sag(desc_of(4, 1, 2), 2);
    EXPECT_GT(stiff, 0.01f);
    EXPECT_NEAR(sag(desc_of(1, 4, 2), 2), stiff, 0.05f * stiff); // twists a little, besides
}

TEST(StrandStiffness, scales_strand_by_strand) {
    std::vector<Vec3> points = curled();
    const size_t row = points.size();
    const std::vector<Vec3> one = points;
    points.insert(points.end(), one.begin(), one.end());
    for (const plait_model model : {PLAIT_MODEL_ARTICULATED}) {
        plait::SimDesc desc = desc_of(1, 1, 1);
        desc.model = model;
        const float scales[] = {1.0f, 4.0f};
        desc.strand_stiffness = {scales, 2, 0};
        OneStrand both(points, static_cast<uint32_t>(row), desc, shared_context());
        both.run(1.0);
        plait::SimDesc stiff = desc_of(4, 1, 1);
        stiff.model = model;
        OneStrand single(one, stiff);
        single.run(1.0);
        EXPECT_EQ(both.read(PLAIT_FIELD_POSITION).back(), single.tip());
        EXPECT_LT(both.read(PLAIT_FIELD_POSITION)[row - 1][1], single.tip()[1] - 0.005f);
    }
}

} // namespace
} // namespace plait::test
