// A video, by piping raw frames to the ffmpeg program.
#pragma once

#include "render/image.hpp"

#include <cstdio>
#include <string>

namespace simulate {

class Video {
  public:
    static bool possible(); // ffmpeg is there

    Video(const std::string& path, uint32_t width, uint32_t height, double rate);
    ~Video();
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    void add(const render::Image& frame);
    bool close(); // whether ffmpeg took everything and ended well

  private:
    std::FILE* pipe_;
    bool good_;
};

} // namespace simulate
