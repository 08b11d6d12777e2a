#include "levels.hpp"

#include "gnuplot.hpp"
#include "text.hpp"

#include "common/file.hpp"

namespace lab::levels {

std::string levels_csv(const std::vector<LevelRow>& rows) {
    std::string csv = "style,guides,ms,of_whole";
    for (const char* motion : motion_names)
        csv += text(",%s", motion);
    csv += ",all,median,listed\n";
    for (const LevelRow& row : rows) {
        csv += text("%s,%u,%.4g,%.4g", row.style.c_str(), row.guides, row.ms, row.of_whole);
        for (const double share : row.share)
            csv += text(",%.3g", share);
        csv += text(",%.3g,%.3g,%.3g\n", row.all, row.median, double(row.listed));
    }
    return csv;
}

std::string levels_text(const std::vector<LevelRow>& rows) {
    std::string all = "style  guides  ms/frame  of all ";
    for (const char* motion : motion_names)
        all += text("%7s", motion);
    all += "    all  median  listed\n";
    for (const LevelRow& row : rows) {
        all += text("%-6s %6u %9.2f %7.2f ", row.style.c_str(), row.guides, row.ms, row.of_whole);
        for (const double share : row.share)
            all += text("%7.2f", share);
        all += text("%7.2f %7.2f %7.2f\n", row.all, row.median, double(row.listed));
    }
    return all + "of all: the cost over that of all strands simulated\n"
                 "shake, nod, gust, all: error over swing, rms; median: of strands; listed: what "
                 "plait_levels_list says\n";
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
