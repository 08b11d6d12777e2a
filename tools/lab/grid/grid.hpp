// Rows 23 to 25 and the figure of the grid between strands: what it sums, what its slots sample,
// and what either costs.
#pragma once

#include "chart/figure.hpp"
#include "run/cost.hpp"
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

// Row 24: how many vertices fall into so many voxels of so many slots, drawn evenly, or as given.
struct SlotOptions {
    std::vector<uint32_t> counts; // of vertices; empty: C/4, C and 4 C
    uint32_t capacity = 256;      // C, slots of a voxel
    uint32_t edge_count = 1;      // voxels along an edge
    std::vector<Vec3> positions;  // instead of `counts`, in voxels

    bool operator==(const SlotOptions&) const = default;
};
std::vector<GridRow> slot_rows(Device& device, const SlotOptions& options = {});

// Points of a file, "x, y, z" a line, m, into the smallest cube of so many voxels that holds them.
// Throws Failure.
std::vector<Vec3> read_positions(const std::string& file, uint32_t edge_count);

Figure grid_figure(const plait_device_info& which, Device& device, const CostOptions& options);

struct GridRun {
    std::vector<GridRow> rows;
    Figure figure;
    std::vector<std::string> files; // written
};

// What the command is asked for. `positions`: a file of them; where it or `slots` says something, row 24 alone.
struct GridOptions {
    std::string out = "out/lab";
    SlotOptions slots;
    std::string positions;
    CostOptions costs;
};

GridRun run_grid(Contexts& contexts, const std::string& out, const CostOptions& options);
std::string rows_text(const std::vector<GridRow>& rows);
std::string rows_markdown(const std::vector<GridRow>& rows);
std::string figure_csv(const Figure& figure);

} // namespace lab::grid
