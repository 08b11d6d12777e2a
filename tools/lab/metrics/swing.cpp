// How hair moves where its roots do: against a converged run, and against the theory of small
// swings.
#include "input.hpp"
#include "methods/models.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>

namespace lab {

namespace {

// ---- error over swing

// Of one strand, over frames and vertices but the root.
struct Moved {
    double error = 0; // rms distance from the reference, both seen from their roots
    double swing = 0; // rms displacement of the reference about its mean, as the head sees it
};

Moved moved(const MetricInput& in, const Recording& reference, size_t strand) {
    const size_t vertices = reference.frames[0].x[strand].size();
    std::vector<Vec3> mean(vertices, Vec3::Zero());
    double error = 0, square = 0;
    size_t frames = 0;
    for (size_t k = 0; k < in.recording.frames.size(); ++k) {
        const Frame& frame = in.recording.frames[k];
        if (!in.counts(frame))
            continue;
        const auto& x = frame.x[strand];
        const auto& y = reference.frames.at(k).x[strand];
        for (size_t i = 1; i < vertices; ++i) {
            error += (x[i] - x[0] - (y[i] - y[0])).squaredNorm();
            const Vec3 seen = frame.root.q.conjugate() * (y[i] - y[0]);
            mean[i] += seen;
            square += seen.squaredNorm();
        }
        ++frames;
    }
    const double n = static_cast<double>(frames);
    for (const Vec3& sum : mean)
        square -= sum.squaredNorm() / n;
    const double all = n * static_cast<double>(vertices - 1);
    return {std::sqrt(error / all), std::sqrt(std::max(0.0, square) / all)};
}

// Of every strand; empty, with the reason, where there is nothing to compare with.
std::vector<Moved> moved_strands(const MetricInput& in, std::string& why) {
    const Reference* reference = in.reference();
    if (!reference || reference->converged.empty() || reference->segments > 0) {
        why = "needs a reference that is a converged run of the scene";
        return {};
    }
    const Recording& run = converged_run(in.scene, *reference);
    if (run.interrupted || run.frames.size() != in.recording.frames.size()) {
        why = "interrupted";
        return {};
    }
    std::vector<Moved> all;
    for (size_t s = 0; s < in.scene.strands.size(); ++s)
        all.push_back(moved(in, run, s));
    return all;
}

// What that share of the values is below, linear in between.
double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto i = std::min(static_cast<size_t>(at), values.size() - 1);
    const double next = values[std::min(i + 1, values.size() - 1)];
    return values[i] + (at - static_cast<double>(i)) * (next - values[i]);
}

// Of every strand, error over swing; empty, with the reason, where one has none.
std::vector<double> errors_over_swings(const MetricInput& in, std::string& why) {
    std::vector<double> ratios;
    for (const Moved& strand : moved_strands(in, why)) {
        if (!(strand.swing > 0)) {
            why = "a strand of the reference stands still";
            return {};
        }
        ratios.push_back(strand.error / strand.swing);
    }
    return ratios;
}

Value error_over_swing(const MetricInput& in, double share) {
    std::string why;
    const std::vector<double> ratios = errors_over_swings(in, why);
    return ratios.empty() ? none(why) : Value{quantile(ratios, share), ""};
}

// ---- amplitude and phase of a driven swing

using Complex = std::complex<double>;

// The root sways as the real part of sum_k way_k exp(i frequency_k time), along `direction`.
struct Drive {
    Vec3 direction = Vec3::Zero();
    std::vector<double> frequencies; // rad/s
    std::vector<Complex> ways;       // m
};

std::string read_drive(const MetricInput& in, Drive& drive) {
    constexpr const char* what = "needs roots that sway all the time, level, one way, as sines";
    for (const Term& term : in.scene.motion.terms) {
        const Sine* sine = std::get_if<Sine>(&term);
        if (!sine || sine->from > 0 || sine->to < in.recording.frames.back().time ||
            std::abs(sine->direction.dot(in.down())) > 1e-6)
            return what;
        if (drive.frequencies.empty())
            drive.direction = sine->direction;
        if (drive.direction.cross(sine->direction).norm() > 1e-6)
            return what;
        drive.frequencies.push_back(2 * pi * sine->frequency);
        const double sign = drive.direction.dot(sine->direction);
        drive.ways.push_back(sign * sine->amplitude *
                             std::polar(1.0, sine->phase * pi / 180 - 0.5 * pi));
    }
    return drive.frequencies.empty() ? what : "";
}

// What a heavy strand of the model's masses answers with where it swings little, steadily:
// sideways, seen from the root. (s M + K) u = -s' M 1 r, s = -w^2 + i c w; the air takes its share
// of the head's velocity along, and so out of s'.
Eigen::VectorXcd answer(const MetricInput& in, double frequency, Complex way) {
    const HangingChain chain = hanging(in);
    const double g = in.scene.gravity.norm(), square = frequency * frequency;
    const Eigen::VectorXd w = chain.frequencies(g);
    const Eigen::MatrixXd modes = chain.modes(g);
    const std::vector<double> masses = chain.masses();
    const Eigen::Map<const Eigen::VectorXd> mass(masses.data(), modes.rows());
    const Eigen::VectorXd free = (modes.rowwise().squaredNorm().array() > 0).cast<double>();
    const double drag = in.scene.drag * frequency;
    const Complex s(-square, drag);
    const Complex driven(-square,
                         drag * (1 - static_cast<double>(in.scene.sim.params.air_with_head)));
    Eigen::VectorXcd u = Eigen::VectorXcd::Zero(modes.rows());
    for (Eigen::Index k = 0; k < modes.cols(); ++k) {
        const double share = modes.col(k).dot(mass.cwiseProduct(free));
        const double norm = modes.col(k).dot(mass.cwiseProduct(modes.col(k)));
        u += modes.col(k) * (-driven * way * share / norm / (w[k] * w[k] + s));
    }
    return u;
}

// Of every vertex (rows) at every frequency (columns): least squares over the frames that count.
Eigen::MatrixXcd found(const MetricInput& in, const Drive& drive) {
    std::vector<const Frame*> frames;
    in.each([&](const Frame& frame) { frames.push_back(&frame); });
    const auto rows = static_cast<Eigen::Index>(frames.size());
    const auto count = static_cast<Eigen::Index>(drive.frequencies.size());
    const auto vertices = static_cast<Eigen::Index>(in.last().size());
    Eigen::MatrixXd basis(rows, 2 * count + 1), ways(rows, vertices);
    for (Eigen::Index k = 0; k < rows; ++k) {
        const Frame& frame = *frames[static_cast<size_t>(k)];
        for (Eigen::Index f = 0; f < count; ++f) {
            const double angle = drive.frequencies[static_cast<size_t>(f)] * frame.time;
            basis(k, 2 * f) = std::cos(angle);
            basis(k, 2 * f + 1) = -std::sin(angle);
        }
        basis(k, 2 * count) = 1;
        for (Eigen::Index i = 0; i < vertices; ++i)
            ways(k, i) =
                (in.x(frame)[static_cast<size_t>(i)] - in.x(frame)[0]).dot(drive.direction);
    }
    const Eigen::MatrixXd fit = basis.colPivHouseholderQr().solve(ways);
    Eigen::MatrixXcd all(vertices, count);
    for (Eigen::Index f = 0; f < count; ++f)
        for (Eigen::Index i = 0; i < vertices; ++i)
            all(i, f) = Complex(fit(2 * f, i), fit(2 * f + 1, i));
    return all;
}

// At each frequency: what the strand did over what it should have done, as one complex number, the
// projection on the latter weighted by mass.
std::string gains_of(const MetricInput& in, std::vector<Complex>& gains) {
    Drive drive;
    if (const std::string why = read_drive(in, drive); !why.empty())
        return why;
    const Eigen::MatrixXcd did = found(in, drive);
    const std::vector<double> masses = hanging(in).masses();
    const Eigen::Map<const Eigen::VectorXd> mass(masses.data(), did.rows());
    for (size_t f = 0; f < drive.frequencies.size(); ++f) {
        const Eigen::VectorXcd should = answer(in, drive.frequencies[f], drive.ways[f]);
        const Eigen::VectorXcd weighted = mass.cast<Complex>().cwiseProduct(should);
        gains.push_back(weighted.dot(did.col(static_cast<Eigen::Index>(f))) /
                        weighted.dot(should)); // dot() conjugates its left side
    }
    return "";
}

// The worst over the frequencies.
template <typename Of> Value worst_gain(const MetricInput& in, const Of& of) {
    std::vector<Complex> gains;
    if (const std::string why = gains_of(in, gains); !why.empty())
        return none(why);
    double worst = 0;
    for (const Complex& gain : gains)
        if (const double value = of(gain); std::abs(value) > std::abs(worst))
            worst = value;
    return {worst, ""};
}

} // namespace

Value swing_error(const MetricInput& in) {
    return error_over_swing(in, 0.5);
}

Value swing_error_strand(const MetricInput& in) {
    std::string why;
    const std::vector<double> ratios = errors_over_swings(in, why);
    return ratios.empty() ? none(why) : Value{ratios[in.measure.strand], ""};
}

Value swing_error_p90(const MetricInput& in) {
    return error_over_swing(in, 0.9);
}

Value swing_least(const MetricInput& in) {
    std::string why;
    const std::vector<Moved> strands = moved_strands(in, why);
    if (strands.empty())
        return none(why);
    double least = 1e9;
    for (size_t s = 0; s < strands.size(); ++s)
        least = std::min(least, strands[s].swing / in.scene.strands[s].length);
    return {least, ""};
}

Value drive_amplitude(const MetricInput& in) {
    return worst_gain(in, [](Complex gain) { return std::abs(gain) - 1; });
}

Value drive_phase(const MetricInput& in) {
    return worst_gain(in, [](Complex gain) { return std::arg(gain) * 180 / pi; });
}

} // namespace lab
