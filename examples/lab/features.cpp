#include "features.hpp"

#include "metrics.hpp"
#include "report.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

namespace lab {

namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

Feature read_feature(JsonReader in, const std::filesystem::path& folder) {
    Feature feature;
    if (!in.text("feature", feature.name))
        in.fail("feature", "is missing: its name");
    if (!in.text("scene", feature.scene))
        in.fail("scene", "is missing: a file beside this one");
    feature.scene = (folder / feature.scene).string();
    if (const Json* with = in.value("with"))
        feature.with = *with;
    if (const Json* without = in.value("without"))
        feature.without = *without;
    in.finish();
    return feature;
}

// Of all vertices of all strands over the whole recording.
double difference(const Recording& a, const Recording& b, double length) {
    double sum = 0;
    size_t count = 0;
    for (size_t k = 0; k < std::min(a.frames.size(), b.frames.size()); ++k)
        for (size_t s = 0; s < a.frames[k].x.size(); ++s)
            for (size_t i = 1; i < a.frames[k].x[s].size(); ++i) {
                sum += (a.frames[k].x[s][i] - b.frames[k].x[s][i]).squaredNorm();
                ++count;
            }
    return count ? std::sqrt(sum / static_cast<double>(count)) / length : nan;
}

struct Half {
    Recording recording;
    double cost, error;
};

// Either half's error is from the whole scene's reference.
Half run_half(Contexts& contexts, const Feature& feature, const Json& overrides,
              const CostOptions& costs) {
    const Scene whole = read_scene(feature.scene, feature.with);
    const Scene scene = read_scene(feature.scene, overrides);
    const Method method = method_of(scene);
    Half half{record(contexts, scene, method), 0, nan};
    if (whole.reference)
        half.error = evaluate(whole, method, half.recording, measure_of("rms_error")).value;
    half.cost = measure_cost(contexts, contexts, scene, method, costs).ms_per_frame();
    return half;
}

std::string percent(double with, double without) {
    char text[32];
    std::snprintf(text, sizeof text, "%+.0f %%", 100 * (with / without - 1));
    return text;
}

} // namespace

std::vector<Feature> read_features(const std::string& file) {
    Origin origin{file, Json::object(), {}};
    const Json document = read_json(origin);
    JsonReader top(document, origin);
    const Json* list = top.value("features");
    if (!list || !list->is_array())
        top.fail("features", "is missing or no list");
    std::vector<Feature> features;
    for (size_t i = 0; i < list->size(); ++i)
        features.push_back(read_feature(top.element(*list, i, "features"),
                                        std::filesystem::path(file).parent_path()));
    top.finish();
    return features;
}

FeatureRun run_features(const FeatureOptions& options) {
    auto features = read_features(
        options.table.empty() ? std::string(PLAIT_LAB_SCENES) + "/features.json" : options.table);
    std::vector<std::string> known;
    for (const Feature& feature : features)
        known.push_back(feature.name);
    for (const std::string& name : options.features)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Failure("--features: \"" + name + "\" is none; the nearest is \"" +
                          std::string(nearest(name, known)) + "\"");
    Contexts contexts(options.backend, options.device);
    FeatureRun run{contexts.device(), {}};
    Progress progress("features", static_cast<uint32_t>(features.size()));
    uint32_t done = 0;
    for (const Feature& feature : features) {
        const bool chosen =
            options.features.empty() || std::find(options.features.begin(), options.features.end(),
                                                  feature.name) != options.features.end();
        if (interrupted())
            break;
        if (chosen) {
            const Scene scene = read_scene(feature.scene, feature.with);
            FeatureResult result;
            result.feature = feature.name;
            result.scene = scene.title;
            result.model = method_of(scene).label();
            try {
                const Half with = run_half(contexts, feature, feature.with, options.costs);
                const Half without = run_half(contexts, feature, feature.without, options.costs);
                result.cost_with = with.cost;
                result.cost_without = without.cost;
                result.error_with = with.error;
                result.error_without = without.error;
                result.moved = difference(with.recording, without.recording, scene.length());
            } catch (const Failure& failure) { // a result, too
                result.note = failure.what();
                result.cost_with = result.cost_without = result.moved = nan;
                result.error_with = result.error_without = nan;
            }
            run.results.push_back(result);
        }
        progress.update(++done);
    }
    return run;
}

std::string features_text(const FeatureRun& run) {
    char line[400];
    std::snprintf(line, sizeof line, "%-26s %-30s %-20s %9s %9s %7s %9s %10s %10s\n", "feature",
                  "scene", "method", "ms with", "without", "cost", "moves", "error with",
                  "without");
    std::string text = line;
    for (const FeatureResult& r : run.results) {
        std::snprintf(line, sizeof line, "%-26s %-30s %-20s %9.4g %9.4g %7s %9s %10s %10s %s\n",
                      r.feature.c_str(), r.scene.c_str(), r.model.c_str(), r.cost_with,
                      r.cost_without, percent(r.cost_with, r.cost_without).c_str(),
                      number(r.moved).c_str(), number(r.error_with).c_str(),
                      number(r.error_without).c_str(), r.note.c_str());
        text += line;
    }
    return text + "ms per 1/60 s and million vertices; moves: rms / L between with and without; "
                  "errors: rms / L from the scene's reference\n";
}

std::string features_markdown(const FeatureRun& run) {
    std::string text =
        "| feature | scene | method | ms with | ms without | cost | moves, rms/L | "
        "error with | error without |\n|---|---|---|---:|---:|---:|---:|---:|---:|\n";
    for (const FeatureResult& r : run.results)
        text += "| " + r.feature + " | " + r.scene + " | " + r.model + " | " + number(r.cost_with) +
                " | " + number(r.cost_without) + " | " + percent(r.cost_with, r.cost_without) +
                " | " + number(r.moved) + " | " + number(r.error_with) + " | " +
                number(r.error_without) + " |" + (r.note.empty() ? "" : " " + r.note) + "\n";
    return text;
}

} // namespace lab
