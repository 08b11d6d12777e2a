// An 8-bit RGB picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace render {

struct Image {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgb; // [height][width][3], top row first

    Image() = default;
    Image(int w, int h) : width(w), height(h), rgb(3u * static_cast<size_t>(w) * h) {}
    uint8_t* pixel(int x, int y) { return &rgb[3u * (static_cast<size_t>(y) * width + x)]; }
    const uint8_t* pixel(int x, int y) const {
        return &rgb[3u * (static_cast<size_t>(y) * width + x)];
    }
};

// Throw std::runtime_error that names the file.
void write_png(const Image& image, const std::string& path);
Image read_png(const std::string& path);

} // namespace render
