// Finite input gives finite output: states without directions, folded, huge or tiny, written into a
// sim with every stage of the parity model switched on.
#include "one_strand.hpp"

namespace plait::test {
namespace {

using State = std::vector<std::array<float, 4>>;
constexpr uint32_t vertices = 17; // no power of two

// A vertex of each state; the strand's roots stay where they are.
struct Degenerate {
    const char* name;
    Vec3 (*place)(uint32_t i);
};

const Degenerate states[] = {
    {"coincident",
     [](uint32_t) {
         return Vec3{0.0f, 0.0f, 0.0f};
     }},
    {"folded",
     [](uint32_t i) {
         return Vec3{0.0f, i % 2 == 0 ? 0.0f : 0.02f, 0.0f};
     }},
    {"against_rest",
     [](uint32_t i) {
         return Vec3{0.0f, 0.02f * static_cast<float>(i), 0.0f};
     }},
    {"denormal",
     [](uint32_t i) {
         return Vec3{1e-40f * static_cast<float>(i), 0.0f, 0.0f};
     }},
    {"tiny",
     [](uint32_t i) {
         return Vec3{0.0f, -1e-25f * static_cast<float>(i), 0.0f};
     }},
    {"far",
     [](uint32_t i) {
         return Vec3{9e5f, 9e5f + static_cast<float>(i), -9e5f};
     }},
    {"one_far",
     [](uint32_t i) {
         return Vec3{i == 9 ? 9e5f : 0.0f, 0.0f, 0.0f};
     }},
};

plait::SimDesc everything_on() {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_TRESSFX;
    desc.follows_per_guide = 2;
    plait_tressfx_desc& tressfx = desc.tressfx;
    tressfx.global_stiffness = 0.4f;
    tressfx.global_range = 0.3f;
    tressfx.max_displacement = 1.0f;
    tressfx.wind[0] = 10.0f;
    tressfx.air_drag = 5.0f;
    desc.params.tip_separation = 1.0f;
    return desc;
}

void add_collider(OneStrand& strand) {
    plait_collider_desc collider = smooth_collider();
    collider.capsule.a[1] = -0.1f; // the strand's rest line is the axis
    collider.capsule.b[1] = -0.2f;
    collider.capsule.radius_a = 0.05f;
    collider.capsule.radius_b = 0.02f;
    collider.friction = 0.5f;
    plait_collider_id id{};
    PLAIT_EXPECT(plait_collider_create(strand.sim(), &collider, &id));
}

void write_state(OneStrand& strand, const Degenerate& state) {
    State x(vertices);
    for (uint32_t i = 0; i < vertices; ++i) {
        const Vec3 p = state.place(i);
        x[i] = {p[0], p[1], p[2], 1.0f};
    }
    const size_t size = x.size() * sizeof x[0];
    PLAIT_EXPECT(plait_sim_write(strand.sim(), PLAIT_FIELD_POSITION, x.data(), size));
    PLAIT_EXPECT(plait_sim_write(strand.sim(), PLAIT_FIELD_POSITION_PREV, x.data(), size));
}

void expect_finite(const OneStrand& strand, const std::string& what) {
    EXPECT_EQ(strand.measure().nonfinite, 0u) << what;
    for (const plait_field field : {PLAIT_FIELD_POSITION, PLAIT_FIELD_TANGENT})
        for (const auto& value : strand.read(field))
            for (const float component : value)
                ASSERT_TRUE(std::isfinite(component)) << what << ", field " << field;
    for (const auto& t : strand.read(PLAIT_FIELD_TANGENT))
        ASSERT_NEAR(std::hypot(t[0], t[1], t[2]), 1.0f, 1e-5f) << what;
}

TEST(Degenerate, states_stay_finite_with_every_option) {
    const StrandShape shape{vertices, 0.3f, {0.0f, -1.0f, 0.0f}};
    for (const Degenerate& state : states)
        for (const plait_grid_form form : {PLAIT_GRID_FORM_SLOTS, PLAIT_GRID_FORM_EXACT})
            for (const int published : {0, 1}) {
                plait::SimDesc desc = everything_on();
                desc.grid.on = true;
                desc.grid.form = form;
                desc.grid.tent = published ? PLAIT_TENT_FORM_VOXEL : PLAIT_TENT_FORM_TRILINEAR;
                desc.tressfx.wind_form =
                    published ? PLAIT_WIND_FORM_PUBLISHED : PLAIT_WIND_FORM_DRAG;
                desc.tressfx.shock_form =
                    published ? PLAIT_SHOCK_FORM_THRESHOLD : PLAIT_SHOCK_FORM_CONTINUOUS;
                desc.tressfx.order =
                    published ? PLAIT_STAGE_ORDER_PUBLISHED : PLAIT_STAGE_ORDER_SHOCK_BEFORE_GLOBAL;
                OneStrand strand(shape, desc);
                add_collider(strand);
                write_state(strand, state);
                const std::string what = std::string(state.name) + (published ? ", published" : "");
                strand.step();
                expect_finite(strand, what + ", after a step");
                strand.run(0.5);
                expect_finite(strand, what + ", after half a second");
            }
}

// What was broken recovers: the strand ends up near where it hangs when nothing happened.
TEST(Degenerate, strands_recover) {
    const StrandShape shape{vertices, 0.3f, {0.0f, -1.0f, 0.0f}};
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_TRESSFX;
    desc.tressfx.global_stiffness = 0.2f; // gives coincident vertices a direction to part in
    desc.tressfx.global_range = 1.0f;
    OneStrand undisturbed(shape, desc);
    undisturbed.run(5.0);
    for (const Degenerate& state : states) {
        OneStrand strand(shape, desc);
        write_state(strand, state);
        strand.run(5.0);
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(strand.tip()[c], undisturbed.tip()[c], 1e-3f) << state.name;
    }
}

} // namespace
} // namespace plait::test
