// What plait_recorder points to.
#pragma once

#include "base/memory.hpp"
#include "io/curves/clip.hpp"

#include <plait/plait_recorder.h>

#include <string>
#include <vector>

namespace plait::api {

class Recorder {
  public:
    Recorder(std::pmr::memory_resource* memory, const plait_recorder_desc& desc)
        : desc_(desc), widths_(memory), uv_(memory), counts_(memory), other_counts_(memory),
          shown_(memory), now_(memory), last_(memory), before_(memory), velocities_(memory) {}

    Status open(const std::string& path);
    Status add(plait_sim* sim, double time);
    Status add_positions(const plait_view& counts, const plait_view& positions, double time);
    Status close();

  private:
    Status check_open() const;
    Status check_time(double time) const;
    Status read_shape(plait_sim* sim);
    Status take_shape(const char* of);
    Status check_metadata() const;
    Status read_positions(plait_sim* sim);
    Status add_frame(double time);
    Status write_frame(double time);
    Status write_velocities(double from, double to, std::span<const float> begin,
                            std::span<const float> end);
    Status end();

    plait_recorder_desc desc_;
    std::string path_;
    std::unique_ptr<ClipWriter> clip_;
    bool ended_ = false, closed_ = false; // by plait_recorder_close or a failure; by the former
    size_t frames_ = 0;
    uint32_t row_ = 0; // vertices of a strand's row in the sim in hand
    std::pmr::vector<float> widths_, uv_;
    std::pmr::vector<uint32_t> counts_;       // vertices of the strands that are recorded
    std::pmr::vector<uint32_t> other_counts_; // of what is in hand
    std::pmr::vector<float> shown_;           // as the sim has them: 4 for each vertex of each row
    // xyz of vertices: of this frame, of the last one and of the one before that
    std::pmr::vector<float> now_, last_, before_;
    double time_ = 0, time_before_ = 0;
    std::pmr::vector<float> velocities_;
};

} // namespace plait::api
