#include "accuracy.hpp"

#include "metrics/metrics.hpp"
#include "run/report.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace lab {

namespace {

constexpr const char* all_variants = "all";

std::vector<Row> choose(const AccuracyOptions& options) {
    const std::string table =
        options.table.empty() ? std::string(PLAIT_LAB_SCENES) + "/accuracy.json" : options.table;
    std::vector<Row> rows = read_rows(table);
    std::vector<std::string> known, scenes;
    for (const Row& row : rows) {
        known.push_back(row.id);
        scenes.push_back(row.scene);
    }
    check_known("--rows", options.rows, known);
    check_scenes(options.scenes, scenes);
    std::erase_if(rows, [&](const Row& row) {
        return !wanted(options.rows, row.id) || !wanted_scene(options.scenes, row.scene);
    });
    return rows;
}

// So many points along the strand, from its root.
std::vector<Vec3> resampled(const std::vector<Vec3>& x) {
    constexpr int samples = 16;
    std::vector<Vec3> points;
    const double last = static_cast<double>(x.size() - 1);
    for (int k = 1; k <= samples; ++k) {
        const double at = last * k / samples;
        const auto i = std::min(static_cast<size_t>(at), x.size() - 2);
        points.push_back(x[i] + (at - static_cast<double>(i)) * (x[i + 1] - x[i]) - x[0]);
    }
    return points;
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double worst = 0;
    for (size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, (a[i] - b[i]).norm());
    return worst;
}

// What is left to be done, method by method, and the bookkeeping around it.
class Runner {
  public:
    Runner(const AccuracyOptions& options, AccuracyRun& run)
        : contexts_(options.backend, options.device),
          results_(options.out + "/accuracy.csv", options.fresh), run_(run) {
        run.device = contexts_.device();
    }

    void all() {
        uint32_t total = 0, done = 0;
        for (const Row& row : run_.rows)
            total += static_cast<uint32_t>(run_.methods.size() * cases(row));
        Progress progress("accuracy", std::max(1u, total));
        for (const Row& row : run_.rows)
            for (size_t c = 0; c < cases(row); ++c)
                for (const Method& method : run_.methods) {
                    if (!interrupted())
                        one(row, c, method);
                    progress.update(++done);
                }
        run_.interrupted = interrupted(); // also in the last of them
    }

  private:
    static size_t cases(const Row& row) { return row.spread ? 1 : row.variants.size(); }

    Result blank(const Row& row, size_t c, const Method& method) const {
        Result result;
        result.row = row.id;
        result.variant = row.spread ? all_variants : row.variants[c].name;
        result.model = method.model->label;
        result.setting = method.setting.label();
        result.device = run_.device.name;
        result.backend = run_.device.backend;
        result.driver = run_.device.driver;
        result.value = std::numeric_limits<double>::quiet_NaN();
        return result;
    }

    void one(const Row& row, size_t c, const Method& method) {
        Result result = blank(row, c, method);
        if (const std::string why = why_not(row, *method.model); !why.empty()) {
            result.verdict = "cannot";
            result.note = why;
            run_.results.push_back(result);
            return;
        }
        std::vector<RowScene> scenes;
        for (size_t v = 0; v < row.variants.size(); ++v)
            if (row.spread || v == c)
                scenes.push_back(scene_of(row, row.variants[v]));
        if (row.over)
            scenes.push_back(scene_of(row, *row.over));
        for (const RowScene& scene : scenes)
            result.fingerprint += scene.fingerprint.substr(0, row.spread ? 6 : 16);
        const Measure measure = row.spread ? spread_measure(row) : scenes[0].scene.measures[0];
        result.unit = row.spread ? "L" : row.over ? "" : metric_unit(measure.metric);
        if (const Result* known = results_.find(result.key())) {
            run_.results.push_back(*known);
            return;
        }
        const auto start = std::chrono::steady_clock::now();
        Value value;
        try {
            value = row.spread ? spread(scenes, method)
                    : row.over ? ratio(scenes[0], scenes[1], method)
                               : measured(scenes[0].scene, method);
        } catch (const Failure& failure) { // a result, too
            value = {std::numeric_limits<double>::quiet_NaN(), failure.what()};
        }
        if (interrupted())
            return;
        finish(result, measure, method, value);
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        result.seconds = spent.count();
        results_.add(result);
        run_.results.push_back(result);
    }

    static Measure spread_measure(const Row& row) {
        Measure measure = measure_of("rms_error"); // only its mark counts
        if (row.measure.contains("pass"))
            measure.pass[""] = row.measure["pass"].get<double>();
        return measure;
    }

    static void finish(Result& result, const Measure& measure, const Method& method,
                       const Value& value) {
        result.value = value.value;
        result.note = value.note;
        if (const double* mark = mark_of(measure, method))
            result.mark = *mark;
        const Verdict verdict = judge(measure, method, value);
        result.verdict = std::isnan(value.value) ? "FAILED" : verdict_word(verdict);
    }

    Value measured(const Scene& scene, const Method& method) {
        const Recording recording = record(contexts_, scene, method);
        if (recording.interrupted)
            return {};
        return evaluate(scene, method, recording, scene.measures[0]);
    }

    // Over what is measured in another scene, which is run once for all variants; less 1.
    Value ratio(const RowScene& scene, const RowScene& over, const Method& method) {
        const auto key = over.fingerprint + method.label();
        if (over_.count(key) == 0) {
            const Value value = measured(over.scene, method);
            if (interrupted())
                return {};
            over_[key] = value;
        }
        const Value& divisor = over_[key];
        if (std::isnan(divisor.value))
            return {divisor.value, divisor.note + ", nor where it is compared with"};
        const Value value = measured(scene.scene, method);
        return {value.value / divisor.value - 1, value.note};
    }

    // The largest distance between any two variants' shapes, in lengths.
    Value spread(const std::vector<RowScene>& scenes, const Method& method) {
        std::vector<std::vector<Vec3>> shapes;
        double worst = 0;
        for (const RowScene& variant : scenes) {
            const Recording recording = record(contexts_, variant.scene, method);
            if (recording.interrupted)
                return {};
            if (recording.nonfinite > 0)
                return {std::numeric_limits<double>::quiet_NaN(), "non-finite"};
            shapes.push_back(resampled(recording.frames.back().x[0]));
            for (const auto& other : shapes)
                worst = std::max(worst, distance(shapes.back(), other));
        }
        return {worst / scenes[0].scene.length(), ""};
    }

    Contexts contexts_;
    Results results_;
    AccuracyRun& run_;
    std::map<std::string, Value> over_; // by fingerprint and method
};

} // namespace

std::vector<const Model*> models_of(const std::vector<std::string>& labels, bool baselines) {
    check_known("--models", labels, model_labels());
    std::vector<const Model*> chosen;
    for (const Model& model : models())
        if (wanted(labels, model.label) && (!labels.empty() || !model.baseline() || baselines))
            chosen.push_back(&model);
    return chosen;
}

std::vector<Method> methods_of(const std::vector<std::string>& labels, bool baselines,
                               bool all_settings) {
    std::vector<Method> methods;
    for (const Model* model : models_of(labels, baselines)) {
        if (all_settings) {
            for (const Setting& setting : model->settings)
                methods.push_back({model, setting});
            continue;
        }
        methods.push_back({model, model->settings.front()});
        if (model->quality)
            methods.push_back({model, *model->quality});
    }
    return methods;
}

AccuracyRun run_accuracy(const AccuracyOptions& options) {
    AccuracyRun run{{},
                    choose(options),
                    methods_of(options.models, options.baselines, options.all_settings),
                    {},
                    false};
    Runner(options, run).all();
    return run;
}

namespace {

// The result of a method in a case, if it was reached.
const Result* find(const AccuracyRun& run, const Row& row, const std::string& variant,
                   const Method& method) {
    for (const Result& result : run.results)
        if (result.row == row.id && result.variant == variant &&
            result.model == method.model->label && result.setting == method.setting.label())
            return &result;
    return nullptr;
}

std::string mark_of(const AccuracyRun& run, const Row& row, const std::string& variant) {
    std::vector<std::string> marks;
    for (const Result& result : run.results)
        if (result.row == row.id && result.variant == variant && result.mark)
            if (const std::string mark = number(*result.mark);
                std::find(marks.begin(), marks.end(), mark) == marks.end())
                marks.push_back(mark);
    std::string text;
    for (const std::string& mark : marks)
        text += (text.empty() ? "" : "/") + mark;
    return text;
}

std::string cell_of(const Result* result) {
    if (!result)
        return "";
    if (result->verdict == "cannot")
        return "n/a";
    if (result->verdict == "FAILED")
        return "FAILED";
    return number(result->value) + (result->verdict == "MISS" ? " !" : "");
}

std::vector<std::string> names_of(const Row& row) {
    std::vector<std::string> names;
    if (row.spread)
        return {all_variants};
    for (const Variant& variant : row.variants)
        names.push_back(variant.name);
    return names;
}

std::string summary(const AccuracyRun& run) {
    size_t pass = 0, miss = 0, failed = 0, cannot = 0;
    for (const Result& result : run.results) {
        pass += result.verdict == "pass";
        miss += result.verdict == "MISS";
        failed += result.verdict == "FAILED";
        cannot += result.verdict == "cannot";
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "%zu pass, %zu miss their mark (!), %zu failed, %zu cannot be done (n/a)%s", pass,
                  miss, failed, cannot, run.interrupted ? "; interrupted" : "");
    return text;
}

// Why things are n/a or failed, each reason once.
std::vector<std::string> reasons(const AccuracyRun& run) {
    std::vector<std::string> lines;
    for (const Result& result : run.results) {
        if (result.note.empty())
            continue;
        const std::string line = "row " + result.row + ", " + result.model + ": " + result.note;
        if (std::find(lines.begin(), lines.end(), line) == lines.end())
            lines.push_back(line);
    }
    return lines;
}

std::string padded(const std::string& text, size_t width, bool right) {
    size_t shown = 0; // UTF-8: continuation bytes take no room
    for (const char c : text)
        shown += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    const std::string space(shown < width ? width - shown : 0, ' ');
    return right ? space + text : text + space;
}

} // namespace

std::string accuracy_text(const AccuracyRun& run) {
    std::string text = std::string("accuracy on ") + run.device.name + " (" + run.device.backend +
                       "), substeps x iterations of each model\n\n";
    text += padded("row", 4, false) + padded("", 54, false) + padded("mark", 15, true);
    for (const Method& method : run.methods)
        text += "  " + padded(method.label(), 14, true);
    text += "\n";
    for (const Row& row : run.rows) {
        bool first = true;
        for (const std::string& variant : names_of(row)) {
            const std::string title = first ? row.title : "";
            text += padded(first ? row.id : "", 4, false);
            text +=
                padded(title + (variant.empty() || variant == all_variants ? "" : "  " + variant),
                       54, false);
            text += padded(mark_of(run, row, variant), 15, true);
            for (const Method& method : run.methods)
                text += "  " + padded(cell_of(find(run, row, variant, method)), 14, true);
            text += "\n";
            first = false;
        }
    }
    text += "\n" + summary(run) + "\n";
    for (const std::string& reason : reasons(run))
        text += "  " + reason + "\n";
    return text;
}

std::string accuracy_markdown(const AccuracyRun& run) {
    std::string text = "| row | | unit | mark |";
    std::string rule = "|---|---|---|---:|";
    for (const Method& method : run.methods) {
        text += " " + method.label() + " |";
        rule += "---:|";
    }
    text += "\n" + rule + "\n";
    for (const Row& row : run.rows)
        for (const std::string& variant : names_of(row)) {
            std::string unit;
            for (const Method& method : run.methods)
                if (const Result* result = find(run, row, variant, method); result && unit.empty())
                    unit = result->unit;
            text += "| " + row.id + " | " + row.title +
                    (variant.empty() || variant == all_variants ? "" : ", " + variant) + " | " +
                    unit + " | " + mark_of(run, row, variant) + " |";
            for (const Method& method : run.methods) {
                const Result* result = find(run, row, variant, method);
                const bool bold = result && result->verdict == "pass";
                const std::string cell = cell_of(result);
                text += bold ? " **" + cell + "** |" : " " + cell + " |";
            }
            text += "\n";
        }
    text += "\n" + summary(run) + ".\n\n";
    for (const std::string& reason : reasons(run))
        text += "- " + reason + "\n";
    return text;
}

} // namespace lab
