#include "rows.hpp"
#include "common/json_reader.hpp"

#include <cmath>
#include <iostream>
#include <sstream>

namespace lab::stability {

namespace {

constexpr const char* header = "kind,model,setting,rate,segments,gamma,column,grade,distance,speed,"
                               "energy,response,jitter,strain,rest_strain";

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
        cells.push_back(cell);
    return cells;
}

double number_of(const std::string& text) {
    return text == "limp" ? limp : std::stod(text);
}

void write_row(std::ostream& stream, const Row& row) {
    const Job& job = row.job;
    const Outcome& o = row.outcome;
    stream << job.kind << ',' << job.model << ',' << job.setting << ',' << text_of(job.place.rate)
           << ',' << job.place.segments << ',' << text_of(job.place.gamma) << ',' << row.column
           << ',' << letter_of(o.grade);
    for (const double value :
         {o.distance, o.speed, o.energy, o.response, o.jitter, o.strain, o.rest_strain})
        stream << ',' << value;
    stream << '\n';
}

Row read_row(const std::string& line, const std::string& place) {
    const auto cells = split(line);
    if (cells.size() != 15 || cells[7].size() != 1)
        throw Failure(place + ": has " + std::to_string(cells.size()) + " cells, not 15");
    try {
        Row row;
        row.job = {
            cells[0],
            cells[1],
            cells[2],
            {number_of(cells[3]), static_cast<uint32_t>(std::stoul(cells[4])), number_of(cells[5])},
            cells[0] == "map" ? "" : cells[6]};
        row.column = cells[6];
        double* const to[] = {&row.outcome.distance,   &row.outcome.speed,  &row.outcome.energy,
                              &row.outcome.response,   &row.outcome.jitter, &row.outcome.strain,
                              &row.outcome.rest_strain};
        row.outcome.grade = grade_of(cells[7][0]);
        for (size_t i = 0; i < std::size(to); ++i)
            *to[i] = std::stod(cells[8 + i]);
        return row;
    } catch (const std::logic_error&) { // std::stod
        throw Failure(place + ": \"" + line + "\" has a cell that is no number");
    }
}

} // namespace

std::string text_of(double value) {
    if (std::isinf(value))
        return "limp";
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", value);
    return buffer;
}

std::string Job::key() const {
    return kind + ',' + model + ',' + setting + ',' + text_of(place.rate) + ',' +
           std::to_string(place.segments) + ',' + text_of(place.gamma) + ',' + value;
}

Rows::Rows(std::filesystem::path file, const std::string& device, bool fresh)
    : file_(std::move(file)) {
    if (file_.has_parent_path())
        std::filesystem::create_directories(file_.parent_path());
    const bool resumes = !fresh && std::filesystem::exists(file_);
    if (resumes)
        load(device);
    stream_.open(file_, resumes ? std::ios::app : std::ios::trunc);
    if (!stream_)
        throw Failure(file_.string() + ": cannot be written");
    if (!resumes)
        stream_ << "# " << device << '\n' << header << '\n' << std::flush;
}

void Rows::load(const std::string& device) {
    std::ifstream stream(file_);
    std::string line;
    if (!std::getline(stream, line) || line != "# " + device)
        throw Failure(file_.string() + ":1: is of \"" + line +
                      "\", not of this device; --fresh starts anew");
    std::getline(stream, line); // column names
    for (size_t at = 3; std::getline(stream, line); ++at) {
        rows_.push_back(read_row(line, file_.string() + ":" + std::to_string(at)));
        ++done_[rows_.back().job.key()];
    }
}

bool Rows::has(const Job& job) const {
    const auto found = done_.find(job.key());
    return found != done_.end() && (job.kind != "map" || found->second >= shakes().size());
}

void Rows::add(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        rows_.push_back(row);
        ++done_[row.job.key()];
        write_row(stream_, row);
    }
    stream_.flush();
}

void write_csv(std::ostream& stream, const std::vector<Row>& rows) {
    stream << header << '\n';
    for (const Row& row : rows)
        write_row(stream, row);
}

Json to_json(const std::vector<Row>& rows) {
    Json all = Json::array();
    for (const Row& row : rows) {
        const Outcome& o = row.outcome;
        const double gamma = row.job.place.gamma;
        all.push_back({{"kind", row.job.kind},
                       {"model", row.job.model},
                       {"setting", row.job.setting},
                       {"rate", row.job.place.rate},
                       {"segments", row.job.place.segments},
                       {"gamma", std::isinf(gamma) ? Json("limp") : Json(gamma)},
                       {"column", row.column},
                       {"grade", std::string(1, letter_of(o.grade))},
                       {"distance", o.distance},
                       {"speed", o.speed},
                       {"energy", o.energy},
                       {"response", o.response},
                       {"jitter", o.jitter},
                       {"strain", o.strain},
                       {"rest_strain", o.rest_strain}});
    }
    return all;
}

} // namespace lab::stability
