// Where the texts beside the markers of a figure go, so that each can be read.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lab {

struct Spot {
    double x, y; // px, y upwards
};

struct Box {
    double left, bottom, right, top;

    bool meets(const Box& other) const {
        return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
    }
    bool holds(Spot spot) const {
        return left < spot.x && spot.x < right && bottom < spot.y && spot.y < top;
    }
    bool holds(const Box& other) const {
        return left <= other.left && other.right <= right && bottom <= other.bottom &&
               other.top <= top;
    }
};

struct Label {
    Spot marker;
    std::string text;
};

struct Surroundings {
    Box area;                 // beyond which nothing may be written
    std::vector<Box> taken;   // markers and texts that no label may touch
    std::vector<Spot> better; // left free, lines: as few as possible are covered
};

// What a text of the figures' small print covers whose left end, half up the line, is at `start`.
Box box_of(const std::string& text, Spot start);

// Where each label starts: beside its marker and clear of all that is taken and of each other, the
// earlier ones first. None: there is no such place near by.
std::vector<std::optional<Spot>> place_labels(const std::vector<Label>& labels,
                                              const Surroundings& around);

} // namespace lab
