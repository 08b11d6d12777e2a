// What the stability sweep has found, row by row: kept in a CSV that a later run goes on from, and
// shown as a map of letters, as JSON and as pictures.
#pragma once

#include "common.hpp"
#include "sweep.hpp"

#include <array>
#include <filesystem>
#include <fstream>

namespace lab::stability {

// One trial with all its columns, or one point of an axis.
struct Job {
    std::string kind, model, setting; // "map" or an axis, "cosserat", "1x3"
    Place place;
    std::string value; // of an axis

    std::string key() const;
};

struct Row {
    Job job;
    std::string column; // the map's motion; an axis's value
    Outcome outcome;
};

// Rows in memory and, as they come, in a file. A file of another device is refused.
class Rows {
  public:
    Rows(std::filesystem::path file, const std::string& device, bool fresh);
    bool has(const Job& job) const;
    void add(const std::vector<Row>& rows); // of one job
    const std::vector<Row>& all() const { return rows_; }

  private:
    void load(const std::string& device);

    std::filesystem::path file_;
    std::ofstream stream_;
    std::vector<Row> rows_;
    std::map<std::string, size_t> done_;
};

void write_csv(std::ostream& stream, const std::vector<Row>& rows);
Json to_json(const std::vector<Row>& rows);

// Letters: a line for each rate and number of segments, a block of motions for each gamma.
void print_map(const std::vector<Row>& rows);
void print_axes(const std::vector<Row>& rows);
// How many of each letter, and how many miss inside the envelope.
struct Count {
    std::string method; // "cosserat 1x3"
    size_t trials = 0, inside = 0, missed = 0;
    std::array<size_t, grades> letters{}; // in the order of Grade
};
std::vector<Count> count_letters(const std::vector<Row>& rows);
void print_count(const std::vector<Row>& rows);
std::string counts_markdown(const std::vector<Row>& rows);
std::string axes_markdown(const std::vector<Row>& rows); // a letter for each value

// DIR/MODEL.svg and .png for each model and baseline, and DIR/stability.svg of all. False where there is no
// gnuplot.
bool draw_maps(const std::vector<Row>& rows, const std::filesystem::path& folder);

std::string text_of(double value); // "60", "limp"

} // namespace lab::stability
