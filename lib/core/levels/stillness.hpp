// Whether hair is still: no vertex of it has been faster than a speed for a while. Probes tell slow hair from fast; a few
// strands may move while all probes rest, so hair whose probes are slow is looked at in whole.
#pragma once

#include "core/base/schedule.hpp"

#include <memory_resource>
#include <vector>

namespace plait {

class Stillness {
  public:
    explicit Stillness(std::pmr::memory_resource* memory) : all_(memory), last_(memory) {}

    // m/s: hair is still when no vertex is faster. 0: it never is.
    void set_speed(float speed);
    // What was asked for before says nothing of what comes.
    void stir();
    void stand(double s); // of hair that is not stepped
    bool is_still() const { return still_; }

    // With each sample of probes. `position`: of all strands, as the last step left them; read where probes have been slow.
    Status ask(Device& device, const Buffer& position);
    // That sample has come, `s` after the one before. `way`: m, rms, that probes moved by; of the first sample infinity.
    // `scale`: m, one unit of the positions.
    void take(double way, double s, float scale);

  private:
    static constexpr double while_slow = 0.5;   // s, before all of it is looked at
    static constexpr double longest_gap = 0.25; // s, between samples that tell a speed
    void look(bool slow, double s, float scale);
    bool looks() const { return speed_ > 0 && calm_ >= while_slow; }

    float speed_ = 0;                       // m/s
    double calm_ = 0;                       // s for which probes have been slower
    std::pmr::vector<float> all_, last_;    // of all strands: what was asked for; the sample before
    bool asked_ = false, has_last_ = false; // all strands: for this sample; in the one before
    bool still_ = false;
    float fastest_ = 0; // m/s, of a vertex of hair that is still
    uint64_t stirs_ = 0, asked_stirs_ = 0,
             last_stirs_ = 0; // so far; when this sample was asked for, and the one before
};

} // namespace plait
