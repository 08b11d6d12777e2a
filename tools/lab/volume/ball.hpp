// A sim of the hair on the ball with one method, and hair in free fall.
#pragma once

#include "volume.hpp"

#include <plait/plait.h>

namespace lab::volume {

// What is simulated: strands of equal numbers of vertices, roots first.
struct Hair {
    std::vector<float> positions; // xyz
    uint32_t row = 0;
    size_t strands() const { return positions.size() / 3 / row; }
};
Hair ball_hair(uint32_t strands);

// The same, held at roots above the grid, with nothing between these and the hair: what the grid
// changes of its momentum, no root takes up.
Hair free_hair(uint32_t strands);

extern const Cube cube; // for both

class Run {
  public:
    // `free`: no ball, no gravity, no drag.
    Run(plait_context* context, const Hair& hair, const Method& method, const std::string& model,
        bool free);

    void set_velocities(const std::vector<Vec3>& v);
    void step();
    Cloud read() const;
    // What the method changes of velocities now; only of those that are the laboratory's.
    std::optional<Change> change(const Cloud& cloud);
    void apply(const Cloud& cloud, const Change& change);

    const Method& method() const { return method_; }
    double step_ms() const { return step_ms_; }       // of the last step
    double program_ms() const { return program_ms_; } // of the method's program after it

  private:
    std::vector<float> field(plait_field which) const;
    void write(plait_field which, const std::vector<Vec3>& values);
    void measure_rest(const Hair& hair);

    const Method& method_;
    SimHandle sim_;
    Cloud rest_; // masses, wanted densities
    std::unique_ptr<Program> program_;
    double step_ms_ = 0, program_ms_ = 0;
};

} // namespace lab::volume
