#include "sheet.hpp"
#include "surface.hpp"

#include <algorithm>

namespace render {

namespace {

// Pixels.
constexpr int margin = 24, gap = 10, caption_height = 26, label_height = 34, header_height = 70;

struct Size {
    int width = 2 * margin;
    int height = margin;
};

int label_space(const SheetRow& row) {
    return row.label.empty() ? 0 : label_height;
}

int row_height(const SheetRow& row) {
    int tallest = 0;
    for (const Cell& cell : row.cells)
        tallest = std::max(tallest, cell.image.height);
    return label_space(row) + tallest + caption_height + gap;
}

Size size_of(const Sheet& sheet) {
    Size size;
    size.height += header_height;
    for (const SheetRow& row : sheet.rows) {
        int width = 2 * margin - gap;
        for (const Cell& cell : row.cells)
            width += cell.image.width + gap;
        size.width = std::max(size.width, width);
        size.height += row_height(row);
    }
    return size;
}

void text(cairo_t* context, double x, double y, double size, double grey, const std::string& line) {
    cairo_set_font_size(context, size);
    cairo_set_source_rgb(context, grey, grey, grey);
    cairo_move_to(context, x, y);
    cairo_show_text(context, line.c_str());
}

void draw_cell(cairo_t* context, const Cell& cell, int x, int y) {
    const Surface picture = to_surface(cell.image);
    cairo_set_source_surface(context, picture.get(), x, y);
    cairo_paint(context);
    text(context, x + 2, y + cell.image.height + 18, 14, 0.35, cell.caption);
}

void draw_row(cairo_t* context, const SheetRow& row, int y) {
    if (!row.label.empty())
        text(context, margin, y + 22, 17, 0.15, row.label);
    int x = margin;
    for (const Cell& cell : row.cells) {
        draw_cell(context, cell, x, y + label_space(row));
        x += cell.image.width + gap;
    }
}

} // namespace

Image side_by_side(const std::vector<Cell>& cells) {
    constexpr int space = 4;
    int width = -space, tallest = 0, top = 0;
    for (const Cell& cell : cells) {
        width += cell.image.width + space;
        tallest = std::max(tallest, cell.image.height);
        top = cell.caption.empty() ? top : caption_height;
    }
    width += width % 2;
    const int height = top + tallest + (top + tallest) % 2;
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    const Context context(cairo_create(surface.get()));
    cairo_set_source_rgb(context.get(), 0.97, 0.97, 0.96);
    cairo_paint(context.get());
    cairo_select_font_face(context.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    int x = 0;
    for (const Cell& cell : cells) {
        const Surface picture = to_surface(cell.image);
        cairo_set_source_surface(context.get(), picture.get(), x, top);
        cairo_paint(context.get());
        text(context.get(), x + 4, 18, 14, 0.15, cell.caption);
        x += cell.image.width + space;
    }
    return to_image(surface);
}

void write_sheet(const Sheet& sheet, const std::string& path) {
    const Size size = size_of(sheet);
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height));
    const Context context(cairo_create(surface.get()));
    cairo_set_source_rgb(context.get(), 0.97, 0.97, 0.96);
    cairo_paint(context.get());
    cairo_select_font_face(context.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    text(context.get(), margin, margin + 22, 24, 0.1, sheet.title);
    text(context.get(), margin, margin + 48, 14, 0.4, sheet.subtitle);
    int y = margin + header_height;
    for (const SheetRow& row : sheet.rows) {
        draw_row(context.get(), row, y);
        y += row_height(row);
    }
    write_png(surface, path);
}

} // namespace render
