// Tables of tests/data: CSV with one line of column names.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace plait::test {

// Empty if the file is not there; cells that are no numbers read as NaN.
inline std::vector<std::vector<double>> read_table(const std::string& name) {
    std::ifstream file(PLAIT_SOURCE_DIR "/tests/data/" + name);
    std::string line;
    std::getline(file, line);
    std::vector<std::vector<double>> rows;
    while (std::getline(file, line)) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            rows.back().push_back(std::stod(cell));
    }
    return rows;
}

} // namespace plait::test
