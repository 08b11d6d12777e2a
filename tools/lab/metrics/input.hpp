// What a metric sees, and the metrics by the file they are in.
#pragma once

#include "metrics.hpp"
#include "references/modes.hpp"

#include <limits>

namespace lab {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct MetricInput {
    const Scene& scene;
    const Method& method;
    const Recording& recording;
    const Measure& measure;

    const Strand& strand() const { return scene.strands[measure.strand]; }
    double length() const { return strand().length; }
    const Reference* reference() const {
        if (measure.reference)
            return &*measure.reference;
        return scene.reference ? &*scene.reference : nullptr;
    }
    const std::vector<Vec3>& x(const Frame& frame) const { return frame.x[measure.strand]; }
    const std::vector<Vec3>& last() const { return x(recording.frames.back()); }
    bool counts(const Frame& frame) const {
        return frame.time >= measure.from - 1e-9 && frame.time <= measure.to + 1e-9;
    }
    template <typename Visit> void each(const Visit& visit) const {
        for (const Frame& frame : recording.frames)
            if (counts(frame))
                visit(frame);
    }
    Vec3 down() const { return scene.gravity.normalized(); }
};

inline Value none(const std::string& note) {
    return {no_number, note};
}

// EA as the library chooses it: 1 % of stretch at 10 g.
double stretch_stiffness(const Scene& scene, double length);

// The strand as its model has it; TressFX's stiffness has no modulus, so it counts as limp.
HangingChain hanging(const MetricInput& in);

// The scene itself, converged (`reference.converged`): run once a process for each scene.
const Recording& converged_run(const Scene& scene, const Reference& reference);

// metrics_swing.cpp: of strands whose roots move
Value swing_error(const MetricInput& in);
Value swing_error_strand(const MetricInput& in);
Value swing_error_p90(const MetricInput& in);
Value swing_least(const MetricInput& in);
Value drive_amplitude(const MetricInput& in);
Value drive_phase(const MetricInput& in);
// metrics_reference.cpp: against a trajectory
Value rms_error(const MetricInput& in);
Value max_error(const MetricInput& in);
Value reference_error(const MetricInput& in);
// metrics_contact.cpp: of strands on colliders
Value tip_travel(const MetricInput& in);
Value tip_speed(const MetricInput& in);
Value acceleration(const MetricInput& in);
Value slip_strain(const MetricInput& in);
Value slip_travel(const MetricInput& in);
Value penetration(const MetricInput& in);
Value passed_through(const MetricInput& in);
Value depth(const MetricInput& in);
// metrics_stretch.cpp: of all strands' lengths
Value segment_strain(const MetricInput& in);
Value strand_strain(const MetricInput& in);
Value stretched_frames(const MetricInput& in);
// metrics_pins.cpp: of strands between two points
Value catenary_sag(const MetricInput& in);
Value catenary_pull(const MetricInput& in);
// metrics_rest.cpp: of shapes at rest
Value tip_error(const MetricInput& in);
Value static_error(const MetricInput& in);
Value static_tip_error(const MetricInput& in);
Value static_floor(const MetricInput& in);
Value static_tip_over_floor(const MetricInput& in);

} // namespace lab
