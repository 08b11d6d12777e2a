#include "rows.hpp"

#include <cstdlib>
#include <set>

namespace lab::stability {

namespace {

// From the top: method, rate, segments; columns: gamma and motion.
using Line = std::tuple<size_t, double, uint32_t>; // the first is a place in methods
struct Picture {
    std::vector<std::string> methods; // "cosserat 1x3"
    std::vector<Line> lines;
    std::vector<double> gammas;
    std::map<std::pair<size_t, size_t>, int> cells; // (column, line)
};

template <typename T> size_t place_in(const std::vector<T>& all, const T& one) {
    return static_cast<size_t>(std::find(all.begin(), all.end(), one) - all.begin());
}

// Of one model's map, or of all models' in the order they come.
Picture picture_of(const std::vector<Row>& rows, const std::string& model) {
    Picture picture;
    std::set<Line> lines;
    std::set<double> gammas;
    const auto line_of = [&](const Row& row) {
        const std::string method = row.job.model + " " + row.job.setting;
        const size_t place = place_in(picture.methods, method);
        if (place == picture.methods.size())
            picture.methods.push_back(method);
        return Line{place, row.job.place.rate, row.job.place.segments};
    };
    std::vector<const Row*> shown;
    for (const Row& row : rows)
        if (row.job.kind == "map" && (model.empty() || row.job.model == model))
            shown.push_back(&row);
    for (const Row* row : shown) {
        lines.insert(line_of(*row));
        gammas.insert(row->job.place.gamma);
    }
    picture.lines.assign(lines.begin(), lines.end());
    picture.gammas.assign(gammas.begin(), gammas.end());
    for (const Row* row : shown) {
        size_t motion = 0;
        while (row->column != shakes()[motion].label)
            ++motion;
        const size_t column =
            place_in(picture.gammas, row->job.place.gamma) * (shakes().size() + 1) + motion;
        picture.cells[{column, place_in(picture.lines, line_of(*row))}] =
            static_cast<int>(row->outcome.grade);
    }
    return picture;
}

void write_data(const Picture& picture, const std::filesystem::path& file) {
    std::ofstream data(file);
    const size_t columns = picture.gammas.size() * (shakes().size() + 1) - 1;
    for (size_t line = 0; line < picture.lines.size(); ++line)
        for (size_t column = 0; column < columns; ++column) {
            const auto found = picture.cells.find({column, line});
            if (found != picture.cells.end())
                data << column << ' ' << line << ' ' << found->second << '\n';
        }
}

void write_script(const Picture& picture, const std::string& model,
                  const std::filesystem::path& stem) {
    std::ofstream script(stem.string() + ".gp");
    const size_t lines = picture.lines.size();
    const size_t columns = picture.gammas.size() * (shakes().size() + 1);
    script << "set palette maxcolors 7 defined (0 '#222222', 1 '#b2182b', 2 '#762a83', 3 "
              "'#2166ac', 4 '#fdae61', 5 '#fee090', 6 '#d9f0d3')\n"
              "set cbrange [-0.5:6.5]\nset cbtics ('N not finite' 0, 'E gains energy' 1, 'F "
              "frozen' 2, 'J jitters' 3, 's strain, shaken' 4, 'r strain, at rest' 5, 'pass' 6)\n"
           << "set title '" << model
           << ": each block a gamma, in it 0 to 1000 g at 2 Hz and jumps of 1 and 10 L'\n"
           << "set xrange [-0.5:" << columns - 1 << "]\nset yrange [" << lines << ":-0.5]\n"
           << "set tics out nomirror\nset rmargin 24\nunset key\nset xtics (";
    for (size_t i = 0; i < picture.gammas.size(); ++i)
        script << (i ? ", " : "") << "'" << text_of(picture.gammas[i]) << "' "
               << static_cast<double>(i * (shakes().size() + 1)) + 3;
    script << ")\nset xlabel 'gamma = rho A g L^3 / EI'\nset ytics noenhanced (";
    for (size_t i = 0; i < lines; ++i) {
        const auto& [method, rate, segments] = picture.lines[i];
        script << (i ? ", " : "") << "'" << picture.methods[method] << ", " << rate << " Hz, N "
               << segments << "' " << i;
    }
    script << ") font ',9'\n";
    const size_t width = 620 + 13 * columns, height = 140 + 14 * lines; // pixels
    const std::string plot = "plot '" + stem.string() +
                             ".dat' using 1:2:(0.5):(0.5):3 with boxxyerror fillcolor palette "
                             "fillstyle solid noborder\n";
    script << "set terminal svg size " << width << "," << height << "\nset output '"
           << stem.string() << ".svg'\n"
           << plot << "set terminal pngcairo size " << width << "," << height << "\nset output '"
           << stem.string() << ".png'\n"
           << plot;
}

} // namespace

bool draw_maps(const std::vector<Row>& rows, const std::filesystem::path& folder) {
    std::set<std::string> models{""}; // all of them in one picture, called stability
    for (const Row& row : rows)
        if (row.job.kind == "map")
            models.insert(row.job.model);
    bool drawn = true;
    for (const std::string& model : models) {
        const Picture picture = picture_of(rows, model);
        const std::filesystem::path stem = folder / (model.empty() ? "stability" : model);
        write_data(picture, stem.string() + ".dat");
        write_script(picture, model.empty() ? "All" : model, stem);
        const std::string command = "gnuplot '" + stem.string() + ".gp'";
        drawn = std::system(command.c_str()) == 0 && drawn;
    }
    return drawn;
}

} // namespace lab::stability
