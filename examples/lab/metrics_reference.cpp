#include "continuum.hpp"
#include "metrics_input.hpp"
#include "table.hpp"

#include <cmath>
#include <map>

namespace lab {

namespace {

struct Errors {
    double sum = 0, largest = 0;
    size_t count = 0;
};

// The scene's own strand, converged: run once a process for each scene.
const std::vector<Snapshot>& converged_run(const Scene& scene, const std::string& model,
                                           uint32_t strand) {
    static std::map<std::string, std::vector<Snapshot>> runs;
    const std::string key = scene.physics + model + std::to_string(strand);
    if (const auto found = runs.find(key); found != runs.end())
        return found->second;
    Contexts float64("reference", "");
    const Recording recording = record(float64, scene, {find_model(model), {64, 2, true}});
    std::vector<Snapshot>& snapshots = runs[key];
    for (const Frame& frame : recording.frames) {
        snapshots.push_back({frame.time, {}});
        for (size_t i = 0; i < frame.x[strand].size(); ++i)
            snapshots.back().vertices.emplace_back(i, frame.x[strand][i] - frame.x[strand][0]);
    }
    return snapshots;
}

// The limit's, at the vertices that are at its places.
std::vector<Snapshot> snapshots_of_limit(const MetricInput& in) {
    const Continuum& limit = continuum_of(in.scene, *in.reference(), in.measure.strand);
    const uint32_t segments = in.strand().segments;
    std::vector<Snapshot> snapshots;
    for (size_t k = 0; k < limit.times.size(); ++k) {
        snapshots.push_back({limit.times[k], {}});
        for (uint32_t i = 1; i <= places; ++i)
            snapshots.back().vertices.emplace_back(i * segments / places, limit.points[k][i - 1]);
    }
    return snapshots;
}

std::vector<Snapshot> snapshots_of(const MetricInput& in) {
    const Reference& reference = *in.reference();
    if (reference.segments > 0)
        return snapshots_of_limit(in);
    return reference.converged.empty()
               ? trajectory(reference)
               : converged_run(in.scene, reference.converged, in.measure.strand);
}

Value trajectory_errors(const MetricInput& in, Errors& errors) {
    if (!in.reference())
        return none("needs a reference");
    if (in.reference()->segments > 0 && in.strand().segments % places != 0)
        return none("no vertices at eighths of its length");
    const double end = in.recording.frames.back().time;
    for (const Snapshot& snapshot : snapshots_of(in)) {
        const bool counts = snapshot.time >= in.measure.from - 1e-9 &&
                            snapshot.time <= std::min(in.measure.to, end) + 1e-6;
        if (!counts)
            continue;
        const auto x = positions_at(in.recording, in.measure.strand, snapshot.time);
        for (const auto& [vertex, expected] : snapshot.vertices) {
            if (vertex >= x.size())
                return none("the table has another number of vertices");
            if (vertex == 0)
                continue;
            const double error = (x[vertex] - x[0] - expected).norm() / in.length();
            errors.sum += error * error;
            errors.largest = std::max(errors.largest, error);
            errors.count += 1;
        }
    }
    return errors.count ? Value{0, ""} : none("no sample of the table lies in the time recorded");
}

} // namespace

Value rms_error(const MetricInput& in) {
    Errors errors;
    const Value value = trajectory_errors(in, errors);
    return std::isnan(value.value)
               ? value
               : Value{std::sqrt(errors.sum / static_cast<double>(errors.count)), ""};
}

Value max_error(const MetricInput& in) {
    Errors errors;
    const Value value = trajectory_errors(in, errors);
    return std::isnan(value.value) ? value : Value{errors.largest, ""};
}

Value reference_error(const MetricInput& in) {
    if (!in.reference() || in.reference()->segments == 0)
        return none("needs a reference in the limit of many segments");
    return {continuum_of(in.scene, *in.reference(), in.measure.strand).error, ""};
}

} // namespace lab
