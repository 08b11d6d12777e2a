#include "compare.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <ostream>
#include <stdexcept>

namespace bench {
namespace {

using Json = nlohmann::json;

constexpr size_t enough_repetitions = 3;
constexpr double usual_least = 5; // %: what runs of one program differ by on a machine at rest

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw std::runtime_error(path + ": " + why);
}

// Seconds of a unit as Google Benchmark writes it.
double seconds_of(const std::string& path, const std::string& unit) {
    static const std::map<std::string, double> units = {
        {"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"s", 1}};
    const auto found = units.find(unit);
    if (found == units.end())
        refuse(path, "time_unit is \"" + unit + "\"; ns, us, ms and s are known");
    return found->second;
}

Json parse(const std::string& path) {
    std::ifstream stream(path);
    if (!stream)
        refuse(path, "cannot be read");
    try {
        return Json::parse(stream);
    } catch (const Json::exception& error) {
        refuse(path, std::string("is not JSON: ") + error.what());
    }
}

// "device:1/feature/wind/manual_time" -> {"device:1", "feature/wind/manual_time"}
std::pair<std::string, std::string> split(const std::string& path, const std::string& name) {
    const size_t slash = name.find('/');
    if (!name.starts_with("device:") || slash == std::string::npos)
        refuse(path, "row \"" + name + "\" begins with no device: not a file of plait-bench");
    return {name.substr(0, slash), name.substr(slash + 1)};
}

void add_row(const std::string& path, const Json& context, const Json& row, Run& run) {
    if (row.value("run_type", "iteration") != "iteration" || row.value("error_occurred", false))
        return; // means of rows that are here themselves; what failed has no time
    const auto name = row.contains("run_name") ? row.at("run_name").get<std::string>()
                                               : row.at("name").get<std::string>();
    const auto [device, rest] = split(path, name);
    if (!context.contains(device))
        refuse(path, "its context does not say what " + device + " is");
    const double seconds =
        row.at("real_time").get<double>() * seconds_of(path, row.at("time_unit"));
    if (!(seconds > 0))
        refuse(path, "real_time of \"" + name + "\" is not above 0");
    auto& rows = run.devices[context.at(device).get<std::string>()];
    rows[rest].seconds.push_back(seconds);
    // The stages of a feature: "us:mesh_nearest". 0 where the driver reports no times.
    for (const auto& [key, value] : row.items())
        if (key.starts_with("us:") && value.get<double>() > 0)
            rows[rest + "/" + key.substr(3)].seconds.push_back(1e-6 * value.get<double>());
}

std::string devices_of(const Run& run) {
    std::string list;
    for (const auto& [device, rows] : run.devices)
        list += (list.empty() ? "" : ", ") + device;
    return list;
}

void list_missing(const Run& from, const Run& in, std::vector<std::string>& out) {
    for (const auto& [device, rows] : from.devices)
        for (const auto& [row, samples] : rows)
            if (!in.devices.contains(device) || !in.devices.at(device).contains(row))
                out.push_back(device + ": " + row);
}

const char* word(Verdict verdict) {
    switch (verdict) {
    case Verdict::faster:
        return "faster";
    case Verdict::slower:
        return "SLOWER";
    default:
        return "";
    }
}

double least_of(const std::string& word, const std::string& value) {
    double percent = 0;
    const auto end = std::from_chars(value.data(), value.data() + value.size(), percent);
    if (end.ec != std::errc() || end.ptr != value.data() + value.size() ||
        !(percent >= 0 && percent <= 1000))
        throw std::runtime_error(word + ": not a number from 0 to 1000");
    return percent;
}

void print_missing(const std::vector<std::string>& rows, const char* where, std::ostream& out) {
    if (rows.empty())
        return;
    out << rows.size() << " rows only in the " << where << " run, the first: " << rows.front()
        << '\n';
}

void print_row(const ComparedRow& row, double least, std::ostream& out) {
    char line[256];
    std::snprintf(line, sizeof line, "%12.2f %12.2f %7.3f %5.0f%% %5.0f%%  %-6s  ",
                  1e6 * row.before.median(), 1e6 * row.after.median(), row.ratio(),
                  100 * row.before.spread(), 100 * row.after.spread(), word(row.verdict(least)));
    out << line << row.row << '\n';
}

} // namespace

double Samples::median() const {
    const size_t half = seconds.size() / 2;
    return seconds.size() % 2 ? seconds[half] : (seconds[half - 1] + seconds[half]) / 2;
}

double Samples::spread() const {
    return (seconds.back() - seconds.front()) / median();
}

Verdict ComparedRow::verdict(double least) const {
    if (std::min(before.seconds.size(), after.seconds.size()) < enough_repetitions)
        return Verdict::unknown;
    const double apart = std::max(ratio(), 1 / ratio()) - 1;
    if (apart < least)
        return Verdict::same;
    if (after.seconds.back() < before.seconds.front())
        return Verdict::faster;
    return after.seconds.front() > before.seconds.back() ? Verdict::slower : Verdict::same;
}

Run read_run(const std::string& path) {
    const Json file = parse(path);
    Run run;
    try {
        run.size = file.at("context").value("size", "");
        for (const Json& row : file.at("benchmarks"))
            add_row(path, file.at("context"), row, run);
    } catch (const Json::exception& error) {
        refuse(path, std::string("is not of Google Benchmark's format: ") + error.what());
    }
    if (run.devices.empty())
        refuse(path, "has no row with a time");
    for (auto& [device, rows] : run.devices)
        for (auto& [row, samples] : rows)
            std::ranges::sort(samples.seconds);
    return run;
}

Comparison compare_runs(const std::string& before, const std::string& after) {
    const Run old_run = read_run(before), new_run = read_run(after);
    if (old_run.size != new_run.size)
        throw std::runtime_error("the rows are of other sizes: " + before + " has " + old_run.size +
                                 ", " + after + " has " + new_run.size);
    Comparison comparison;
    bool same_device = false;
    for (const auto& [device, rows] : old_run.devices) {
        const auto found = new_run.devices.find(device);
        same_device = same_device || found != new_run.devices.end();
        for (const auto& [row, samples] : rows)
            if (found != new_run.devices.end() && found->second.contains(row))
                comparison.rows.push_back({device, row, samples, found->second.at(row)});
    }
    if (!same_device)
        throw std::runtime_error("no device is in both: " + before + " is of " +
                                 devices_of(old_run) + "; " + after + " is of " +
                                 devices_of(new_run));
    if (comparison.rows.empty())
        throw std::runtime_error("no row is in both " + before + " and " + after);
    list_missing(old_run, new_run, comparison.only_before);
    list_missing(new_run, old_run, comparison.only_after);
    return comparison;
}

void print_comparison(const Comparison& comparison, double least, std::ostream& out) {
    std::string device;
    bool too_few = false;
    size_t faster = 0, slower = 0;
    for (const ComparedRow& row : comparison.rows) {
        if (row.device != device)
            out << row.device << "\n      old, us      new, us new/old  spread, old new\n";
        device = row.device;
        print_row(row, least, out);
        const Verdict verdict = row.verdict(least);
        too_few = too_few || verdict == Verdict::unknown;
        faster += verdict == Verdict::faster;
        slower += verdict == Verdict::slower;
    }
    out << comparison.rows.size() << " rows: beyond the noise " << faster << " faster, " << slower
        << " slower\n";
    if (too_few)
        out << "rows with fewer than " << enough_repetitions
            << " repetitions are not judged: --benchmark_repetitions=5\n";
    print_missing(comparison.only_before, "old", out);
    print_missing(comparison.only_after, "new", out);
}

int compare_command(const std::vector<std::string>& words, std::ostream& out) {
    std::vector<std::string> files;
    double least = usual_least;
    for (const std::string& word : words)
        if (word.starts_with("--least="))
            least = least_of(word, word.substr(word.find('=') + 1));
        else if (word.starts_with("-"))
            throw std::runtime_error("compare: there is no option " + word);
        else
            files.push_back(word);
    if (files.size() != 2)
        throw std::runtime_error("compare takes two files, OLD.json and NEW.json; here are " +
                                 std::to_string(files.size()));
    print_comparison(compare_runs(files[0], files[1]), least / 100, out);
    return 0;
}

} // namespace bench
