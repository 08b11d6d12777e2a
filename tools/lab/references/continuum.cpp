#include "continuum.hpp"

#include "run/recording.hpp"

#include "common/progress.hpp"

#include <cmath>
#include <map>

namespace lab {

namespace {

constexpr uint32_t substeps = 16, newton_steps = 2; // of BDF2

using Points = std::vector<std::vector<Vec3>>; // by frame and place

class Runs {
  public:
    Runs(const Scene& scene, const Reference& reference, uint32_t strand)
        : scene_(scene), model_(*find_model(reference.converged)), strand_(strand),
          float64_("reference", ""), progress_("reference", 1000) {}

    // `share`: of all the work, for whoever waits.
    Points of(uint32_t segments, uint32_t steps, double share) {
        Scene scene = scene_;
        for (Strand& strand : scene.strands)
            strand.segments = segments;
        const Recording recording =
            record(float64_, scene, {&model_, {steps, newton_steps, true}}, [&](double part) {
                progress_.update(static_cast<uint32_t>(1000 * (done_ + share * part)) + 1);
            });
        done_ += share;
        Points points;
        for (const Frame& frame : recording.frames) {
            const auto& x = frame.x[strand_];
            points.emplace_back();
            for (uint32_t i = 1; i <= places; ++i)
                points.back().push_back(x[i * segments / places] - x[0]);
        }
        return points;
    }

  private:
    const Scene& scene_;
    const Model& model_;
    uint32_t strand_;
    Contexts float64_;
    Progress progress_;
    double done_ = 0;
};

double distance(const Points& a, const Points& b, double length) {
    double sum = 0;
    for (size_t k = 0; k < a.size(); ++k)
        for (size_t i = 0; i < places; ++i)
            sum += (a[k][i] - b[k][i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(a.size() * places)) / length;
}

// From two numbers of segments, one twice the other, whose error falls to `1/factor`.
Points extrapolated(const Points& fine, const Points& coarse, double factor) {
    Points limit = fine;
    for (size_t k = 0; k < fine.size(); ++k)
        for (size_t i = 0; i < places; ++i)
            limit[k][i] += (fine[k][i] - coarse[k][i]) / (factor - 1);
    return limit;
}

Continuum converged(const Scene& scene, const Reference& reference, uint32_t strand) {
    const uint32_t n = reference.segments;
    Runs runs(scene, reference, strand);
    const Points fine = runs.of(n, substeps, 0.8);
    const Points half = runs.of(n / 2, substeps, 0.13);
    const Points slow = runs.of(n / 2, substeps / 2, 0.07);
    if (interrupted())
        return {};
    const double factor = find_model(reference.converged)->half_tip ? 4 : 2;
    const double length = scene.strands[strand].length;
    Continuum limit;
    for (size_t k = 0; k < fine.size(); ++k)
        limit.times.push_back(static_cast<double>(k) / scene.rate);
    limit.points = extrapolated(fine, half, factor);
    limit.error = distance(limit.points, fine, length) + distance(half, slow, length);
    return limit;
}

} // namespace

const Continuum& continuum_of(const Scene& scene, const Reference& reference, uint32_t strand) {
    static std::map<std::string, Continuum> runs;
    const std::string key = scene.physics_but_segments + reference.converged + " " +
                            std::to_string(reference.segments) + " " + std::to_string(strand);
    if (const auto found = runs.find(key); found != runs.end() && !found->second.times.empty())
        return found->second;
    return runs[key] = converged(scene, reference, strand);
}

} // namespace lab
