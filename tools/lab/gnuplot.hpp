// Figures, drawn by the program gnuplot.
#pragma once

#include <string>

namespace lab {

// Into <path>.svg and <path>.png, of so many pixels in the first: `lines` sets axes, `plot` draws.
std::string figure_script(const std::string& path, const std::string& lines,
                          const std::string& plot, int width, int height);

// Writes <path>.gp and runs it. False, and a line to stderr: there is no gnuplot, or it failed.
bool draw_figure(const std::string& path, const std::string& script);

} // namespace lab
