// plait-lab features, and plait-lab all: the table, the figures, the features, stability, and a
// page of them.
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
    std::string out = "out/lab", write;
    bool fresh = false;
};

stability::SweepOptions stability_options(const Options& o) {
    stability::SweepOptions sweep;
    sweep.models.clear();
    for (const Model* model : models_of(o.accuracy.models, true))
        sweep.models.push_back(model->label);
    sweep.out = o.out;
    sweep.fresh = o.fresh;
    sweep.few_baselines = true;
    return sweep;
}

// One after the other, until somebody interrupts.
Page measure_all(const Options& o) {
    Page page;
    page.accuracy = run_accuracy(o.accuracy);
    std::cout << accuracy_text(page.accuracy) << std::endl;
    if (!interrupted())
        page.charts = run_charts(o.charts);
    for (const std::string& file : page.charts.files)
        std::printf("wrote %s\n", file.c_str());
    if (!interrupted()) {
        Contexts contexts(o.device.backend, o.device.device);
        page.grid = grid::run_grid(contexts, o.out, o.charts.costs);
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
    o.accuracy.out = o.charts.out = o.out;
    o.accuracy.fresh = o.charts.fresh = o.fresh;
    o.charts.models = o.accuracy.models;
    const Page page = measure_all(o);
    if (o.write.empty())
        return Exit::ok;
    if (interrupted())
        throw Failure(
            "interrupted: no page is written of half a run; the same command takes it up");
    for (const std::string& file : write_page(o.write, page, o.out))
        std::printf("wrote %s\n", file.c_str());
    return Exit::ok;
}

Exit run_features_command(FeatureOptions options, const DeviceOptions& device) {
    options.device = device.device;
    options.backend = device.backend;
    std::cout << features_text(run_features(options));
    return Exit::ok;
}

} // namespace

void add_features(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<FeatureOptions>();
    auto device = std::make_shared<DeviceOptions>();
    CLI::App* command = app.add_subcommand("features", "what each feature costs, and does");
    command->add_option("--features", options->features, "only these")->delimiter(',');
    command->add_option("--table", options->table, "the features [assets/lab/features.json]");
    add_cost_options(*command, options->costs);
    add_device_options(*command, *device);
    command->callback([options, device, &chosen] {
        chosen = [options, device] { return run_features_command(*options, *device); };
    });
}

void add_all(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("all", "accuracy, chart, features and stability");
    command->add_option("--models", options->accuracy.models, "only these")->delimiter(',');
    command->add_option("--out", options->out, "folder of the results, taken up again")
        ->capture_default_str();
    command->add_option("--write", options->write, "also write a page of results into this folder");
    command->add_flag("--fresh", options->fresh, "measure again what is there");
    add_cost_options(*command, options->charts.costs);
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run_all(*options); }; });
}

} // namespace lab
