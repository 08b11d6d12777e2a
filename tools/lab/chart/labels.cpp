#include "labels.hpp"

#include <algorithm>
#include <array>

namespace lab {

namespace {

constexpr double character = 6.4, line = 12; // px, of DejaVu Sans at 10
constexpr std::array<double, 3> gaps{8, 14, 20};

// Right, left or over the marker; above, below or beside it: in the order of what reads best.
struct Side {
    int x, y;
};
constexpr std::array<Side, 8> sides{
    {{1, 1}, {1, 0}, {1, -1}, {0, 1}, {-1, 1}, {0, -1}, {-1, 0}, {-1, -1}}};

// Of UTF-8, whose later bytes of a character begin with the bits 10.
double width_of(const std::string& text) {
    return character * static_cast<double>(std::count_if(
                           text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

Spot start_of(const Label& label, Side side, double gap) {
    const double width = width_of(label.text);
    const double x = side.x > 0 ? gap : side.x < 0 ? -gap - width : -width / 2;
    return {label.marker.x + x, label.marker.y + side.y * gap};
}

} // namespace

Box box_of(const std::string& text, Spot start) {
    return {start.x, start.y - line / 2, start.x + width_of(text), start.y + line / 2};
}

std::vector<std::optional<Spot>> place_labels(const std::vector<Label>& labels,
                                              const Surroundings& around) {
    std::vector<Box> taken = around.taken;
    std::vector<std::optional<Spot>> spots;
    for (const Label& label : labels) {
        std::optional<Spot> best;
        ptrdiff_t covered = 0;
        for (const double gap : gaps)
            for (const Side side : sides) {
                const Spot start = start_of(label, side, gap);
                const Box box = box_of(label.text, start);
                if (!around.area.holds(box) ||
                    std::any_of(taken.begin(), taken.end(),
                                [&](const Box& other) { return box.meets(other); }))
                    continue;
                const auto covers = std::count_if(around.better.begin(), around.better.end(),
                                                  [&](Spot spot) { return box.holds(spot); });
                if (best && covers >= covered)
                    continue;
                best = start;
                covered = covers;
            }
        if (best)
            taken.push_back(box_of(label.text, *best));
        spots.push_back(best);
    }
    return spots;
}

} // namespace lab
