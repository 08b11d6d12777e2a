#include "grid.hpp"

#include "common/file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

namespace lab::grid {

namespace {

constexpr double edge = 0.4;           // m, of the cube
constexpr uint32_t per_strand = 16;    // vertices
constexpr double strand_length = 0.15; // m
constexpr double own_speed = 0.3;      // m/s, standard deviation of a strand's own velocity

// How hair of a head that turns at 5 rad/s moves, and swings: about 1 m/s, waves of 40 cm.
Vec3 field(const Vec3& x) {
    const Vec3 from_axis = x - Vec3::Constant(0.5 * edge);
    const Vec3 swing(0.5 * std::sin(2 * pi * x.y() / edge), 0,
                     0.3 * std::cos(2 * pi * x.y() / edge));
    return Vec3(0, 5, 0).cross(from_axis) + swing;
}

// Strands hang anywhere inside; each moves with the field and at a velocity of its own.
std::vector<Vertex> hair(size_t strands) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> within(0.03, edge - 0.03);
    std::normal_distribution<double> normal(0, own_speed);
    std::vector<Vertex> vertices;
    for (size_t s = 0; s < strands; ++s) {
        const double top = 0.02 + strand_length +
                           (edge - 0.04 - strand_length) * (within(random) - 0.03) / (edge - 0.06);
        const Vec3 root(within(random), top, within(random));
        const Vec3 own(normal(random), normal(random), normal(random));
        for (uint32_t i = 0; i < per_strand; ++i) {
            const Vec3 x = root - Vec3(0, strand_length * i / (per_strand - 1), 0);
            vertices.push_back({x, field(x) + own});
        }
    }
    return vertices;
}

// rms over the vertices between the mean velocity they see and the field, over the rms of v.
double error_of(const Stages& stages, const std::vector<Vertex>& vertices) {
    const auto velocity = stages.velocity();
    double sum = 0, speeds = 0;
    for (const Vertex& vertex : vertices) {
        sum += (stages.seen(velocity, vertex.x) - field(vertex.x)).squaredNorm();
        speeds += vertex.v.squaredNorm();
    }
    return std::sqrt(sum / speeds);
}

struct Kind {
    uint32_t edge_count, capacity; // capacity 0: exact
    uint32_t tent;
};

void sum_up(Stages& stages, const Kind& kind) {
    ++stages.params.frame;
    if (kind.capacity > 0)
        stages.slots();
    else
        stages.exact();
}

Dot dot_of(Device& device, const std::vector<Vertex>& vertices, const Kind& kind,
           const CostOptions& options) {
    plait_grid_params grid =
        params_of(kind.edge_count, edge / kind.edge_count, std::max(kind.capacity, 1u));
    grid.tent = kind.tent;
    grid.h = 1.0f / 60;
    Stages stages(device, grid, vertices.size(), per_strand);
    stages.place(vertices);
    sum_up(stages, kind);
    Dot dot{0, error_of(stages, vertices), "", "", 0, false};
    std::vector<double> times;
    double spent = 0;
    while (times.size() < options.runs && (times.size() < 3 || spent < options.seconds)) {
        stages.wait();
        const auto start = std::chrono::steady_clock::now();
        sum_up(stages, kind);
        stages.diffuse();
        stages.wait();
        const std::chrono::duration<double> one = std::chrono::steady_clock::now() - start;
        times.push_back(one.count());
        spent += one.count();
    }
    std::nth_element(times.begin(), times.begin() + static_cast<ptrdiff_t>(times.size() / 2),
                     times.end());
    dot.cost = 1e3 * times[times.size() / 2] * 1e6 / static_cast<double>(vertices.size());
    return dot;
}

} // namespace

Figure grid_figure(const plait_device_info& which, Device& device, const CostOptions& options) {
    const auto vertices = hair((options.vertices + per_strand - 1) / per_strand);
    Figure figure;
    figure.name = "grid";
    figure.title = "Between strands: the mean velocity of a voxel grid over a box of 40 cm";
    figure.subtitle = std::string(which.name) + ", " + which.backend;
    figure.error_axis = "error of the mean velocity, rms / rms speed";
    figure.bands = false;
    Series slots{"slots, 8³ voxels", "#D55E00", false, {}};
    for (const uint32_t capacity : {1u, 4u, 16u, 64u, 256u, 1024u}) {
        slots.dots.push_back(dot_of(device, vertices, {8, capacity, PLAIT_TENT_VOXEL}, options));
        slots.dots.back().label = "C = " + std::to_string(capacity);
        slots.dots.back().name = "slots, C = " + std::to_string(capacity);
    }
    Series voxel{"exact, voxel", "#009E73", false, {}},
        linear{"exact, trilinear", "#8E3B8F", false, {}};
    for (const uint32_t n : {4u, 8u, 16u, 32u})
        for (Series* series : {&voxel, &linear}) {
            const uint32_t tent = series == &voxel ? PLAIT_TENT_VOXEL : PLAIT_TENT_TRILINEAR;
            series->dots.push_back(dot_of(device, vertices, {n, 0, tent}, options));
            series->dots.back().label = std::to_string(n) + "³";
            series->dots.back().name = series->name + ", " + std::to_string(n) + "³";
        }
    figure.series = {slots, voxel, linear};
    return figure;
}

std::string figure_csv(const Figure& figure) {
    std::string text = "# " + figure.title + "; " + figure.subtitle +
                       "\nmethod,error_rms_over_rms_speed,ms_per_step_per_million\n";
    for (const Series& series : figure.series)
        for (const Dot& dot : series.dots) {
            char line[128];
            std::snprintf(line, sizeof line, "\"%s\",%.6g,%.6g\n", dot.name.c_str(), dot.error,
                          dot.cost);
            text += line;
        }
    return text;
}

GridRun run_grid(Contexts& contexts, const std::string& out, const CostOptions& options) {
    const plait_device_info which = contexts.device();
    Device device(which);
    GridRun run{exact_rows(device), grid_figure(which, device, options), {}};
    const auto sampled = slot_rows(device);
    run.rows.insert(run.rows.end() - 2, sampled.begin(), sampled.end()); // before row 25
    make_folder(out);
    write_text(figure_csv(run.figure), out + "/grid.csv");
    run.files.push_back(out + "/grid.csv");
    if (draw(run.figure, out))
        run.files.insert(run.files.end(), {out + "/grid.svg", out + "/grid.png"});
    return run;
}

} // namespace lab::grid
