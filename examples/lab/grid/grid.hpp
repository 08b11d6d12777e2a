// Rows 23 to 25 and the figure of the grid between strands: what it sums, what its slots sample,
// and what either costs.
#pragma once

#include "../cost.hpp"
#include "../figure.hpp"
#include "stages.hpp"

#include <optional>

namespace lab::grid {

struct GridRow {
    std::string id, title, unit;
    std::optional<double> mark;
    double value = 0;
    std::string note;

    bool passes() const;
};

std::vector<GridRow> exact_rows(Device& device); // 23, 25
std::vector<GridRow> slot_rows(Device& device);  // 24
Figure grid_figure(const plait_device_info& which, Device& device, const CostOptions& options);

struct GridRun {
    std::vector<GridRow> rows;
    Figure figure;
    std::vector<std::string> files; // written
};

GridRun run_grid(Contexts& contexts, const std::string& out, const CostOptions& options);
std::string rows_text(const std::vector<GridRow>& rows);
std::string rows_markdown(const std::vector<GridRow>& rows);
std::string figure_csv(const Figure& figure);

} // namespace lab::grid
