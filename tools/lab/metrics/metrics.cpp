#include "metrics.hpp"

#include "input.hpp"
#include "references/elastic.hpp"
#include "references/modes.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lab {

namespace {

// ---- lengths

Value strain_max(const MetricInput& in) {
    const auto lengths = in.strand().segment_lengths();
    double worst = 0;
    in.each([&](const Frame& frame) {
        const double strain = strain_at(lengths, in.x(frame));
        worst = std::isfinite(strain) && std::isfinite(worst) ? std::max(worst, strain) : no_number;
    });
    return {worst, std::isfinite(worst) ? "" : "non-finite"};
}

Value strain_rest(const MetricInput& in) {
    return {strain_at(in.strand().segment_lengths(), in.last()), ""};
}

// ---- movement

Value jitter(const MetricInput& in) {
    double sum = 0;
    size_t count = 0;
    const auto& frames = in.recording.frames;
    for (size_t k = 1; k < frames.size(); ++k) {
        if (!in.counts(frames[k]) || !in.counts(frames[k - 1]))
            continue;
        for (size_t i = 1; i < in.x(frames[k]).size(); ++i)
            sum += (in.x(frames[k])[i] - in.x(frames[k - 1])[i]).squaredNorm();
        count += in.x(frames[k]).size() - 1;
    }
    if (count == 0)
        return none("needs two frames");
    return {std::sqrt(sum / static_cast<double>(count)) / in.length(), ""};
}

// Amplitude of the first mode over time: sideways displacement weighted by mass and mode shape.
std::vector<double> first_mode(const MetricInput& in) {
    const HangingChain chain = hanging(in);
    const Eigen::VectorXd shape = chain.modes(in.scene.gravity.norm()).col(0);
    const auto mass = chain.masses();
    const auto& start = in.x(in.recording.frames.front());
    Vec3 side = start.back() - start.front();
    side -= in.down() * side.dot(in.down());
    side.normalize();
    std::vector<double> signal;
    in.each([&](const Frame& frame) {
        double sum = 0;
        for (size_t i = 0; i < in.x(frame).size(); ++i)
            sum += mass[i] * shape[static_cast<Eigen::Index>(i)] *
                   (in.x(frame)[i] - in.x(frame)[0]).dot(side);
        signal.push_back(sum);
    });
    return signal;
}

bool is_held(const MetricInput& in) { // every vertex of it
    return in.last().size() <= in.method.model->pinned;
}

Swing swing_of(const MetricInput& in) {
    return is_held(in) ? Swing{} : fit_swing(first_mode(in), 1 / in.scene.rate);
}

Value frequency(const MetricInput& in) {
    const Swing swing = swing_of(in);
    return swing.frequency > 0 ? Value{swing.frequency, ""} : none("does not swing");
}

Value frequency_error(const MetricInput& in) {
    const Value found = frequency(in);
    if (is_held(in))
        return found;
    const double expected = hanging(in).frequencies(in.scene.gravity.norm())[0];
    return {found.value / expected - 1, found.note};
}

Value damping_ratio(const MetricInput& in) {
    const Swing swing = swing_of(in);
    return swing.frequency > 0 ? Value{swing.damping, ""} : none("does not swing");
}

// ---- energy

// Kinetic, of weight and elastic, J.
double energy(const MetricInput& in, const Frame& frame) {
    const auto& x = in.x(frame);
    const auto& v = frame.v[in.measure.strand];
    const auto mass = masses_of(in.scene, *in.method.model, in.strand());
    double sum = 0;
    for (size_t i = 1; i < x.size(); ++i)
        sum += mass[i] * (0.5 * v[i].squaredNorm() - in.scene.gravity.dot(x[i] - x[0]));
    if (!in.method.model->bends || !in.method.model->twists)
        return sum;
    const bool straight = in.strand().curvature == 0 && in.strand().points.empty();
    const auto& rest = in.recording.rest[in.measure.strand];
    const ElasticStrand strand{
        in.strand().segment_lengths(), stretch_stiffness(in.scene, in.length()),
        straight ? in.scene.bend_stiffness(in.strand()) : 0, (rest[1] - rest[0]).normalized()};
    return sum + least_elastic_energy(strand, x);
}

Value energy_rise(const MetricInput& in) {
    if (!in.scene.motion.still())
        return none("the root's work is not known: needs a still root");
    const auto mass = masses_of(in.scene, *in.method.model, in.strand());
    const double weight =
        std::accumulate(mass.begin() + 1, mass.end(), 0.0) * in.scene.gravity.norm() * in.length();
    const double start = energy(in, in.recording.frames.front());
    double highest = start;
    in.each([&](const Frame& frame) { highest = std::max(highest, energy(in, frame)); });
    return {(highest - start) / weight, ""};
}

Value speed_max(const MetricInput& in) {
    double fastest = 0;
    in.each([&](const Frame& frame) {
        for (const Vec3& v : frame.v[in.measure.strand])
            fastest = std::max(fastest, v.norm());
    });
    return {fastest, ""};
}

// ---- attitude

// Between the line from root to tip and gravity, averaged over the frames that count.
Value tilt(const MetricInput& in) {
    double sum = 0;
    size_t count = 0;
    in.each([&](const Frame& frame) {
        const Vec3 line = in.x(frame).back() - in.x(frame).front();
        sum += std::atan2(line.cross(in.down()).norm(), line.dot(in.down()));
        ++count;
    });
    return {sum / static_cast<double>(count) * 180 / pi - in.measure.expect.value_or(0), ""};
}

Value out_of_plane(const MetricInput& in) {
    const auto& rest = in.recording.rest[in.measure.strand];
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); // about the root
    for (const Vec3& x : rest)
        spread += (x - rest[0]) * (x - rest[0]).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread); // ascending
    Vec3 normal = axes.eigenvectors().col(0);
    if (axes.eigenvalues()[1] <
        1e-12 * in.length() * in.length()) // straight: the plane it falls in
        normal = (rest.back() - rest[0]).cross(in.down()).normalized();
    double worst = 0;
    in.each([&](const Frame& frame) {
        for (const Vec3& x : in.x(frame)) {
            const Vec3 local = frame.root.q.conjugate() * (x - in.x(frame)[0]);
            worst = std::max(worst, std::abs(local.dot(normal)));
        }
    });
    return {worst / in.length(), ""};
}

Value teleport_change(const MetricInput& in) {
    return {in.recording.teleport_change / in.length(), ""};
}

Value nonfinite(const MetricInput& in) {
    return {static_cast<double>(in.recording.nonfinite), ""};
}

Value drop(const MetricInput& in) {
    return {(in.last().back() - in.last().front()).dot(in.down()) / in.length() -
                in.measure.expect.value_or(0),
            ""};
}

struct Metric {
    const char* name;
    const char* unit;
    Value (*evaluate)(const MetricInput&);
    bool of_all_strands = false; // `strand` chooses nothing
};

constexpr Metric metrics[] = {
    {"rms_error", "L", rms_error},
    {"max_error", "L", max_error},
    {"reference_error", "L", reference_error},
    {"swing_error", "", swing_error, true},
    {"swing_error_strand", "", swing_error_strand},
    {"swing_error_p90", "", swing_error_p90, true},
    {"swing_least", "L", swing_least, true},
    {"drive_amplitude", "", drive_amplitude},
    {"drive_phase", "deg", drive_phase},
    {"tip_error", "L", tip_error},
    {"static_error", "L", static_error},
    {"static_tip_error", "L", static_tip_error},
    {"static_floor", "L", static_floor},
    {"static_tip_over_floor", "", static_tip_over_floor},
    {"catenary_sag", "L", catenary_sag},
    {"catenary_pull", "", catenary_pull},
    {"strain_max", "", strain_max},
    {"strain_rest", "", strain_rest},
    {"segment_strain", "", segment_strain, true},
    {"strand_strain", "", strand_strain, true},
    {"stretched_frames", "frames", stretched_frames, true},
    {"jitter", "L/frame", jitter},
    {"frequency", "rad/s", frequency},
    {"frequency_error", "", frequency_error},
    {"damping_ratio", "", damping_ratio},
    {"energy_rise", "m g L", energy_rise},
    {"speed_max", "m/s", speed_max},
    {"tilt", "deg", tilt},
    {"out_of_plane", "L", out_of_plane},
    {"teleport_change", "L", teleport_change, true},
    {"tip_travel", "L", tip_travel},
    {"tip_speed", "L/s", tip_speed},
    {"acceleration", "", acceleration},
    {"slip_strain", "", slip_strain},
    {"slip_travel", "L", slip_travel},
    {"penetration", "L", penetration},
    {"depth", "m", depth, true},
    {"passed_through", "of strands", passed_through, true},
    {"drop", "L", drop},
    {"nonfinite", "vertices", nonfinite, true},
};

const Metric* find(const std::string& name) {
    const auto found = std::find_if(std::begin(metrics), std::end(metrics),
                                    [&](const Metric& metric) { return name == metric.name; });
    return found == std::end(metrics) ? nullptr : found;
}
} // namespace

HangingChain hanging(const MetricInput& in) {
    const Model& model = *in.method.model;
    const bool modulus = model.bends && model.model != PLAIT_MODEL_TRESSFX;
    return {in.strand().segment_lengths(), model.pinned, model.half_tip,
            modulus ? in.scene.bend_stiffness(in.strand()) / in.scene.material.line_density : 0};
}

double stretch_stiffness(const Scene& scene, double length) {
    const Material& m = scene.material;
    return m.stretch_stiffness > 0 ? m.stretch_stiffness
                                   : m.line_density * length * 10 * standard_gravity / 0.01;
}

Measure measure_of(const char* metric) {
    Measure measure;
    measure.metric = metric;
    return measure;
}

bool is_metric(const std::string& name) {
    return find(name) != nullptr;
}

const std::vector<std::string>& metric_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Metric& metric : metrics)
            all.emplace_back(metric.name);
        return all;
    }();
    return names;
}

std::string metric_list() {
    std::string list;
    for (const std::string& name : metric_names())
        list += (list.empty() ? "" : ", ") + name;
    return list;
}

const char* metric_unit(const std::string& metric) {
    return find(metric)->unit;
}

bool is_of_all_strands(const std::string& metric) {
    return find(metric)->of_all_strands;
}

bool counts_over_swing(const std::string& metric) {
    return metric == "swing_error" || metric == "swing_error_strand" || metric == "swing_error_p90";
}

Value evaluate(const Scene& scene, const Method& method, const Recording& recording,
               const Measure& measure) {
    if (recording.nonfinite > 0 && measure.metric != "nonfinite")
        return none("non-finite");
    return find(measure.metric)->evaluate({scene, method, recording, measure});
}

const double* mark_of(const Measure& measure, const Method& method) {
    const bool quality = method.setting == method.model->quality;
    for (const std::string& key :
         {method.model->label, std::string(quality ? "quality" : ""), std::string()})
        if (const auto mark = measure.pass.find(key); mark != measure.pass.end())
            return &mark->second;
    return nullptr;
}

Verdict judge(const Measure& measure, const Method& method, const Value& value) {
    if (measure.at_least)
        return value.value >= *measure.at_least ? Verdict::pass : Verdict::fail;
    const double* mark = mark_of(measure, method);
    if (!mark)
        return Verdict::none;
    return std::abs(value.value) <= *mark ? Verdict::pass : Verdict::fail;
}

double strain_at(const std::vector<double>& lengths, const std::vector<Vec3>& x) {
    double worst = 0;
    for (size_t i = 0; i < lengths.size(); ++i) {
        const double strain = std::abs((x[i + 1] - x[i]).norm() / lengths[i] - 1);
        if (!std::isfinite(strain))
            return no_number;
        worst = std::max(worst, strain);
    }
    return worst;
}

std::vector<double> masses_of(const Scene& scene, const Model& model, const Strand& strand) {
    auto mass = HangingChain{strand.segment_lengths(), model.pinned, model.half_tip, 0}.masses();
    for (double& m : mass)
        m *= scene.material.line_density;
    return mass;
}

namespace {

// Slope of the least-squares line through (0, y_0), (1, y_1), ...
double slope(const std::vector<double>& y) {
    const double n = static_cast<double>(y.size());
    double moment = 0;
    for (size_t i = 0; i < y.size(); ++i)
        moment += (static_cast<double>(i) - 0.5 * (n - 1)) * y[i];
    return 12 * moment / (n * (n * n - 1));
}

} // namespace

Swing fit_swing(const std::vector<double>& signal, double step) {
    std::vector<double> crossings, peaks; // times in samples; logarithms
    for (size_t i = 1; i + 1 < signal.size(); ++i) {
        const double a = signal[i - 1], b = signal[i], c = signal[i + 1];
        if ((a < 0) != (b < 0))
            crossings.push_back(static_cast<double>(i) - b / (b - a));
        if (std::abs(b) > std::abs(a) && std::abs(b) >= std::abs(c) && a * c > 0) {
            const double bend = a - 2 * b + c;
            peaks.push_back(std::log(std::abs(b - (c - a) * (c - a) / (8 * bend))));
        }
    }
    if (crossings.size() < 2 || peaks.size() < 2) // less is no swing
        return {};
    const double half_period = slope(crossings) * step;
    return {pi / half_period, -slope(peaks) / pi};
}

std::vector<Vec3> positions_at(const Recording& recording, size_t strand, double time) {
    const auto& frames = recording.frames;
    const auto after = std::find_if(frames.begin(), frames.end(),
                                    [&](const Frame& frame) { return frame.time >= time - 1e-7; });
    if (after == frames.end())
        return frames.back().x[strand];
    const auto k = static_cast<size_t>(after - frames.begin());
    if (k == 0 || std::abs(after->time - time) < 1e-6 * (after->time - frames[k - 1].time))
        return after->x[strand];
    const auto& p0 = frames[k >= 2 ? k - 2 : k - 1].x[strand];
    const auto& p1 = frames[k - 1].x[strand];
    const auto& p2 = after->x[strand];
    const auto& p3 = frames[std::min(k + 1, frames.size() - 1)].x[strand];
    const double s = (time - frames[k - 1].time) / (after->time - frames[k - 1].time);
    std::vector<Vec3> x;
    for (size_t i = 0; i < p1.size(); ++i) // Catmull-Rom
        x.push_back(p1[i] + 0.5 * s *
                                (p2[i] - p0[i] +
                                 s * (2 * p0[i] - 5 * p1[i] + 4 * p2[i] - p3[i] +
                                      s * (3 * (p1[i] - p2[i]) + p3[i] - p0[i]))));
    return x;
}

} // namespace lab
