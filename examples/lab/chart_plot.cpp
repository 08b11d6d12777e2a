// The figure: log-log, cost to the right, error upwards.
#include "chart.hpp"

#include "common/file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lab {

namespace {

constexpr double top = 2; // the upper edge, where failures are put

// Okabe and Ito's colours: told apart by everyone, and in grey.
const char* colour_of(const std::string& model, size_t index) {
    if (model == "tressfx")
        return "#D55E00";
    if (model == "chain")
        return "#0072B2";
    if (model == "cosserat")
        return "#009E73";
    if (model == "rod")
        return "#8E3B8F";
    constexpr const char* others[] = {"#7F7F7F", "#E69F00", "#56B4E9",
                                      "#A0522D", "#4D4D4D", "#B8A000"};
    return others[index % std::size(others)];
}

template <typename... Values> std::string text(const char* pattern, Values... values) {
    char line[1024];
    std::snprintf(line, sizeof line, pattern, values...);
    return line;
}

bool off_scale(const ChartPoint& p) {
    return p.letter == 'N' || p.letter == 'E' || p.letter == 'o' || !(p.error > 0);
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

// "4×2", and "4×2 b" with BDF2.
std::string marker_of(const Setting& s) {
    return text("%u×%u%s", s.substeps, s.iterations, s.bdf2 ? "b" : "");
}

// 1, 3, 10, 30, ... thousands of strands along the upper edge.
std::string strand_tics(const Range& x, double per_strand) {
    std::string tics;
    for (double decade = 1; decade < 1e10; decade *= 10)
        for (const double strands : {decade, 3 * decade}) {
            const double at = per_strand / strands;
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

std::string row_of(const ChartPoint& p, double y) {
    return text("%.6g %.6g \"%s\"\n", p.cost.ms_per_frame(), y,
                marker_of(p.method.setting).c_str());
}

// A model's points in the order of their cost, and what is written beside them.
struct Series {
    const Model* model;
    std::string rows, failures;
};

std::vector<Series> series_of(const Chart& chart) {
    std::vector<Series> all;
    std::vector<ChartPoint> sorted = chart.points;
    std::stable_sort(sorted.begin(), sorted.end(), [](const ChartPoint& a, const ChartPoint& b) {
        return a.cost.ms_per_frame() < b.cost.ms_per_frame();
    });
    for (const ChartPoint& p : chart.points)
        if (std::none_of(all.begin(), all.end(),
                         [&](const Series& s) { return s.model == p.method.model; }))
            all.push_back({p.method.model, "", ""});
    for (const ChartPoint& p : sorted)
        for (Series& s : all)
            if (s.model == p.method.model) {
                if (off_scale(p))
                    s.failures +=
                        text("%.6g %.6g \"%s %c\"\n", p.cost.ms_per_frame(), 0.75 * top,
                             marker_of(p.method.setting).c_str(), p.letter ? p.letter : 'o');
                else
                    s.rows += row_of(p, p.error);
            }
    return all;
}

std::string bands(const Range& y) {
    std::string script =
        text("set object 1 rect from graph 0, first %.6g to graph 1, first 0.02 behind fc rgb "
             "'#E4F2E7' fs solid noborder\n",
             y.least) +
        "set object 2 rect from graph 0, first 0.02 to graph 1, first 0.1 behind fc rgb "
        "'#FBF6DF' fs solid noborder\n";
    script += "set label 1 'indistinguishable at N = 16' at graph 0.012, first 0.0175 tc rgb "
              "'#4E7A57' font ',11'\n"
              "set label 2 'plausible' at graph 0.012, first 0.087 tc rgb '#8A7A2E' font ',11'\n";
    return script;
}

} // namespace

std::string gnuplot_script(const Chart& chart, const plait_device_info& device,
                           const std::string& path) {
    Range x, y;
    for (const ChartPoint& p : chart.points) {
        x.take(p.cost.ms_per_frame());
        if (!off_scale(p))
            y.take(p.error);
    }
    y.take(chart.floor);
    x = {x.least / 1.5, x.most * 1.9};
    y = {std::pow(10, std::floor(std::log10(std::min(y.least, 0.01) / 1.5))), top};
    const double per_strand = 1e3 / 60 * 1e6 / (chart.segments + 1);

    std::string script = "set encoding utf8\nset logscale xy\nset logscale x2\n";
    script += text("set xrange [%.6g:%.6g]\nset x2range [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n",
                   x.least, x.most, x.least, x.most, y.least, y.most);
    script += text("set title \"{/:Bold %s}\\n{/*0.8 %s, %s}\" offset 0, 0.6\n",
                   chart.family.title.c_str(), device.name, device.backend);
    script += "set xlabel 'ms per 1/60 s of simulated time and million vertices (wall, launches "
              "included)'\n"
              "set ylabel 'error, rms / L'\n"
              "set format y '%g'\nset format x '%g'\n"
              "set x2label 'strands in real time at 60 Hz' offset 0, -0.3\n"
              "set x2tics (" +
              strand_tics(x, per_strand) + ")\nset xtics nomirror (" + cost_tics(x) +
              ")\n"
              "set grid xtics ytics lc rgb '#D8D8D8' lw 0.7\n"
              "set key noenhanced outside right center vertical Left reverse samplen 2 spacing 1.3 "
              "font ',12'\n"
              "set border lc rgb '#606060'\nset tics tc rgb '#303030'\n";
    script += bands(y);
    if (chart.floor > 0)
        script +=
            text("set label 3 'discretisation at rest' at graph 0.988, first %.6g right tc rgb "
                 "'#505050' font ',11'\n",
                 chart.floor * 1.13);

    std::string plots;
    const auto add = [&](const std::string& plot) {
        plots += (plots.empty() ? "" : ", \\\n  ") + plot;
    };
    std::string front;
    for (const ChartPoint& p : pareto_front(chart.points))
        front += row_of(p, p.error);
    if (!front.empty()) {
        script += block("front", front);
        add("$front using 1:2 with lines dt '.' lw 3 lc rgb '#202020' title 'best at its cost'");
    }
    if (chart.floor > 0)
        add(text("%.6g with lines dt 2 lw 1.3 lc rgb '#707070' notitle", chart.floor));
    size_t index = 0, other = 0;
    for (const Series& s : series_of(chart)) {
        const char* colour = colour_of(s.model->label, other);
        other += s.model->baseline();
        const std::string name = text("m%zu", index);
        const int point = 5 + 2 * static_cast<int>(index % 5);
        const std::string label = s.model->label + (s.model->baseline() ? " (baseline)" : "");
        if (!s.rows.empty()) {
            script += block(name.c_str(), s.rows);
            add(text(
                "$%s using 1:2 with linespoints lw 2 dt %d pt %d ps 1.1 lc rgb '%s' title '%s'",
                name.c_str(), s.model->baseline() ? 4 : 1, point, colour, label.c_str()));
            add(text("$%s using 1:2:3 with labels left offset 0.7, 0.6 font ',10' tc rgb '%s' "
                     "notitle",
                     name.c_str(), colour));
        }
        if (!s.failures.empty()) {
            script += block((name + "f").c_str(), s.failures);
            add(text("$%sf using 1:2 with points pt 2 ps 1.4 lw 2 lc rgb '%s' %s", name.c_str(),
                     colour, s.rows.empty() ? ("title '" + label + "'").c_str() : "notitle"));
            add(text("$%sf using 1:2:3 with labels left offset 0.7, -0.5 font ',10' tc rgb '%s' "
                     "notitle",
                     name.c_str(), colour));
        }
        ++index;
    }
    const std::string plot = "plot " + plots + "\n";
    return script +
           "set terminal svg size 1100,720 font 'DejaVu Sans,14' background rgb 'white'\n" +
           "set output '" + path + ".svg'\n" + plot +
           "set terminal pngcairo size 1650,1080 font 'DejaVu Sans,18' fontscale 1 "
           "background rgb 'white'\nset output '" +
           path + ".png'\n" + plot + "set output\n";
}

bool draw(const Chart& chart, const plait_device_info& device, const std::string& out) {
    const bool nothing = std::none_of(chart.points.begin(), chart.points.end(),
                                      [](const ChartPoint& p) { return p.cost.wall > 0; });
    if (nothing)
        return false;
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
        std::fprintf(stderr,
                     "plait-lab: no figure %s: the program gnuplot is not there (Debian: "
                     "gnuplot-nox)\n",
                     chart.family.name.c_str());
        return false;
    }
    const std::string script = out + "/" + chart.family.name + ".gp";
    write_text(gnuplot_script(chart, device, out + "/" + chart.family.name), script);
    const std::string command = "gnuplot '" + script + "'";
    if (std::system(command.c_str()) != 0) {
        std::fprintf(stderr, "plait-lab: gnuplot did not draw %s\n", script.c_str());
        return false;
    }
    return true;
}

} // namespace lab
