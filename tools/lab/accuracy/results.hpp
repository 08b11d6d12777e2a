// Results on disk: a CSV that grows by a line a result, so that a run can be taken up again.
#pragma once

#include "common.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lab {

struct Result {
    std::string row, variant, model, setting, device, backend, driver, fingerprint; // the key
    double value = 0;                                                               // NaN: none
    std::string unit;
    std::optional<double> mark;
    std::string verdict; // pass, MISS, FAILED (no number), cannot (the model lacks something), ""
    std::string note;
    double seconds = 0; // it took

    std::string key() const;
};

class Results {
  public:
    // Takes up what is in `file`, unless `fresh`. A last line cut short is dropped.
    Results(std::string file, bool fresh);
    const Result* find(const std::string& key) const;
    void add(const Result& result); // on disk before it returns
    size_t taken_up() const { return taken_up_; }

  private:
    std::string file_;
    std::map<std::string, Result> all_;
    size_t taken_up_ = 0;
};

std::string json_of(const std::vector<Result>& results);
std::string csv_of(const std::vector<Result>& results);

// "a,b" -> "\"a,b\"" where it must be.
std::string csv_cell(const std::string& text);
std::vector<std::string> csv_cells(const std::string& line);

} // namespace lab
