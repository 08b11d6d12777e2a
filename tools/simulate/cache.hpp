// Trajectories on disk. Little-endian:
//   char magic[8] "PLAITTRJ", u32 version 1, u32 strands, u32 row (vertices per strand),
//   u32 frames planned, f32 rate (frames/s), u32 0
//   u32 vertex_count[strands]
//   then frame after frame: f32 head[7] (q x y z w, t in m), f32 xyz[strands][row][3] in m
// Each frame is flushed, so a file cut short at any byte holds all its whole frames.
#pragma once

#include "shot.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace simulate {

struct CacheHeader {
    char magic[8];
    uint32_t version, strands, row, frames_planned;
    float rate;
    uint32_t reserved;
};
static_assert(sizeof(CacheHeader) == 32);

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

class CacheWriter {
  public:
    // Throws Failure, as does append().
    CacheWriter(const std::string& path, std::span<const uint32_t> vertex_count, uint32_t row,
                uint32_t frames_planned, float rate);
    // Goes on after the first `frames` frames of a file with that header.
    CacheWriter(const std::string& path, const CacheHeader& header, uint32_t frames);
    void append(const Shot& shot);
    std::span<const float> packed() const { return packed_; } // the last frame, as in the file

  private:
    void write(const void* data, size_t size);
    std::string path_;
    File file_;
    std::vector<float> packed_;
};

class CacheReader {
  public:
    explicit CacheReader(const std::string& path);
    const CacheHeader& header() const { return header_; }
    uint32_t frames() const { return frames_; }               // whole ones in the file
    Shot read(uint32_t frame);                                // its spans last until the next read
    std::span<const float> packed() const { return packed_; } // that frame, as in the file

  private:
    void read_exactly(void* data, size_t size);
    size_t frame_size() const;
    std::string path_;
    File file_;
    CacheHeader header_{};
    uint32_t frames_ = 0;
    std::vector<uint32_t> vertex_count_;
    std::vector<float> packed_, positions_;
};

} // namespace simulate
