#include "gnuplot.hpp"

#include "text.hpp"

#include "common/file.hpp"

#include <cstdlib>

namespace lab {

std::string figure_script(const std::string& path, const std::string& lines,
                          const std::string& plot, int width, int height) {
    return lines + "set border 3\nset tics nomirror out\nset grid ytics lc rgb '#dddddd'\n" +
           text("set terminal svg size %d,%d font 'DejaVu Sans,14' background rgb 'white'\n", width,
                height) +
           "set output '" + path + ".svg'\n" + plot +
           text("\nset terminal pngcairo size %d,%d font 'DejaVu Sans,14' fontscale 1.4 linewidth "
                "1.5 background rgb 'white'\n",
                width * 3 / 2, height * 3 / 2) +
           "set output '" + path + ".png'\n" + plot + "\nset output\n";
}

bool draw_figure(const std::string& path, const std::string& script) {
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
        std::fprintf(stderr,
                     "plait-lab: no figure %s: the program gnuplot is not there (Debian: "
                     "gnuplot-nox)\n",
                     path.c_str());
        return false;
    }
    common::write_text(script, path + ".gp");
    if (std::system(("gnuplot '" + path + ".gp'").c_str()) != 0) {
        std::fprintf(stderr, "plait-lab: gnuplot did not draw %s.gp\n", path.c_str());
        return false;
    }
    return true;
}

} // namespace lab
