// A plane curl at its instability: each half of row 16 has to fail where the other is.
#include "accuracy/rows.hpp"
#include "measured.hpp"

#include <gtest/gtest.h>

using lab::Verdict;

namespace {

Verdict verdict_of(const std::string& id, const lab::Method& rod, double gamma) {
    static lab::Contexts contexts("opencl", "");
    for (const lab::Row& row : lab::read_rows(PLAIT_SCENES "/accuracy.json"))
        if (row.id == id) {
            lab::Variant variant = row.variants.front();
            variant.overrides["material"]["gamma"] = gamma;
            const lab::Scene scene = scene_of(row, variant).scene;
            const lab::Measure& measure = scene.measures[0];
            return judge(measure, rod, evaluate(scene, rod, record(contexts, scene, rod), measure));
        }
    ADD_FAILURE() << "no row " << id;
    return Verdict::none;
}

// Romero et al. 2021: cube root of gamma over its 20 rad is 0.61 where GJ/EI is 0.69. The 32
// chords of the scene turn out at 1.02 times that (the least eigenvalue of their energy's second
// derivative out of the plane).
constexpr double boundary = 0.61 * 20 * 0.61 * 20 * 0.61 * 20;

TEST(LabCurl, halves_fail_on_the_other_side) {
    const lab::Method rod{lab::find_model("rod"), {2, 1, true}};
    EXPECT_EQ(verdict_of("16a", rod, 0.97 * boundary), Verdict::pass);
    EXPECT_EQ(verdict_of("16a", rod, 1.03 * boundary), Verdict::fail);
    EXPECT_EQ(verdict_of("16b", rod, 1.03 * boundary), Verdict::pass);
    EXPECT_EQ(verdict_of("16b", rod, 0.97 * boundary), Verdict::fail);
}

} // namespace
