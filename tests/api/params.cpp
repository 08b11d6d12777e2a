// The table of parameters: nothing is missing, ranges are those that are checked and those that
// plait.h names, defaults are those of the struct, and each says in a sentence what it does.
#include "headers.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <regex>
#include <set>
#include <sstream>

namespace {

using Params = plait_sim_params;

void put(Params& params, const plait_param_info& info, uint32_t component, double value) {
    unsigned char bytes[4];
    const auto number = static_cast<float>(value);
    const auto whole = static_cast<int32_t>(value);
    if (info.kind == PLAIT_PARAM_KIND_FLOAT)
        std::memcpy(bytes, &number, sizeof bytes);
    else
        std::memcpy(bytes, &whole, sizeof bytes);
    std::memcpy(reinterpret_cast<unsigned char*>(&params) + info.offset + 4 * component, bytes,
                sizeof bytes);
}

class ParamTable : public testing::Test {
  protected:
    // Refused by name, or taken.
    void expect(const Params& params, const plait_param_info& info, bool fine) {
        const plait_result result = plait_sim_set_params(sim, &params);
        EXPECT_EQ(result, fine ? PLAIT_OK : PLAIT_INVALID_ARGUMENT) << info.name;
        if (!fine) {
            EXPECT_EQ(std::string(plait_last_error())
                          .find(std::string("plait_sim_set_params: ") + info.name),
                      0u)
                << plait_last_error();
        }
    }

    plait::Context context = make_context("reference");
    plait::Sim sim{context, make_groom(tuft(1, 3))};
    std::vector<plait_param_info> list = plait::params_list();
};

TEST_F(ParamTable, CoversTheStructWithoutAGap) {
    size_t end = sizeof Params::struct_size;
    for (const plait_param_info& info : list) {
        EXPECT_EQ(info.offset, end) << info.name;
        end = info.offset + 4 * size_t{info.count};
        EXPECT_LT(info.least, info.most) << info.name;
        EXPECT_EQ(info.choices != nullptr, info.kind == PLAIT_PARAM_KIND_CHOICE) << info.name;
        for (int i = 0; info.choices && i <= static_cast<int>(info.most); ++i)
            EXPECT_STRNE(info.choices[i], "");
    }
    EXPECT_EQ(end, sizeof(Params));
}

TEST_F(ParamTable, ItsRangesAreTheOnesThatAreChecked) {
    for (const plait_param_info& info : list)
        for (uint32_t i = 0; i < info.count; ++i)
            for (const bool low : {true, false}) {
                const double edge = low ? info.least : info.most;
                Params params = plait_sim_params_defaults();
                if (std::strcmp(info.name, "volume") == 0) // needs it
                    params.interhair = PLAIT_INTERHAIR_EXACT;
                // alone, all the slots there may be
                const bool slots = std::strcmp(info.name, "slot_capacity") == 0 && !low;
                put(params, info, i, edge);
                if (!slots && std::strcmp(info.name, "grid_edge_count") != 0)
                    expect(params, info, !(low && info.least_excluded));
                const double step = std::max(std::abs(edge) * 1e-3, 1e-3);
                const double beyond = info.kind == PLAIT_PARAM_KIND_FLOAT ? step : 1;
                put(params, info, i, low ? edge - beyond : edge + beyond);
                expect(params, info,
                       params.bdf2 == PLAIT_BDF2_OF_MODEL && std::strcmp(info.name, "bdf2") == 0);
                if (info.kind != PLAIT_PARAM_KIND_FLOAT)
                    continue;
                put(params, info, i, NAN);
                expect(params, info, false);
            }
}

double component(const Params& params, const plait_param_info& info, uint32_t i) {
    const auto* const at = reinterpret_cast<const unsigned char*>(&params) + info.offset + 4 * i;
    float number;
    uint32_t whole;
    std::memcpy(&number, at, sizeof number);
    std::memcpy(&whole, at, sizeof whole);
    return info.kind == PLAIT_PARAM_KIND_FLOAT ? double(number) : double(whole);
}

TEST_F(ParamTable, ItsDefaultsAreThoseOfTheStruct) {
    const Params params = plait_sim_params_defaults();
    for (const plait_param_info& info : list) {
        for (uint32_t i = 0; i < info.count; ++i)
            EXPECT_EQ(info.default_value[std::min(i, 2u)], component(params, info, i))
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
TEST_F(ParamTable, EveryFeatureHasAPage) {
    const std::string docs = PLAIT_SOURCE_DIR "/docs/";
    for (const plait_param_info& info : list) {
        ASSERT_NE(info.feature, nullptr) << info.name;
        const std::string feature = info.feature;
        if (std::set<std::string>{"gravity", "material", "solver"}.count(feature))
            continue;
        EXPECT_TRUE(std::ifstream(docs + feature + ".md") ||
                    std::ifstream(docs + "stages/" + feature + ".md"))
            << info.name << " is of " << feature;
        if (info.models == 1u << PLAIT_MODEL_TRESSFX) {
            EXPECT_EQ(feature, "tressfx") << info.name;
        }
    }
}

TEST_F(ParamTable, IsCutOrRefusedLikeEveryList) {
    size_t count = 2;
    std::vector<plait_param_info> two(2, plait_param_info_defaults());
    ASSERT_EQ(plait_params_list(two.data(), &count), PLAIT_OK);
    EXPECT_EQ(count, 2u);
    EXPECT_STREQ(two[1].name, "damping");
    two[1].struct_size = 0;
    EXPECT_EQ(plait_params_list(two.data(), &count), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(plait_params_list(nullptr, nullptr), PLAIT_INVALID_ARGUMENT);
}

// ---- what plait.h says of a field ---------------------------------------------------------------

std::string params_struct() {
    const std::string all = text_of_header("plait.h");
    const size_t begin = all.find("typedef struct plait_sim_params {");
    return all.substr(begin, all.find("} plait_sim_params;") - begin);
}

double number(const std::string& word) {
    return word == "pi/2" ? std::acos(0.0) : std::stod(word);
}

// "" where it says nothing.
std::string comment_of(const plait_param_info& info, const std::string& text) {
    std::smatch found;
    const std::regex declared("\\b" + std::string(info.name) + "(\\[\\d+\\])?;\\s*/\\*([^*]*)\\*/");
    return std::regex_search(text, found, declared) ? found[2].str() : "";
}

TEST_F(ParamTable, ItsRangesAreTheOnesThatTheHeaderNames) {
    const std::string text = params_struct();
    const std::regex range("([\\[(])([-0-9.e]+),\\s*([-0-9.e]+|pi/2)\\]");
    for (const plait_param_info& info : list) {
        if (info.kind == PLAIT_PARAM_KIND_CHOICE ||
            (info.kind == PLAIT_PARAM_KIND_UINT && info.most == 1))
            continue; // these are named
        const std::string comment = comment_of(info, text);
        std::smatch found;
        ASSERT_TRUE(std::regex_search(comment, found, range)) << info.name << ": " << comment;
        EXPECT_EQ(info.least_excluded, found[1] == "(" ? 1u : 0u) << info.name;
        EXPECT_EQ(info.least, number(found[2])) << info.name;
        EXPECT_EQ(info.most, number(found[3])) << info.name;
        EXPECT_NE(comment.find(info.unit), std::string::npos) << info.name << ": " << comment;
    }
}

} // namespace
