// The table of parameters: nothing is missing, ranges are those that are checked and those that
// plait.h names, defaults are those of the struct, and each says in a sentence what it does.
#include "headers.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace {

void put(plait::SimDesc& desc, const plait_param_info& info, uint32_t component, double value) {
    unsigned char bytes[4];
    const auto number = static_cast<float>(value);
    const auto whole = static_cast<int32_t>(value);
    if (info.kind == PLAIT_PARAM_KIND_FLOAT)
        std::memcpy(bytes, &number, sizeof bytes);
    else
        std::memcpy(bytes, &whole, sizeof bytes);
    std::memcpy(static_cast<unsigned char*>(plait::field_of(desc, info)) + 4 * component, bytes,
                sizeof bytes);
}

// With all that its model may have.
plait::SimDesc with_all(bool tressfx) {
    plait::SimDesc desc;
    desc.model = tressfx ? PLAIT_MODEL_TRESSFX : PLAIT_MODEL_ARTICULATED;
    desc.grid.on = desc.acceleration.on = true;
    desc.volume.on = desc.strand_contact.on = desc.wetness.on = !tressfx;
    return desc;
}

bool of_tressfx(const plait_param_info& info) {
    return std::string(info.feature) == "tressfx";
}

class ParamTable : public testing::Test {
  protected:
    // Refused by name, or taken.
    void expect(const plait::SimDesc& desc, const plait_param_info& info, bool fine) {
        const plait_result result = plait::set_all(of_tressfx(info) ? tressfx : sim, desc);
        EXPECT_EQ(result, fine ? PLAIT_OK : PLAIT_INVALID_ARGUMENT)
            << info.name << ": " << plait_last_error();
        if (!fine) {
            const std::string field = info.name, said = plait_last_error();
            EXPECT_NE(said.find(field), std::string::npos) << said;
            EXPECT_NE(said.find(" is "), std::string::npos) << said;
        }
    }

    plait::Context context = make_context("reference");
    plait::Sim sim{context, make_groom(tuft(1, 3)), with_all(false)};
    plait::Sim tressfx{context, make_groom(tuft(1, 3)), with_all(true)};
    std::vector<plait_param_info> list = plait::params_list();
};

TEST_F(ParamTable, CoversTheStructsWithoutAGap) {
    const std::map<std::string, size_t> sizes = {
        {"params", sizeof(plait_sim_params)},
        {"material", sizeof(plait_material)},
        {"tressfx", sizeof(plait_tressfx_desc)},
        {"grid", sizeof(plait_grid_desc)},
        {"volume", sizeof(plait_volume_desc)},
        {"strand_contact", sizeof(plait_strand_contact_desc)},
        {"wetness", sizeof(plait_wetness_desc)},
        {"acceleration", sizeof(plait_acceleration_desc)}};
    std::map<std::string, size_t> ends;
    for (const plait_param_info& info : list) {
        size_t& end = ends.emplace(info.feature, sizeof(uint32_t)).first->second;
        EXPECT_EQ(info.offset, end) << info.name;
        end = info.offset + 4 * size_t{info.count};
        EXPECT_LT(info.least, info.most) << info.name;
        EXPECT_EQ(info.choices != nullptr, info.kind == PLAIT_PARAM_KIND_CHOICE) << info.name;
        for (int i = 0; info.choices && i <= static_cast<int>(info.most); ++i)
            EXPECT_STRNE(info.choices[i], "");
    }
    EXPECT_EQ(ends, sizes);
}

TEST_F(ParamTable, ItsRangesAreTheOnesThatAreChecked) {
    for (const plait_param_info& info : list)
        for (uint32_t i = 0; i < info.count; ++i)
            for (const bool low : {true, false}) {
                const double edge = low ? info.least : info.most;
                plait::SimDesc desc = with_all(of_tressfx(info));
                const bool slots = std::string(info.name) == "grid_form" && low;
                desc.volume.on = desc.volume.on && !slots; // which needs the other form
                put(desc, info, i, edge);
                if (std::strcmp(info.name, "grid_edge_count") != 0) // with volume, memory
                    expect(desc, info, !(low && info.least_excluded));
                const double step = std::max(std::abs(edge) * 1e-3, 1e-3);
                const double beyond = info.kind == PLAIT_PARAM_KIND_FLOAT ? step : 1;
                put(desc, info, i, low ? edge - beyond : edge + beyond);
                expect(desc, info,
                       desc.params.bdf2 == PLAIT_BDF2_OF_MODEL &&
                           std::strcmp(info.name, "bdf2") == 0);
                if (info.kind != PLAIT_PARAM_KIND_FLOAT)
                    continue;
                put(desc, info, i, NAN);
                expect(desc, info, false);
            }
}

double component(plait::SimDesc& desc, const plait_param_info& info, uint32_t i) {
    const auto* const at = static_cast<const unsigned char*>(plait::field_of(desc, info)) + 4 * i;
    float number;
    uint32_t whole;
    std::memcpy(&number, at, sizeof number);
    std::memcpy(&whole, at, sizeof whole);
    return info.kind == PLAIT_PARAM_KIND_FLOAT ? double(number) : double(whole);
}

TEST_F(ParamTable, ItsDefaultsAreThoseOfTheStruct) {
    plait::SimDesc desc;
    for (const plait_param_info& info : list) {
        for (uint32_t i = 0; i < info.count; ++i)
            EXPECT_EQ(info.default_value[std::min(i, 2u)], component(desc, info, i))
                << info.name << "[" << i << "]";
        for (uint32_t i = info.count; i < 3; ++i)
            EXPECT_EQ(info.default_value[i], 0) << info.name << "[" << i << "]";
    }
}

// What plait.h says of its default: it stands for off, or for a choice of the library's.
bool has_a_default_beside_its_slider(const std::string& name) {
    return std::set<std::string>{"max_displacement", "bdf2", "stretch_stiffness", "twist_stiffness"}
        .count(name);
}

TEST_F(ParamTable, SlidersLieInTheRangeAndHoldTheDefault) {
    for (const plait_param_info& info : list) {
        EXPECT_LE(info.least, info.slider_least) << info.name;
        EXPECT_LT(info.slider_least, info.slider_most) << info.name;
        EXPECT_LE(info.slider_most, info.most) << info.name;
        EXPECT_FALSE(info.least_excluded && info.slider_least == info.least) << info.name;
        EXPECT_TRUE(info.slider_log == 0 || (info.slider_log == 1 && info.slider_least > 0))
            << info.name;
        bool held = true;
        for (uint32_t i = 0; i < std::min(info.count, 3u); ++i)
            held = held && info.slider_least <= info.default_value[i] &&
                   info.default_value[i] <= info.slider_most;
        EXPECT_NE(held, has_a_default_beside_its_slider(info.name)) << info.name;
        if (info.kind == PLAIT_PARAM_KIND_CHOICE) {
            EXPECT_EQ(info.slider_least, info.least) << info.name;
            EXPECT_EQ(info.slider_most, info.most) << info.name;
        }
    }
}

TEST_F(ParamTable, EveryTextIsASentence) {
    std::set<std::string> texts;
    for (const plait_param_info& info : list) {
        ASSERT_NE(info.text, nullptr) << info.name;
        const std::string text = info.text;
        EXPECT_TRUE(std::regex_match(text, std::regex("[A-Z][^.\n]*[^ ]\\."))) << text;
        EXPECT_GE(std::count(text.begin(), text.end(), ' '), 4) << text;
        EXPECT_LE(text.size(), 120u) << text;
        EXPECT_TRUE(texts.insert(text).second) << info.name << ": " << text;
        for (int i = 0; info.choices && i <= static_cast<int>(info.most); ++i)
            EXPECT_NE(text.find(info.choices[i]), std::string::npos) << text;
    }
}

// Those without a page are the core of any simulation.
TEST_F(ParamTable, EveryFeatureHasAPageAndNamesItsFields) {
    const std::string docs = PLAIT_SOURCE_DIR "/docs/";
    for (const plait_param_info& info : list) {
        ASSERT_NE(info.feature, nullptr) << info.name;
        const std::string feature = info.feature;
        if (feature == "params" || feature == "material")
            continue;
        const char* const page = feature == "acceleration" ? "backends" : info.feature;
        EXPECT_TRUE(std::ifstream(docs + page + ".md")) << info.name << " is of " << feature;
        EXPECT_EQ(feature == "tressfx", info.models == 1u << PLAIT_MODEL_TRESSFX) << info.name;
        EXPECT_TRUE(feature == "tressfx" || std::string(info.name).starts_with(feature + "_"))
            << info.name;
    }
}

TEST_F(ParamTable, IsCutOrRefusedLikeEveryList) {
    size_t count = 2;
    std::vector<plait_param_info> two(2, plait_param_info_defaults());
    ASSERT_EQ(plait_params_list(two.data(), &count), PLAIT_OK);
    EXPECT_EQ(count, 2u);
    EXPECT_STREQ(two[1].name, "follow_contact");
    two[1].struct_size = 0;
    EXPECT_EQ(plait_params_list(two.data(), &count), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(plait_params_list(nullptr, nullptr), PLAIT_INVALID_ARGUMENT);
}

// ---- what plait.h says of a field ---------------------------------------------------------------

// The struct that has a field.
std::string struct_of(const plait_param_info& info) {
    const std::string feature = info.feature;
    const std::string name = feature == "params"     ? "plait_sim_params"
                             : feature == "material" ? "plait_material"
                                                     : "plait_" + feature + "_desc";
    const std::string all = text_of_header("plait.h") + text_of_header("plait_features.h");
    const size_t begin = all.find("typedef struct " + name + " {");
    return all.substr(begin, all.find("} " + name + ";") - begin);
}

std::string field_name(const plait_param_info& info) {
    const std::string name = info.name, prefix = std::string(info.feature) + "_";
    return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
}

double number(const std::string& word) {
    return word == "pi/2" ? std::acos(0.0) : std::stod(word);
}

// "" where it says nothing.
std::string comment_of(const plait_param_info& info, const std::string& text) {
    std::smatch found;
    const std::regex declared("\\b" + field_name(info) + "(\\[\\d+\\])?;\\s*/\\*([^*]*)\\*/");
    return std::regex_search(text, found, declared) ? found[2].str() : "";
}

TEST_F(ParamTable, ItsRangesAreTheOnesThatTheHeaderNames) {
    const std::regex range("([\\[(])([-0-9.e]+),\\s*([-0-9.e]+|pi/2)\\]");
    for (const plait_param_info& info : list) {
        if (info.kind == PLAIT_PARAM_KIND_CHOICE ||
            (info.kind == PLAIT_PARAM_KIND_UINT && info.most == 1))
            continue; // these are named
        const std::string comment = comment_of(info, struct_of(info));
        std::smatch found;
        ASSERT_TRUE(std::regex_search(comment, found, range)) << info.name << ": " << comment;
        EXPECT_EQ(info.least_excluded, found[1] == "(" ? 1u : 0u) << info.name;
        EXPECT_EQ(info.least, number(found[2])) << info.name;
        EXPECT_EQ(info.most, number(found[3])) << info.name;
        EXPECT_NE(comment.find(info.unit), std::string::npos) << info.name << ": " << comment;
    }
}

} // namespace
