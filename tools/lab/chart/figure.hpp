// A figure of error over cost, log-log, drawn by gnuplot; and what is best in it.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace lab {

struct Dot {
    double cost, error;      // along the axes; no number: it failed
    std::string name, label; // "rod 4x1 BDF2", and "4×1 b" beside the marker
    char letter = 0;         // of its failure: N, E, o; s and r still have a place
    bool baseline = false;

    bool off_scale() const;
};

struct Series {
    std::string name, colour; // "rod", "#8E3B8F"
    bool dashed = false;
    std::vector<Dot> dots;
};

struct Figure {
    std::string name, title, subtitle; // the first names files
    std::string error_axis = "error, rms / L";
    std::string cost_axis = "ms per 1/60 s of simulated time and million vertices";
    std::string floor_label = "discretisation at rest";
    std::string band_label = "indistinguishable at N = 16";
    std::vector<Series> series;
    double strands = 0;      // in real time at 60 Hz where the cost is 1; 0: no axis of them
    bool own_fronts = false; // a series' line joins what nothing of its own beats; the rest, dots
    double floor = std::numeric_limits<double>::quiet_NaN(); // of discretisation; NaN: none
    bool bands = true;                 // what the eye takes for the same, and for plausible
    double top = 2;                    // the upper edge, below which failures are drawn
    std::vector<std::string> left_out; // "chain: does not bend"
};

std::vector<Dot> dots_of(const Figure& figure);
std::vector<Dot> by_cost(std::vector<Dot> dots);

// Dots no other beats in both cost and error, by cost.
std::vector<Dot> front_of(const std::vector<Dot>& dots);
std::vector<Dot> front_of(const Figure& figure);

// Every label beside its marker, or left out where there is no room. `path`: of the picture,
// without its extension.
std::string gnuplot_script(const Figure& figure, const std::string& path);
// Draws <out>/<name>.svg and .png; false, with a sentence on stderr, where there is no gnuplot.
bool draw(const Figure& figure, const std::string& out);

// Who is best at which cost, and who of those that are no baselines: a table of Markdown.
std::string winners_markdown(const Figure& figure);
// "chain, pbd: does not bend", a line for each reason.
std::vector<std::string> left_out_by_reason(const std::vector<std::string>& left_out);

} // namespace lab
