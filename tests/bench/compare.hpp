// Two runs of plait-bench, row by row: what has become faster or slower beyond the noise of either.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace bench {

// A row of one run: its repetitions.
struct Samples {
    std::vector<double> seconds; // sorted
    double median() const;
    double spread() const; // (greatest - least) / median
};

// What a file of Google Benchmark's JSON format holds.
struct Run {
    std::string size;                                              // of the rows of features
    std::map<std::string, std::map<std::string, Samples>> devices; // by "name; platform" and row
};

enum class Verdict { same, faster, slower, unknown };

struct ComparedRow {
    std::string device, row;
    Samples before, after;
    double ratio() const { return after.median() / before.median(); }
    // Faster or slower where no repetition of one run is within the other's, and the medians are
    // apart by `least` of the smaller at least. Unknown with fewer than three repetitions of
    // either.
    Verdict verdict(double least) const;
};

struct Comparison {
    std::vector<ComparedRow> rows;
    std::vector<std::string> only_before, only_after; // "device: row"
};

// Both throw std::runtime_error, whose sentence names the file and what is wrong with it.
Run read_run(const std::string& path);
Comparison compare_runs(const std::string& before, const std::string& after);

void print_comparison(const Comparison& comparison, double least, std::ostream& out);

// `plait-bench compare OLD.json NEW.json [--least=PERCENT]`, from `compare` on: the exit code.
int compare_command(const std::vector<std::string>& words, std::ostream& out);

} // namespace bench
