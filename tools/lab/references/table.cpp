#include "table.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace lab {

namespace {

std::string& folder() {
    static std::string name = PLAIT_LAB_TABLES;
    return name;
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::string cell;
    bool quoted = false;
    for (const char c : line)
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.push_back(std::exchange(cell, ""));
        else if (c != '\r')
            cell += c;
    cells.push_back(cell);
    return cells;
}

double number_of(const std::string& cell) {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    return end != cell.c_str() && *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
}

// A table of one row a moment (t, x, y, x, y, ...: the columns again for each vertex) as one of a row a
// vertex (t, vertex, x, y), vertices counted from 1; any other as it is.
Table by_vertex(Table table) {
    const auto& columns = table.columns;
    const auto again = std::find(columns.begin() + std::min<size_t>(2, columns.size()),
                                 columns.end(), columns[columns.size() > 1]);
    if (again == columns.end())
        return table;
    const std::ptrdiff_t group = again - columns.begin() - 1;
    Table all{table.file, {columns[0], "vertex"}, {}};
    all.columns.insert(all.columns.end(), columns.begin() + 1, again);
    for (const auto& row : table.rows)
        for (auto cell = row.begin() + 1; row.end() - cell >= group; cell += group) {
            auto& of = all.rows.emplace_back(
                std::vector{row[0], double((cell - row.begin()) / group + 1)});
            of.insert(of.end(), cell, cell + group);
        }
    return all;
}

Table read_table(const std::string& name) {
    const std::string path = folder() + "/" + name;
    std::ifstream stream(path);
    if (!stream)
        throw Failure(path + ": cannot be opened; --tables DIR says where the tables are");
    Table table{path, {}, {}};
    std::string line;
    std::getline(stream, line);
    table.columns = cells_of(line);
    while (std::getline(stream, line)) {
        std::vector<double> row;
        for (const std::string& cell : cells_of(line))
            row.push_back(number_of(cell));
        if (row.size() != table.columns.size())
            throw Failure(path + ":" + std::to_string(table.rows.size() + 2) + ": has " +
                          std::to_string(row.size()) + " cells, the head " +
                          std::to_string(table.columns.size()));
        table.rows.push_back(std::move(row));
    }
    return by_vertex(std::move(table));
}

bool close(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
}

} // namespace

size_t Table::column(const std::string& name) const {
    for (size_t i = 0; i < columns.size(); ++i)
        if (columns[i] == name)
            return i;
    throw Failure(file + ": has no column \"" + name + "\"; the nearest is \"" +
                  std::string(nearest(name, columns)) + "\"");
}

void set_table_folder(const std::string& name) {
    folder() = name;
}

const Table& load_table(std::string_view name) {
    static std::map<std::string, Table> tables;
    const std::string key = (folder() + "/").append(name);
    const auto found = tables.find(key);
    return found != tables.end() ? found->second
                                 : tables.emplace(key, read_table(std::string(name))).first->second;
}

std::vector<std::vector<double>> select(const Reference& reference) {
    const Table& table = load_table(reference.table);
    std::vector<std::vector<double>> rows;
    for (const auto& row : table.rows) {
        bool fits = true;
        for (const auto& [column, value] : reference.where)
            fits = fits && close(row[table.column(column)], value);
        if (fits)
            rows.push_back(row);
    }
    return rows;
}

Vec3 point_of(const Reference& reference, const std::vector<double>& row) {
    const Table& table = load_table(reference.table);
    Vec3 point = Vec3::Zero();
    for (size_t i = 0; i < reference.columns.size(); ++i) {
        const bool optional = i == 2 && reference.columns[2] == "z"; // of plane tables
        const auto& names = table.columns;
        if (optional && std::find(names.begin(), names.end(), "z") == names.end())
            continue;
        point[static_cast<Eigen::Index>(i)] =
            row[table.column(reference.columns[i])] * reference.length_unit;
    }
    return point;
}

std::vector<Snapshot> trajectory(const Reference& reference) {
    const Table& table = load_table(reference.table);
    const size_t t = 0, vertex = table.column("vertex");
    std::vector<Snapshot> snapshots;
    for (const auto& row : select(reference)) {
        const double time = row[t] * reference.time_unit;
        if (snapshots.empty() || time > snapshots.back().time)
            snapshots.push_back({time, {}});
        const auto index = static_cast<size_t>(row[vertex]);
        snapshots.back().vertices.emplace_back(index, point_of(reference, row));
    }
    return snapshots;
}

} // namespace lab
