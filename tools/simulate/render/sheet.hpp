// A contact sheet: pictures in rows with captions under them.
#pragma once

#include "image.hpp"

namespace render {

struct Cell {
    Image image;
    std::string caption;
};

struct SheetRow {
    std::string label; // above the row; "": none
    std::vector<Cell> cells;
};

struct Sheet {
    std::string title;
    std::string subtitle;
    std::vector<SheetRow> rows;
};

// Throws std::runtime_error when the file cannot be written.
void write_sheet(const Sheet& sheet, const std::string& path);

// Cells beside each other with their captions above, of even width and height, as films want.
// "": no room for captions.
Image side_by_side(const std::vector<Cell>& cells);

} // namespace render
