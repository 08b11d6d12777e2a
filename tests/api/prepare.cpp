// plait_context_prepare: after it sims compile nothing of what they were said to do.
#include "faulty.hpp"
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <functional>
#include <memory>

namespace {

// How many programs a device has taken for its kernels.
struct Log {
    std::vector<std::string> stages;

    static void add(plait_log_level, const char* text, void* user) {
        const std::string line = text;
        if (line.starts_with("stage ") &&
            (line.find(": built, ") != line.npos || line.find(": loaded, ") != line.npos ||
             line.find(": shared, ") != line.npos))
            static_cast<Log*>(user)->stages.push_back(line);
    }
};

plait::Context logging(const std::string& backend, Log& log) {
    auto desc = plait_context_desc_defaults();
    desc.backend = backend.c_str();
    desc.log = Log::add;
    desc.log_user = &log;
    return plait::Context(desc);
}

plait::Mesh box() {
    const ShapeMesh shape = box_mesh(0.05, 0.05, 0.05);
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

plait::Groom skinned() {
    const GroomArrays arrays(tuft(3, 7));
    const std::vector<uint32_t> bones(12, 0);
    const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    auto desc = arrays.desc();
    desc.bone_indices = plait::view(bones, 4);
    desc.bone_weights = plait::view(weights, 4);
    return plait::Groom(desc);
}

// Two classes of length.
Strands short_and_long() {
    Strands strands = tuft(100, 64);
    for (const Strand& strand : tuft(200, 6))
        strands.push_back(strand);
    return strands;
}

void use_all_calls(plait::Sim& sim) {
    for (const plait_collider_kind kind :
         {PLAIT_COLLIDER_KIND_CAPSULE, PLAIT_COLLIDER_KIND_PLANE, PLAIT_COLLIDER_KIND_BOX}) {
        auto desc = smooth_collider();
        desc.kind = kind;
        desc.capsule.a[1] = -0.5f;
        sim.create_collider(desc);
    }
    sim.create_hull(box());
    sim.set_roots(head_at({0, 0, 0}));
    for (int i = 1; i < 4; ++i) {
        sim.set_roots(head_at({0.01f * static_cast<float>(i), 0, 0}));
        sim.step(1.3 * frame);
    }
    sim.teleport(head_at({1, 0, 0}));
    run(sim, 1);
    sim.step(0.5);
    sim.measure();
    sim.read(PLAIT_FIELD_BOUNDS);
    const auto now = sim.read(PLAIT_FIELD_POSITION_PREV);
    sim.write(PLAIT_FIELD_POSITION, now);
    sim.write(PLAIT_FIELD_VELOCITY, std::vector<float>(now.size(), 0.0f));
    run(sim, 1);
    sim.restore(sim.save());
    sim.reset();
    run(sim, 1);
}

// A sim that has a feature, and what it does with it.
struct Case {
    const char* name;
    uint32_t features;
    std::function<void(plait::SimDesc&)> change;
    std::function<void(plait::Sim&)> use;
    std::function<plait::Groom()> groom = [] { return make_groom(tuft(3, 7)); };
    uint32_t models = 1u << PLAIT_MODEL_ARTICULATED;
    bool has_map = false;
};

std::function<void(plait::SimDesc&)> same() {
    return [](plait::SimDesc&) {};
}

void blow(plait::Sim& sim) {
    auto wind = plait_wind_desc_defaults();
    wind.velocity[0] = 3;
    wind.turbulence = 1;
    sim.set_wind(wind);
}

void add_bending(plait::Sim& sim) {
    const auto mesh = box();
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = PLAIT_MESH_FORM_NEAREST;
    const auto id = sim.create_collider(mesh, desc);
    const auto positions = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    run(sim, 1);
    sim.set_collider_positions(id, plait::view(positions, 3));
}

void wet(plait::Sim& sim) {
    sim.write(PLAIT_FIELD_WETNESS, {1, 0.5f, 0});
}

void curl_follows(plait::Sim& sim) {
    auto detail = plait_detail_desc_defaults();
    std::fill_n(detail.clump, 4, 0.5f);
    std::fill_n(detail.curl, 4, 0.001f);
    sim.set_detail(detail);
}

const std::vector<Case>& cases() {
    static const std::vector<Case> list = {
        {"nothing", 0, [](auto& d) { d.keep_last_frame = 1; }, use_all_calls},
        {"lengths", 0, same(), use_all_calls, [] { return make_groom(short_and_long()); }},
        {"tressfx", 0, [](auto& d) { d.model = PLAIT_MODEL_TRESSFX; }, use_all_calls,
         [] { return make_groom(tuft(3, 7)); }, 1u << PLAIT_MODEL_TRESSFX},
        {"tressfx with all that it may have",
         PLAIT_FEATURE_WIND | PLAIT_FEATURE_FRAME | PLAIT_FEATURE_GRID | PLAIT_FEATURE_FOLLOWS,
         [](auto& d) {
             d.model = PLAIT_MODEL_TRESSFX;
             d.follows_per_guide = 1;
             d.tressfx.wind[0] = d.tressfx.air_drag = d.tressfx.attachment = 1;
             d.tressfx.global_stiffness = d.tressfx.global_range = 0.1f;
             d.tressfx.order = PLAIT_STAGE_ORDER_SHOCK_BEFORE_GLOBAL;
             d.tressfx.max_displacement = 0.1f;
             d.grid.on = true;
         },
         [](plait::Sim& sim) {
             sim.set_frame(plait_frame_desc_defaults());
             use_all_calls(sim);
         },
         [] { return make_groom(tuft(3, 7)); }, 1u << PLAIT_MODEL_TRESSFX},
        {"switches", PLAIT_FEATURE_SWITCHES, same(),
         [](plait::Sim& sim) {
             take_substeps(sim, {1, 2, 4});
             run(sim, 1);
             sim.set_settings({of_substeps(2)});
         },
         [] { return make_groom(tuft(3, 7)); }},
        {"skin", PLAIT_FEATURE_SKIN, same(),
         [](plait::Sim& sim) {
             const std::vector<float> bones = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
             auto roots = plait_roots_defaults();
             roots.bones = plait::view(bones, 12);
             sim.set_roots(roots);
         },
         skinned},
        {"bound roots", PLAIT_FEATURE_BOUND_ROOTS, same(),
         [](plait::Sim& sim) {
             const auto mesh = box();
             sim.bind_roots(mesh);
             const auto positions = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
             auto roots = plait_roots_defaults();
             roots.mesh_positions = plait::view(positions, 3);
             sim.set_roots(roots);
         }},
        {"a frame", PLAIT_FEATURE_FRAME, same(),
         [](plait::Sim& sim) {
             for (int i = 0; i < 3; ++i) {
                 auto desc = plait_frame_desc_defaults();
                 desc.pose.t[0] = 0.1f * static_cast<float>(i);
                 sim.set_frame(desc);
                 run(sim, 1);
             }
         }},
        {"meshes", PLAIT_FEATURE_MESHES, same(),
         [](plait::Sim& sim) { sim.create_collider(box()); }},
        {"meshes that bend", PLAIT_FEATURE_BENDING_MESHES, same(), add_bending},
        {"pins", PLAIT_FEATURE_PINS, same(),
         [](plait::Sim& sim) {
             plait_pin pin{};
             pin.vertex = 3;
             pin.stiffness = 1;
             sim.set_pins({pin});
         }},
        {"groom", PLAIT_FEATURE_GROOM, [](auto& d) { d.params.groom = 0.5f; }, [](plait::Sim&) {}},
        {"acceleration", PLAIT_FEATURE_ACCELERATION, [](auto& d) { d.acceleration.on = true; },
         [](plait::Sim&) {}},
        {"wind", PLAIT_FEATURE_WIND, same(), blow},
        {"wind and meshes",
         PLAIT_FEATURE_WIND | PLAIT_FEATURE_MESHES | PLAIT_FEATURE_BENDING_MESHES, same(),
         [](plait::Sim& sim) {
             blow(sim);
             sim.create_collider(box());
             add_bending(sim);
         }},
        {"exact grid", PLAIT_FEATURE_GRID, [](auto& d) { set_grid(d, Grid::exact); },
         use_all_calls},
        {"slots", PLAIT_FEATURE_SLOTS, [](auto& d) { set_grid(d, Grid::slots); }, use_all_calls},
        {"volume", PLAIT_FEATURE_VOLUME, [](auto& d) { d.volume.on = true; }, use_all_calls},
        {"strand contact", PLAIT_FEATURE_STRAND_CONTACT,
         [](auto& d) { d.strand_contact.on = true; }, use_all_calls},
        {"wetness", PLAIT_FEATURE_WETNESS, [](auto& d) { d.wetness.on = true; }, wet},
        {"follows of guides", PLAIT_FEATURE_FOLLOWS, [](auto& d) { d.follows_per_guide = 2; },
         use_all_calls},
        {"follows by a map, wet, curled, among meshes",
         PLAIT_FEATURE_FOLLOWS | PLAIT_FEATURE_DETAIL | PLAIT_FEATURE_WETNESS |
             PLAIT_FEATURE_MESHES | PLAIT_FEATURE_BENDING_MESHES,
         [](auto& d) { d.wetness.on = true; },
         [](plait::Sim& sim) {
             curl_follows(sim);
             wet(sim);
             sim.create_collider(box());
             add_bending(sim);
             use_all_calls(sim);
         },
         [] { return make_groom(tuft(12, 7)); }, 1u << PLAIT_MODEL_ARTICULATED, true},
    };
    return list;
}

// Prepares, calls `prepared` and has a sim do what it said it would.
template <typename Prepared>
void go_through(const Case& of, const plait::Context& context, bool with_groom,
                const Prepared& prepared) {
    plait::Groom groom = of.groom();
    auto guides = std::make_unique<plait::Guides>(groom.guides(3));
    const plait::Groom& hair = of.has_map ? guides->groom : groom;
    auto announced = plait_prepare_desc_defaults();
    announced.models = of.models;
    announced.features = of.features;
    announced.groom = with_groom ? hair.get() : nullptr;
    announced.vertices_per_strand = with_groom ? 0 : hair.describe().max_vertices;
    ASSERT_EQ(plait_context_prepare(context, &announced), PLAIT_OK) << plait_last_error();
    prepared();
    plait::SimDesc desc;
    of.change(desc);
    desc.follow_map = of.has_map ? guides->map.get() : nullptr;
    plait::Sim sim(context, hair, desc);
    of.use(sim);
    run(sim, 2);
}

class Prepare : public OnBackend {};
ON_EVERY_BACKEND(Prepare);

TEST_P(Prepare, NothingThatWasAnnouncedIsBuiltLater) {
    for (const Case& of : cases())
        for (const bool with_groom : {true, false}) {
            if (!with_groom && std::string(of.name) == "lengths")
                continue; // nobody knows them
            Log log;
            const auto own = logging(GetParam(), log);
            size_t before = 0;
            go_through(of, own, with_groom, [&] { before = log.stages.size(); });
            for (size_t i = before; i < log.stages.size(); ++i)
                ADD_FAILURE() << of.name << ": " << log.stages[i];
        }
}

// On one lane, where hair is seen otherwise.
TEST(PrepareOnFaulty, NothingThatWasAnnouncedIsEnqueuedForTheFirstTimeLater) {
    for (const Case& of : cases()) {
        Faults& faults = faulty();
        const auto context = make_context("faulty");
        bool before[PLAIT_STAGE_COUNT];
        go_through(of, context, true, [&] { std::ranges::copy(faults.prepared, before); });
        for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage)
            EXPECT_LE(faults.submitted[stage], before[stage])
                << of.name << ": " << plait_stage_describe(static_cast<plait_stage>(stage))->name;
    }
}

// Of stages, that are for nothing but what was asked for.
TEST(PrepareOnFaulty, BuildsNoMoreThanWasAskedFor) {
    const Faults& faults = faulty();
    const auto context = make_context("faulty");
    ASSERT_EQ(plait_context_prepare(context, nullptr), PLAIT_OK) << plait_last_error();
    std::vector<std::string> names;
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage)
        if (faults.prepared[stage])
            names.emplace_back(plait_stage_describe(static_cast<plait_stage>(stage))->name);
    EXPECT_EQ(names, (std::vector<std::string>{"roots", "articulated", "lane_reset",
                                               "lane_teleport", "lane_set_off", "lane_unpack",
                                               "lane_pack", "lane_orient", "output_keep", "output",
                                               "tangents", "last_frame", "bounds", "stats"}));
}

struct Progress {
    uint32_t stop_at = UINT32_MAX; // done
    std::vector<std::string> stages;
    uint32_t done = 0, total = 0;

    static int report(uint32_t done, uint32_t total, const char* stage, void* user) {
        auto& self = *static_cast<Progress*>(user);
        EXPECT_EQ(done, self.stages.size());
        self.stages.emplace_back(stage);
        self.done = done;
        self.total = total;
        return done == self.stop_at;
    }
};

TEST_P(Prepare, TellsHowFarItIsAndStops) {
    Progress whole;
    auto desc = plait_prepare_desc_defaults();
    desc.progress = Progress::report;
    desc.progress_user = &whole;
    ASSERT_EQ(plait_context_prepare(context, &desc), PLAIT_OK) << plait_last_error();
    EXPECT_EQ(whole.done, whole.total);
    EXPECT_EQ(whole.stages.back(), "");
    EXPECT_EQ(whole.stages.size(), whole.total + 1);
    EXPECT_NE(std::ranges::find(whole.stages, "articulated"), whole.stages.end());

    Progress cut;
    cut.stop_at = 3;
    desc.progress_user = &cut;
    EXPECT_EQ(plait_context_prepare(context, &desc), PLAIT_CANCELLED);
    EXPECT_EQ(cut.stages.size(), 4u);
    EXPECT_NE(std::string(plait_last_error()).find("after 3 of 14 stages"), std::string::npos)
        << plait_last_error();
    desc.progress = nullptr;
    EXPECT_EQ(plait_context_prepare(context, &desc), PLAIT_OK) << plait_last_error();
}

TEST_P(Prepare, SaysWhatItCannot) {
    const auto refused = [&](const auto& change, const char* sentence) {
        auto desc = plait_prepare_desc_defaults();
        change(desc);
        EXPECT_EQ(plait_context_prepare(context, &desc), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
    };
    for (const uint32_t vertices : {1u, 257u})
        refused([&](auto& d) { d.vertices_per_strand = vertices; }, "range is [2, 256], or 0");
    refused([](auto& d) { d.models = 0; }, "desc->models is 0x0, range is [1, 0x3]");
    refused([](auto& d) { d.models = 32; }, "desc->models is 0x20");
    refused([](auto& d) { d.features = 1u << 17; }, "desc->features is 0x20000");
}

TEST(PrepareOnFaulty, ALackingStageIsNamed) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    faults.missing = PLAIT_STAGE_lane_wind;
    EXPECT_EQ(plait_context_prepare(context, nullptr), PLAIT_OK) << plait_last_error();
    auto desc = plait_prepare_desc_defaults();
    desc.features = PLAIT_FEATURE_WIND;
    EXPECT_EQ(plait_context_prepare(context, &desc), PLAIT_UNSUPPORTED);
    EXPECT_NE(std::string(plait_last_error()).find("lane_wind"), std::string::npos);
    faults.missing = PLAIT_STAGE_COUNT;
}

} // namespace
