// A figure as a script of gnuplot.
#include "figure.hpp"

#include "common.hpp"
#include "labels.hpp"
#include "text.hpp"

#include "common/file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lab {

namespace {

constexpr double failures = 0.75; // where they are drawn, of the upper edge

// Texts inside, which end at this share of the width, and at which errors they stand.
constexpr double text_end = 0.988;
constexpr const char* plausible = "plausible";
constexpr double band_text = 0.0175, plausible_text = 0.087;
constexpr double floor_text = 1.13; // over the floor

// A figure of 1100 x 720 px, and the edges of its inside as shares of it.
constexpr double left_edge = 0.095, right_edge = 0.745, lower_edge = 0.095, upper_edge = 0.825;

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

std::string bands(const Range& y, const std::string& label) {
    std::string script =
        text("set object 1 rect from graph 0, first %.6g to graph 1, first 0.02 behind fc rgb "
             "'#E4F2E7' fs solid noborder\n",
             y.least) +
        "set object 2 rect from graph 0, first 0.02 to graph 1, first 0.1 behind fc rgb "
        "'#FBF6DF' fs solid noborder\n";
    const auto add = [&](int number, const std::string& label_text, double error,
                         const char* colour) {
        script += text("set label %d '%s' at graph %g, first %g right tc rgb '%s' font ',11'\n",
                       number, label_text.c_str(), text_end, error, colour);
    };
    add(1, label, band_text, "#4E7A57");
    add(2, plausible, plausible_text, "#8A7A2E");
    return script;
}

struct Axes {
    Range x, y;

    // Of the inside of a figure, px.
    static constexpr double width = 1100 * (right_edge - left_edge);
    static constexpr double height = 720 * (upper_edge - lower_edge);

    Spot spot_of(double cost, double error) const {
        return {width * std::log(cost / x.least) / std::log(x.most / x.least),
                height * std::log(error / y.least) / std::log(y.most / y.least)};
    }
    double cost_at(Spot spot) const { return x.least * std::pow(x.most / x.least, spot.x / width); }
    double error_at(Spot spot) const {
        return y.least * std::pow(y.most / y.least, spot.y / height);
    }
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
        figure.top};
    return axes;
}

std::string settings_of(const Figure& figure, const Axes& axes) {
    const auto& [x, y] = axes;
    std::string script = "set encoding utf8\nset logscale xy\nset logscale x2\n";
    script += text("set lmargin at screen %g\nset rmargin at screen %g\n"
                   "set bmargin at screen %g\nset tmargin at screen %g\n",
                   left_edge, right_edge, lower_edge, upper_edge);
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
        script += text("set label 3 '%s' at graph %g, first %.6g right tc rgb "
                       "'#505050' font ',11'\n",
                       figure.floor_label.c_str(), text_end, floor_text * figure.floor);
    return script;
}

bool among(const std::vector<Dot>& dots, const Dot& dot) {
    return std::any_of(dots.begin(), dots.end(), [&](const Dot& other) {
        return other.cost == dot.cost && other.error == dot.error;
    });
}

// A series as it is drawn: what its line joins, dots beside it, and failures on the upper edge.
struct Marks {
    std::vector<Dot> joined, loose, failed;

    Marks(const Series& series, bool own_front) {
        const auto front = front_of(series.dots);
        for (const Dot& dot : by_cost(series.dots))
            if (dot.off_scale())
                failed.push_back(dot);
            else
                (own_front && !among(front, dot) ? loose : joined).push_back(dot);
    }
};

double height_of(const Dot& dot, double top) {
    return dot.off_scale() ? failures * top : dot.error;
}

std::string rows_of(const std::vector<Dot>& dots, double top) {
    std::string rows;
    for (const Dot& dot : dots)
        rows += text("%.6g %.6g\n", dot.cost, height_of(dot, top));
    return rows;
}

// Data blocks, and the plot command that shows them.
struct Drawing {
    double top;
    std::string blocks = {}, plots = {};

    void add(const std::string& plot) { plots += (plots.empty() ? "" : ", \\\n  ") + plot; }
    void add_series(const Series& series, const Marks& marks, size_t index);
    void add_labels(const Series& series, const std::string& rows, size_t index);
};

void Drawing::add_series(const Series& series, const Marks& marks, size_t index) {
    const std::string name = text("m%zu", index);
    const int point = 5 + 2 * static_cast<int>(index % 5);
    const char* colour = series.colour.c_str();
    if (!marks.joined.empty()) {
        blocks += block(name.c_str(), rows_of(marks.joined, top));
        add(text("$%s using 1:2 with linespoints lw 2 dt %d pt %d ps 1.1 lc rgb '%s' title '%s'",
                 name.c_str(), series.dashed ? 4 : 1, point, colour, series.name.c_str()));
    }
    if (!marks.loose.empty()) {
        blocks += block((name + "o").c_str(), rows_of(marks.loose, top));
        add(text("$%so using 1:2 with points pt %d ps 0.7 lc rgb '%s' notitle", name.c_str(), point,
                 colour));
    }
    if (!marks.failed.empty()) {
        blocks += block((name + "f").c_str(), rows_of(marks.failed, top));
        add(text("$%sf using 1:2 with points pt 2 ps 1.4 lw 2 lc rgb '%s' %s", name.c_str(), colour,
                 marks.joined.empty() ? ("title '" + series.name + "'").c_str() : "notitle"));
    }
}

void Drawing::add_labels(const Series& series, const std::string& rows, size_t index) {
    if (rows.empty())
        return;
    const std::string name = text("l%zu", index);
    blocks += block(name.c_str(), rows);
    add(text("$%s using 1:2:3 with labels left font ',10' tc rgb '%s' notitle", name.c_str(),
             series.colour.c_str()));
}

Box around(Spot spot, double radius) {
    return {spot.x - radius, spot.y - radius, spot.x + radius, spot.y + radius};
}

// A line from a to b, a spot every few px.
void sample(Spot a, Spot b, std::vector<Spot>& spots) {
    const int count = 1 + static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 4);
    for (int i = 0; i <= count; ++i)
        spots.push_back({a.x + (b.x - a.x) * i / count, a.y + (b.y - a.y) * i / count});
}

Surroundings surroundings_of(const Figure& figure, const Axes& axes,
                             const std::vector<Marks>& series) {
    Surroundings all{{0, 0, Axes::width, Axes::height}, {}, {}};
    const auto spot_of = [&](const Dot& dot) {
        return axes.spot_of(dot.cost, height_of(dot, figure.top));
    };
    const auto take = [&](const std::vector<Dot>& dots, double radius) {
        for (const Dot& dot : dots)
            all.taken.push_back(around(spot_of(dot), radius));
    };
    for (const Marks& marks : series) {
        take(marks.joined, 6);
        take(marks.loose, 4);
        take(marks.failed, 7);
        for (size_t i = 1; i < marks.joined.size(); ++i)
            sample(spot_of(marks.joined[i - 1]), spot_of(marks.joined[i]), all.better);
    }
    const auto add_text = [&](const std::string& label, double error) {
        const double y = axes.spot_of(axes.x.least, error).y;
        const Box box = box_of(label, {0, y});
        all.taken.push_back(
            {text_end * Axes::width - box.right, box.bottom, text_end * Axes::width, box.top});
    };
    if (figure.bands) {
        add_text(figure.band_label, band_text);
        add_text(plausible, plausible_text);
    }
    if (figure.floor > 0) {
        add_text(figure.floor_label, floor_text * figure.floor);
        const double y = axes.spot_of(axes.x.least, figure.floor).y;
        sample({0, y}, {Axes::width, y}, all.better);
    }
    return all;
}

// Of each series, rows of its labels.
std::vector<std::string> labels_of(const Figure& figure, const Axes& axes,
                                   const std::vector<Marks>& series) {
    std::vector<Label> labels;
    std::vector<size_t> owners;
    const auto add = [&](size_t owner, const Dot& dot, const std::string& label) {
        labels.push_back({axes.spot_of(dot.cost, height_of(dot, figure.top)), label});
        owners.push_back(owner);
    };
    for (size_t i = 0; i < series.size(); ++i) {
        for (const Dot& dot : series[i].joined)
            add(i, dot, dot.label);
        for (const Dot& dot : series[i].failed)
            add(i, dot,
                (figure.own_fronts ? "" : dot.label + " ") + (dot.letter ? dot.letter : 'o'));
    }
    const auto places = place_labels(labels, surroundings_of(figure, axes, series));
    std::vector<std::string> rows(series.size());
    for (size_t i = 0; i < labels.size(); ++i)
        if (const auto& place = places[i])
            rows[owners[i]] += text("%.6g %.6g \"%s\"\n", axes.cost_at(*place),
                                    axes.error_at(*place), labels[i].text.c_str());
    return rows;
}

} // namespace

std::string gnuplot_script(const Figure& figure, const std::string& path) {
    const Axes axes = axes_of(figure);
    std::vector<Marks> series;
    for (const Series& each : figure.series)
        series.emplace_back(each, figure.own_fronts);
    Drawing drawing{figure.top};
    if (const auto front = front_of(figure); !front.empty()) {
        drawing.blocks += block("front", rows_of(front, figure.top));
        drawing.add(
            "$front using 1:2 with lines dt '.' lw 3 lc rgb '#202020' title 'best at its cost'");
    }
    if (figure.floor > 0)
        drawing.add(text("%.6g with lines dt 2 lw 1.3 lc rgb '#707070' notitle", figure.floor));
    const auto labels = labels_of(figure, axes, series);
    for (size_t i = 0; i < series.size(); ++i) {
        drawing.add_series(figure.series[i], series[i], i);
        drawing.add_labels(figure.series[i], labels[i], i);
    }
    const std::string plot = "plot " + drawing.plots + "\n";
    return settings_of(figure, axes) + drawing.blocks +
           "set terminal svg size 1100,720 font 'DejaVu Sans,14' background rgb 'white'\n" +
           "set output '" + path + ".svg'\n" + plot +
           "set terminal pngcairo size 1650,1080 font 'DejaVu Sans,14' fontscale 1.15 "
           "linewidth 1.5 pointscale 1.5 background rgb 'white'\nset output '" +
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

} // namespace lab
