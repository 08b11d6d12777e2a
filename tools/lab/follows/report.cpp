#include "follows.hpp"

#include "gnuplot.hpp"
#include "text.hpp"

#include "common/file.hpp"

#include <iterator>

namespace lab::follows {

namespace {

const char* name_of(Weights weights) {
    switch (weights) {
    case Weights::near:
        return "near";
    case Weights::learnt:
        return "learnt";
    case Weights::none:
        return "all";
    }
    return "";
}

} // namespace

std::string follows_csv(const std::vector<FollowRow>& rows) {
    std::string csv = "guides,weights,ms,of_whole,away_m,away_most_m,length,kink_deg,tip_step,"
                      "beside\n";
    for (const FollowRow& row : rows)
        csv += text("%u,%s,%.4g,%.4g,%.4g,%.4g,%.3g,%.4g,%.3g,%.3g\n", row.guides,
                    name_of(row.weights), row.wall, row.of_whole, row.away, row.away_most,
                    row.length, row.kink, row.step, row.beside);
    return csv;
}

std::string follows_text(const std::vector<FollowRow>& rows) {
    std::string all = "guides  weights  ms/frame  of all  from all, mm   worst  length error  "
                      "kink, deg  tip step  neighbours\n";
    for (const FollowRow& row : rows)
        all += text("%6u  %-7s %9.2f %7.2f %13.1f %7.0f %13.1e %10.1f %9.2f %11.2f\n", row.guides,
                    name_of(row.weights), row.wall, row.of_whole, 1e3 * row.away,
                    1e3 * row.away_most, row.length, row.kink, row.step, row.beside);
    return all +
           "weights: of the nearest roots, or learnt; of all: the cost over that of all strands "
           "simulated\n"
           "from all: rms distance from where all are simulated\n"
           "tip step: of follows over the guides'; neighbours: least of 99 % of their distances, "
           "over that at rest\n";
}

std::string follows_curves(const std::vector<FollowRow>& rows) {
    std::string csv = "seconds";
    for (const FollowRow& row : rows)
        csv += text(",%u_%s", row.guides, name_of(row.weights));
    csv += '\n';
    for (size_t frame = 0; frame < rows[0].curve.size(); ++frame) {
        csv += text("%.5g", static_cast<double>(frame + 1) / rate);
        for (const FollowRow& row : rows)
            csv += text(",%.5g", row.curve[frame]);
        csv += '\n';
    }
    return csv;
}

namespace {

// Of a number of guides.
const char* colour_of(size_t choice) {
    constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"};
    return colours[choice % std::size(colours)];
}

const char* line_of(Weights weights) {
    return weights == Weights::near ? "dt 2 lw 2" : "dt 1 lw 2.5";
}

std::string points_of(const std::vector<FollowRow>& rows, Weights weights) {
    std::string block = text("$%s << EOD\n", name_of(weights));
    for (const FollowRow& row : rows)
        if (row.weights == weights)
            block += text("%u %.4g\n", row.guides, 1e3 * row.away);
    return block + "EOD\n";
}

// Distance over the number of guides.
std::string guides_plot(bool learnt) {
    std::string plot = text("set logscale x 2\nset offsets graph 0.1, graph 0.1\n"
                            "set xlabel 'guides'\nset ylabel 'rms distance, mm'\n"
                            "plot $near with linespoints %s pt 7 ps 0.6 lc rgb '#333333' "
                            "title 'weights of the nearest roots'",
                            line_of(Weights::near));
    if (learnt)
        plot += text(", $learnt with linespoints %s pt 7 ps 0.6 lc rgb '#333333' "
                     "title 'weights learnt from other motion'",
                     line_of(Weights::learnt));
    return plot + "\nunset logscale x\nunset offsets\n";
}

// Distance over time, the rows' curves.
std::string time_plot(const std::vector<FollowRow>& rows, const std::string& path) {
    std::string plot = "set xlabel 'time, s'\nset ylabel ''\nset datafile separator ','\nplot ";
    size_t choice = 0;
    for (size_t i = 0; i + 1 < rows.size(); ++i) {
        choice += i > 0 && rows[i].guides != rows[i - 1].guides ? 1 : 0;
        const bool last = rows[i].guides != rows[i + 1].guides;
        plot +=
            text("%s'%s_curves.csv' using 1:(1e3*$%zu) with lines %s lc rgb '%s' ", i ? ", " : "",
                 path.c_str(), i + 2, line_of(rows[i].weights), colour_of(choice)) +
            (last ? text("title '%u guides'", rows[i].guides) : "notitle");
    }
    return plot + "\nset datafile separator whitespace\n";
}

std::string script_of(const std::vector<FollowRow>& rows, const FollowOptions& options,
                      const std::string& path) {
    const bool learnt = rows.size() > 1 && rows[1].weights == Weights::learnt;
    const std::string panels =
        text("set multiplot layout 1,2 title \"How far hair that follows guides is from where all "
             "of it is simulated\\n{/*0.8 %u hairs of the style %s, on a head that turns and "
             "nods}\"\n",
             options.strands, options.style.c_str()) +
        guides_plot(learnt) + time_plot(rows, path) + "unset multiplot";
    const std::string lines = points_of(rows, Weights::near) + points_of(rows, Weights::learnt) +
                              "set yrange [0:*]\n"
                              "set key bottom right Left reverse noenhanced samplen 2\n";
    return figure_script(path, lines, panels, 1000, 560);
}

} // namespace

bool draw_follows(const std::vector<FollowRow>& rows, const FollowOptions& options) {
    const std::string path = options.out + "/follows";
    return draw_figure(path, script_of(rows, options, path));
}

} // namespace lab::follows
