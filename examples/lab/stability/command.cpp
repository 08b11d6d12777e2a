// plait-lab stability: where methods fail, as a map.
#include "../commands.hpp"
#include "../models.hpp"
#include "bad_input.hpp"
#include "rows.hpp"

#include "common/file.hpp"
#include "common/progress.hpp"

#include <cstdio>
#include <iostream>

namespace lab::stability {

namespace {

struct Options {
    std::vector<std::string> models{"tressfx", "chain", "cosserat", "rod"};
    std::string out = "out/stability";
    DeviceOptions device;
    bool full = false, fresh = false, json = false, csv = false, pictures = true;
};

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

Subject subject_of(const Model& model, const Setting& setting, Contexts& contexts) {
    return {model.label + " " + setting.label(),
            model.model,
            setting.substeps,
            setting.iterations,
            setting.bdf2,
            contexts.of(model)};
}

void add_map(std::vector<Work>& work, const Subject& subject, const Model& model,
             const Setting& setting, bool full) {
    const std::vector<double> none{limp};
    for (const double rate : rates(full))
        for (const uint32_t segments : segment_counts(full))
            for (const double gamma : subject.bends() ? gammas(full) : none)
                work.push_back({subject,
                                {"map", model.label, setting.label(), {rate, segments, gamma}, ""},
                                {}});
}

// Axes with the first setting only; long ones in full.
void add_axes(std::vector<Work>& work, const Subject& subject, const Model& model, bool full) {
    for (const AxisPoint& point : axis_points())
        if (full || !(point.axis == "substeps" && std::stoi(point.value) > 100))
            work.push_back(
                {subject,
                 {point.axis, model.label, model.settings[0].label(), Place{}, point.value},
                 point.trial});
}

std::vector<Work> plan(const Options& options, Contexts& contexts) {
    std::vector<Work> work;
    for (const std::string& label : options.models) {
        const Model* model = find_model(label);
        if (!model)
            throw Failure("no model is called \"" + label + "\", the nearest is \"" +
                          std::string(nearest(label, model_labels())) + "\"");
        for (const Setting& setting : model->settings) {
            if (!options.full && &setting != &model->settings[0])
                break;
            add_map(work, subject_of(*model, setting, contexts), *model, setting, options.full);
        }
        add_axes(work, subject_of(*model, model->settings[0], contexts), *model, options.full);
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

std::vector<Row> wanted(const std::vector<Work>& work, const Rows& rows) {
    std::map<std::string, bool> keys;
    for (const Work& one : work)
        keys[one.job.key()] = true;
    std::vector<Row> kept;
    for (const Row& row : rows.all())
        if (keys.count(row.job.key()))
            kept.push_back(row);
    return kept;
}

std::vector<std::pair<std::string, Verdict>> do_bad_inputs(const Options& options,
                                                           Contexts& contexts) {
    std::vector<std::pair<std::string, Verdict>> verdicts;
    for (const std::string& label : options.models) {
        const Model& model = *find_model(label);
        const Subject subject = subject_of(model, model.settings[0], contexts);
        for (const std::string& input : bad_inputs())
            if (!interrupted())
                verdicts.emplace_back(label, try_bad_input(subject, input));
    }
    return verdicts;
}

void print_verdicts(const std::vector<std::pair<std::string, Verdict>>& verdicts) {
    std::puts("\nbad input");
    for (const auto& [model, verdict] : verdicts)
        std::printf("  %-4s %-10s %-32s %s\n", verdict.passed ? "ok" : "FAIL", model.c_str(),
                    verdict.input.c_str(), verdict.what.c_str());
}

Json to_json(const std::vector<std::pair<std::string, Verdict>>& verdicts) {
    Json all = Json::array();
    for (const auto& [model, verdict] : verdicts)
        all.push_back({{"model", model},
                       {"input", verdict.input},
                       {"passed", verdict.passed},
                       {"what", verdict.what}});
    return all;
}

Exit sweep(const Options& options) {
    Contexts contexts(options.device.backend, options.device.device);
    const auto work = plan(options, contexts);
    const plait_device_info device = contexts.device();
    const std::string name = std::string(device.name) + " (" + device.backend + ")";
    const std::filesystem::path out = options.out;
    Rows rows(out / "stability.csv", name, options.fresh);
    do_all(work, rows);
    const std::vector<Row> found = wanted(work, rows);
    const auto verdicts = do_bad_inputs(options, contexts);
    const Json json{{"device", name}, {"trials", to_json(found)}, {"bad_input", to_json(verdicts)}};
    write_json(json, (out / "stability.json").string());
    if (options.pictures && !draw_maps(found, out))
        std::fprintf(stderr, "plait-lab: gnuplot has drawn no pictures; their scripts are in %s\n",
                     options.out.c_str());
    if (options.json) {
        std::cout << json.dump(2) << '\n';
    } else if (options.csv) {
        write_csv(std::cout, found);
    } else {
        std::printf("%s\n", name.c_str());
        print_map(found);
        print_axes(found);
        print_count(found);
        print_verdicts(verdicts);
    }
    return Exit::ok;
}

} // namespace

} // namespace lab::stability

namespace lab {

void add_stability(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<stability::Options>();
    CLI::App* command = app.add_subcommand("stability", "shake the models till they fail");
    command->add_option("--models", options->models, "labels [tressfx,chain,cosserat,rod]")
        ->delimiter(',');
    command->add_option("--out", options->out, "folder of what is found; a run goes on from there")
        ->capture_default_str();
    add_device_options(*command, options->device);
    command->add_flag("--full", options->full, "all rates, segments, gammas and settings: hours");
    command->add_flag("--fresh", options->fresh, "forget what an earlier run found");
    command->add_flag("--json", options->json, "print JSON instead of maps");
    command->add_flag("--csv", options->csv, "print CSV instead of maps");
    command->add_flag("!--no-pictures", options->pictures, "do not call gnuplot");
    command->callback(
        [options, &chosen] { chosen = [options] { return stability::sweep(*options); }; });
}

} // namespace lab
