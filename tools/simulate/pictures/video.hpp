// A film: an .mp4 by piping raw frames to the ffmpeg program where it is there, else a .gif, which
// needs nothing.
#pragma once

#include "render/gif.hpp"

#include <cstdio>
#include <memory>
#include <string>

namespace simulate {

class Video {
  public:
    // `stem`: the path without .mp4 or .gif.
    Video(const std::string& stem, uint32_t width, uint32_t height, double rate);
    ~Video(); // without close(): nothing is left behind
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    void add(const render::Image& frame);
    bool close(); // whether everything was written; then the file is there, whole
    const std::string& path() const { return path_; }

  private:
    std::string path_, partial_; // of the .mp4 while it is written
    std::FILE* pipe_ = nullptr;
    std::unique_ptr<render::Gif> gif_;
    bool good_ = true;
};

} // namespace simulate
