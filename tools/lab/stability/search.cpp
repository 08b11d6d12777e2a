#include "search.hpp"

#include "choice.hpp"
#include "common/json_reader.hpp"
#include "methods/settings.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lab::stability {

namespace {

const std::vector<double>& rates(bool full) {
    static const std::vector<double> few{30, 60, 240}, all{30, 60, 144, 240};
    return full ? all : few;
}

const std::vector<uint32_t>& segment_counts(bool full) {
    static const std::vector<uint32_t> few{2, 16, 64}, all{2, 3, 8, 16, 32, 64, 128, 255};
    return full ? all : few;
}

// Of models that bend; the others have none.
const std::vector<double>& gammas(bool full) {
    static const std::vector<double> few{1e-1, 10, 1e3, limp},
        all{1e-3, 1e-2, 1e-1, 1, 10, 100, 1e3, 1e4, 1e5, limp};
    return full ? all : few;
}

struct Work {
    Subject subject;
    Job job;
    std::function<Trial(const Subject&)> axis; // empty: the map
};

// As lab::stiffest, of the sweep's strands: the library's own stretch stiffness, 1 % at 10 g.
double stiffest_of(const Place& place) {
    const double unit = std::sqrt(gravity / length), n = place.segments;
    return unit * std::max(2 * std::sqrt(1000.0) * n, 4 * n * n / std::sqrt(place.gamma));
}

// Of explicit baselines with as many substeps as they need at the place.
Subject subject_of(const Model& model, const Setting& setting, const Place& place,
                   Contexts& contexts) {
    const bool own = setting.substeps == 0;
    const double w = own ? stiffest_of(place) : 0;
    return {model.label + " " + setting.label(),
            model.model,
            own ? substeps_of(model, place.rate, w) : setting.substeps,
            setting.iterations,
            setting.bdf2,
            contexts.of(model),
            !model.bends};
}

void add_map(std::vector<Work>& work, const Model& model, const Setting& setting,
             Contexts& contexts, const SweepOptions& options) {
    const std::vector<double> none{limp};
    const bool bends = subject_of(model, setting, Place{}, contexts).bends();
    const bool full = options.full;
    for (const double rate :
         model.baseline() && options.few_baselines ? std::vector<double>{60} : rates(full))
        for (const uint32_t segments : segment_counts(full))
            for (const double gamma : bends ? gammas(full) : none) {
                const Place place{rate, segments, gamma};
                work.push_back({subject_of(model, setting, place, contexts),
                                {"map", model.label, setting.label(), place, ""},
                                {}});
            }
}

// "collider speed (m/s)" -> "collider_speed"
std::string scene_of(const std::string& axis) {
    std::string name = axis.substr(0, axis.find(" ("));
    std::ranges::replace(name, ' ', '_');
    return name;
}

// Long ones in full.
void add_axes(std::vector<Work>& work, const Model& model, const Setting& setting,
              Contexts& contexts, const SweepOptions& options) {
    const Subject subject = subject_of(model, setting, Place{}, contexts);
    for (const AxisPoint& point : axis_points())
        if (wanted(options.scenes, scene_of(point.axis)) && (model.pins || !point.pins) &&
            (options.full || !(point.axis == "substeps" && std::stoi(point.value) > 100)))
            work.push_back({subject,
                            {point.axis, model.label, setting.label(), Place{}, point.value},
                            point.trial});
}

// For real time and for quality; of baselines the first.
std::vector<Setting> settings_of(const Model& model, bool full) {
    if (full)
        return model.settings;
    std::vector<Setting> settings{model.settings[0]};
    if (model.quality)
        settings.push_back(*model.quality);
    return settings;
}

std::vector<Work> plan(const SweepOptions& options, Contexts& contexts) {
    check_known("--scenes", options.scenes, scene_names());
    std::vector<Work> work;
    for (const std::string& label : options.models) {
        const Model* model = find_model(label);
        if (!model)
            throw Failure("no model is called \"" + label + "\", the nearest is \"" +
                          std::string(nearest(label, model_labels())) + "\"");
        for (const Setting& setting : settings_of(*model, options.full)) {
            if (wanted(options.scenes, "map"))
                add_map(work, *model, setting, contexts, options);
            if (!(model->baseline() && options.few_baselines))
                add_axes(work, *model, setting, contexts, options);
        }
    }
    return work;
}

std::vector<Row> rows_of(const Work& work) {
    std::vector<Row> rows;
    if (work.axis) {
        const auto each = run(work.subject.context, work.axis(work.subject));
        return {{work.job, work.job.value, worst(each[0], each[1])}};
    }
    const auto outcomes = try_place(work.subject, work.job.place);
    for (size_t i = 0; i < outcomes.size(); ++i)
        rows.push_back({work.job, shakes()[i].label, outcomes[i]});
    return rows;
}

void do_all(const std::vector<Work>& work, Rows& rows) {
    Progress progress("stability", static_cast<uint32_t>(work.size()));
    uint32_t done = 0, fresh = 0;
    for (const Work& one : work) {
        if (interrupted())
            return;
        ++done;
        if (rows.has(one.job))
            continue;
        rows.add(rows_of(one));
        ++fresh;
        progress.update(done);
    }
}

std::vector<Row> rows_of(const std::vector<Work>& work, const Rows& rows) {
    std::map<std::string, bool> keys;
    for (const Work& one : work)
        keys[one.job.key()] = true;
    std::vector<Row> kept;
    for (const Row& row : rows.all())
        if (keys.count(row.job.key()))
            kept.push_back(row);
    return kept;
}

} // namespace

std::string grid_of(const SweepOptions& options) {
    const auto list = [](const auto& values) {
        std::string text;
        for (const auto& value : values)
            text += (text.empty() ? "" : ", ") + text_of(static_cast<double>(value));
        return text;
    };
    return list(rates(options.full)) + " Hz; N " + list(segment_counts(options.full)) + "; Γ " +
           list(gammas(options.full));
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names{"map"};
    for (const AxisPoint& point : axis_points())
        if (const std::string name = scene_of(point.axis); name != names.back())
            names.push_back(name);
    names.push_back("bad_input");
    return names;
}

Verdicts try_bad_inputs(const SweepOptions& options, Contexts& contexts) {
    Verdicts verdicts;
    if (!wanted(options.scenes, "bad_input"))
        return verdicts;
    for (const std::string& label : options.models) {
        const Model& model = *find_model(label);
        if (model.baseline() && options.few_baselines)
            continue;
        const Subject subject = subject_of(model, model.settings[0], Place{}, contexts);
        for (const std::string& input : bad_inputs())
            if (!interrupted())
                verdicts.emplace_back(label, try_bad_input(subject, input));
    }
    return verdicts;
}

std::string verdicts_markdown(const Verdicts& verdicts) {
    std::vector<std::string> models;
    for (const auto& [model, verdict] : verdicts)
        if (std::ranges::find(models, model) == models.end())
            models.push_back(model);
    std::string text = "| input |", rule = "\n|---|";
    for (const std::string& model : models) {
        text += " " + model + " |";
        rule += "---|";
    }
    text += rule;
    for (const std::string& input : bad_inputs()) {
        text += "\n| " + input + " |";
        for (const auto& [model, verdict] : verdicts)
            if (verdict.input == input)
                text += verdict.passed ? " borne |" : " **" + verdict.what + "** |";
    }
    return text + "\n";
}

Sweep sweep(const SweepOptions& options, Contexts& contexts) {
    const auto work = plan(options, contexts);
    const plait_device_info device = contexts.device();
    Sweep done{std::string(device.name) + " (" + device.backend + ")", {}, false};
    const std::filesystem::path out = options.out;
    Rows rows(out / "stability.csv", done.device, options.fresh);
    do_all(work, rows);
    done.interrupted = interrupted();
    done.rows = rows_of(work, rows);
    if (options.pictures && !draw_maps(done.rows, out))
        std::fprintf(stderr, "plait-lab: gnuplot has drawn no pictures; their scripts are in %s\n",
                     options.out.c_str());
    return done;
}

} // namespace lab::stability
