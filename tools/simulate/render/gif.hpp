// A film that every viewer of pictures shows: GIF89a, 255 colours, frames as changes to the one
// before.
#pragma once

#include "image.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace render {

class Gif {
  public:
    // Written beside `path`, which appears whole at close() or not at all.
    Gif(std::string path, int width, int height, double rate);
    ~Gif();
    Gif(const Gif&) = delete;
    Gif& operator=(const Gif&) = delete;

    void add(const Image& frame); // of the size given
    bool close();                 // whether everything could be written

  private:
    struct Box {
        int left, top, right, bottom; // right and bottom are outside
    };
    void begin(const Image& first);
    uint8_t index_of(const uint8_t* rgb, int x, int y);
    Box changed(const std::vector<uint8_t>& indices) const;
    void write_frame(const std::vector<uint8_t>& indices, Box box);
    void put(const std::vector<uint8_t>& bytes);

    std::string path_;
    int width_, height_;
    double rate_; // frames a second
    std::FILE* file_;
    bool good_;
    uint32_t frames_ = 0;
    std::vector<std::array<uint8_t, 3>> palette_;
    std::vector<int16_t> nearest_; // of each colour of 6 bits a channel; -1: not yet sought
    std::vector<uint8_t> shown_;   // indices of the frame before
};

} // namespace render
