#include "chart.hpp"

#include "hash.hpp"
#include "metrics/metrics.hpp"
#include "references/continuum.hpp"

#include "common/file.hpp"
#include "common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>

namespace lab {

namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

constexpr const char* every_model = "models"; // of the library, in each of its settings

// "rod 4x2 BDF2", or "verlet auto": with as many substeps as it needs.
Method read_method(JsonReader& in, const Json& text) {
    const std::string method = text.is_string() ? text.get<std::string>() : text.dump();
    std::istringstream words(method);
    std::string model, setting, scheme;
    words >> model >> setting >> scheme;
    const Model* known = find_model(model);
    Setting s{0, 1, scheme == "BDF2"};
    const bool fine = (setting == "auto" && known && known->longest_step) ||
                      std::sscanf(setting.c_str(), "%ux%u", &s.substeps, &s.iterations) == 2;
    if (!known || !fine || (!scheme.empty() && !s.bdf2))
        in.fail("methods", "has \"" + method + "\", which is none like \"rod 4x2 BDF2\"");
    return {known, s};
}

std::vector<uint32_t> read_segments(JsonReader& in, const Json& list) {
    const auto has_places = [](const Json& n) {
        return n.is_number_unsigned() && n > 0 && n < 256 && n.get<uint32_t>() % places == 0;
    };
    if (!list.is_array() || !std::all_of(list.begin(), list.end(), has_places))
        in.fail("segments", "is " + list.dump() + ", not a list of multiples of " +
                                std::to_string(places) + " below 256");
    return list.get<std::vector<uint32_t>>();
}

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

// A list of methods, or the name of one of the table's lists.
std::vector<Method> read_methods(JsonReader& in, const Json& given, const Json& lists) {
    const Json* list = &given;
    if (given.is_string()) {
        const auto named = lists.find(given.get<std::string>());
        if (named == lists.end())
            in.fail("methods", "is " + given.dump() + ", none of the lists that are named above");
        list = &*named;
    }
    if (!list->is_array())
        in.fail("methods", "is " + list->dump() + ", not a list");
    std::vector<Method> methods;
    for (const Json& text : *list) {
        if (text != every_model) {
            methods.push_back(read_method(in, text));
            continue;
        }
        const auto all = methods_of({}, false, true);
        methods.insert(methods.end(), all.begin(), all.end());
    }
    return methods;
}

Family read_family(JsonReader in, const std::filesystem::path& folder, const Json& lists) {
    Family family;
    if (!in.text("name", family.name))
        in.fail("name", "is missing: of the files it makes");
    in.text("title", family.title);
    if (!in.text("scene", family.scene))
        in.fail("scene", "is missing: a file beside this one");
    family.scene = (folder / family.scene).string();
    if (const Json* set = in.value("set"))
        family.overrides = *set;
    if (const Json* needs = in.value("needs"))
        family.needs = needs->get<std::vector<std::string>>();
    if (const Json* segments = in.value("segments"))
        family.segments = read_segments(in, *segments);
    if (const Json* methods = in.value("methods"))
        family.methods = read_methods(in, *methods, lists);
    if (in.text("metric", family.metric) && !is_metric(family.metric))
        in.fail("metric", "is \"" + family.metric + "\", none of " + metric_list());
    in.finish();
    return family;
}

// Upper edges of figures: an error of a whole length is off the scale, and of five swings.
constexpr double length_top = 2, swing_top = 10;

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

std::vector<Family> read_families(const std::string& file) {
    Origin origin{file, Json::object(), {}};
    const Json document = read_json(origin);
    JsonReader top(document, origin);
    std::vector<Family> families;
    const Json* list = top.value("charts");
    if (!list || !list->is_array())
        top.fail("charts", "is missing or no list");
    const Json* named = top.value("methods");
    if (named && !named->is_object())
        top.fail("methods", "is " + named->dump() + ", not lists by their names");
    const Json lists = named ? *named : Json::object();
    for (size_t i = 0; i < list->size(); ++i)
        families.push_back(read_family(top.element(*list, i, "charts"),
                                       std::filesystem::path(file).parent_path(), lists));
    top.finish();
    return families;
}

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

namespace {

// Okabe and Ito's colours: told apart by everyone, and in grey.
const char* colour_of(const std::string& model, size_t index) {
    if (model == "tressfx")
        return "#D55E00";
    if (model == "chain")
        return "#0072B2";
    if (model == "cosserat")
        return "#009E73";
    if (model == "rod")
        return "#8E3B8F";
    if (model == "articulated")
        return "#CC0033";
    constexpr const char* others[] = {"#7F7F7F", "#E69F00", "#56B4E9",
                                      "#A0522D", "#4D4D4D", "#B8A000"};
    return others[index % std::size(others)];
}

// "4×2", "4×2 b" with BDF2, and "32: 4×2" where the number of segments is free.
Dot dot_of(const ChartPoint& point, bool free) {
    const Setting& s = point.method.setting;
    const std::string segments = std::to_string(point.segments);
    return {free ? point.ms_per_100k_strands() : point.cost.ms_per_frame(),
            point.error,
            point.method.label() + (free ? ", N " + segments : ""),
            (free ? segments + ": " : "") + std::to_string(s.substeps) + "×" +
                std::to_string(s.iterations) + (s.bdf2 ? " b" : ""),
            point.letter,
            point.method.model->baseline()};
}

void of_swing(Figure& figure) {
    figure.error_axis = "error / swing, median of the strands";
    figure.floor_label = "hair that stands still";
    figure.bands = false;
    figure.top = swing_top;
}

void of_free_segments(Figure& figure) {
    figure.error_axis = "E_{total}, rms / L";
    figure.cost_axis = "ms per 1/60 s of simulated time and 100,000 strands";
    figure.strands = 1e3 / 60 * 1e5;
    figure.floor_label = "error of the reference";
    figure.band_label = "indistinguishable";
    figure.own_fronts = true;
}

} // namespace

double ChartPoint::ms_per_100k_strands() const {
    return 0.1 * cost.ms_per_frame() * (segments + 1);
}

Figure figure_of(const Chart& chart, const plait_device_info& device) {
    Figure figure;
    figure.name = chart.family.name;
    figure.title = chart.family.title;
    figure.subtitle = std::string(device.name) + ", " + device.backend;
    if (counts_over_swing(chart.family.metric))
        of_swing(figure);
    if (chart.family.free())
        of_free_segments(figure);
    else if (!chart.points.empty())
        figure.strands = 1e3 / 60 * 1e6 / (chart.points[0].segments + 1);
    figure.floor = chart.floor;
    figure.left_out = chart.left_out;
    size_t baselines = 0;
    for (const ChartPoint& point : chart.points) {
        const Model& model = *point.method.model;
        const std::string name = model.label + (model.baseline() ? " (baseline)" : "");
        if (figure.series.empty() || figure.series.back().name != name) {
            figure.series.push_back(
                {name, colour_of(model.label, baselines), model.baseline(), {}});
            baselines += model.baseline();
        }
        figure.series.back().dots.push_back(dot_of(point, chart.family.free()));
    }
    return figure;
}

namespace {

constexpr const char* csv_head =
    "model,baseline,segments,substeps,iterations,bdf2,error,class,"
    "ms_per_frame_per_million,ms_per_frame_per_100k_strands,kernel_ns_per_vertex,"
    "strands_at_60_hz,floor,vertices,steps,metric\n";

std::string csv_line(const Chart& chart, const ChartPoint& p) {
    char line[384];
    const Setting& s = p.method.setting;
    std::snprintf(
        line, sizeof line, "%s,%d,%u,%u,%u,%d,%.6g,%c,%.6g,%.6g,%.6g,%.6g,%.6g,%llu,%u,%s\n",
        p.method.model->label.c_str(), p.method.model->baseline(), p.segments, s.substeps,
        s.iterations, s.bdf2, p.error, p.letter ? p.letter : '.', p.cost.ms_per_frame(),
        p.ms_per_100k_strands(), 1e9 * p.cost.kernel / static_cast<double>(p.cost.vertices),
        p.cost.strands_at_60_hz(p.segments + 1), chart.floor,
        static_cast<unsigned long long>(p.cost.vertices), p.cost.runs, chart.family.metric.c_str());
    return line;
}

Json to_json(const ChartPoint& p) {
    return {{"model", p.method.model->label},
            {"baseline", p.method.model->baseline()},
            {"segments", p.segments},
            {"substeps", p.method.setting.substeps},
            {"iterations", p.method.setting.iterations},
            {"bdf2", p.method.setting.bdf2},
            {"error", p.error}, // null when it is no number
            {"class", std::string(1, p.letter ? p.letter : '.')},
            {"ms_per_frame_per_million", p.cost.ms_per_frame()},
            {"ms_per_frame_per_100k_strands", p.ms_per_100k_strands()},
            {"vertices", p.cost.vertices},
            {"steps", p.cost.runs}};
}

} // namespace

std::string chart_csv(const Chart& chart, const plait_device_info& device) {
    std::string text =
        "# " + chart.family.title + "; " + device.name + "; driver " + device.driver + "\n";
    text += csv_head;
    for (const ChartPoint& point : chart.points)
        text += csv_line(chart, point);
    return text;
}

std::string charts_csv(const ChartRun& run) {
    std::string text = std::string("figure,") + csv_head;
    for (const Chart& chart : run.charts)
        for (const ChartPoint& point : chart.points)
            text += chart.family.name + "," + csv_line(chart, point);
    return text;
}

Json to_json(const ChartRun& run) {
    Json figures = Json::array();
    for (const Chart& chart : run.charts) {
        Json points = Json::array();
        for (const ChartPoint& point : chart.points)
            points.push_back(to_json(point));
        figures.push_back({{"figure", chart.family.name},
                           {"title", chart.family.title},
                           {"metric", chart.family.metric},
                           {"floor", chart.floor},
                           {"points", points},
                           {"left_out", chart.left_out}});
    }
    return {{"device", run.device.name},
            {"backend", run.device.backend},
            {"driver", run.device.driver},
            {"figures", figures}};
}

} // namespace lab
