#include "page.hpp"
#include "sim.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace bench {
namespace {

[[gnu::format(printf, 1, 2)]] std::string text(const char* pattern, ...) {
    char line[1024];
    va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(line, sizeof line, pattern, arguments);
    va_end(arguments);
    return line;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    char date[16];
    std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
    return date;
}

// What else the machine was doing matters most where the device is the host's own processor.
std::string load_before(const Options& options) {
    return text("%.1f on %u processors", options.load, std::thread::hardware_concurrency());
}

} // namespace

std::string slug(const plait_device_info& device) {
    std::string name;
    for (const char* c = device.name; *c; ++c)
        if (std::isalnum(static_cast<unsigned char>(*c)))
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
        else if (!name.empty() && name.back() != '-')
            name += '-';
    while (name.ends_with('-'))
        name.pop_back();
    return name;
}

namespace {

std::string header(const Options& options, const plait_device_info& device) {
    return text("# Cost on %s\n\n"
                "| | |\n|---|---|\n"
                "| device | %s, %u compute units |\n"
                "| platform | %s |\n"
                "| driver | %s |\n"
                "| date | %s |\n"
                "| load before | %s |\n"
                "| plait | %d.%d.%d |\n\n"
                "Written by `./dev bench`. Wall time, launches included.\n",
                device.name, device.name, device.compute_units, device.platform, device.driver,
                today().c_str(), load_before(options).c_str(), PLAIT_VERSION_MAJOR,
                PLAIT_VERSION_MINOR, PLAIT_VERSION_PATCH);
}

// What the device gives at the most, where it was measured.
std::string ceilings(const DeviceResults& results) {
    if (results.copy_rate == 0 && results.flop_rate == 0)
        return "";
    return text(
        "\n## Ceilings\n\nMeasured in the same process: a copy of 64 MiB %.2f GB/s, read and "
        "written; multiply-adds in registers %.1f GFLOP/s.\n",
        1e-9 * results.copy_rate, 1e-9 * results.flop_rate);
}

// "articulated 71 %, mesh_nearest 20 %, output 4 %": by what they take, to nine tenths of all.
std::string split(const FeatureRow& row) {
    std::vector<std::pair<double, std::string>> list;
    double all = 0, told = 0;
    for (const auto& [stage, sum] : row.stages) {
        list.emplace_back(sum.seconds, stage);
        all += sum.seconds;
    }
    if (all == 0)
        return "the driver reports no times"; // of launches
    std::ranges::sort(list, std::greater{});
    std::string line;
    for (const auto& [seconds, stage] : list) {
        if (told > 0.9 * all)
            break;
        line += text("%s%s %.0f %%", line.empty() ? "" : ", ", stage.c_str(), 100 * seconds / all);
        told += seconds;
    }
    return line;
}

std::string feature_table(const Options& options, const DeviceResults& results) {
    if (results.features.empty())
        return ""; // filtered out
    std::map<std::string, double> seconds;
    for (const FeatureRow& row : results.features)
        seconds[row.name] = row.seconds;
    std::string rows;
    for (const FeatureRow& row : results.features) {
        rows += text("| %s | %.3g |", row.name.c_str(), 1e3 * row.seconds);
        rows += row.over != row.name && seconds.contains(row.over)
                    ? text(" %.2f of %s |", row.seconds / seconds[row.over], row.over.c_str())
                    : " |";
        rows += text(" %s |\n", split(row).c_str());
    }
    return text("\n## Features\n\nA frame of %u strands of %u vertices on a head that turns to and "
                "fro, with one feature: milliseconds, times what it takes without, and the stages "
                "that nine tenths of the device's time go to. *field*, *nearest*: the head as a "
                "mesh; *far*: the mesh 3 m away; *bends*: its vertices are posed each frame; "
                "*ball*: hair that lies on a ball in place of the "
                "head; *guides*: a tenth of the strands, whom in *follows* and *detail* the others "
                "follow.\n\n"
                "| feature | ms a frame | times | stages |\n|---|---:|---:|---|\n",
                options.strands, model_vertices) +
           rows;
}

// Each stage in the feature where it takes the most.
std::string stage_table(const DeviceResults& results) {
    std::map<std::string, std::pair<const FeatureRow*, StageSums>> most;
    for (const FeatureRow& row : results.features)
        for (const auto& [stage, sum] : row.stages)
            if (auto& [feature, best] = most[stage]; !feature || sum.seconds > best.seconds)
                most[stage] = {&row, sum};
    std::string rows;
    for (const auto& [stage, where] : most)
        if (const auto& [feature, sum] = where; sum.seconds > 0)
            rows += text("| %s | %s | %.3g | %.1f | %.2f |\n", stage.c_str(), feature->name.c_str(),
                         sum.calls, 1e6 * sum.seconds / sum.calls, 1e-9 * sum.bytes / sum.seconds);
    return rows.empty() ? ""
                        : "\n## Stages\n\nEach in the feature above where it takes the most: "
                          "launches a frame, what one takes, and the rate at which it moves the "
                          "least it has to through memory, each buffer once for reading and once "
                          "for writing.\n\n"
                          "| stage | feature | launches | us each | GB/s |\n"
                          "|---|---|---:|---:|---:|\n" +
                              rows;
}

std::set<uint32_t> strand_counts(const DeviceResults& results) {
    std::set<uint32_t> counts;
    for (const auto& [key, seconds] : results.step_seconds)
        counts.insert(key.first);
    return counts;
}

// Frames per second without the inter-hair step and with it: "36.9 -> 30.5, 17 % lost".
std::string step_cell(const DeviceResults& results, uint32_t strands, Interhair interhair) {
    const auto original = results.step_seconds.find({strands, Interhair::off});
    const auto with = results.step_seconds.find({strands, interhair});
    if (original == results.step_seconds.end() || with == results.step_seconds.end())
        return " - | - |";
    return text(" %.2f | %.1f %% |", 1 / with->second, 100 * (1 - original->second / with->second));
}

std::string step_table(const Options& options, const DeviceResults& results) {
    if (results.step_seconds.empty())
        return ""; // filtered out
    std::string page = text(
        "\n## The whole step\n\nSteps per second of the model `tressfx`, with the iterations and "
        "stiffnesses of TressFX's sample hair and real gravity, and with the inter-hair step after "
        "it, as in table 5.1 of Ugurca 2015 (there 3 %% to 21 %% of the frame rate was lost, "
        "rendering included; here "
        "nothing is rendered). *thesis*: sampled slots by its hash and its rule. *slots*, *exact*: "
        "slots and exact sums as they are by default. Strands of %u vertices.\n\n"
        "| strands | original, 1/s | + thesis, 1/s | lost | + slots, 1/s | lost | + exact, 1/s | "
        "lost |\n"
        "|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        options.vertices);
    for (const uint32_t strands : strand_counts(results)) {
        const auto original = results.step_seconds.find({strands, Interhair::off});
        page += text("| %u |", strands);
        page +=
            original == results.step_seconds.end() ? " - |" : text(" %.2f |", 1 / original->second);
        page += step_cell(results, strands, Interhair::thesis);
        page += step_cell(results, strands, Interhair::slots);
        page += step_cell(results, strands, Interhair::exact) + "\n";
    }
    return page;
}

std::string model_table(const DeviceResults& results) {
    std::set<uint32_t> counts;
    std::set<std::string> models;
    for (const auto& [key, seconds] : results.model_seconds) {
        counts.insert(key.first);
        models.insert(key.second);
    }
    if (counts.empty())
        return "";
    std::string head = "| strands |", rule = "|---:|", real_time = "| at 60 Hz |", rows;
    for (const std::string& model : models) {
        head += " " + model + " |";
        rule += "---:|";
    }
    for (const uint32_t strands : counts) {
        rows += text("| %u |", strands);
        for (const std::string& model : models) {
            const auto found = results.model_seconds.find({strands, model});
            const double seconds = found == results.model_seconds.end() ? 0 : found->second;
            rows += seconds > 0 ? text(" %.3g |", 1e3 * seconds) : " - |";
            if (strands == *counts.rbegin())
                real_time += seconds > 0 ? text(" %.0f |", strands / (60.0 * seconds)) : " - |";
        }
        rows += "\n";
    }
    return text("\n## The models\n\nMilliseconds of a step of each model as it is by default, "
                "without the inter-hair step. Strands of %u vertices; in the last row how many of "
                "them go into 1/60 s, by the row above it.\n\n",
                model_vertices) +
           head + "\n" + rule + "\n" + rows + real_time + "\n";
}

std::string character_table(const DeviceResults& results) {
    if (results.character_seconds.empty())
        return "";
    std::string rows;
    std::set<std::pair<uint32_t, std::string>> seen;
    for (const auto& [key, seconds] : results.character_seconds)
        seen.insert({key.strands, key.model});
    for (const auto& [strands, model] : seen) {
        rows += text("| %u | %s |", strands, model.c_str());
        double last = 0;
        for (const Scene scene : {Scene::alone, Scene::bodies, Scene::everything}) {
            const auto found = results.character_seconds.find({strands, model, scene});
            last = found == results.character_seconds.end() ? 0 : found->second;
            rows += last > 0 ? text(" %.3g |", 1e3 * last) : " - |";
        }
        rows += last > 0 ? text(" %.0f |\n", strands / (60.0 * last)) : " - |\n";
    }
    return text(
               "\n## A character\n\nMilliseconds of a frame of long hair on a mannequin whose head "
               "turns to and fro by 29 degrees in a second, each model as it is by default: hair "
               "alone, with the mannequin's 14 capsules, and with these and the grid between "
               "strands (exact sums). Means over whole turns. Strands of %u vertices; last, how "
               "many of them go into 1/60 s with everything on.\n\n"
               "| strands | model | alone | + 14 capsules | + grid | at 60 Hz |\n"
               "|---:|---|---:|---:|---:|---:|\n",
               model_vertices) +
           rows;
}

// Over one sim of as many strands; 0: not measured.
double over_one(const DeviceResults& results, const CrowdKey& key, double seconds) {
    const auto one =
        results.crowd_seconds.find({1, key.sims * key.strands, key.model, key.scene, true});
    return one == results.crowd_seconds.end() ? 0 : seconds / one->second;
}

std::string crowd_table(const DeviceResults& results) {
    if (results.crowd_seconds.empty())
        return "";
    constexpr const char* scenes[] = {"alone", "+ 14 capsules", "+ grid"};
    std::string rows;
    for (const auto& [key, seconds] : results.crowd_seconds) {
        const double ratio = over_one(results, key, seconds);
        rows += text("| %u | %u | %s | %s | %s | %.3g | %.0f |", key.sims, key.strands,
                     key.model.c_str(), scenes[static_cast<int>(key.scene)],
                     key.sims == 1  ? ""
                     : key.together ? "one"
                                    : "one each",
                     1e3 * seconds, 1e6 * seconds / key.sims);
        rows += key.sims > 1 && ratio > 0 ? text(" %.2f |\n", ratio) : " |\n";
    }
    constexpr char head[] =
        "\n## Small, and many\n\nThe same character: little hair, of whose step the part is large "
        "that does not depend on its size; and many sims of one context, in one call of "
        "`plait_context_step` or one after another by `plait_sim_step`, and waited for once, "
        "beside one sim of as many strands.\n\n"
        "| sims | strands of each | model | with | calls | ms/frame | us/sim | x one sim |\n"
        "|---:|---:|---|---|---|---:|---:|---:|\n";
    return head + rows;
}

std::string levels_table(const DeviceResults& results) {
    if (results.levels.empty())
        return "";
    const auto full = results.levels.find(0);
    std::string rows;
    for (const auto& [budget, row] : results.levels) {
        rows += budget == 0 ? "| all strands of all |" : text("| %u ms |", budget);
        rows += text(" %.3g | %.3g |", 1e3 * row.median, 1e3 * row.slow);
        rows += full == results.levels.end() ? " - |"
                                             : text(" %.1f |", full->second.median / row.median);
        rows += budget == 0 ? " |\n" : text(" %.3g |\n", row.worst_px);
    }
    return "\n## Levels\n\nA hero 0.6 m from the camera and twenty others 2 to 40 m away, each of "
           "4,000 strands of 16 "
           "vertices of long hair with 14 capsules, heads turning; the director shares out the "
           "budget. The error is "
           "the director's own estimate for who has the largest.\n\n"
           "| budget | ms a frame, median | 95 of 100 below | times faster | worst, px |\n"
           "|---|---:|---:|---:|---:|\n" +
           rows;
}

std::string csv(const Options& options, const DeviceResults& results) {
    const plait_device_info& device = results.device;
    std::string rows = text("# %s; %s; driver %s; %s\n", device.name, device.platform,
                            device.driver, today().c_str()) +
                       "row,strands,vertices,seconds\n";
    for (const FeatureRow& feature : results.features) {
        rows += text("feature %s,%u,%u,%.9g\n", feature.name.c_str(), options.strands,
                     model_vertices, feature.seconds);
        for (const auto& [stage, sum] : feature.stages)
            rows += text("feature %s %s,%u,%u,%.9g\n", feature.name.c_str(), stage.c_str(),
                         options.strands, model_vertices, sum.seconds);
    }
    constexpr const char* names[] = {"step", "step+thesis", "step+slots", "step+exact"};
    for (const auto& [key, seconds] : results.step_seconds)
        rows += text("%s,%u,%u,%.9g\n", names[static_cast<int>(key.second)], key.first,
                     options.vertices, seconds);
    for (const auto& [key, seconds] : results.model_seconds)
        rows +=
            text("model %s,%u,%u,%.9g\n", key.second.c_str(), key.first, model_vertices, seconds);
    constexpr const char* scenes[] = {"alone", "bodies", "everything"};
    for (const auto& [key, seconds] : results.character_seconds)
        rows += text("character %s %s,%u,%u,%.9g\n", key.model.c_str(),
                     scenes[static_cast<int>(key.scene)], key.strands, model_vertices, seconds);
    for (const auto& [key, seconds] : results.crowd_seconds)
        rows += text("sims:%u%s %s %s,%u,%u,%.9g\n", key.sims, key.together ? "" : " apart",
                     key.model.c_str(), scenes[static_cast<int>(key.scene)], key.strands,
                     model_vertices, seconds);
    for (const auto& [budget, row] : results.levels)
        rows +=
            text("levels budget:%u,%u,%u,%.9g\n", budget, 21 * 4000, model_vertices, row.median);
    return rows;
}

// Nothing without a folder.
void write_file(const std::filesystem::path& folder, const std::string& name,
                const std::string& contents) {
    if (folder.empty())
        return;
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / name;
    std::ofstream file(path, std::ios::binary);
    file << contents;
    file.close();
    if (!file)
        throw std::runtime_error(path.string() + " cannot be written");
}

} // namespace

void write_pages(const Results& results) {
    for (const auto& [index, device] : results.devices) {
        if (device.features.empty() && device.step_seconds.empty() &&
            device.model_seconds.empty() && device.character_seconds.empty() &&
            device.crowd_seconds.empty() && device.levels.empty())
            continue; // filtered out
        const std::string name = "bench-" + slug(device.device);
        write_file(results.options.csv, name + ".csv", csv(results.options, device));
        write_file(results.options.write, name + ".md",
                   header(results.options, device.device) + ceilings(device) +
                       feature_table(results.options, device) + stage_table(device) +
                       step_table(results.options, device) + model_table(device) +
                       character_table(device) + crowd_table(device) + levels_table(device));
    }
}

} // namespace bench
