#include "volume.hpp"

#include "gnuplot.hpp"
#include "text.hpp"

#include "common/file.hpp"

namespace lab::volume {

std::string volume_csv(const std::vector<VolumeRow>& rows) {
    std::string csv =
        "method,volume,volume_least,volume_most,height,height_least,momentum,energy,neighbours,"
        "crowd,jitter,ms,where\n";
    for (const VolumeRow& row : rows)
        csv += text("%s,%.4g,%.4g,%.4g,%.4g,%.4g,%.3g,%.4g,%.4g,%.4g,%.3g,%.4g,%s\n",
                    row.method->name.c_str(), row.volume, row.volume_least, row.volume_most,
                    row.height, row.height_least, row.momentum, row.energy, row.neighbours,
                    row.crowd, row.jitter, row.cost, row.method->program ? "host" : "device");
    return csv;
}

std::string volume_text(const std::vector<VolumeRow>& rows) {
    std::string all =
        "method       volume   least    most  height   least  momentum   energy  neighbours"
        "  crowd   jitter       ms\n";
    for (const VolumeRow& row : rows)
        all +=
            text("%-12s %6.2f %7.2f %7.2f %7.2f %7.2f %9.1e %+7.1f%% %11.2f %6.2f %8.1e %8.2f%s\n",
                 row.method->name.c_str(), row.volume, row.volume_least, row.volume_most,
                 row.height, row.height_least, row.momentum, 100 * row.energy, row.neighbours,
                 row.crowd, row.jitter, row.cost, row.method->program ? " host" : "");
    return all +
           "volume, height: over those at rest, at the end, least of the last second, "
           "most of all\n"
           "momentum, energy: of hair in free fall, what one step changes over what there is\n"
           "neighbours: pairs within 12 mm at rest that still are; crowd: such pairs over those at "
           "rest\n"
           "jitter: rms way in the last step over the strands' length; ms: a step, the method "
           "alone, the least\n";
}

std::string volume_curves(const std::vector<VolumeRow>& rows) {
    std::string csv = "seconds";
    for (const VolumeRow& row : rows)
        csv += "," + row.method->name;
    csv += "\n0";
    for (size_t i = 0; i < rows.size(); ++i)
        csv += ",1";
    csv += '\n';
    for (size_t step = 0; step < rows[0].volumes.size(); ++step) {
        csv += text("%.5g", static_cast<double>(step + 1) / rate);
        for (const VolumeRow& row : rows)
            csv += step < row.volumes.size() ? text(",%.5g", row.volumes[step]) : ",";
        csv += '\n';
    }
    return csv;
}

namespace {

std::string script_of(const std::vector<VolumeRow>& rows, const VolumeOptions& options,
                      const std::string& path) {
    std::string plot;
    for (size_t i = 0; i < rows.size(); ++i)
        plot += text("%s'%s_curves.csv' using 1:%zu with lines lw %s lc rgb '%s' title \"%s\"",
                     i ? ", " : "plot ", path.c_str(), i + 2,
                     rows[i].method->name == "volume" ? "3.5" : "2", rows[i].method->colour.c_str(),
                     rows[i].method->title.c_str());
    const std::string lines =
        text("set datafile separator ','\n"
             "set title \"What is left of the volume of limp hair on a ball\\n"
             "{/*0.8 %u strands, %s, 60 Hz}\"\n",
             options.strands, options.model.c_str()) +
        "set xlabel 'time, s'\nset ylabel 'volume, over that in the groom'\n"
        "set yrange [0:2.5]\nset key below left Left reverse noenhanced samplen 2\n";
    return figure_script(path, lines, plot, 900, 640);
}

} // namespace

bool draw_volume(const std::vector<VolumeRow>& rows, const VolumeOptions& options) {
    const std::string path = options.out + "/volume";
    return draw_figure(path, script_of(rows, options, path));
}

} // namespace lab::volume
