// Scenes in which tressfx.cpp shows the parity model to fail, and others that methods fail in, run
// with the default model. One strand of 0.3 m, 17 vertices and the default hair, unless said
// otherwise.
#include "scenes.hpp"

#include <ostream>

namespace plait::test {
namespace {

constexpr StrandShape level{17, 0.3f, {1.0f, 0.0f, 0.0f}};
constexpr StrandShape hanging{17, 0.3f, {0.0f, -1.0f, 0.0f}};

plait::SimDesc desc_of(float hz = 60.0f) {
    plait::SimDesc desc;
    desc.step = 1.0f / hz;
    return desc;
}

float distance(const std::array<float, 4>& a, const std::array<float, 4>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

float worst_distance(const std::vector<std::array<float, 4>>& a,
                     const std::vector<std::array<float, 4>>& b) {
    EXPECT_EQ(a.size(), b.size());
    float worst = 0.0f;
    for (size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, distance(a[i], b[i]));
    return worst;
}

class Strand : public testing::Test {
  protected:
    static plait::SimDesc desc(float hz = 60.0f) { return desc_of(hz); }
    static constexpr float rounding = 2e-4f; // lengths, after ten steps
};

TEST_F(Strand, sag_does_not_depend_on_the_step) {
    OneStrand at_60(level, desc());
    at_60.run(20.0);
    for (const float hz : {30.0f, 120.0f, 240.0f}) {
        OneStrand strand(level, desc(hz));
        strand.run(20.0);
        EXPECT_LT(distance(strand.tip(), at_60.tip()), 0.005f * 0.3f) << hz << " Hz";
    }
}

TEST_F(Strand, sag_does_not_depend_on_the_iterations) {
    OneStrand usual(level, desc());
    usual.run(20.0);
    for (const uint32_t iterations : {1u, 2u, 8u, 32u}) {
        plait::SimDesc with = desc();
        with.params.iterations = iterations;
        OneStrand strand(level, with);
        strand.run(20.0);
        EXPECT_LT(distance(strand.tip(), usual.tip()), 0.005f * 0.3f) << iterations;
    }
}

// 1 g: 0.1 % by default under the whole weight; the first segment bears half its own less.
TEST_F(Strand, hangs_without_stretch) {
    for (const uint32_t vertices : {2u, 8u, 16u, 64u, 256u}) {
        StrandShape shape = hanging;
        shape.vertices = vertices;
        OneStrand strand(shape, desc());
        strand.run(10.0);
        EXPECT_LT(strand.measure().max_stretch, 1e-3f) << vertices << " vertices";
    }
}

TEST_F(Strand, teleport_carries_the_strand_as_it_is) {
    OneStrand strand(hanging, desc());
    strand.run(1.0);
    strand.teleport({30.0f, 0.0f, 0.0f});
    EXPECT_LT(worst_stretch_over(strand, 60), 0.002f);
    EXPECT_NEAR(strand.tip()[0], 30.0f, 1e-3f);
}

// The head jumps 30 m and nobody says so: 100 lengths within a step, 1800 m/s.
TEST_F(Strand, survives_a_jump) {
    OneStrand strand(hanging, desc());
    strand.run(1.0);
    strand.move_head({30.0f, 0.0f, 0.0f});
    worst_stretch_over(strand, 60); // finite
    strand.run(10.0);
    EXPECT_LT(strand.measure().max_stretch, 0.01f);
    EXPECT_LT(strand.tip()[1], -0.29f);
}

TEST_F(Strand, shaken_root_hardly_stretches) {
    OneStrand strand(hanging, desc());
    EXPECT_LT(stretch_when_shaken(strand).worst, 1e-4f);
}

// The same everywhere.
void blow(OneStrand& strand, const Vec3& velocity) {
    plait_wind_desc wind = plait_wind_desc_defaults();
    std::copy(velocity.begin(), velocity.end(), wind.velocity);
    wind.shelter = 0;
    PLAIT_EXPECT(plait_sim_set_wind(strand.sim(), &wind));
}

TEST_F(Strand, wind_blows_with_the_wind) {
    OneStrand strand(hanging, desc());
    blow(strand, {5.0f, 0.0f, 0.0f});
    strand.run(2.0);
    EXPECT_GT(strand.tip()[0], 0.02f);
}

TEST_F(Strand, jittering_frames_do_not_reach_the_solver) {
    const float even = peak_speed_when_swayed({level, desc()}, false);
    EXPECT_GT(even, 0.25f);
    EXPECT_NEAR(peak_speed_when_swayed({level, desc()}, true), even, 0.01f * even);
}

TEST_F(Strand, zero_length_segment_stays_finite) {
    OneStrand strand(with_zero_length_segment(level), desc());
    EXPECT_EQ(strand.groom_info().repairs[PLAIT_REPAIR_ZERO_SEGMENT], 1u);
    EXPECT_LT(worst_stretch_over(strand, 60), 0.01f);
    strand.run(5.0);
    EXPECT_LT(strand.tip()[1], -0.2f);
}

// The most a vertex moves in a step, in lengths, after 20 s.
float flicker(const plait::SimDesc& desc, uint32_t vertices) {
    StrandShape shape = level;
    shape.vertices = vertices;
    OneStrand strand(shape, desc);
    strand.run(20.0);
    float worst = 0.0f;
    for (int i = 0; i < 30; ++i) {
        const auto before = strand.read(PLAIT_FIELD_POSITION);
        strand.step();
        worst = std::max(worst, worst_distance(before, strand.read(PLAIT_FIELD_POSITION)));
    }
    return worst / shape.length;
}

TEST_F(Strand, settled_strand_does_not_flicker) {
    // BDF2 swings on for as long as the drag of 1/s lets it, e^-10 after 20 s
    EXPECT_LT(flicker(desc(), 17), 1e-5f);
}

TEST_F(Strand, many_short_segments_do_not_flicker) {
    EXPECT_LT(flicker(desc(), 64), 1e-5f);
}

// ---- the same result in another place, order or width -------------------------------------------

Vec3 rotated(const std::array<float, 4>& q, const Vec3& v) {
    const Vec3 u{q[0], q[1], q[2]};
    const auto cross = [](const Vec3& a, const Vec3& b) {
        return Vec3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]};
    };
    const Vec3 t = cross(u, v), s = cross(u, t);
    return {v[0] + 2 * (q[3] * t[0] + s[0]), v[1] + 2 * (q[3] * t[1] + s[1]),
            v[2] + 2 * (q[3] * t[2] + s[2])};
}

// Curls of differing width and heading, 0.3 m of arc each, side by side.
std::vector<Vec3> curls(uint32_t strands, uint32_t vertices = 17) {
    std::vector<Vec3> points;
    for (uint32_t s = 0; s < strands; ++s) {
        const float turn = 0.1f + 0.02f * static_cast<float>(s); // rad per segment
        const float heading = 0.7f * static_cast<float>(s);
        Vec3 p{0.01f * static_cast<float>(s), 0.0f, 0.0f};
        for (uint32_t i = 0; i < vertices; ++i) {
            points.push_back(p);
            const float a = heading + turn * static_cast<float>(i);
            p[0] += 0.015f * std::cos(a);
            p[1] += 0.012f * std::sin(a);
            p[2] += 0.009f * std::sin(a);
        }
    }
    return points;
}

TEST_F(Strand, turned_world_turns_the_result) {
    const std::array<float, 4> q{0.1825742f, 0.3651484f, 0.5477226f, 0.7302967f};
    const plait::SimDesc windy = desc();
    std::vector<Vec3> points = curls(3);
    OneStrand plain(points, 17, windy, shared_context());
    for (Vec3& p : points)
        p = rotated(q, p);
    plait::SimDesc turned_desc = windy;
    const Vec3 gravity = rotated(q, {0.0f, windy.params.gravity[1], 0.0f});
    const Vec3 wind = rotated(q, {0.0f, 0.0f, 1.0f});
    std::copy(gravity.begin(), gravity.end(), turned_desc.params.gravity);
    OneStrand turned(points, 17, turned_desc, shared_context());
    blow(plain, {0.0f, 0.0f, 1.0f});
    blow(turned, wind);
    plain.run(10.0 / 60.0);
    turned.run(10.0 / 60.0);
    auto expected = plain.read(PLAIT_FIELD_POSITION);
    for (auto& x : expected) {
        const Vec3 r = rotated(q, {x[0], x[1], x[2]});
        x = {r[0], r[1], r[2], x[3]};
    }
    EXPECT_LT(worst_distance(turned.read(PLAIT_FIELD_POSITION), expected), rounding * 0.3f);
}

// Positions are relative to the root: far away only the sum that is shown is rounded, 4 um at 64 m.
TEST_F(Strand, moved_world_moves_the_result) {
    const Vec3 away{64.0f, -32.0f, 16.0f};
    OneStrand here(curls(20), 17, desc(), shared_context());
    OneStrand there(curls(20), 17, desc(), shared_context());
    there.teleport(away);
    here.run(1.0);
    there.run(1.0);
    auto expected = here.read(PLAIT_FIELD_POSITION);
    for (auto& x : expected)
        for (size_t c = 0; c < 3; ++c)
            x[c] += away[c];
    EXPECT_LT(worst_distance(there.read(PLAIT_FIELD_POSITION), expected), 1e-5f);
}

// Strands know nothing of their neighbours, also not within one work-item.
TEST_F(Strand, order_of_strands_does_not_matter) {
    constexpr size_t strands = 20;
    const std::vector<Vec3> points = curls(strands);
    std::vector<Vec3> reversed(points.size());
    for (size_t s = 0; s < strands; ++s)
        std::copy_n(points.begin() + static_cast<long>(17 * s), 17,
                    reversed.begin() + static_cast<long>(17 * (strands - 1 - s)));
    OneStrand a(points, 17, desc(), shared_context());
    OneStrand b(reversed, 17, desc(), shared_context());
    a.run(1.0);
    b.run(1.0);
    const auto x = a.read(PLAIT_FIELD_POSITION), y = b.read(PLAIT_FIELD_POSITION);
    for (size_t s = 0; s < strands; ++s)
        for (size_t i = 0; i < 17; ++i)
            EXPECT_EQ(x[17 * s + i], y[17 * (strands - 1 - s) + i]) << "strand " << s;
}

Context context_with(uint32_t lanes, const char* backend = nullptr) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.lanes = lanes;
    desc.backend = backend;
    return make_context(&desc);
}

TEST_F(Strand, every_width_and_the_reference_agree) {
    const auto after_ten_steps = [&](plait_context* context) {
        OneStrand strand(curls(20), 17, desc(), context);
        strand.run(10.0 / 60.0);
        return strand.read(PLAIT_FIELD_POSITION);
    };
    const Context reference = context_with(0, "reference");
    const auto expected = after_ten_steps(reference.get());
    for (const uint32_t lanes : {1u, 4u, 8u, 16u}) {
        const Context context = context_with(lanes);
        EXPECT_LT(worst_distance(after_ten_steps(context.get()), expected), rounding * 0.3f)
            << lanes << " lanes";
    }
}

// A strand alone is a work-group of one, whatever the device takes for a hundred.
TEST_F(Strand, size_of_the_work_group_does_not_matter) {
    constexpr uint32_t strands = 100;
    const std::vector<Vec3> points = curls(strands);
    for (const uint32_t lanes : {1u, 16u}) {
        const Context context = context_with(lanes);
        OneStrand all(points, 17, desc(), context.get());
        all.run(0.5);
        const auto x = all.read(PLAIT_FIELD_POSITION);
        for (const uint32_t s : {0u, 41u, strands - 1}) {
            const long first = long{17} * s;
            OneStrand alone({points.begin() + first, points.begin() + first + 17}, 17, desc(),
                            context.get());
            alone.run(0.5);
            EXPECT_EQ(alone.read(PLAIT_FIELD_POSITION),
                      std::vector(x.begin() + first, x.begin() + first + 17))
                << "strand " << s << ", " << lanes << " lanes";
        }
    }
}

uint64_t hash_of(const OneStrand& strand) {
    uint64_t hash = 0;
    PLAIT_EXPECT(plait_sim_hash(strand.sim(), &hash));
    return hash;
}

TEST_F(Strand, state_moves_to_a_device_of_another_width) {
    plait::SimDesc bdf2 = desc();
    bdf2.params.bdf2 = 1;
    const Context wide = context_with(16), narrow = context_with(4);
    OneStrand from(curls(20), 17, bdf2, wide.get());
    from.run(0.5);
    size_t size = 0;
    PLAIT_EXPECT(plait_sim_save(from.sim(), nullptr, &size));
    std::vector<unsigned char> state(size);
    PLAIT_EXPECT(plait_sim_save(from.sim(), state.data(), &size));
    OneStrand to(curls(20), 17, bdf2, narrow.get());
    EXPECT_NE(hash_of(to), hash_of(from));
    PLAIT_EXPECT(plait_sim_restore(to.sim(), state.data(), size));
    EXPECT_EQ(hash_of(to), hash_of(from));
    from.step();
    to.step();
    EXPECT_LT(worst_distance(to.read(PLAIT_FIELD_POSITION), from.read(PLAIT_FIELD_POSITION)),
              1e-5f * 0.3f);
}

// ---- parameters at their ends -------------------------------------------------------------------

TEST_F(Strand, bdf2_can_be_switched_while_it_moves) {
    OneStrand strand(level, desc());
    plait_sim_params params = desc().params;
    float worst = 0.0f;
    for (const uint32_t on : {1u, 0u, 1u}) {
        strand.run(0.25);
        params.bdf2 = on;
        PLAIT_EXPECT(plait_sim_set_params(strand.sim(), &params));
        worst = std::max(worst, worst_stretch_over(strand, 15));
    }
    EXPECT_LT(worst, 0.02f);
}

TEST_F(Strand, any_number_of_iterations_stays_finite) {
    for (const uint32_t iterations : {0u, 1u, 2u, 5u, 64u}) {
        plait::SimDesc with = desc();
        with.params.iterations = iterations;
        OneStrand strand(level, with);
        EXPECT_LT(worst_stretch_over(strand, 60), 0.1f) << iterations;
    }
}

TEST_F(Strand, any_bend_stiffness_stays_finite) {
    for (const float EI : {0.0f, 1e-12f, 1e-10f, 1e-8f, 1e-6f, 1e-4f, 1e-2f, 1.0f}) {
        plait::SimDesc with = desc();
        with.material.bend_stiffness = EI;
        OneStrand strand(level, with);
        strand.move_head({0.1f, 0.0f, 0.0f});
        EXPECT_LT(worst_stretch_over(strand, 60), 0.1f) << EI << " N m^2";
        strand.run(5.0);
        EXPECT_LT(strand.measure().max_stretch, 0.01f) << EI << " N m^2";
    }
}

// Level hair without bend stiffness falls as a chain does.
TEST_F(Strand, limp_hair_falls) {
    for (const float length : {0.01f, 0.3f}) {
        plait::SimDesc limp = desc();
        limp.material.bend_stiffness = 0.0f;
        limp.params.drag = 3.0f;
        StrandShape shape = level;
        shape.length = length;
        OneStrand strand(shape, limp);
        EXPECT_LT(worst_stretch_over(strand, 60), 0.03f);
        strand.run(9.0);
        EXPECT_LT(strand.tip()[1], -0.98f * length) << length << " m";
    }
}

TEST_F(Strand, long_steps_of_stiff_hair) {
    plait::SimDesc with = desc(15.0f);
    with.material.bend_stiffness *= 1e4f;
    OneStrand strand(level, with);
    float worst = 0.0f;
    for (int i = 1; i <= 60; ++i) {
        strand.move_head({0.0f, 0.05f * std::sin(0.8f * static_cast<float>(i)), 0.0f});
        worst = std::max(worst, worst_stretch_over(strand, 1));
    }
    EXPECT_LT(worst, 0.1f);
}

} // namespace
} // namespace plait::test
