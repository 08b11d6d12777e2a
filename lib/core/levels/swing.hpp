// How far hair swings in the frame of its head, rms of some strands, the probes, about their means; from positions that are
// read while the device goes on.
#pragma once

#include "core/base/layout.hpp"
#include "core/base/schedule.hpp"
#include "core/levels/stillness.hpp"

#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

class Swing {
  public:
    explicit Swing(std::pmr::memory_resource* memory)
        : stillness(memory), counts_(memory), read_(memory), last_(memory), mean_(memory) {}
    // Of the first strands; `counts`: vertices of each.
    Status open(Device& device, std::span<const uint32_t> counts, uint32_t row);

    // A fixed step is over, `s` after the one before.
    void pass(double s) { waited_ += s; }
    // Whether positions are to be put into probes() now, to be asked for.
    bool is_due() const { return fence_ == 0 && waited_ >= interval; }
    const Buffer& probes() const { return probes_; } // float4 [strands()*V], in the frames of roots
    uint32_t strands() const { return static_cast<uint32_t>(counts_.size()); }
    // After they are enqueued; gives the fence before which the read lies. `position` as Stillness asks for it.
    Result<uint64_t> ask(Device& device, const Buffer& position);
    // Takes what was asked for, if it has come. `scale`: m, one unit of the positions.
    Status take(Device& device, float scale);

    Stillness stillness; // told by the same samples

    float rms() const { return known_ >= settled ? rms_ : -1; } // m; < 0: not known yet
    uint64_t device_bytes() const { return probes_.bytes(); }

  private:
    static constexpr double interval = 0.05; // s, between samples
    static constexpr double settled = 1;     // s, of samples
    void add(float scale);

    Buffer probes_;
    uint32_t row_ = 0;
    std::pmr::vector<uint32_t> counts_;
    std::pmr::vector<float> read_, last_; // what was asked for; the sample before, m
    std::pmr::vector<double> mean_;
    uint64_t fence_ = 0;            // of what was asked for; 0: nothing was
    double waited_ = 0, asked_ = 0; // s: since the last sample was asked for; between it and before
    double known_ = 0, square_ = 0; // s; m^2
    float rms_ = 0;
};

} // namespace plait
