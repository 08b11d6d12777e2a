// Reference tables: CSV with one line of column names. Of a trajectory a row is a vertex at a moment
// (t, vertex, x, y), or a moment (t, x, y, x, y, ...: vertex 1, vertex 2), which is read as the former.
#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace lab {

struct Table {
    std::string file;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows; // cells that are no numbers are NaN

    size_t column(const std::string& name) const; // throws Failure with the nearest
};

// Where tables are looked for: what --tables says, else tests/data of the sources.
void set_table_folder(const std::string& folder);

// Read once a process. Throws Failure.
const Table& load_table(std::string_view name);

// The rows of a reference whose `where` holds.
std::vector<std::vector<double>> select(const Reference& reference);

// A point from the reference's columns of `row`, m. Absent columns are 0.
Vec3 point_of(const Reference& reference, const std::vector<double>& row);

// Where the vertices are at one time of a trajectory (columns t, vertex and the reference's).
struct Snapshot {
    double time; // s
    std::vector<std::pair<size_t, Vec3>> vertices;
};
std::vector<Snapshot> trajectory(const Reference& reference);

} // namespace lab
