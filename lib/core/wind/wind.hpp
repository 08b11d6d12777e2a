// The wind of a sim: what the caller wants, its own time, and the stages that say what it is where.
#pragma once

#include "core/base/part.hpp"
#include "core/base/pose.hpp"
#include "core/base/schedule.hpp"
#include "core/wind/wind_grid.hpp"

#include <plait/plait.h>

#include <array>

namespace plait {

plait_wind_desc default_wind_desc();
// INVALID_ARGUMENT names the field, its value and its range.
Status check_wind(const plait_wind_desc& desc);

// What the groom says of single hairs.
struct HairSizes {
    float diameter; // m, the mean
    float length;   // m, that a vertex of a guide stands for
    float strands;  // that are shown, of each guide
};

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
    float crowd = 1; // guides, for each that is stepped

    // `from`: the wind that it takes the place of. Fails without an effect.
    Status begin(Device& device, const Wind& from, const plait_wind_desc& desc,
                 const HairSizes& hair);
    bool blows() const { return blows_; }
    bool is_sheltered() const { return grid_.is_sheltered(); }
    void reset(); // to when it began

    // A fixed step begins: the grid moves to where the hair is. append() is due.
    void place(const GridCube& cube, const plait_pose& head) { grid_.place(cube, head); }
    // The wind at the end of the step, of `step` s. `air`: m/s, that of a sim without wind; `still`:
    // m/s, of the head.
    void append(Schedule& schedule, const HairNow& hair, const std::array<float, 3>& air,
                const std::array<float, 3>& still, double step) const;
    void advance(double step); // the fixed step is over
    // Appends the drag on a part, as springs, and puts what else pushes it beside that. `first`: of the
    // substeps of a fixed step, of `step` s. `air`: m/s, that of a sim without wind.
    void fill(Schedule& schedule, const Part& part, const std::array<float, 3>& air, bool first,
              double step, Doors& doors) const;

    uint64_t device_bytes() const { return grid_.device_bytes(); }

  private:
    Vector mean(double time) const; // m/s
    double gust(double time) const; // of the mean's own speed
    std::array<float, 3> stream(const std::array<float, 3>& air, double step) const; // m/s
    float extinction(double speed) const; // 1/m, of one vertex per m^3
    plait_wind_field_params field_params(double step) const;

    plait_wind_desc desc_{};
    bool blows_ = false;
    float vertex_length_ = 0; // m of hair, of all that a guide stands for
    WindGrid grid_;
};

} // namespace plait
