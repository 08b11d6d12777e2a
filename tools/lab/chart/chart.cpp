#include "chart.hpp"

#include "common/json_reader.hpp"
#include "hash.hpp"
#include "metrics/metrics.hpp"
#include "references/continuum.hpp"

#include "common/file.hpp"
#include "common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace lab {

namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

// The family's scene once, or with each number of segments.
std::vector<Scene> scenes_of(const Family& family) {
    if (!family.free())
        return {read_scene(family.scene, family.overrides)};
    std::vector<Scene> scenes;
    for (const uint32_t segments : family.segments) {
        Json overrides = family.overrides;
        set_path(overrides, "strand.segments", segments);
        scenes.push_back(read_scene(family.scene, overrides));
    }
    return scenes;
}

double top_of(const Family& family) {
    return counts_over_swing(family.metric) ? swing_top : length_top;
}

bool far_away(const Scene& scene, const Recording& recording) {
    for (const Frame& frame : recording.frames)
        for (size_t s = 0; s < frame.x.size(); ++s)
            for (const Vec3& x : frame.x[s])
                if ((x - frame.x[s][0]).norm() > 100 * scene.strands[s].length)
                    return true;
    return false;
}

// N: not finite, or 100 lengths away. E: energy out of nothing. o: off the scale. s, r: strained by
// 10 % at some time, by 1 % at the end: these still have a place in the figure. Of the worst
// strand.
char letter_of(const Scene& scene, const Method& method, const Recording& recording, double error,
               double top) {
    const auto value = [&](const char* metric) {
        double worst = 0;
        Measure measure = measure_of(metric);
        for (measure.strand = 0; measure.strand < scene.strands.size(); ++measure.strand)
            worst = std::max(worst, evaluate(scene, method, recording, measure).value);
        return worst;
    };
    if (recording.nonfinite > 0 || far_away(scene, recording))
        return 'N';
    if (value("energy_rise") > 0.05)
        return 'E';
    if (!(error < 0.5 * top))
        return 'o';
    if (value("strain_max") > 0.1)
        return 's';
    return value("strain_rest") > 0.01 ? 'r' : '\0';
}

class Runner {
  public:
    Runner(const ChartOptions& options, ChartRun& run)
        : options_(options), contexts_(options.backend, options.device),
          profiled_(options.backend, options.device, true),
          results_(options.out + "/charts.csv", options.fresh), run_(run) {
        run.device = contexts_.device();
    }

    void all(const std::vector<Family>& families, const std::vector<const Model*>& models) {
        uint32_t all = 0, done = 0;
        for (const Family& family : families)
            for (const Scene& scene : scenes_of(family))
                all += static_cast<uint32_t>(methods_on(family, scene, models).size());
        Progress progress("chart", all);
        for (const Family& family : families) {
            Chart chart{family, nan, {}, {}};
            for (const Scene& scene : scenes_of(family))
                for (const Method& method : methods_on(family, scene, models)) {
                    if (interrupted()) {
                        run_.interrupted = true;
                        return;
                    }
                    one(chart, scene, method);
                    progress.update(++done);
                }
            std::stable_sort(chart.points.begin(), chart.points.end(), by_model);
            run_.charts.push_back(std::move(chart));
        }
    }

  private:
    static bool by_model(const ChartPoint& a, const ChartPoint& b) {
        return a.method.model < b.method.model; // of models(), one list
    }

    static std::vector<Method> methods_on(const Family& family, const Scene& scene,
                                          const std::vector<const Model*>& models) {
        std::vector<Method> methods;
        for (const Method& method : family.methods)
            if (std::find(models.begin(), models.end(), method.model) != models.end())
                methods.push_back({method.model, resolved(*method.model, method.setting, scene)});
        if (!family.methods.empty())
            return methods;
        for (const Model* model : models)
            for (const Setting& setting : settings_of(*model, scene))
                methods.push_back({model, setting});
        return methods;
    }

    void one(Chart& chart, const Scene& scene, const Method& method) {
        const Row row{chart.family.name, "", "", {}, {}, false, chart.family.needs};
        if (const std::string why = why_not(row, *method.model); !why.empty()) {
            const std::string line = method.model->label + ": " + why;
            if (!wanted(chart.left_out, line) || chart.left_out.empty())
                chart.left_out.push_back(line);
            return;
        }
        ChartPoint point{method, scene.strands[0].segments, nan, '\0', {}};
        measured_cost(chart, scene, point);
        if (point.cost.runs == 0) {
            char line[96];
            std::snprintf(line, sizeof line, "%s: costs %.0f s, more than %.0f",
                          method.label().c_str(), point.cost.ms_per_frame() / 1e3,
                          options_.costs.dearest / 1e3);
            chart.left_out.push_back(line);
            return;
        }
        measured_error(chart, scene, point);
        if (!interrupted())
            chart.points.push_back(point);
    }

    Result blank(const Chart& chart, const Scene& scene, const Method& method,
                 const char* what) const {
        Result result;
        result.row = chart.family.name;
        result.variant = what;
        result.model = method.model->label;
        result.setting = method.setting.label();
        result.device = run_.device.name;
        result.backend = run_.device.backend;
        result.driver = run_.device.driver;
        result.fingerprint = scene.physics;
        return result;
    }

    // What is measured; the scene's fingerprint is without its reference.
    static std::string error_of(const Family& family, const Scene& scene) {
        if (counts_over_swing(family.metric))
            return family.metric + " from " + std::to_string(scene.reference->substeps);
        const bool limit = scene.reference && scene.reference->segments > 0;
        return limit ? "error from " + scene.reference->converged + " " +
                           std::to_string(scene.reference->segments)
                     : "error";
    }

    // Below it nothing can be told apart, or, of errors over swing, nothing moves as it should.
    static double line_of(const Family& family, const Scene& scene, const Method& method,
                          const Recording& recording) {
        if (counts_over_swing(family.metric))
            return 1;
        const char* metric = family.free() ? "reference_error" : "static_floor";
        return evaluate(scene, method, recording, measure_of(metric)).value;
    }

    // The letter is kept where a verdict would be, the floor where a mark would be.
    void measured_error(Chart& chart, const Scene& scene, ChartPoint& point) {
        Result result = blank(chart, scene, point.method, error_of(chart.family, scene).c_str());
        if (const Result* known = results_.find(result.key())) {
            result = *known;
        } else {
            const Recording recording = record(contexts_, scene, point.method);
            if (recording.interrupted)
                return;
            const Value error =
                evaluate(scene, point.method, recording, measure_of(chart.family.metric.c_str()));
            const char letter =
                letter_of(scene, point.method, recording, error.value, top_of(chart.family));
            result.value = error.value;
            result.note = error.note;
            result.verdict = letter ? std::string(1, letter) : "";
            result.unit = metric_unit(chart.family.metric);
            result.mark = line_of(chart.family, scene, point.method, recording);
            if (interrupted()) // while it made the reference
                return;
            results_.add(result);
        }
        point.error = result.value;
        point.letter = result.verdict.empty() ? '\0' : result.verdict[0];
        if (result.mark && std::isfinite(*result.mark))
            chart.floor = *result.mark;
    }

    // Wall in `value`, kernels in `mark`, vertices and steps in the note.
    void measured_cost(Chart& chart, const Scene& scene, ChartPoint& point) {
        const std::string size =
            std::to_string(options_.costs.vertices) + " x " + std::to_string(options_.costs.runs);
        Result result = blank(chart, scene, point.method, ("cost " + size).c_str());
        if (const Result* known = results_.find(result.key())) {
            result = *known;
        } else {
            const Cost cost =
                measure_cost(contexts_, profiled_, scene, point.method, options_.costs);
            result.value = cost.wall;
            result.mark = cost.kernel;
            result.unit = "s";
            result.note = std::to_string(cost.vertices) + " x " + std::to_string(cost.runs);
            results_.add(result);
        }
        unsigned long long vertices = 0;
        unsigned runs = 0;
        std::sscanf(result.note.c_str(), "%llu x %u", &vertices, &runs);
        point.cost = {vertices, runs, result.value, result.mark.value_or(0), 1 / scene.rate};
    }

    const ChartOptions& options_;
    Contexts contexts_, profiled_;
    Results results_;
    ChartRun& run_;
};

} // namespace

ChartRun run_charts(const ChartOptions& options) {
    auto families = read_families(
        options.table.empty() ? std::string(PLAIT_LAB_SCENES) + "/charts.json" : options.table);
    std::vector<std::string> known, scenes;
    for (const Family& family : families) {
        known.push_back(family.name);
        scenes.push_back(family.scene);
    }
    check_known("--families", options.families, known);
    check_scenes(options.scenes, scenes);
    std::erase_if(families, [&](const Family& family) {
        return !wanted(options.families, family.name) ||
               !wanted_scene(options.scenes, family.scene);
    });
    ChartRun run;
    Runner(options, run).all(families, models_of(options.models, true));
    for (const Chart& chart : run.charts) {
        const std::string path = options.out + "/" + chart.family.name;
        write_text(chart_csv(chart, run.device), path + ".csv");
        run.files.push_back(path + ".csv");
        if (draw(figure_of(chart, run.device), options.out))
            run.files.insert(run.files.end(), {path + ".svg", path + ".png"});
    }
    return run;
}

} // namespace lab
