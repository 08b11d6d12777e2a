// The wind of a sim: what the caller wants, its own time, and the stage that fills its turbulence.
#pragma once

#include "core/interhair.hpp"
#include "core/pose.hpp"
#include "core/schedule.hpp"
#include "core/wind_step.hpp"

#include <plait/plait.h>

#include <array>

namespace plait {

plait_wind_desc default_wind_desc();
// INVALID_ARGUMENT names the field, its value and its range.
Status check_wind(const plait_wind_desc& desc);

class Wind {
  public:
    using Vector = std::array<double, 3>;

    // What goes on from step to step; snapshots hold it.
    struct Moving {
        double time = 0;             // s since the wind began
        Vector way{};                // m, by which its mean has carried the turbulence
        std::array<float, 3> jump{}; // m/s, by which the caller has changed it since the last step
    };
    Moving moving;

    // `from`: the wind that it takes the place of. `diameter`: m, where the descriptor leaves it to
    // the groom. Fails without an effect.
    Status begin(Device& device, const Wind& from, const plait_wind_desc& desc, float diameter);
    bool blows() const { return blows_; }
    void reset(); // to when it began

    // The turbulence at the end of a fixed step of `step` s, around a head there.
    void append(Schedule& schedule, const plait_pose& head, const GridCube& cube, double step);
    void advance(double step); // the fixed step is over
    // `first`: of the substeps of a fixed step. `air`: m/s, that of a sim without wind.
    WindStep at(const std::array<float, 3>& air, bool first, double step) const;

    uint64_t device_bytes() const { return velocity_.bytes(); }

  private:
    Vector mean(double time) const; // m/s
    double gust(double time) const; // of the mean's own speed
    plait_air_field_params field_params(double step) const;

    plait_wind_desc desc_{};
    bool blows_ = false;
    plait_pose corner_ = identity_pose; // of the grid, in the last step
    float edge_ = 1;                    // m, of a voxel
    Buffer velocity_;                   // float4 [nodes^3], m/s; only with turbulence
};

} // namespace plait
