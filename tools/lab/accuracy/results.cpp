#include "results.hpp"

#include "common/file.hpp"
#include "common/json_reader.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

namespace lab {

namespace {

constexpr const char* head =
    "row,variant,model,setting,device,backend,driver,fingerprint,value,unit,"
    "mark,verdict,note,seconds";
constexpr size_t columns = 14;

std::string text_of(double value) {
    if (std::isnan(value))
        return "";
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

std::string line_of(const Result& r) {
    std::string line;
    for (const std::string& cell :
         {r.row, r.variant, r.model, r.setting, r.device, r.backend, r.driver, r.fingerprint,
          text_of(r.value), r.unit, r.mark ? text_of(*r.mark) : "", r.verdict, r.note})
        line += csv_cell(cell) + ",";
    return line + text_of(r.seconds) + "\n";
}

double number_of(const std::string& cell) {
    return cell.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : std::strtod(cell.c_str(), nullptr);
}

Result result_of(const std::vector<std::string>& c) {
    Result r{c[0],
             c[1],
             c[2],
             c[3],
             c[4],
             c[5],
             c[6],
             c[7],
             number_of(c[8]),
             c[9],
             {},
             c[11],
             c[12],
             number_of(c[13])};
    if (!c[10].empty())
        r.mark = number_of(c[10]);
    return r;
}

} // namespace

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
    return quoted + "\"";
}

std::vector<std::string> csv_cells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (size_t i = 0; i < line.size(); ++i)
        if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[++i];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += line[i];
    return cells;
}

std::string Result::key() const {
    std::string key;
    for (const std::string* part :
         {&row, &variant, &model, &setting, &device, &backend, &driver, &fingerprint})
        key += *part + "|";
    return key;
}

Results::Results(std::string file, bool fresh) : file_(std::move(file)) {
    if (const auto folder = std::filesystem::path(file_).parent_path(); !folder.empty())
        make_folder(folder.string());
    std::string kept = std::string(head) + "\n";
    std::ifstream stream(file_);
    std::string line;
    if (!fresh && std::getline(stream, line) && line != head)
        throw Failure(file_ +
                      ":1: has other columns than this program writes; --fresh starts over");
    while (!fresh && std::getline(stream, line) && !stream.eof()) {
        const auto cells = csv_cells(line);
        if (cells.size() != columns)
            continue;
        const Result result = result_of(cells);
        all_[result.key()] = result;
        kept += line + "\n";
    }
    taken_up_ = all_.size();
    stream.close(); // what is open cannot be replaced on Windows
    write_text(kept, file_);
}

const Result* Results::find(const std::string& key) const {
    const auto found = all_.find(key);
    return found == all_.end() ? nullptr : &found->second;
}

void Results::add(const Result& result) {
    std::ofstream stream(file_, std::ios::app | std::ios::binary);
    stream << line_of(result);
    stream.close();
    if (!stream)
        throw Failure(file_ + ": cannot be written");
    all_[result.key()] = result;
}

std::string csv_of(const std::vector<Result>& results) {
    std::string text = std::string(head) + "\n";
    for (const Result& result : results)
        text += line_of(result);
    return text;
}

namespace {

Json to_json(const Result& r) {
    Json json{{"row", r.row},         {"variant", r.variant}, {"model", r.model},
              {"setting", r.setting}, {"device", r.device},   {"backend", r.backend},
              {"driver", r.driver},   {"value", r.value},     {"unit", r.unit},
              {"verdict", r.verdict}, {"note", r.note},       {"seconds", r.seconds}};
    if (r.mark)
        json["mark"] = *r.mark;
    return json;
}

} // namespace

std::string json_of(const std::vector<Result>& results) {
    Json all = Json::array();
    for (const Result& result : results)
        all.push_back(to_json(result));
    return json_text(all);
}

} // namespace lab
