// Snapshots that somebody made up, with a checksum that is right: they are refused, or are states
// that the sim goes on from and stays finite.
#include "forged.hpp"
#include "support.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace {

class MadeUp : public testing::TestWithParam<plait_model> {
  protected:
    static plait::SimDesc desc() {
        plait::SimDesc desc;
        desc.model = GetParam();
        desc.interpolate_output = 1;
        desc.params.bdf2 = 1;
        return desc;
    }
    void SetUp() override {
        auto collider = smooth_collider();
        collider.capsule.radius_a = collider.capsule.radius_b = 0.02f;
        collider.pose.t[1] = -0.04f;
        sim.create_collider(collider);
        auto roots = plait_roots_defaults();
        const std::vector<plait_pose> own(2, {{0, 0, 0, 1}, {0.01f, 0, 0}});
        roots.root_poses = plait::view(own);
        sim.set_roots(roots);
        for (int i = 0; i < 3; ++i)
            sim.step(1.0 / 60);
        saved = sim.save();
    }

    plait::Context context = make_context(backends().front());
    plait::Sim sim{context, make_groom(tuft(2, 4)), desc()};
    std::vector<unsigned char> saved;
};
INSTANTIATE_TEST_SUITE_P(Models, MadeUp,
                         testing::Values(PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED));

TEST_P(MadeUp, TheTestSignsAsTheLibraryDoes) {
    auto bytes = saved;
    forged::sign(bytes);
    EXPECT_EQ(bytes, saved);
}

TEST_P(MadeUp, IsRefusedOrStaysFinite) {
    const uint32_t ones = 0xffffffffu, two = 2;
    int restored = 0, refused = 0;
    for (size_t at = forged::covered_from; at + 4 <= saved.size(); at += 4)
        for (const float value :
             {0.0f, -1.0f, 1e3f, 4e6f, 1e30f, std::numeric_limits<float>::quiet_NaN(),
              std::bit_cast<float>(ones), std::bit_cast<float>(two)}) {
            auto bytes = saved;
            std::memcpy(bytes.data() + at, &value, sizeof value);
            forged::sign(bytes);
            if (plait_sim_restore(sim, bytes.data(), bytes.size()) != PLAIT_OK) {
                EXPECT_STRNE(plait_last_error(), "");
                ++refused;
                continue;
            }
            ++restored;
            for (int i = 0; i < 3; ++i)
                sim.step(1.0 / 60);
            ASSERT_EQ(sim.measure().nonfinite, 0u) << "byte " << at << " as " << value;
        }
    EXPECT_GT(restored, 100); // small positions are positions
    EXPECT_GT(refused, 100);
    sim.restore(saved);
    EXPECT_EQ(sim.save(), saved);
}

} // namespace
