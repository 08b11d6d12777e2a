// plait-lab features, and plait-lab all: the table, the figures, the features, and a page of them.
#include "commands.hpp"
#include "page.hpp"

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

Exit run_all(Options o) {
    o.accuracy.device = o.charts.device = o.features.device = o.device.device;
    o.accuracy.backend = o.charts.backend = o.features.backend = o.device.backend;
    o.accuracy.out = o.charts.out = o.out;
    o.accuracy.fresh = o.charts.fresh = o.fresh;
    o.charts.models = o.accuracy.models;
    const AccuracyRun accuracy = run_accuracy(o.accuracy);
    std::cout << accuracy_text(accuracy) << std::endl;
    const ChartRun charts = accuracy.interrupted ? ChartRun{} : run_charts(o.charts);
    const bool stop = accuracy.interrupted || charts.interrupted;
    const FeatureRun features = stop ? FeatureRun{} : run_features(o.features);
    std::cout << features_text(features);
    for (const std::string& file : charts.files)
        std::printf("wrote %s\n", file.c_str());
    if (o.write.empty())
        return Exit::ok;
    if (stop)
        throw Failure(
            "interrupted: no page is written of half a run; the same command takes it up");
    for (const std::string& file : write_page(o.write, accuracy, charts, features, o.out))
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
    CLI::App* command = app.add_subcommand("all", "accuracy, chart and features");
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
