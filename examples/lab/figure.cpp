#include "figure.hpp"

#include "common.hpp"

#include "common/file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lab {

namespace {

constexpr double top = 2; // the upper edge, where failures are put

template <typename... Values> std::string text(const char* pattern, Values... values) {
    char line[1024];
    std::snprintf(line, sizeof line, pattern, values...);
    return line;
}

struct Range {
    double least = 1e300, most = 0;
    void take(double value) {
        if (value > 0 && std::isfinite(value)) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
};

// 1, 3, 10, 30, ... thousands of strands along the upper edge.
std::string strand_tics(const Range& x, double at_1) {
    std::string tics;
    for (double decade = 1; decade < 1e10; decade *= 10)
        for (const double strands : {decade, 3 * decade}) {
            const double at = at_1 / strands;
            if (at < x.least || at > x.most)
                continue;
            const std::string label = strands >= 1e6   ? text("%gM", strands / 1e6)
                                      : strands >= 1e3 ? text("%gk", strands / 1e3)
                                                       : text("%g", strands);
            tics += text("%s\"%s\" %.6g", tics.empty() ? "" : ", ", label.c_str(), at);
        }
    return tics;
}

// 1, 2, 5, 10, ... along the lower one.
std::string cost_tics(const Range& x) {
    std::string tics;
    for (int decade = -6; decade < 9; ++decade)
        for (const int factor : {1, 2, 5}) {
            const double at = factor * std::pow(10, decade);
            if (at >= x.least && at <= x.most)
                tics += text("%s\"%g\" %.6g", tics.empty() ? "" : ", ", at, at);
        }
    return tics;
}

std::string block(const char* name, const std::string& rows) {
    return std::string("$") + name + " << EOD\n" + rows + "EOD\n";
}

std::string row_of(const Dot& dot, double y) {
    return text("%.6g %.6g \"%s\"\n", dot.cost, y, dot.label.c_str());
}

std::vector<Dot> by_cost(std::vector<Dot> dots) {
    std::stable_sort(dots.begin(), dots.end(),
                     [](const Dot& a, const Dot& b) { return a.cost < b.cost; });
    return dots;
}

std::vector<Dot> dots_of(const Figure& figure) {
    std::vector<Dot> all;
    for (const Series& series : figure.series)
        all.insert(all.end(), series.dots.begin(), series.dots.end());
    return all;
}

// The last of a front that costs no more.
const Dot* best_at(const std::vector<Dot>& front, double cost) {
    const Dot* best = nullptr;
    for (const Dot& dot : front)
        if (dot.cost <= cost)
            best = &dot;
    return best;
}

std::string bands(const Range& y, const std::string& label) {
    std::string script =
        text("set object 1 rect from graph 0, first %.6g to graph 1, first 0.02 behind fc rgb "
             "'#E4F2E7' fs solid noborder\n",
             y.least) +
        "set object 2 rect from graph 0, first 0.02 to graph 1, first 0.1 behind fc rgb "
        "'#FBF6DF' fs solid noborder\n";
    script += "set label 1 '" + label +
              "' at graph 0.012, first 0.0175 tc rgb "
              "'#4E7A57' font ',11'\n"
              "set label 2 'plausible' at graph 0.012, first 0.087 tc rgb '#8A7A2E' font ',11'\n";
    return script;
}

struct Axes {
    Range x, y;
};

Axes axes_of(const Figure& figure) {
    Axes axes;
    for (const Dot& dot : dots_of(figure)) {
        axes.x.take(dot.cost);
        if (!dot.off_scale())
            axes.y.take(dot.error);
    }
    axes.y.take(figure.floor);
    axes.x = {axes.x.least / 1.5, axes.x.most * 1.9};
    axes.y = {
        std::pow(10, std::floor(std::log10(
                         (figure.bands ? std::min(axes.y.least, 0.01) : axes.y.least) / 1.5))),
        top};
    return axes;
}

std::string settings_of(const Figure& figure, const Axes& axes) {
    const auto& [x, y] = axes;
    std::string script = "set encoding utf8\nset logscale xy\nset logscale x2\n";
    script += text("set xrange [%.6g:%.6g]\nset x2range [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n",
                   x.least, x.most, x.least, x.most, y.least, y.most);
    script += text("set title \"{/:Bold %s}\\n{/*0.8 %s}\" offset 0, 0.6\n", figure.title.c_str(),
                   figure.subtitle.c_str());
    script += "set xlabel '" + figure.cost_axis + " (wall, launches included)'\nset ylabel '" +
              figure.error_axis + "'\nset format y '%g'\nset format x '%g'\n";
    if (figure.strands > 0)
        script += "set x2label 'strands in real time at 60 Hz' offset 0, -0.3\nset x2tics (" +
                  strand_tics(x, figure.strands) + ")\n";
    script += "set xtics nomirror (" + cost_tics(x) +
              ")\n"
              "set grid xtics ytics lc rgb '#D8D8D8' lw 0.7\n"
              "set key noenhanced outside right center vertical Left reverse samplen 2 spacing 1.3 "
              "font ',12'\n"
              "set border lc rgb '#606060'\nset tics tc rgb '#303030'\n";
    if (figure.bands)
        script += bands(y, figure.band_label);
    if (figure.floor > 0)
        script += text("set label 3 '%s' at graph 0.988, first %.6g right tc rgb "
                       "'#505050' font ',11'\n",
                       figure.floor_label.c_str(), figure.floor * 1.13);
    return script;
}

// Data blocks, and the plot command that shows them.
struct Drawing {
    std::string blocks, plots;

    void add(const std::string& plot) { plots += (plots.empty() ? "" : ", \\\n  ") + plot; }
    void add_series(const Series& series, size_t index, bool own_front);
};

void Drawing::add_series(const Series& series, size_t index, bool own_front) {
    std::string rows, failures, others;
    const auto front = front_of(series.dots);
    const auto on_front = [&](const Dot& dot) {
        return std::any_of(front.begin(), front.end(), [&](const Dot& best) {
            return best.cost == dot.cost && best.error == dot.error;
        });
    };
    for (const Dot& dot : by_cost(series.dots))
        if (dot.off_scale())
            failures +=
                text("%.6g %.6g \"%s%c\"\n", dot.cost, 0.75 * top,
                     own_front ? "" : (dot.label + " ").c_str(), dot.letter ? dot.letter : 'o');
        else
            (own_front && !on_front(dot) ? others : rows) += row_of(dot, dot.error);
    const std::string name = text("m%zu", index);
    const int point = 5 + 2 * static_cast<int>(index % 5);
    const char* colour = series.colour.c_str();
    if (!rows.empty()) {
        blocks += block(name.c_str(), rows);
        add(text("$%s using 1:2 with linespoints lw 2 dt %d pt %d ps 1.1 lc rgb '%s' title '%s'",
                 name.c_str(), series.dashed ? 4 : 1, point, colour, series.name.c_str()));
        add(text("$%s using 1:2:3 with labels left offset 0.7, 0.6 font ',10' tc rgb '%s' notitle",
                 name.c_str(), colour));
    }
    if (!others.empty()) {
        blocks += block((name + "o").c_str(), others);
        add(text("$%so using 1:2 with points pt %d ps 0.7 lc rgb '%s' notitle", name.c_str(), point,
                 colour));
    }
    if (!failures.empty()) {
        blocks += block((name + "f").c_str(), failures);
        add(text("$%sf using 1:2 with points pt 2 ps 1.4 lw 2 lc rgb '%s' %s", name.c_str(), colour,
                 rows.empty() ? ("title '" + series.name + "'").c_str() : "notitle"));
        add(text("$%sf using 1:2:3 with labels left offset 0.7, -0.5 font ',10' tc rgb '%s' "
                 "notitle",
                 name.c_str(), colour));
    }
}

} // namespace

bool Dot::off_scale() const {
    return letter == 'N' || letter == 'E' || letter == 'o' || !(error > 0);
}

std::vector<Dot> front_of(const std::vector<Dot>& dots) {
    std::vector<Dot> front;
    for (const Dot& dot : by_cost(dots))
        if (!dot.off_scale() && (front.empty() || dot.error < front.back().error))
            front.push_back(dot);
    return front;
}

std::vector<Dot> front_of(const Figure& figure) {
    return front_of(dots_of(figure));
}

std::string gnuplot_script(const Figure& figure, const std::string& path) {
    Drawing drawing;
    std::string front;
    for (const Dot& dot : front_of(figure))
        front += row_of(dot, dot.error);
    if (!front.empty()) {
        drawing.blocks += block("front", front);
        drawing.add(
            "$front using 1:2 with lines dt '.' lw 3 lc rgb '#202020' title 'best at its cost'");
    }
    if (figure.floor > 0)
        drawing.add(text("%.6g with lines dt 2 lw 1.3 lc rgb '#707070' notitle", figure.floor));
    for (size_t i = 0; i < figure.series.size(); ++i)
        drawing.add_series(figure.series[i], i, figure.own_fronts);
    const std::string plot = "plot " + drawing.plots + "\n";
    return settings_of(figure, axes_of(figure)) + drawing.blocks +
           "set terminal svg size 1100,720 font 'DejaVu Sans,14' background rgb 'white'\n" +
           "set output '" + path + ".svg'\n" + plot +
           "set terminal pngcairo size 1650,1080 font 'DejaVu Sans,18' fontscale 1 "
           "background rgb 'white'\nset output '" +
           path + ".png'\n" + plot + "set output\n";
}

bool draw(const Figure& figure, const std::string& out) {
    const auto dots = dots_of(figure);
    if (std::none_of(dots.begin(), dots.end(), [](const Dot& dot) { return dot.cost > 0; }))
        return false;
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
        std::fprintf(stderr,
                     "plait-lab: no figure %s: the program gnuplot is not there (Debian: "
                     "gnuplot-nox)\n",
                     figure.name.c_str());
        return false;
    }
    const std::string script = out + "/" + figure.name + ".gp";
    write_text(gnuplot_script(figure, out + "/" + figure.name), script);
    const std::string command = "gnuplot '" + script + "'";
    if (std::system(command.c_str()) != 0) {
        std::fprintf(stderr, "plait-lab: gnuplot did not draw %s\n", script.c_str());
        return false;
    }
    return true;
}

std::string winners_markdown(const Figure& figure) {
    const auto dots = dots_of(figure);
    const bool baselines =
        std::any_of(dots.begin(), dots.end(), [](const Dot& dot) { return dot.baseline; });
    std::vector<Dot> own;
    for (const Dot& dot : dots)
        if (!dot.baseline)
            own.push_back(dot);
    const auto front = front_of(dots), own_front = front_of(own);
    std::string table = std::string("| from, ms | best | error |") +
                        (baselines ? " best of plait's models | error |" : "") +
                        "\n|---:|---|---:|" + (baselines ? "---|---:|" : "") + "\n";
    for (const Dot& dot : front) {
        table += text("| %.3g | %s%s | %.2g |", dot.cost, dot.name.c_str(),
                      dot.baseline ? " (baseline)" : "", dot.error);
        if (const Dot* ours = baselines ? best_at(own_front, dot.cost) : nullptr)
            table += text(" %s | %.2g |", ours->name.c_str(), ours->error);
        else if (baselines)
            table += " - | - |";
        table += "\n";
    }
    return table;
}

std::vector<std::string> left_out_by_reason(const std::vector<std::string>& left_out) {
    std::vector<std::pair<std::string, std::string>> reasons; // and who
    for (const std::string& line : left_out) {
        const size_t colon = line.find(": ");
        const std::string who = line.substr(0, colon), why = line.substr(colon + 2);
        const auto known = std::find_if(reasons.begin(), reasons.end(),
                                        [&](const auto& reason) { return reason.first == why; });
        if (known == reasons.end())
            reasons.emplace_back(why, who);
        else
            known->second += ", " + who;
    }
    std::vector<std::string> lines;
    for (const auto& [why, who] : reasons)
        lines.push_back(who + ": " + why);
    return lines;
}

} // namespace lab
