#include "levels.hpp"

#include "gnuplot.hpp"
#include "text.hpp"

#include "common/file.hpp"

#include <algorithm>
#include <cmath>

namespace lab::levels {

std::string levels_csv(const std::vector<LevelRow>& rows) {
    std::string csv = "style,guides,ms,of_whole";
    for (const size_t motion : shares)
        csv += text(",%s", level_motions()[motion].name);
    csv += ",all,median,listed\n";
    for (const LevelRow& row : rows) {
        csv += text("%s,%u,%.4g,%.4g", row.style.c_str(), row.guides, row.ms, row.of_whole);
        for (const size_t motion : shares)
            csv += text(",%.3g", row.found[motion].share());
        csv += text(",%.3g,%.3g,%.3g\n", row.all, row.median, double(row.listed));
    }
    return csv;
}

std::string levels_text(const std::vector<LevelRow>& rows) {
    std::string all = "style  guides  ms/frame  of all ";
    for (const size_t motion : shares)
        all += text("%7s", level_motions()[motion].name);
    all += "    all  median  listed\n";
    for (const LevelRow& row : rows) {
        all += text("%-6s %6u %9.2f %7.2f ", row.style.c_str(), row.guides, row.ms, row.of_whole);
        for (const size_t motion : shares)
            all += text("%7.2f", row.found[motion].share());
        all += text("%7.2f %7.2f %7.2f\n", row.all, row.median, double(row.listed));
    }
    return all + "of all: the cost over that of all strands simulated\n"
                 "shake, nod, gust, all: error over swing, rms; median: of strands; listed: what "
                 "plait_levels_list says\n";
}

namespace {

// A level's error over swing: what the library lists, or what it was in the lesson.
double taught_share(const LevelRow& row) {
    double squares = 0;
    for (const size_t motion : lesson)
        squares += std::pow(row.found[motion].share(), 2);
    return std::sqrt(squares / std::size(lesson));
}

template <typename Share>
Transfer transfer(const std::vector<LevelRow>& rows, const char* taught, double factor,
                  const Share& share) {
    constexpr double least = 2e-3; // m, of swing
    std::vector<double> ratios;
    for (const LevelRow& row : rows)
        for (size_t motion = 0; motion < row.found.size(); ++motion)
            if (std::ranges::find(lesson, motion) == std::end(lesson) &&
                row.found[motion].swing >= least)
                ratios.push_back(factor * share(row) * row.found[motion].own /
                                 row.found[motion].error);
    std::ranges::sort(ratios);
    const auto percent = [&](auto holds) {
        return 100 * static_cast<double>(std::ranges::count_if(ratios, holds)) /
               static_cast<double>(ratios.size());
    };
    double logs = 0;
    for (const double ratio : ratios)
        logs += std::log(ratio) / static_cast<double>(ratios.size());
    const auto at = [&](double part) {
        return ratios[static_cast<size_t>(part * static_cast<double>(ratios.size() - 1))];
    };
    return {taught,
            factor,
            ratios.size(),
            percent([](double r) { return r >= 0.5 && r <= 2; }),
            percent([](double r) { return r < 0.5; }),
            percent([](double r) { return r < 1.0 / 3; }),
            std::exp(logs),
            at(0.05),
            at(0.95)};
}

} // namespace

std::vector<Transfer> transfer_of(const std::vector<LevelRow>& rows) {
    std::vector<Transfer> all;
    for (const double factor : {1.0, 1.5}) {
        all.push_back(transfer(rows, "listed", factor,
                               [](const LevelRow& row) { return double(row.listed); }));
        all.push_back(transfer(rows, "lesson", factor, taught_share));
    }
    return all;
}

std::string transfer_text(const std::vector<Transfer>& rows) {
    std::string all = "share   factor  cases  within 2x  under 2x  under 3x   mean    5 %   95 %\n";
    for (const Transfer& row : rows)
        all += text("%-7s %6.1f %6zu %9.1f%% %8.1f%% %8.1f%% %6.2f %6.2f %6.2f\n", row.taught,
                    row.factor, row.cases, row.within_2, row.under_2, row.under_3, row.mean, row.p5,
                    row.p95);
    return all + "What a level is told to be wrong by, share x the swing of its own hair x factor, "
                 "over what it "
                 "is wrong by,\nin motions that are not of the lesson (shake, walk, gust)\n";
}

std::string transfer_csv(const std::vector<LevelRow>& rows) {
    std::string csv = "style,guides,motion,error,swing,own,listed,lesson\n";
    for (const LevelRow& row : rows)
        for (size_t motion = 0; motion < row.found.size(); ++motion) {
            const LevelRow::Found& found = row.found[motion];
            csv += text("%s,%u,\"%s\",%.4g,%.4g,%.4g,%.3g,%.3g\n", row.style.c_str(), row.guides,
                        level_motions()[motion].name, found.error, found.swing, found.own,
                        double(row.listed), taught_share(row));
        }
    return csv;
}

bool draw_levels(const std::vector<LevelRow>& rows, const LevelsOptions& options) {
    constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73"};
    const std::string path = options.out + "/levels";
    std::string points, plot;
    for (size_t k = 0; k < options.styles.size(); ++k) {
        points += text("$style%zu << EOD\n", k);
        for (const LevelRow& row : rows)
            if (row.style == options.styles[k] && row.ms > 0)
                points += text("%.4g %.4g %u\n", row.ms, row.all, row.guides);
        points += "EOD\n";
        const char* colour = colours[k % std::size(colours)];
        plot +=
            text("%s$style%zu using 1:2 with linespoints lw 2 pt 7 ps 0.7 lc rgb '%s' title "
                 "'%s', $style%zu using 1:2:3 with labels left offset 0.7,0.6 tc rgb '%s' notitle",
                 k ? ", " : "plot ", k, colour, options.styles[k].c_str(), k, colour);
    }
    plot += ", 1 with lines lw 2 dt 2 lc rgb '#777777' title 'hair that goes with the head'";
    const std::string lines =
        points +
        text("set title \"What a level of detail costs, and what it is wrong by\\n{/*0.8 %u hairs, "
             "numbers are guides; against all of them in four substeps}\"\n",
             options.strands) +
        "set xrange [0:*]\nset yrange [0:1.1]\n"
        "set xlabel 'ms a frame'\nset ylabel 'error over swing'\n"
        "set key bottom right noenhanced samplen 2\n";
    return draw_figure(path, figure_script(path, lines, plot, 800, 560));
}

} // namespace lab::levels
