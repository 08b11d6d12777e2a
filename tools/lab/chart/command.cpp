// plait-lab chart: the figures.
#include "command.hpp"
#include "chart.hpp"

#include <cstdio>
#include <iostream>

namespace lab {

namespace {

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

} // namespace

Exit run(const Command<ChartOptions>& command) {
    const ChartRun done = run_charts(command.on_device());
    if (command.print.json)
        std::cout << charts_json(done);
    else if (command.print.csv)
        std::cout << charts_csv(done);
    else
        print_tables(done);
    return Exit::ok;
}

} // namespace lab
