// How far hair swings in the frame of its head, rms of some strands about their means, and whether all of it is still;
// from positions that are read while the device goes on.
#pragma once

#include "core/base/layout.hpp"
#include "core/base/schedule.hpp"

#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

class Swing {
  public:
    explicit Swing(std::pmr::memory_resource* memory)
        : counts_(memory), read_(memory), last_(memory), all_(memory), all_last_(memory),
          mean_(memory) {}
    // Of the first strands; `counts`: vertices of each.
    Status open(Device& device, std::span<const uint32_t> counts, uint32_t row);

    // A fixed step is over, `s` after the one before.
    void pass(double s) { waited_ += s; }
    // Whether positions are to be put into probes() now, to be asked for.
    bool is_due() const { return fence_ == 0 && waited_ >= interval; }
    const Buffer& probes() const { return probes_; } // float4 [strands()*V], in the frames of roots
    uint32_t strands() const { return static_cast<uint32_t>(counts_.size()); }
    // After they are enqueued; gives the fence before which the read lies. `position`: of all strands, as the last
    // step left them; read where the probes have been slow.
    Result<uint64_t> ask(Device& device, const Buffer& position);
    // Takes what was asked for, if it has come. `scale`: m, one unit of the positions.
    Status take(Device& device, float scale);

    // m/s: hair is still, after a while, of which no vertex is faster. 0: none is.
    void set_still(float speed);
    // What was asked for before says nothing of what comes.
    void stir();
    void stand(double s); // of hair that is not stepped
    bool is_still() const { return still_; }

    float rms() const { return known_ >= settled ? rms_ : -1; } // m; < 0: not known yet
    uint64_t device_bytes() const { return probes_.bytes(); }

  private:
    static constexpr double interval = 0.05;    // s, between samples
    static constexpr double settled = 1;        // s, of samples
    static constexpr double falls_asleep = 0.5; // s
    static constexpr double longest_gap = 0.25; // s, between samples that tell a speed
    void add(float scale);
    void look(float scale, bool slow);
    bool looks() const { return still_below_ > 0 && calm_ >= falls_asleep; }

    Buffer probes_;
    uint32_t row_ = 0;
    std::pmr::vector<uint32_t> counts_;
    std::pmr::vector<float> read_, last_;    // what was asked for; the sample before, m
    std::pmr::vector<float> all_, all_last_; // of all strands, from the first look on
    std::pmr::vector<double> mean_;
    uint64_t fence_ = 0;            // of what was asked for; 0: nothing was
    double waited_ = 0, asked_ = 0; // s: since the last sample was asked for; between it and before
    double known_ = 0, square_ = 0; // s; m^2
    float rms_ = 0;
    float still_below_ = 0; // m/s
    double calm_ = 0;       // s for which probes have been slower
    bool looked_ = false,
         has_last_look_ = false; // all strands were asked for; were in the sample before
    bool still_ = false;
    float fastest_ = 0; // m/s, of a vertex of hair that is still
    uint64_t stirs_ = 0, asked_stirs_ = 0,
             last_stirs_ = 0; // so far; then, and at the sample before
};

} // namespace plait
