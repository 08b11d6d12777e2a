// plait-lab as a user runs it.
#include "common/json_reader.hpp"

#include "simulate/support.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdio>

using testing::HasSubstr;

namespace {

struct Outcome {
    int code;
    std::string text;
};

Outcome lab(const std::string& arguments, bool errors) {
    const std::string command =
        std::string(PLAIT_LAB) + " " + arguments + (errors ? " 2>&1 >/dev/null" : " 2>/dev/null");
    FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> buffer;
    while (const size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
        text.append(buffer.data(), got);
    return {WEXITSTATUS(pclose(pipe)), text};
}

class LabProgram : public TemporaryFolder {
  protected:
    // A level hair of 4 segments that sags for a quarter of a second.
    std::string scene() const {
        return write("s.json", R"({"strand": {"segments": 4, "length": 0.1}, "duration": 0.25,
            "measure": [{"metric": "drop"}]})");
    }
    double drop_on(const std::string& backend) const {
        const Outcome outcome =
            lab("run " + scene() + " --no-cost --json --model rod --backend " + backend, false);
        EXPECT_EQ(outcome.code, 0);
        const auto json = common::Json::parse(outcome.text, nullptr, false);
        EXPECT_FALSE(json.is_discarded()) << outcome.text;
        return json["measured"][0]["value"].get<double>();
    }
};

TEST_F(LabProgram, devices_and_the_reference_agree) {
    const double opencl = drop_on("opencl"), reference = drop_on("reference");
    EXPECT_GT(opencl, 0.05);
    EXPECT_NEAR(opencl, reference, 1e-4);
}

TEST_F(LabProgram, prints_tables_and_costs) {
    const Outcome outcome =
        lab("run " + scene() + " --cost-vertices 100 --cost-runs 3 --backend opencl", false);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.text, HasSubstr("strain_max"));
    EXPECT_THAT(outcome.text, HasSubstr("ns per vertex"));
}

TEST_F(LabProgram, says_what_is_wrong) {
    const Outcome bad = lab("run " + scene() + " --set strand.segments=0", true);
    EXPECT_EQ(bad.code, 1);
    EXPECT_THAT(bad.text, HasSubstr("command line: strand.segments is 0, outside [1,255]"));
    EXPECT_EQ(lab("run nowhere.json", true).code, 1);
    EXPECT_EQ(lab("walk", true).code, 1);
    const std::string ball =
        write("b.json", R"({"colliders": [{"a": [0.1, -0.1, 0], "radius_a": 0.05}]})");
    const Outcome through = lab("run " + ball + " --model verlet", true);
    EXPECT_EQ(through.code, 1);
    EXPECT_THAT(through.text, HasSubstr("the baseline \"verlet\" knows no colliders"));
    const Outcome device = lab("run " + scene() + " --device nobody", true);
    EXPECT_NE(device.code, 0);
    EXPECT_THAT(device.text, HasSubstr("nobody"));
}

} // namespace
