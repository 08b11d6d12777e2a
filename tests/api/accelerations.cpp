// Accelerations of single vertices, beside gravity and air: PLAIT_FIELD_ACCELERATION and the stage
// that fills it.
#include "support.hpp"

#include <algorithm>

namespace {

constexpr plait_model every_model[] = {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_TRESSFX};

plait::SimDesc pulled(plait_model model) {
    plait::SimDesc desc;
    desc.model = model;
    desc.substeps = 2;
    desc.acceleration.on = true;
    return desc;
}

void write(plait::Sim& sim, const std::vector<float>& accelerations) {
    ASSERT_EQ(plait_sim_write(sim, PLAIT_FIELD_ACCELERATION, accelerations.data(),
                              4 * accelerations.size()),
              PLAIT_OK)
        << plait_last_error();
}

std::vector<float> everywhere(size_t vertices, Point pull) {
    std::vector<float> values;
    for (size_t i = 0; i < vertices; ++i)
        values.insert(values.end(), {pull[0], pull[1], pull[2], 0});
    return values;
}

class Accelerations : public OnBackend {};
ON_EVERY_BACKEND(Accelerations);

// Also in what the energy budget of a step counts as work.
TEST_P(Accelerations, OfAllVerticesAreGravity) {
    for (const plait_model model : every_model) {
        auto desc = pulled(model);
        std::copy_n(Point{3, -8, 2}.begin(), 3, desc.params.gravity);
        plait::Sim heavy(context, make_groom(tuft(5, 12)), desc);
        std::copy_n(Point{0, 0, 0}.begin(), 3, desc.params.gravity);
        plait::Sim sim(context, make_groom(tuft(5, 12)), desc);
        write(sim, everywhere(5 * 12, {3, -8, 2}));
        const auto start = sim.read(PLAIT_FIELD_POSITION);
        run(heavy, 10);
        run(sim, 10);
        const auto fallen = heavy.read(PLAIT_FIELD_POSITION);
        EXPECT_GT(largest_difference(fallen, start), 0.05f) << model;
        EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), fallen), 2e-6f) << model;
    }
}

// Each strand by its own: hair whose strands are pulled apart is that of each pull alone.
TEST_P(Accelerations, AreThoseOfTheirVertex) {
    for (const plait_model model : every_model) {
        std::vector<float> apart;
        std::vector<std::vector<float>> alone;
        for (const float side : {-6.0f, 6.0f}) {
            const auto values = everywhere(12, {0, 0, side});
            apart.insert(apart.end(), values.begin(), values.end());
            plait::Sim sim(context, make_groom({curl({0, 0, 0}, 12)}), pulled(model));
            write(sim, values);
            run(sim, 10);
            alone.push_back(sim.read(PLAIT_FIELD_POSITION));
        }
        plait::Sim sim(context, make_groom({curl({0, 0, 0}, 12), curl({0, 0, 0}, 12)}),
                       pulled(model));
        write(sim, apart);
        run(sim, 10);
        auto both = sim.read(PLAIT_FIELD_POSITION);
        const std::vector<float> second(both.begin() + 48, both.end());
        both.resize(48);
        EXPECT_LT(largest_difference(both, alone[0]), 1e-5f) << model;
        EXPECT_LT(largest_difference(second, alone[1]), 1e-5f) << model;
        EXPECT_GT(largest_difference(both, second), 0.05f) << model;
    }
}

// Nothing past the tip of a shorter strand has mass.
TEST_P(Accelerations, PastTheTipAreNothing) {
    for (const plait_model model : every_model) {
        const Strands strands{curl({0, 0, 0}, 12), curl({0, 0.1f, 0}, 5)};
        plait::Sim sim(context, make_groom(strands), pulled(model));
        plait::Sim other(context, make_groom(strands), pulled(model));
        auto values = everywhere(2 * 12, {1, 2, 3});
        write(sim, values);
        std::fill(values.begin() + 4 * (12 + 5), values.end(), 900.0f);
        write(other, values);
        run(sim, 5);
        run(other, 5);
        EXPECT_EQ(sim.read(PLAIT_FIELD_VELOCITY), other.read(PLAIT_FIELD_VELOCITY)) << model;
    }
}

// What is not used costs nothing: neither a launch, nor a byte, nor a bit.
TEST_P(Accelerations, OfZeroChangeNoBitAndOffCostNothing) {
    auto profiled = plait_context_desc_defaults();
    profiled.backend = GetParam().c_str();
    profiled.profile = 1;
    const plait::Context timed(profiled);
    for (const plait_model model : every_model) {
        auto desc = pulled(model);
        plait::Sim on(timed, make_groom(tuft(5, 12)), desc);
        desc.acceleration.on = false;
        plait::Sim off(timed, make_groom(tuft(5, 12)), desc);
        run(on, 3);
        run(off, 3);
        EXPECT_EQ(on.read(PLAIT_FIELD_POSITION), off.read(PLAIT_FIELD_POSITION)) << model;
        const auto with = launched_stages(on), without = launched_stages(off);
        const size_t copies = model == PLAIT_MODEL_TRESSFX ? 0 : 3;
        EXPECT_EQ(std::ranges::count(with, "lane_accelerate"), static_cast<int>(copies));
        EXPECT_EQ(std::ranges::count(without, "lane_accelerate"), 0);
        EXPECT_EQ(with.size(), without.size() + copies);
        const auto bytes = on.describe().device_bytes, least = off.describe().device_bytes;
        EXPECT_GE(bytes, least + 5 * 12 * 16);
    }
}

TEST_P(Accelerations, StayUntilTheyAreWrittenAgain) {
    auto desc = pulled(PLAIT_MODEL_ARTICULATED);
    std::fill_n(desc.params.gravity, 3, 0.0f);
    plait::Sim sim(context, make_groom(tuft(3, 8)), desc);
    const auto values = everywhere(3 * 8, {0, -5, 0});
    write(sim, values);
    run(sim, 3);
    take_substeps(sim, {2, 2, 2});
    sim.reset();
    const auto start = sim.read(PLAIT_FIELD_POSITION);
    run(sim, 10);
    EXPECT_EQ(sim.read(PLAIT_FIELD_ACCELERATION), values);
    const auto end = sim.read(PLAIT_FIELD_POSITION);
    EXPECT_LT(end[4 * 7 + 1], start[4 * 7 + 1] - 0.02f) << "the tip of the first has sunk";
}

TEST_P(Accelerations, AreOffUnlessTheyAreAskedFor) {
    plait::Sim sim(context, make_groom(tuft(3, 8)));
    const auto values = everywhere(3 * 8, {0, 0, 0});
    EXPECT_EQ(plait_sim_write(sim, PLAIT_FIELD_ACCELERATION, values.data(), 4 * values.size()),
              PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("plait_sim_set_acceleration"),
              std::string::npos);
    size_t size = 0;
    EXPECT_EQ(plait_sim_read(sim, PLAIT_FIELD_ACCELERATION, nullptr, &size), PLAIT_INVALID_STATE);
}

TEST_P(Accelerations, BeyondTheirRangeAreRefusedWhole) {
    plait::Sim sim(context, make_groom(tuft(3, 8)), pulled(PLAIT_MODEL_ARTICULATED));
    const auto before = sim.read(PLAIT_FIELD_ACCELERATION);
    EXPECT_EQ(before, everywhere(3 * 8, {0, 0, 0}));
    for (const float bad : {2e4f, -2e4f, NAN, INFINITY}) {
        auto values = everywhere(3 * 8, {1, 1, 1});
        values[4 * 9 + 2] = bad;
        EXPECT_EQ(plait_sim_write(sim, PLAIT_FIELD_ACCELERATION, values.data(), 4 * values.size()),
                  PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find("acceleration"), std::string::npos);
        EXPECT_NE(std::string(plait_last_error()).find("9"), std::string::npos);
        EXPECT_EQ(sim.read(PLAIT_FIELD_ACCELERATION), before);
    }
}

// A well that is switched on at `value[4]` s: the caller's own kernel, its numbers and its clock.
plait_stage_source well() {
    return {"accelerate",
            "#include <plait/params.h>\n"
            "__kernel void plait_accelerate(const uint item_count,\n"
            "    const plait_accelerate_params params, __global const uint* vertex_count,\n"
            "    __global const float4* position, __global const float4* position_prev,\n"
            "    __global float4* acceleration) {\n"
            "    const uint i = get_global_id(0);\n"
            "    if (i >= item_count)\n"
            "        return;\n"
            "    const float3 well = vload3(0, params.value);\n"
            "    const float3 way = well - position[i].xyz;\n"
            "    const float rate = params.time >= params.value[4] ? params.value[3] : 0.0f;\n"
            "    acceleration[i] = (float4)(rate * way, 0.0f);\n"
            "}\n",
            "well.cl"};
}

TEST(AccelerationsOnOpenCL, AreFilledByTheCallersOwnKernel) {
    const plait_stage_source source = well();
    auto context_desc = plait_context_desc_defaults();
    context_desc.backend = "opencl";
    context_desc.stage_sources = &source;
    context_desc.stage_source_count = 1;
    const plait::Context own(context_desc);
    for (const plait_model model : every_model) {
        auto desc = pulled(model);
        std::fill_n(desc.params.gravity, 3, 0.0f);
        const Point at{0.1f, -0.2f, 0.15f};
        std::copy(at.begin(), at.end(), desc.acceleration.values);
        desc.acceleration.values[3] = 100; // 1/s^2
        desc.acceleration.values[4] = 0.2f;
        plait::Sim sim(own, make_groom(tuft(3, 8)), desc);
        const auto away = [&] {
            const auto positions = sim.read(PLAIT_FIELD_POSITION);
            const float* tip = &positions[4 * 7];
            return std::hypot(tip[0] - at[0], tip[1] - at[1], tip[2] - at[2]);
        };
        const float begin = away();
        run(sim, 12); // the last of these began 11/60 s after the first
        EXPECT_NEAR(away(), begin, 1e-3f) << "not yet, " << model;
        run(sim, 18);
        EXPECT_LT(away(), 0.8f * begin) << model;
    }
}

// Writes what value[0] says to vertex 2 of strand 1, past the tip of strand 0, and 3 m/s^2
// elsewhere.
constexpr const char* writes_anything =
    "#include <plait/params.h>\n"
    "__kernel void plait_accelerate(const uint item_count,\n"
    "    const plait_accelerate_params params, __global const uint* vertex_count,\n"
    "    __global const float4* position, __global const float4* position_prev,\n"
    "    __global float4* acceleration) {\n"
    "    const uint i = get_global_id(0);\n"
    "    if (i >= item_count)\n"
    "        return;\n"
    "    const float bad = params.value[0] > 0.0f ? params.value[1] : NAN;\n"
    "    const uint stride = params.vertex_stride;\n"
    "    const int is_bad = i == stride + 2 || i == stride - 1;\n"
    "    acceleration[i] = (float4)(3.0f, is_bad ? bad : 0.0f, 0.0f, 0.0f);\n"
    "}\n";

// As if the caller had written 0 there; counted, but not where there is no vertex.
TEST(AccelerationsOnOpenCL, OutOfRangeAreZeroAndCounted) {
    const plait_stage_source source{"accelerate", writes_anything, "anything.cl"};
    auto context_desc = plait_context_desc_defaults();
    context_desc.backend = "opencl";
    context_desc.stage_sources = &source;
    context_desc.stage_source_count = 1;
    const plait::Context own(context_desc);
    const auto plain = make_context("opencl");
    const Strands strands{curl({0, 0, 0}, 6), curl({0, 0.1f, 0}, 8)};
    auto values = everywhere(2 * 8, {3, 0, 0});
    std::fill_n(values.begin() + 4 * (8 + 2), 4, 0.0f);
    for (const plait_model model : every_model) {
        plait::Sim expected(plain, make_groom(strands), pulled(model));
        write(expected, values);
        run(expected, 5);
        EXPECT_EQ(expected.measure().nonfinite, 0u);
        const float numbers[][2] = {{0, 0}, {1, 1e6f}, {1, -1.1e4f}}; // the first is NaN
        for (const auto& number : numbers) {
            auto desc = pulled(model);
            std::copy_n(number, 2, desc.acceleration.values);
            plait::Sim sim(own, make_groom(strands), desc);
            run(sim, 5);
            EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), expected.read(PLAIT_FIELD_POSITION))
                << model << ", " << number[1];
            EXPECT_EQ(sim.measure().nonfinite, 1u) << model << ", " << number[1];
        }
    }
}

// A context with a kernel of the caller's, or with none, and what it warns of.
struct Warned {
    explicit Warned(bool own) : context(create(own)) {}

    std::string warnings() {
        std::string taken;
        taken.swap(text);
        return taken;
    }
    bool says(const std::string& word) const { return text.find(word) != std::string::npos; }

    std::string text;
    plait::Context context;

  private:
    plait::Context create(bool own) {
        const plait_stage_source source = well();
        auto desc = plait_context_desc_defaults();
        desc.backend = own ? "opencl" : "reference";
        desc.stage_sources = own ? &source : nullptr;
        desc.stage_source_count = own ? 1 : 0;
        desc.log = [](plait_log_level level, const char* line, void* user) {
            if (level == PLAIT_LOG_LEVEL_WARNING)
                *static_cast<std::string*>(user) += std::string(line) + "\n";
        };
        desc.log_user = &text;
        return plait::Context(desc);
    }
};

TEST(AccelerationsThatNothingReads, AreWarnedOfWithoutAKernel) {
    Warned warned(false);
    auto desc = pulled(PLAIT_MODEL_ARTICULATED);
    plait::Sim sim(warned.context, make_groom(tuft(2, 6)), desc);
    EXPECT_EQ(warned.warnings(), "") << "the caller writes them";
    desc.acceleration.values[15] = 3;
    sim.set_acceleration(desc.acceleration.desc());
    EXPECT_EQ(warned.warnings(), "");
    run(sim, 1);
    EXPECT_TRUE(
        warned.says("acceleration_values is set, and no kernel reads it: the context has no "
                    "kernel of yours"))
        << warned.text;
    EXPECT_STREQ(sim.describe().warning, "") << "a parameter, not the sim";
    warned.warnings();
    desc.params.drag = 3;
    sim.set_params(desc.params);
    run(sim, 1);
    EXPECT_EQ(warned.warnings(), "") << "said before";
}

TEST(AccelerationsThatNothingReads, AreWarnedOfWhereTheyAreOff) {
    Warned warned(true);
    auto desc = pulled(PLAIT_MODEL_ARTICULATED);
    desc.acceleration.values[0] = 1;
    plait::Sim on(warned.context, make_groom(tuft(2, 6)), desc);
    run(on, 1);
    EXPECT_EQ(warned.warnings(), "");
    EXPECT_STREQ(on.describe().warning, "");
    desc.acceleration.on = false;
    plait::Sim off(warned.context, make_groom(tuft(2, 6)), desc);
    EXPECT_EQ(warned.warnings(), "") << "it may come on by the first step";
    run(off, 1);
    EXPECT_TRUE(warned.says("plait_sim_set_acceleration turns it on")) << warned.text;
    warned.warnings();
    run(off, 1);
    EXPECT_EQ(warned.warnings(), "") << "said once";
}

} // namespace
