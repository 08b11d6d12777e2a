// What a sim and a groom say of themselves, and what they warn of: lengths that are not hair's,
// sag-free starts that are not reached, parameters that nothing reads.
#include "faulty.hpp"
#include "support.hpp"

#include <cstring>

namespace {

// A context whose log is kept.
struct Logged {
    explicit Logged(const char* backend = "reference") : context(create(backend)) {}

    // Warnings since the last call.
    std::string warnings() {
        std::string taken;
        taken.swap(text);
        return taken;
    }

    std::string text;
    plait::Context context;

  private:
    plait::Context create(const char* backend) {
        auto desc = plait_context_desc_defaults();
        desc.backend = backend;
        desc.log = [](plait_log_level level, const char* line, void* user) {
            if (level == PLAIT_LOG_LEVEL_WARNING)
                *static_cast<std::string*>(user) += std::string(line) + "\n";
        };
        desc.log_user = &text;
        return plait::Context(desc);
    }
};

plait::Groom scaled(const Strands& strands, float scale) {
    auto options = plait_import_options_defaults();
    options.scale = scale;
    return plait::Groom(GroomArrays(strands).desc(), options);
}

bool has(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

// ---- grooms -------------------------------------------------------------------------------------

TEST(GroomUnits, TheLikelyScaleBringsTheMeanLengthToThatOfHair) {
    const Strands strands = tuft(3, 11); // 0.19 m long
    const auto likely = [&](float times) { return scaled(strands, times).describe().likely_scale; };
    EXPECT_EQ(likely(1), 1);
    EXPECT_EQ(likely(100), 0.01f);  // a file in centimetres
    EXPECT_EQ(likely(1000), 0.01f); // 1.9 m: still hair
    EXPECT_EQ(likely(2000), 0.001f);
    EXPECT_EQ(likely(0.01f), 100);
    EXPECT_EQ(likely(1e-4f), 1000);
    EXPECT_EQ(likely(1e5f), 1e-5f);
}

TEST(GroomUnits, TheShortestTheMeanAndTheLongestStrandAreMeasured) {
    const auto info =
        make_groom({{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}, {{0, 0, 1}, {0, 0, 2}}}).describe();
    EXPECT_FLOAT_EQ(info.min_length, 1);
    EXPECT_FLOAT_EQ(info.mean_length, 4);
    EXPECT_FLOAT_EQ(info.max_length, 7);
    EXPECT_EQ(info.likely_scale, 0.01f);
}

TEST(GroomUnits, ASimOfSuchAGroomWarnsWithTheScale) {
    Logged logged;
    plait::Sim fine(logged.context, make_groom(tuft(3, 11)));
    EXPECT_EQ(logged.warnings(), "");
    EXPECT_STREQ(fine.describe().warning, "");
    plait::Sim large(logged.context, scaled(tuft(3, 11), 100));
    const std::string text = logged.warnings();
    EXPECT_TRUE(has(text, "m long in the mean")) << text;
    EXPECT_TRUE(has(text, "scale 0.01, as for a file in centimetres")) << text;
    EXPECT_TRUE(has(text, large.describe().warning)) << text;
}

// ---- sims ---------------------------------------------------------------------------------------

TEST(DescribeSim, SaysWhatItIsAndHasDone) {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_ARTICULATED;
    desc.follows_per_guide = 3;
    desc.substeps = 2;
    plait::Sim sim(make_context("reference"), make_groom(tuft(4, 6)), desc);
    sim.create_collider(smooth_collider());
    run(sim, 5);
    const auto info = sim.describe();
    EXPECT_EQ(info.model, PLAIT_MODEL_ARTICULATED);
    EXPECT_EQ(info.guides, 4u);
    EXPECT_EQ(info.strands, 16u);
    EXPECT_EQ(info.follows_per_guide, 3u);
    EXPECT_EQ(info.vertices_per_strand, 6u);
    EXPECT_EQ(info.substeps, 2u);
    EXPECT_EQ(info.step, desc.step);
    EXPECT_EQ(info.steps, 5u);
    EXPECT_EQ(info.steps_dropped, 0u);
    EXPECT_NEAR(info.time, 5 * frame, 1e-6);
    EXPECT_EQ(info.colliders, 1u);
    EXPECT_EQ(info.sag_free, PLAIT_SAG_FREE_OFF);
    EXPECT_EQ(info.sag_joints, 0u);
    EXPECT_EQ(info.worst_stiffening, 1);
    (void)sim.measure(); // makes a buffer of its own: 4 floats a guide
    EXPECT_EQ(info.device_bytes + 4 * 16, sim.describe().device_bytes);
}

TEST(DescribeSim, LeavesTheDeviceAlone) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    plait::Sim sim(context, make_groom(tuft(2, 4)));
    run(sim, 2);
    faults.lose_after = 0;
    EXPECT_EQ(plait_sim_step(sim, frame), PLAIT_DEVICE_LOST);
    EXPECT_EQ(sim.describe().steps, 2u);
    auto stats = plait_sim_measures_defaults();
    EXPECT_EQ(plait_sim_measure(sim, &stats), PLAIT_DEVICE_LOST);
}

// ---- sag-free start -----------------------------------------------------------------------------

plait::SimDesc sag_free(plait_sag_free mode) {
    plait::SimDesc desc;
    desc.sag_free = mode;
    return desc;
}

TEST(SagReport, StiffenReachesBalanceAndSaysHowMuchItTook) {
    Logged logged;
    plait::Sim sim(logged.context, make_groom(tuft(3, 11)), sag_free(PLAIT_SAG_FREE_STIFFEN));
    const auto info = sim.describe();
    EXPECT_EQ(info.sag_free, PLAIT_SAG_FREE_STIFFEN);
    EXPECT_EQ(info.sag_joints, 30u);
    EXPECT_GT(info.joints_stiffened, 0u);
    EXPECT_GT(info.worst_stiffening, 1);
    EXPECT_LT(info.worst_stiffening, 1000);
    EXPECT_LT(info.sag_residual, 1e-10f);
    EXPECT_EQ(info.sag_unreached, 0u);
    EXPECT_EQ(logged.warnings(), "");
    EXPECT_EQ(info.worst_stiffening, sim.describe().worst_stiffening);
}

TEST(SagReport, RestSaysWhichStrandIsNotInBalance) {
    Logged logged;
    Strands strands = tuft(3, 11);
    for (size_t i = 0; i < 11; ++i) { // hangs: in balance however limp
        strands[0][i] = {0, -0.02f * static_cast<float>(i), 0};
        strands[2][i] = {0.1f, -0.02f * static_cast<float>(i), 0};
    }
    auto desc = sag_free(PLAIT_SAG_FREE_REST);
    desc.material.bend_stiffness = 1e-12f;
    plait::Sim sim(logged.context, make_groom(strands), desc);
    const auto info = sim.describe();
    EXPECT_EQ(info.sag_unreached, 1u);
    EXPECT_EQ(info.worst_residual_strand, 1u);
    EXPECT_GT(info.sag_residual, 0.1f);
    const std::string text = logged.warnings();
    EXPECT_TRUE(has(text, "1 of 3 strands are not in balance")) << text;
    EXPECT_TRUE(has(text, "strand 1")) << text;
    EXPECT_TRUE(has(text, "PLAIT_SAG_FREE_STIFFEN")) << text;
}

TEST(SagReport, MuchStiffeningIsWarnedOfWithTheScale) {
    Logged logged;
    // fur of 1.5 cm in centimetres: 1.5 m is a length that hair has
    plait::Sim sim(logged.context, scaled(tuft(3, 11), 8), sag_free(PLAIT_SAG_FREE_STIFFEN));
    const auto info = sim.describe();
    EXPECT_GT(info.worst_stiffening, 1000);
    const std::string text = logged.warnings();
    EXPECT_TRUE(has(text, "joints were stiffened")) << text;
    EXPECT_TRUE(has(text, "scale 0.01")) << text;
    // told once, and again when it changes
    auto params = sim.params();
    params.drag = 2;
    sim.set_params(params);
    EXPECT_EQ(logged.warnings(), "");
    sim.set_param("bend_stiffness", {0.1 * sim.param("bend_stiffness")[0]});
    EXPECT_TRUE(has(logged.warnings(), "joints were stiffened"));
}

// ---- parameters that nothing reads --------------------------------------------------------------

constexpr plait_model every_model[] = {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED};

// Everything that parameters steer is on: constraints, shock, wind, grid, follows, a moving head.
plait::SimDesc busy(plait_model model) {
    plait::SimDesc desc;
    desc.model = model;
    desc.follows_per_guide = 1;
    plait_tressfx_desc& t = desc.tressfx;
    t.global_stiffness = 0.2f;
    t.global_range = 0.7f;
    t.attachment = 0.9f;
    t.vsp_accel_threshold = 0.003f;
    t.wind[0] = 2;
    t.wind[2] = 1;
    t.air_drag = 0.1f;
    desc.params.tip_separation = 0.3f;
    desc.params.air_with_head = 0.5f;
    desc.params.drag = 1;
    desc.material.groom_stiffness = model == PLAIT_MODEL_ARTICULATED ? 1e-4f : 0;
    desc.grid.edge_count = 4;
    desc.grid.slot_capacity = 2;
    desc.grid.edge = 0.5f;
    for (float& corner : desc.grid.origin)
        corner = -0.2f;
    return desc;
}

// Another value of a parameter, inside its range.
void change(plait::SimDesc& desc, const plait_param_info& info) {
    void* const at = plait::field_of(desc, info);
    if (info.kind == PLAIT_PARAM_KIND_FLOAT) {
        float value;
        std::memcpy(&value, at, sizeof value);
        const std::string name = info.name;
        if (name == "max_displacement")
            value = 1e-3f; // a clamp that bites
        else if (name == "stretch_stiffness")
            value = 0.01f;
        else if (name == "twist_stiffness")
            value = 1e-9f;
        else
            value = value == 0 ? static_cast<float>(std::min(info.most, 0.5)) : value * 0.6f;
        std::memcpy(at, &value, sizeof value);
        return;
    }
    uint32_t value;
    std::memcpy(&value, at, sizeof value);
    if (std::string(info.name) == "bdf2") // the one that is not the model's
        value = desc.model == PLAIT_MODEL_ARTICULATED ? 0 : 1;
    else if (std::string(info.name) == "iterations")
        value = 2; // beside a body none is one
    else
        value = value > info.least ? value - 1 : value + 1;
    std::memcpy(at, &value, sizeof value);
}

// Positions of guides and follows after a while, of hair that begins wet where it may be.
std::vector<float> motion(const plait::Context& context, const plait::Groom& groom,
                          const plait::SimDesc& desc) {
    plait::Sim sim(context, groom, desc);
    if (desc.wetness.on)
        sim.write(PLAIT_FIELD_WETNESS, std::vector<float>(sim.describe().guides, 1.0f));
    auto collider = smooth_collider();
    collider.capsule.radius_a = collider.capsule.radius_b = 0.03f;
    collider.friction = 0.3f;
    collider.pose.t[0] = 0.05f;
    collider.pose.t[1] = -0.06f;
    sim.create_collider(collider);
    for (int i = 1; i <= 8; ++i) {
        const float part = static_cast<float>(i) / 8, share = part * part; // accelerating
        sim.set_roots(head_at({0, 0.03f * share, 0.08f * share},
                              {0, std::sin(0.3f * share), 0, std::cos(0.3f * share)}));
        sim.step(frame);
    }
    return sim.read(PLAIT_FIELD_POSITION);
}

// The scenes in which a parameter may show.
std::vector<plait::SimDesc> scenes(plait_model model) {
    std::vector<plait::SimDesc> list(4, busy(model));
    list[0].grid.on = true;
    list[1].grid.on = true;
    list[1].grid.form = PLAIT_GRID_FORM_SLOTS;
    list[1].grid.edge_count = 2; // strands meet in a voxel
    list[1].grid.diffuse_ratio = 0.1f;
    list[1].grid.diffuse_floor = 0;
    list[1].tressfx.vsp_accel_threshold = 0.002f; // between once and twice: 2.7 mm a frame squared
    list[2].tressfx.wind_form = PLAIT_WIND_FORM_PUBLISHED;
    list[2].grid.on = true;
    list[2].grid.diffuse_rule = PLAIT_DIFFUSE_RULE_THESIS;
    list[3].params.follow_form = PLAIT_FOLLOW_FORM_PUBLISHED;
    list[3].grid.on = true;
    list[3].grid.tent = PLAIT_TENT_FORM_TRILINEAR;
    list[3].grid.diffuse_ratio = 0.1f;
    if (model == PLAIT_MODEL_TRESSFX)
        return list;
    list.resize(6, busy(model));
    for (size_t i = 4; i < 6; ++i) {
        list[i].grid.on = true;
        list[i].volume.on = true;
        list[i].grid.edge_count = 16;
        list[i].volume.cohesion = 0.5f;
    }
    list[5].volume.share = 0.2f; // so dense that the rate bounds how fast it parts
    list.push_back(list[4]);
    list.back().wetness.on = true;
    list.push_back(busy(model));
    list.back().strand_contact.on = true;
    list.back().strand_contact.radius = 0.004f; // 1 cm apart in the groom, and they come nearer
    return list;
}

class WhoReads : public testing::TestWithParam<plait_model> {};
INSTANTIATE_TEST_SUITE_P(Models, WhoReads, testing::ValuesIn(every_model));

// m: of 1/line_density times line_density, say.
constexpr float rounding = 1e-7f;

// The table says which models read a parameter: those whose hair moves otherwise with another
// value, and no others.
TEST_P(WhoReads, IsWhatTheTableSays) {
    const auto context = make_context("reference");
    const auto groom = make_groom(tuft(24, 7));
    const auto list = scenes(GetParam());
    std::vector<std::vector<float>> plain;
    for (const plait::SimDesc& desc : list)
        plain.push_back(motion(context, groom, desc));
    for (const plait_param_info& info : plait::params_list()) {
        const std::string feature = info.feature;
        if (feature == "acceleration")
            continue; // told to a kernel of the caller's: see AccelerationsOnOpenCL
        if (std::string(info.name) == "follow_contact")
            continue; // of hair that follows by a map: see FollowContact
        bool moved = false;
        for (size_t i = 0; i < list.size() && !moved; ++i) {
            if (!plait::has_feature(list[i], info))
                continue;
            if (list[i].strand_contact.on && feature != "strand_contact")
                continue; // which makes much of the last bits of others
            plait::SimDesc desc = list[i];
            change(desc, info);
            moved = largest_difference(motion(context, groom, desc), plain[i]) > rounding;
        }
        EXPECT_EQ(moved, (info.models & (1u << GetParam())) != 0) << info.name;
    }
}

// Once, in the next step: by then features are on that calls turn on.
TEST(IgnoredParams, AreLoggedInTheNextStep) {
    Logged logged;
    plait::SimDesc desc;
    desc.grid.on = desc.volume.on = true;
    desc.grid.diffuse_ratio = 1;
    desc.grid.slot_capacity = 7;
    desc.params.tip_separation = 0.1f;
    desc.material.stretch_stiffness = 1;
    desc.params.drag = 1; // which the model reads
    plait::Sim sim(logged.context, make_groom(tuft(3, 11)), desc);
    EXPECT_EQ(logged.warnings(), "");
    run(sim, 1);
    const std::string text = logged.warnings();
    for (const char* sentence :
         {"params: grid_slot_capacity is set, and is not read by a grid of form 1 (exact)",
          "grid_diffuse_ratio is set, and is not read while volume takes the place",
          "tip_separation is set, and is not read without follows_per_guide",
          "stretch_stiffness is set, and no model of the library reads it"})
        EXPECT_TRUE(has(text, sentence)) << text;
    EXPECT_FALSE(has(text, "drag")) << text;
    run(sim, 2);
    desc.params.drag = 2;
    sim.set_params(desc.params);
    run(sim, 1);
    EXPECT_EQ(logged.warnings(), "") << "said before";
}

TEST(IgnoredParams, OfTheOtherModelAreNamed) {
    Logged logged;
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_TRESSFX;
    desc.params.drag = 3;
    plait::Sim sim(logged.context, make_groom(tuft(2, 6)), desc);
    run(sim, 1);
    const std::string text = logged.warnings();
    EXPECT_TRUE(has(text, "drag is set, and strands of the model tressfx do not read it")) << text;
}

// ---- follows ------------------------------------------------------------------------------------

TEST(FollowGuides, AreReadBackAsPositionsPlaceThem) {
    plait::SimDesc desc;
    desc.follows_per_guide = 2;
    desc.follow_radius = 0.001f;
    plait::Sim sim(make_context("reference"), make_groom(tuft(3, 5)), desc);
    const auto guide = sim.read<uint32_t>(PLAIT_FIELD_FOLLOW_GUIDE);
    const auto p = sim.read(PLAIT_FIELD_POSITION);
    ASSERT_EQ(guide.size(), 6u);
    for (size_t i = 0; i < guide.size(); ++i) {
        ASSERT_LT(guide[i], 3u);
        const float* follow = &p[4 * 5 * (3 + i)];
        const float* root = &p[size_t{4} * 5 * guide[i]];
        EXPECT_LT(std::hypot(follow[0] - root[0], follow[1] - root[1], follow[2] - root[2]), 0.002f)
            << "follow " << i;
    }
}

TEST(FollowGuides, WithoutFollowsThereIsNoMap) {
    plait::Sim sim(make_context("reference"), make_groom(tuft(3, 5)));
    size_t size = 0;
    EXPECT_EQ(plait_sim_read(sim, PLAIT_FIELD_FOLLOW_GUIDE, nullptr, &size), PLAIT_INVALID_STATE);
    EXPECT_TRUE(has(plait_last_error(), "follows_per_guide is 0"));
}

} // namespace
