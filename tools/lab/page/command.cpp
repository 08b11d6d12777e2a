// plait-lab all: the table, the figures, the features, stability, and a page of them.
#include "commands.hpp"
#include "page.hpp"

#include "common/progress.hpp"

#include <cstdio>
#include <iostream>

namespace lab {

namespace {

struct Options {
    AccuracyOptions accuracy;
    ChartOptions charts;
    FeatureOptions features;
    DeviceOptions device;
    Choice choice;
    std::string write;
};

stability::SweepOptions stability_options(const Options& o) {
    stability::SweepOptions sweep;
    sweep.models.clear();
    for (const Model* model : models_of(o.choice.models, true))
        sweep.models.push_back(model->label);
    sweep.out = o.choice.out;
    sweep.fresh = o.choice.fresh;
    sweep.few_baselines = true;
    return sweep;
}

// Of each kind the cheapest, a minute or two. None where models are named.
AccuracyRun run_baselines(const Options& o) {
    if (!o.choice.models.empty())
        return {};
    AccuracyOptions options = o.accuracy;
    options.models = {"pbd", "xpbd", "xpbd_heavy", "verlet_limp", "verlet"};
    return run_accuracy(options);
}

// One after the other, until somebody interrupts.
Page measure_all(const Options& o) {
    Page page;
    page.accuracy = run_accuracy(o.accuracy);
    std::cout << accuracy_text(page.accuracy) << std::endl;
    if (!interrupted())
        page.baselines = run_baselines(o);
    if (!page.baselines.methods.empty())
        std::cout << accuracy_text(page.baselines) << std::endl;
    if (!interrupted())
        page.charts = run_charts(o.charts);
    for (const std::string& file : page.charts.files)
        std::printf("wrote %s\n", file.c_str());
    if (!interrupted()) {
        Contexts contexts(o.device.backend, o.device.device);
        page.grid = grid::run_grid(contexts, o.choice.out, o.charts.costs);
        std::cout << grid::rows_text(page.grid.rows);
    }
    if (!interrupted())
        page.features = run_features(o.features);
    std::cout << features_text(page.features);
    if (!interrupted()) {
        const auto options = stability_options(o);
        Contexts contexts(o.device.backend, o.device.device);
        page.stability = sweep(options, contexts);
        page.places = grid_of(options);
        page.bad_input = try_bad_inputs(options, contexts);
        print_count(page.stability.rows);
    }
    return page;
}

Exit run_all(Options o) {
    o.accuracy.device = o.charts.device = o.features.device = o.device.device;
    o.accuracy.backend = o.charts.backend = o.features.backend = o.device.backend;
    for (Choice* choice : {static_cast<Choice*>(&o.accuracy), static_cast<Choice*>(&o.charts),
                           static_cast<Choice*>(&o.features)})
        *choice = o.choice;
    const Page page = measure_all(o);
    if (o.write.empty())
        return Exit::ok;
    if (interrupted())
        throw Failure("interrupted: no page is written of half a run; the same command takes it up",
                      ended());
    for (const std::string& file : write_page(o.write, page, o.choice.out))
        std::printf("wrote %s\n", file.c_str());
    return Exit::ok;
}

} // namespace

void add_all(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("all", "accuracy, chart, features and stability");
    add_choice(*command, options->choice);
    command->add_option("--write", options->write, "also write a page of results into this folder");
    add_cost_options(*command, options->charts.costs);
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run_all(*options); }; });
}

} // namespace lab
