// plait-lab as a user runs it.
#include "common/json_reader.hpp"

#include "simulate/support.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

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

std::string contents(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
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
    EXPECT_THAT(outcome.text, HasSubstr("articulated 1x1 BDF2")) << "the library's default";
    EXPECT_THAT(outcome.text, HasSubstr("strain_max"));
    EXPECT_THAT(outcome.text, HasSubstr("ns per vertex"));
}

// The commands with tables: the same options, and what is printed is for programs.
TEST_F(LabProgram, tables_are_chosen_from_and_printed_as_json_and_csv) {
    scene();
    write("t.json", R"({"reference": {"converged": "rod"}, "strand": {"segments": 2},
        "duration": 0.05})");
    const std::string tables[][2] = {
        {"accuracy", R"({"rows": [{"row": "1", "scene": "s.json", "measure": {"metric": "drop"}},
            {"row": "2", "scene": "t.json", "measure": {"metric": "drop"}}]})"},
        {"chart", R"({"charts": [{"name": "a", "scene": "s.json"}, {"name": "b",
            "scene": "t.json", "methods": ["rod 1x1", "chain 1x1"]}]})"},
        {"features", R"({"features": [{"feature": "a", "scenes": ["s.json"]}, {"feature": "b",
            "scenes": ["t.json"], "with": {"model": "rod"}, "without": {"model": "chain"}}]})"}};
    for (const auto& [command, table] : tables) {
        const std::string arguments = command + " --table " + write(command + ".json", table) +
                                      " --scenes t --models rod --backend opencl --out " +
                                      path("out") +
                                      (command == "accuracy" ? "" : " --cost-vertices 3000") + " ";
        const Outcome json = lab(arguments + "--json", false);
        EXPECT_EQ(json.code, 0) << command;
        const auto document = common::Json::parse(json.text, nullptr, false);
        ASSERT_FALSE(document.is_discarded()) << json.text;
        const Outcome csv = lab(arguments + "--csv", false);
        const auto lines = std::count(csv.text.begin(), csv.text.end(), '\n');
        EXPECT_EQ(lines, command == "accuracy" ? 3 : 2) << csv.text; // with its head
        EXPECT_THAT(csv.text, HasSubstr("rod")) << command;
        EXPECT_THAT(json.text, HasSubstr("rod")) << command;
        EXPECT_EQ(lab(arguments + "--csv --json", true).code, 1) << command;
        const Outcome none = lab(arguments + "--scenes u", true);
        EXPECT_EQ(none.code, 1);
        EXPECT_THAT(none.text, HasSubstr("--scenes: \"u\" is none; the nearest is")) << command;
    }
}

// Row 24 alone, of what is asked for.
TEST_F(LabProgram, draws_slots_as_told) {
    const Outcome drawn =
        lab("grid --counts 16,65 --capacity 64 --edge-count 2 --backend opencl", false);
    EXPECT_EQ(drawn.code, 0);
    EXPECT_THAT(drawn.text, HasSubstr("65 in 2³ voxels of 64: occupied share"));
    EXPECT_EQ(std::count(drawn.text.begin(), drawn.text.end(), '\n'), 8);
    const std::string file = write("p.csv", "0,0,0\n0.1,0,0\n0,0.1,0.1\n");
    const Outcome given = lab("grid --backend opencl --positions " + file, false);
    EXPECT_EQ(given.code, 0);
    EXPECT_THAT(given.text, HasSubstr("3 in 1³ voxels of 256"));
    const std::pair<const char*, const char*> bad[] = {
        {"--counts 0", "--counts"},
        {"--counts many", "--counts"},
        {"--capacity 65537", "--capacity"},
        {"--edge-count 65", "--edge-count"},
        {"--edge-count 64 --capacity 65536", "more than 67108864"},
        {"--positions nowhere.csv", "nowhere.csv: cannot be opened"},
        {"--positions nowhere.csv --counts 3", "--counts"}};
    for (const auto& [arguments, word] : bad) {
        const Outcome refused = lab(std::string("grid ") + arguments, true);
        EXPECT_EQ(refused.code, 1) << arguments;
        EXPECT_THAT(refused.text, HasSubstr(word)) << arguments;
    }
}

// Follows keep their lengths, all strands simulated are where they are, and learnt weights are nearer
// to that in motion that they were not learnt from.
TEST_F(LabProgram, measures_hair_that_follows) {
    const Outcome outcome = lab("follows --strands 300 --guides 20,60 --lesson 1 --seconds 1 --csv "
                                "--out " +
                                    path("follows"),
                                false);
    EXPECT_EQ(outcome.code, 0);
    std::istringstream text(outcome.text);
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "guides,weights,ms,of_whole,away_m,away_most_m,length,kink_deg,tip_step,"
                    "beside");
    std::map<std::string, double> away;
    while (std::getline(text, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');)
            cells.push_back(cell);
        ASSERT_EQ(cells.size(), 10u) << line;
        const auto number = [&](size_t i) { return std::stod(cells[i]); };
        const std::string name = cells[0] + " " + cells[1];
        away[name] = number(4);
        EXPECT_GT(number(2), 0) << name;
        EXPECT_LT(number(6), 1e-4) << name << ": lengths";
        EXPECT_EQ(number(4) == 0, name == "300 all") << name;
        EXPECT_GE(number(5), number(4)) << name;
    }
    ASSERT_EQ(away.size(), 5u);
    EXPECT_LT(away["20 learnt"], 0.8 * away["20 near"]);
    EXPECT_LT(away["60 learnt"], 0.8 * away["60 near"]);
    EXPECT_LT(away["60 near"], away["20 near"]);
    const std::string curves = contents(path("follows/follows_curves.csv"));
    EXPECT_EQ(curves.substr(0, curves.find('\n')),
              "seconds,20_near,20_learnt,60_near,60_learnt,300_all");
    EXPECT_EQ(std::count(curves.begin(), curves.end(), '\n'), 61);
    EXPECT_TRUE(std::filesystem::exists(path("follows/follows.csv")));
    for (const char* bad :
         {"--guides 60 --strands 60", "--guides 0", "--style bald", "--lesson -1"})
        EXPECT_EQ(lab(std::string("follows ") + bad, true).code, 1) << bad;
}

// The coarser, the farther from the truth, up to hair that goes with the head.
TEST_F(LabProgram, measures_levels_of_detail) {
    const Outcome outcome = lab(
        "levels --styles long --strands 200 --seconds 0.5 --csv --out " + path("levels"), false);
    EXPECT_EQ(outcome.code, 0);
    std::istringstream text(outcome.text);
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "style,guides,ms,of_whole,shake,nod,gust,all,median,listed");
    std::vector<std::vector<std::string>> rows;
    while (std::getline(text, line)) {
        std::istringstream row(line);
        rows.emplace_back();
        for (std::string cell; std::getline(row, cell, ',');)
            rows.back().push_back(cell);
        ASSERT_EQ(rows.back().size(), 10u) << line;
    }
    ASSERT_GE(rows.size(), 3u);
    for (size_t i = 1; i < rows.size(); ++i)
        EXPECT_LT(std::stod(rows[i - 1][7]), std::stod(rows[i][7])) << rows[i][1] << " guides";
    EXPECT_EQ(rows.front()[1], "200");
    EXPECT_EQ(std::stod(rows.front()[3]), 1);
    EXPECT_LT(std::stod(rows.front()[4]), 0.3);
    EXPECT_EQ(rows.back()[1], "0");
    EXPECT_GT(std::stod(rows.back()[4]), 0.9);
    EXPECT_TRUE(std::filesystem::exists(path("levels/levels.csv")));
    for (const char* bad : {"--styles bald", "--strands 3", "--seconds 0"})
        EXPECT_EQ(lab(std::string("levels ") + bad, true).code, 1) << bad;
}

// Errors told from a swing, in thirteen motions of which shares know nothing: each within a factor that says that
// they belong to the same hair.
TEST_F(LabProgram, measures_how_errors_of_levels_transfer) {
    const Outcome outcome =
        lab("levels --styles long --strands 200 --seconds 0.5 --transfer --out " + path("levels"),
            false);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.text.find("within 2x"), std::string::npos);
    std::ifstream csv(path("levels/transfer.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "style,guides,motion,error,swing,own,listed,lesson");
    size_t rows = 0, moved = 0;
    while (std::getline(csv, line)) {
        std::istringstream row(line.substr(line.rfind('"') + 2)); // names of motions have commas
        std::vector<double> numbers;
        for (std::string cell; std::getline(row, cell, ',');)
            numbers.push_back(std::stod(cell));
        ASSERT_EQ(numbers.size(), 5u) << line;
        ++rows;
        moved += numbers[1] > 1e-3;
        EXPECT_GT(numbers[4] * numbers[2] / numbers[0], 0.05) << line;
        EXPECT_LT(numbers[4] * numbers[2] / numbers[0], 20) << line;
    }
    EXPECT_EQ(rows % 16, 0u);
    EXPECT_GT(moved, rows / 2);
}

// By name, what each of the methods that keep hair's volume is known by.
TEST_F(LabProgram, measures_methods_that_keep_volume) {
    const Outcome outcome =
        lab("volume --strands 300 --seconds 1 --csv --out " + path("volume"), false);
    EXPECT_EQ(outcome.code, 0);
    std::istringstream text(outcome.text);
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "method,volume,volume_least,volume_most,height,height_least,momentum,energy,"
                    "neighbours,crowd,jitter,ms,where");
    struct Row {
        double volume, most, height, momentum, energy, neighbours, crowd;
        std::string where;
    };
    std::map<std::string, Row> rows;
    while (std::getline(text, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');)
            cells.push_back(cell);
        ASSERT_EQ(cells.size(), 13u) << line;
        const auto number = [&](size_t i) { return std::stod(cells[i]); };
        rows[cells[0]] = {number(1), number(3), number(4), number(6),
                          number(7), number(8), number(9), cells[12]};
    }
    ASSERT_EQ(rows.size(), 8u);
    for (const char* fallen : {"off", "diffusion"}) {
        EXPECT_LT(rows[fallen].volume, 0.65) << fallen;
        EXPECT_LT(rows[fallen].height, 0.15) << fallen;
        EXPECT_GT(rows[fallen].crowd, 1.5) << fallen;
    }
    for (const auto& [name, row] : rows) { // one of them keeps no momentum
        EXPECT_EQ(row.momentum > 0.02, name == "diffusion") << name;
        EXPECT_EQ(row.where == "host",
                  name.starts_with("fluid") || name == "petrovic" || name == "projection")
            << name;
        EXPECT_GT(row.neighbours, 0.1) << name;
    }
    EXPECT_EQ(rows["off"].energy, 0);
    EXPECT_LT(rows["projection"].energy, -0.01);
    EXPECT_LT(rows["volume"].energy, -0.01);
    EXPECT_GT(rows["fluid_stiff"].energy, 1) << "gains energy";
    EXPECT_GT(rows["fluid_stiff"].most, 1.4) << "throws hair off";
    EXPECT_LT(rows["fluid_soft"].most, 1.3);
    EXPECT_LT(rows["volume"].most, 1.3);
    EXPECT_GT(rows["petrovic"].volume, 1.25) << "swells";
    EXPECT_GT(rows["fluid_beyond"].energy, 2 * rows["fluid_stiff"].energy);
    EXPECT_LT(rows["projection"].height, 0.3) << "sinks by g h^2 a step";
    EXPECT_GT(rows["fluid_soft"].height, 2 * rows["projection"].height);
    EXPECT_GT(rows["volume"].height, 0.6);
    EXPECT_GT(rows["volume"].volume, 0.8);
    for (const char* file : {"volume/volume.csv", "volume/volume_curves.csv"})
        EXPECT_TRUE(std::filesystem::exists(path(file))) << file;
    for (const char* bad : {"--methods bald", "--model tressfx", "--strands 1", "--seconds 0"})
        EXPECT_EQ(lab(std::string("volume ") + bad, true).code, 1) << bad;
}

// The program with its output in `text`, to be waited for.
pid_t start(const std::vector<std::string>& words, const std::string& text) {
    const pid_t pid = fork();
    if (pid != 0)
        return pid;
    std::vector<char*> arguments{const_cast<char*>("plait-lab")};
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    if (std::freopen(text.c_str(), "w", stdout) && dup2(STDOUT_FILENO, STDERR_FILENO) >= 0)
        execv(PLAIT_LAB, arguments.data());
    _exit(1);
}

// Sends it once `ready`; the exit code, -1 where it was over before or did not exit.
template <typename Ready> int code_after(int signal, pid_t pid, const Ready& ready) {
    int status = 0;
    while (!ready()) {
        if (waitpid(pid, &status, WNOHANG) != 0)
            return -1;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill(pid, signal);
    return waitpid(pid, &status, 0) == pid && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// A signal in the middle of a row: what was measured before it is on disk, whole, and a shell does
// not go on.
TEST_F(LabProgram, ends_well_on_interrupt) {
    scene();
    write("endless.json", R"({"strand": {"segments": 4}, "duration": 16000})");
    const std::string table = write("t.json", R"({"rows": [
        {"row": "1", "scene": "s.json", "measure": {"metric": "drop"}},
        {"row": "2", "scene": "endless.json", "measure": {"metric": "drop"}}]})");
    const std::string csv = path("out/accuracy.csv");
    const auto lines = [&] {
        const std::string all = contents(csv);
        return std::count(all.begin(), all.end(), '\n');
    };
    const auto measured = [&] { return lines() == 3; }; // the head and row 1 in two settings
    for (const int signal : {SIGINT, SIGTERM}) {
        std::filesystem::remove_all(path("out"));
        const pid_t pid = start({"accuracy", "--table", table, "--models", "chain", "--backend",
                                 "reference", "--out", path("out")},
                                path("text"));
        EXPECT_EQ(code_after(signal, pid, measured), 128 + signal) << contents(path("text"));
        EXPECT_TRUE(measured()) << "and nothing of row 2: " << contents(csv);
        EXPECT_THAT(contents(path("text")), HasSubstr("interrupted"));
    }
}

// Where no frame is recorded yet there is nothing to print.
TEST_F(LabProgram, ends_well_on_interrupt_before_the_first_frame) {
    if (!std::filesystem::exists("/proc/self/status"))
        GTEST_SKIP() << "nothing tells when it is ready for the signal";
    const std::string settling =
        write("settling.json", R"({"strand": {"segments": 4}, "settle": 16000})");
    const pid_t pid = start({"run", settling, "--backend", "reference"}, path("text"));
    const auto watches = [&] { // the main thread leaves signals to another
        std::error_code gone;
        const auto program =
            std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/exe", gone);
        if (program.filename() !=
            "plait-lab") // still a fork, in which the C library holds signals up
            return false;
        const std::string status = contents("/proc/" + std::to_string(pid) + "/status");
        const size_t at = status.find("SigBlk:");
        return at != std::string::npos &&
               (std::strtoull(&status[at + 7], nullptr, 16) & (1 << (SIGINT - 1))) != 0;
    };
    EXPECT_EQ(code_after(SIGINT, pid, watches), 128 + SIGINT) << contents(path("text"));
    EXPECT_THAT(contents(path("text")), HasSubstr("interrupted before the first frame"));
}

TEST_F(LabProgram, says_what_is_wrong) {
    const Outcome bad = lab("run " + scene() + " --set strand.length=-.1", true);
    EXPECT_EQ(bad.code, 1);
    EXPECT_THAT(bad.text, HasSubstr("command line: strand.length is -0.1, outside ["));
    EXPECT_EQ(lab("run nowhere.json", true).code, 1);
    const Outcome word = lab("run " + scene() + " --model true", true);
    EXPECT_THAT(word.text, HasSubstr("model is \"true\", no known model"));
    const Outcome negative = lab("run " + scene() + " --substeps -1", true);
    EXPECT_THAT(negative.text, HasSubstr("substeps is -1, outside [1,"));
    EXPECT_EQ(lab("walk", true).code, 1);
    const Outcome device = lab("run " + scene() + " --device nobody", true);
    EXPECT_NE(device.code, 0);
    EXPECT_THAT(device.text, HasSubstr("nobody"));
}

} // namespace
