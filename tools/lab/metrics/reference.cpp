#include "input.hpp"
#include "references/continuum.hpp"
#include "references/plane_fall.hpp"
#include "references/table.hpp"

#include <cmath>
#include <map>

namespace lab {

namespace {

struct Errors {
    double sum = 0, largest = 0;
    size_t count = 0;
};

// The scene's own strand, converged.
std::vector<Snapshot> snapshots_of_run(const MetricInput& in) {
    const uint32_t strand = in.measure.strand;
    std::vector<Snapshot> snapshots;
    for (const Frame& frame : converged_run(in.scene, *in.reference()).frames) {
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

// Why the strand does not fall in a plane from rest; "": it does.
std::string why_no_plane(const Scene& scene, uint32_t strand) {
    if (!scene.motion.still() || !scene.colliders.empty() || scene.settle > 0)
        return "falls in a plane are of still roots, without colliders and settling";
    if (scene.material.tip_stiffness != 1)
        return "falls in a plane are of even strands";
    const Vec3 side = scene.strands[strand].direction.cross(scene.gravity);
    const std::vector<Vec3> rest = rest_shape(scene.strands[strand], 1, true);
    for (const Vec3& x : rest)
        if (std::abs((x - rest[0]).dot(side)) > 1e-9 * side.norm() * scene.strands[strand].length)
            return "the strand's rest shape is in no plane with gravity";
    return "";
}

// The strand of this model, let go: run once a process for each scene and kind of masses.
const std::vector<Snapshot>& fall_of(const MetricInput& in) {
    static std::map<std::string, std::vector<Snapshot>> runs;
    const Model& model = *in.method.model;
    const std::string key = in.scene.physics + " " + std::to_string(model.half_tip) + " " +
                            std::to_string(in.measure.strand);
    if (const auto found = runs.find(key); found != runs.end())
        return found->second;
    const Vec3 up = -in.down();
    Vec3 along = in.strand().direction - up * up.dot(in.strand().direction);
    along = along.norm() > 1e-9 ? along.normalized() : up.unitOrthogonal();
    PlaneFall fall{in.strand().segment_lengths(), masses_of(in.scene, model, in.strand()), {}};
    const std::vector<Vec3> rest = rest_shape(in.strand(), 1, model.half_tip);
    for (size_t i = 0; i + 1 < rest.size(); ++i)
        fall.angles.push_back(
            std::atan2((rest[i + 1] - rest[i]).dot(up), (rest[i + 1] - rest[i]).dot(along)));
    fall.bend_stiffness = in.scene.bend_stiffness(in.strand());
    fall.gravity = in.scene.gravity.norm();
    fall.drag = in.scene.drag;
    const auto way = fall_in_plane(fall, in.scene.frames(), 1 / in.scene.rate);
    std::vector<Snapshot>& snapshots = runs[key];
    for (size_t k = 0; k < way.size(); ++k) {
        snapshots.push_back({static_cast<double>(k) / in.scene.rate, {}});
        for (size_t i = 0; i < way[k].size(); ++i)
            snapshots.back().vertices.emplace_back(i, way[k][i].x() * along + way[k][i].y() * up);
    }
    return snapshots;
}

std::vector<Snapshot> snapshots_of(const MetricInput& in) {
    const Reference& reference = *in.reference();
    if (reference.plane)
        return fall_of(in);
    if (reference.segments > 0)
        return snapshots_of_limit(in);
    return reference.converged.empty() ? trajectory(reference) : snapshots_of_run(in);
}

Value trajectory_errors(const MetricInput& in, Errors& errors) {
    if (!in.reference())
        return none("needs a reference");
    if (in.reference()->plane)
        if (const std::string why = why_no_plane(in.scene, in.measure.strand); !why.empty())
            return none(why);
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

const Recording& converged_run(const Scene& scene, const Reference& reference) {
    static std::map<std::string, Recording> runs;
    const std::string key =
        scene.physics + reference.converged + " " + std::to_string(reference.substeps);
    if (const auto found = runs.find(key); found != runs.end() && !found->second.interrupted)
        return found->second;
    Contexts float64("reference", "");
    const Method method{find_model(reference.converged), {reference.substeps, 2, true}};
    return runs[key] = record(float64, scene, method);
}

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
