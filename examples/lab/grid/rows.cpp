#include "grid.hpp"

#include "../table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace lab::grid {

namespace {

// The table's nodes are at integers; ours are voxel centres, half a voxel further.
std::vector<Vertex> table_vertices() {
    std::vector<Vertex> vertices;
    for (const auto& row : load_table("grid_particles.csv").rows)
        vertices.push_back(
            {Vec3(row[0], row[1], row[2]) + Vec3::Constant(0.5), Vec3(row[3], row[4], row[5])});
    return vertices;
}

// Pairs of them are strands; in another order.
std::vector<Vertex> permuted(const std::vector<Vertex>& vertices) {
    std::vector<size_t> order(vertices.size() / 2);
    std::iota(order.begin(), order.end(), size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(12));
    std::vector<Vertex> all;
    for (const size_t strand : order)
        all.insert(all.end(), {vertices[2 * strand], vertices[2 * strand + 1]});
    return all;
}

size_t differing(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i)
        count += a[i] != b[i];
    return count;
}

// Of the worst component: |sum of v now - before| over the sum of |v| before.
double lost_momentum(const Vec3& now, const std::vector<Vec3>& before) {
    Vec3 sum = Vec3::Zero(), speeds = Vec3::Zero();
    for (const Vec3& v : before) {
        sum += v;
        speeds += v.cwiseAbs();
    }
    return ((now - sum).cwiseAbs().array() / speeds.array()).maxCoeff();
}

Vec3 total(const std::vector<Vec3>& v) {
    return std::accumulate(v.begin(), v.end(), Vec3(Vec3::Zero()));
}

// ---- slots: n vertices in one voxel of C

struct Sampled {
    double occupied = 0;                    // share of slots, mean over frames
    double density = 0, density_error = 0;  // of the exact one, and the mean's standard error
    double spread = 0, expected_spread = 0; // of V, in standard deviations of v
    double order_bias = 0;                  // of V where v = index/n
};

constexpr uint32_t frames = 400;

// Velocities anew each frame, so that who wins a slot says nothing about them.
Sampled sample(Device& device, uint32_t capacity, uint32_t n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> within(0.01, 0.99);
    std::normal_distribution<double> normal;
    Stages stages(device, params_of(1, 1, capacity), n, 2);
    Sampled seen;
    double squares = 0;
    for (uint32_t& frame = stages.params.frame; frame < frames; ++frame) {
        std::vector<Vertex> vertices(n);
        for (Vertex& vertex : vertices)
            vertex = {Vec3(within(random), within(random), within(random)), Vec3::Zero()};
        stages.place(vertices);
        stages.slots();
        const double sampled = stages.density()[0];
        seen.occupied += static_cast<double>(stages.occupied()) / capacity / frames;
        stages.exact();
        const double ratio = sampled / stages.density()[0];
        seen.density += ratio / frames;
        squares += ratio * ratio / frames;
        // At the centre all tents are 1: V is the mean of k of n, with variance S^2 (1/k - 1/n).
        Vec3 mean = Vec3::Zero();
        for (Vertex& vertex : vertices) {
            vertex = {Vec3::Constant(0.5), Vec3(normal(random), normal(random), normal(random))};
            mean += vertex.v / n;
        }
        stages.place(vertices);
        stages.slots();
        const double k = static_cast<double>(stages.occupied());
        seen.spread += (stages.velocity()[0] - mean).squaredNorm() / (3 * frames);
        seen.expected_spread += (1 / k - 1.0 / n) / frames;
        for (uint32_t i = 0; i < n; ++i)
            vertices[i].v = Vec3(static_cast<double>(i) / n, 0, 0);
        stages.place(vertices);
        stages.slots();
        seen.order_bias += (stages.velocity()[0].x() - 0.5 * (n - 1) / n) / frames;
    }
    seen.spread = std::sqrt(seen.spread);
    seen.expected_spread = std::sqrt(seen.expected_spread);
    seen.density_error = std::sqrt((squares - seen.density * seen.density) / frames);
    return seen;
}

// Of the share of C slots that n throws fill: mean, and standard deviation in a frame.
double share(double n, double capacity) {
    return 1 - std::pow(1 - 1 / capacity, n);
}

double share_deviation(double n, double capacity) {
    const double empty = std::pow(1 - 1 / capacity, n);
    const double two_empty = std::pow(1 - 2 / capacity, n);
    return std::sqrt((capacity - 1) * two_empty / capacity + empty / capacity - empty * empty);
}

// A pattern may leave the second out.
std::string number_of(const char* pattern, double a, double b) {
    char text[96];
    std::snprintf(text, sizeof text, pattern, a, b);
    return text;
}

} // namespace

bool GridRow::passes() const {
    return mark && std::abs(value) <= *mark;
}

std::vector<GridRow> exact_rows(Device& device) {
    const auto vertices = table_vertices();
    plait_grid_params grid = params_of(8, 1, 1);
    grid.tent = PLAIT_TENT_TRILINEAR;
    Stages stages(device, grid, vertices.size(), 2);
    stages.place(vertices);
    stages.exact();
    const auto density = stages.density();
    const auto velocity = stages.velocity();
    const auto before = stages.velocities();
    double density_error = 0, velocity_error = 0, gather_error = 0;
    for (const auto& row : load_table("grid_nodes.csv").rows) {
        const auto node = static_cast<size_t>(row[1] * 64 + row[2] * 8 + row[0]);
        const Vec3 off = velocity[node] - Vec3(row[4], row[5], row[6]);
        density_error = std::max(density_error, std::abs(density[node] - row[3]));
        velocity_error = std::max(velocity_error, off.cwiseAbs().maxCoeff());
    }
    const auto& gathered = load_table("grid_gathered_velocity.csv").rows;
    for (size_t i = 0; i < vertices.size(); ++i) {
        const Vec3 seen = stages.seen(velocity, vertices[i].x);
        const Vec3 off = seen - Vec3(gathered[i][0], gathered[i][1], gathered[i][2]);
        gather_error = std::max(gather_error, off.cwiseAbs().maxCoeff());
    }
    const double n = static_cast<double>(vertices.size());
    const double sum = std::accumulate(density.begin(), density.end(), 0.0);
    Vec3 on_grid = Vec3::Zero();
    for (size_t node = 0; node < density.size(); ++node)
        on_grid += density[node] * velocity[node];

    const auto first = stages.sums();
    stages.exact();
    size_t differ = differing(stages.sums(), first);
    stages.place(permuted(vertices));
    stages.exact();
    differ += differing(stages.sums(), first);

    stages.place(vertices);
    stages.exact();
    stages.diffuse();
    const double braked = lost_momentum(total(stages.velocities()), before);
    return {{"23", "exact: density D of 8³ nodes from 1000 vertices, largest error", "", 1e-5,
             density_error, ""},
            {"23", "... mean velocity V of the nodes", "", 1e-5, velocity_error, ""},
            {"23", "... V as a vertex sees it", "", 1e-5, gather_error, ""},
            {"23", "... sum of D over n, less 1", "", 1e-6, sum / n - 1, ""},
            {"23", "... words that differ when it runs again, or with strands permuted", "", 0.0,
             static_cast<double>(differ), ""},
            {"25", "momentum of the velocity grid from the vertices'", "Σ\\|v\\|", 1e-6,
             lost_momentum(on_grid, before), ""},
            {"25", "... of the vertices after one diffusion step", "Σ\\|v\\|", 1e-6, braked,
             "the step brakes what outruns its neighbours and hands nothing over"}};
}

std::vector<GridRow> slot_rows(Device& device) {
    constexpr uint32_t capacity = 256;
    std::vector<GridRow> rows;
    for (const uint32_t n : {capacity / 4, capacity, 4 * capacity}) {
        const std::string head = "slots, n = " + number_of("%g C: ", 1.0 * n / capacity, 0);
        const Sampled seen = sample(device, capacity, n);
        const double filled = share(n, capacity), survival = filled * capacity / n;
        const double spread_error = 1 / std::sqrt(2.0 * 3 * frames);
        double order = std::numeric_limits<double>::quiet_NaN();
        for (const auto& row : load_table("slot_statistics.csv").rows)
            if (row[0] == capacity && row[1] == n)
                order = row.back();
        rows.push_back(
            {"24", head + "occupied share", "standard errors", 3.0,
             (seen.occupied - filled) / (share_deviation(n, capacity) / std::sqrt(frames)),
             number_of("%.4f, expected %.4f", seen.occupied, filled)});
        rows.push_back({"24", head + "density over the exact one", "standard errors", 3.0,
                        (seen.density - survival) / seen.density_error,
                        number_of("%.4f, expected %.4f", seen.density, survival)});
        rows.push_back({"24", head + "spread of V", "standard errors", 3.0,
                        (seen.spread / seen.expected_spread - 1) / spread_error,
                        number_of("%.4f, expected %.4f", seen.spread, seen.expected_spread)});
        rows.push_back({"24", head + "bias of V where v = index/n", "", std::nullopt,
                        seen.order_bias, number_of("%+.3f if later writers always win", order, 0)});
    }
    return rows;
}

std::string rows_text(const std::vector<GridRow>& rows) {
    std::string text;
    for (const GridRow& row : rows) {
        char line[256];
        std::snprintf(line, sizeof line, "%-3s %-68s %10.3g %-5s %s\n", row.id.c_str(),
                      row.title.c_str(), row.value,
                      !row.mark      ? ""
                      : row.passes() ? "pass"
                                     : "MISS",
                      row.note.c_str());
        text += line;
    }
    return text;
}

std::string rows_markdown(const std::vector<GridRow>& rows) {
    std::string text = "| row | | unit | mark | value | |\n|---|---|---|---:|---:|---|\n";
    for (const GridRow& row : rows) {
        char value[64], mark[32] = "";
        std::snprintf(value, sizeof value,
                      !row.mark      ? "%.3g"
                      : row.passes() ? "**%.3g**"
                                     : "%.3g !",
                      row.value);
        if (row.mark)
            std::snprintf(mark, sizeof mark, "%g", *row.mark);
        text.append("| ").append(row.id).append(" | ").append(row.title).append(" | ");
        text.append(row.unit).append(" | ").append(mark).append(" | ").append(value);
        text.append(" | ").append(row.note).append(" |\n");
    }
    return text;
}

} // namespace lab::grid
