// plait-lab chart: the figures.
#include "chart.hpp"
#include "commands.hpp"

#include <cstdio>

namespace lab {

namespace {

Exit run(ChartOptions options, const DeviceOptions& device) {
    options.device = device.device;
    options.backend = device.backend;
    const ChartRun done = run_charts(options);
    for (const Chart& chart : done.charts) {
        std::printf("%s\n", chart.family.title.c_str());
        for (const Dot& dot : front_of(figure_of(chart, done.device)))
            std::printf("  %-20s %10.3g L %10.4g ms\n", dot.name.c_str(), dot.error, dot.cost);
        for (const std::string& line : left_out_by_reason(chart.left_out))
            std::printf("  left out: %s\n", line.c_str());
    }
    for (const std::string& file : done.files)
        std::printf("wrote %s\n", file.c_str());
    return Exit::ok;
}

} // namespace

void add_chart(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<ChartOptions>();
    auto device = std::make_shared<DeviceOptions>();
    CLI::App* command = app.add_subcommand("chart", "cost against accuracy, drawn by gnuplot");
    command->add_option("--models", options->models, "only these")->delimiter(',');
    command->add_option("--families", options->families, "only these figures")->delimiter(',');
    command->add_option("--table", options->table, "the figures [assets/lab/charts.json]");
    command->add_option("--out", options->out, "folder of the figures and charts.csv")
        ->capture_default_str();
    command->add_flag("--fresh", options->fresh, "measure again what is there");
    add_cost_options(*command, options->costs);
    add_device_options(*command, *device);
    command->callback([options, device, &chosen] {
        chosen = [options, device] { return run(*options, *device); };
    });
}

} // namespace lab
