// plait-lab chart: the figures.
#include "chart.hpp"
#include "commands.hpp"
#include "common/json_reader.hpp"

#include <cstdio>
#include <iostream>

namespace lab {

namespace {

using Options = TableCommand<ChartOptions>;

void print_tables(const ChartRun& done) {
    for (const Chart& chart : done.charts) {
        std::printf("%s\n", chart.family.title.c_str());
        for (const Dot& dot : front_of(figure_of(chart, done.device)))
            std::printf("  %-20s %10.3g L %10.4g ms\n", dot.name.c_str(), dot.error, dot.cost);
        for (const std::string& line : left_out_by_reason(chart.left_out))
            std::printf("  left out: %s\n", line.c_str());
    }
    for (const std::string& file : done.files)
        std::printf("wrote %s\n", file.c_str());
}

Exit run(const Options& options) {
    const ChartRun done = run_charts(options.on_device());
    if (options.print.json)
        std::cout << to_json(done).dump(2) << '\n';
    else if (options.print.csv)
        std::cout << charts_csv(done);
    else
        print_tables(done);
    return Exit::ok;
}

} // namespace

void add_chart(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("chart", "cost against accuracy, drawn by gnuplot");
    command->add_option("--families", options->run.families, "only these figures")->delimiter(',');
    command->add_option("--table", options->run.table, "the figures [assets/lab/charts.json]");
    add_table_options(*command, *options);
    add_cost_options(*command, options->run.costs);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
