// Kinds of hair by name: each is what its file says, takes the place of the one before, and is refused as
// a whole.
#include "support.hpp"

#include <algorithm>
#include <set>

namespace {

std::vector<plait_preset_info> all_presets() {
    size_t count = 0;
    plait::check(plait_presets_list(nullptr, &count));
    std::vector<plait_preset_info> infos(count, plait_preset_info_defaults());
    plait::check(plait_presets_list(infos.data(), &count));
    return infos;
}

std::vector<plait_preset_value> values_of(const char* preset) {
    size_t count = 0;
    plait::check(plait_preset_read(preset, nullptr, &count));
    std::vector<plait_preset_value> values(count, plait_preset_value_defaults());
    plait::check(plait_preset_read(preset, values.data(), &count));
    return values;
}

class Presets : public OnBackend {
  protected:
    plait::Sim sim{context, make_groom(tuft(3, 6))};
};
ON_EVERY_BACKEND(Presets);

TEST_P(Presets, set_what_they_list) {
    std::set<std::string> names;
    for (const plait_preset_info& info : all_presets()) {
        SCOPED_TRACE(info.name);
        names.insert(info.name);
        EXPECT_GT(std::string(info.text).size(), 20u);
        sim.set_preset(info.name);
        for (const plait_preset_value& value : values_of(info.name)) {
            const auto got = sim.param(value.param);
            ASSERT_EQ(got.size(), value.count) << value.param;
            for (size_t i = 0; i < got.size(); ++i)
                EXPECT_FLOAT_EQ(static_cast<float>(got[i]), static_cast<float>(value.values[i]))
                    << value.param;
        }
        run(sim, 3);
        EXPECT_EQ(sim.measure().nonfinite, 0u);
    }
    EXPECT_GE(names.size(), 15u);
    EXPECT_EQ(names.size(), all_presets().size()) << "two have one name";
}

// A parameter that the next one does not name is not left over, and what is no hair's stays.
TEST_P(Presets, take_the_place_of_the_one_before) {
    auto params = sim.params();
    params.gravity[1] = -1.6f;
    sim.set_params(params);
    sim.set_preset("wet");
    const auto wetness = sim.read(PLAIT_FIELD_WETNESS);
    EXPECT_EQ(wetness, std::vector<float>(3, 1.0f));
    sim.set_preset("afro");
    EXPECT_GT(sim.param("section_ratio")[0], 1);
    sim.set_preset("straight");
    EXPECT_EQ(sim.param("section_ratio")[0], 1);
    EXPECT_EQ(sim.param("groom")[0], 0);
    EXPECT_FLOAT_EQ(sim.params().gravity[1], -1.6f);
    plait::Sim other(context, make_groom(tuft(3, 6)));
    other.set_params(params);
    other.set_preset("straight");
    sim.reset();
    run(sim, 10);
    run(other, 10);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), other.read(PLAIT_FIELD_POSITION));
}

void expect_refused(const plait::Sim& sim, const char* name, plait_result code, const char* part) {
    const auto params = sim.params();
    EXPECT_EQ(plait_sim_set_preset(const_cast<plait_sim*>(sim.get()), name), code);
    EXPECT_NE(std::string(plait_last_error()).find(part), std::string::npos) << plait_last_error();
    EXPECT_EQ(sim.params().drag, params.drag);
}

TEST_P(Presets, are_refused_where_they_do_not_fit) {
    expect_refused(sim, "curls", PLAIT_NOT_FOUND, "no preset is called \"curls\"");
    expect_refused(plait::Sim(context, make_groom(tuft(3, 6)), tressfx_desc()), "curly",
                   PLAIT_INVALID_STATE, "articulated");
    const std::vector<plait_material> two(2, plait_material_defaults());
    const std::vector<uint32_t> of{0, 1, 0};
    plait::SimDesc desc;
    desc.materials = two.data();
    desc.material_count = two.size();
    desc.strand_material = plait::view(of);
    expect_refused(plait::Sim(context, make_groom(tuft(3, 6)), desc), "curly", PLAIT_INVALID_STATE,
                   "of 2 materials");
}

} // namespace
