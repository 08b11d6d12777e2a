#include "grid.hpp"

#include "references/table.hpp"

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

// ---- slots: n vertices in voxels of C

// What is seen and what is expected of it, each a mean over frames, with its standard error.
struct Sampled {
    double value = 0, expected = 0, error = 0;

    // A statistic that cannot scatter has to be met.
    double off() const {
        const double by = value - expected;
        if (error > 1e-12)
            return by / error;
        return std::abs(by) < 1e-6 ? 0 : std::numeric_limits<double>::infinity();
    }
};

struct Seen {
    Sampled occupied, density; // share of slots; of the exact density
    Sampled spread;            // of V, in standard deviations of v
    double order_bias = 0;     // of V where v = index/n
};

constexpr uint32_t frames = 400;

// Of the share of C slots that n throws fill: mean, and variance in a frame.
double share(double n, double capacity) {
    return 1 - std::pow(1 - 1 / capacity, n);
}

double share_variance(double n, double capacity) {
    const double empty = std::pow(1 - 1 / capacity, n);
    const double two_empty = std::pow(1 - 2 / capacity, n);
    return std::max(0.0, (capacity - 1) * two_empty / capacity + empty / capacity - empty * empty);
}

// The voxel of a position in voxels, as the device finds it.
size_t voxel_of(const Vec3& x, uint32_t edge_count) {
    const auto cell = [](double c) { return static_cast<size_t>(static_cast<float>(c)); };
    return (cell(x.y()) * edge_count + cell(x.z())) * edge_count + cell(x.x());
}

// One number of vertices, wherever they are drawn or given.
class Sampling {
  public:
    Sampling(Device& device, const SlotOptions& options, uint32_t n)
        : options_(options), n_(n),
          stages_(device, params_of(options.edge_count, 1, options.capacity), n + n % 2, 2) {}

    Seen all() {
        for (uint32_t& frame = stages_.params.frame; frame < frames; ++frame) {
            throw_vertices();
            see_shares();
            see_velocities();
            see_order();
        }
        const double slots = 1.0 * options_.capacity * static_cast<double>(voxels_.size());
        seen_.occupied.value /= slots;
        seen_.occupied.expected /= static_cast<double>(voxels_.size());
        seen_.occupied.error =
            std::sqrt(seen_.occupied.error / frames) / static_cast<double>(voxels_.size());
        seen_.density.error = std::sqrt(seen_.density.error / frames);
        finish_spread();
        return seen_;
    }

  private:
    // Anywhere, but for those that are given. Strands have two: an odd one lies outside the grid,
    // where nothing sees it.
    void throw_vertices() {
        vertices_.assign(n_ + n_ % 2, {Vec3::Constant(-10), Vec3::Zero()});
        for (uint32_t i = 0; i < n_; ++i)
            vertices_[i] = {options_.positions.empty()
                                ? options_.edge_count *
                                      Vec3(within_(random_), within_(random_), within_(random_))
                                : options_.positions[i],
                            Vec3::Zero()};
        const size_t edge = options_.edge_count;
        voxels_.assign(edge * edge * edge, {});
        for (uint32_t i = 0; i < n_; ++i)
            voxels_[voxel_of(vertices_[i].x, options_.edge_count)].push_back(i);
    }

    void see_shares() {
        stages_.place(vertices_);
        stages_.slots();
        const auto sampled = stages_.density();
        seen_.occupied.value += static_cast<double>(stages_.occupied()) / frames;
        stages_.exact();
        const auto exact = stages_.density();
        double whole = 0, got = 0, expected = 0;
        for (size_t v = 0; v < voxels_.size(); ++v) {
            const double n = static_cast<double>(voxels_[v].size()), filled = share(n, capacity());
            seen_.occupied.expected += filled / frames;
            seen_.occupied.error += share_variance(n, capacity()) / frames;
            whole += exact[v];
            got += sampled[v];
            expected += n > 0 ? exact[v] * filled * capacity() / n : 0;
        }
        seen_.density.value += got / whole / frames;
        seen_.density.expected += expected / whole / frames;
        const double by = (got - expected) / whole;
        seen_.density.error += by * by / frames;
    }

    // At the centre of a voxel all tents are 1: V is the mean of k of n, with variance
    // S^2 (1/k - 1/n).
    void see_velocities() {
        std::vector<Vec3> mean(voxels_.size(), Vec3::Zero());
        for (size_t v = 0; v < voxels_.size(); ++v)
            for (const uint32_t i : voxels_[v]) {
                const Vec3 centre =
                    vertices_[i].x.cast<float>().array().floor().cast<double>() + 0.5;
                vertices_[i] = {centre, Vec3(normal_(random_), normal_(random_), normal_(random_))};
                mean[v] += vertices_[i].v / static_cast<double>(voxels_[v].size());
            }
        stages_.place(vertices_);
        stages_.slots();
        const auto velocity = stages_.velocity();
        const auto sampled = stages_.density();
        const double one = density_of_one();
        for (size_t v = 0; v < voxels_.size(); ++v) {
            const double n = static_cast<double>(voxels_[v].size());
            const double k = std::round(sampled[v] / one);
            if (k == 0)
                continue;
            const double square = 1 / k - 1 / n;
            spread_ += (velocity[v] - mean[v]).squaredNorm() / 3;
            expected_ += square;
            fourths_ += square * square;
        }
    }

    // Of a vertex at the centre of its voxel.
    double density_of_one() {
        if (one_ == 0) {
            stages_.exact();
            const auto exact = stages_.density();
            one_ = std::accumulate(exact.begin(), exact.end(), 0.0) / n_;
        }
        return one_;
    }

    // Where velocity goes with the index, the mean is biased by who writes last.
    void see_order() {
        for (uint32_t i = 0; i < n_; ++i)
            vertices_[i].v = Vec3(static_cast<double>(i) / n_, 0, 0);
        stages_.place(vertices_);
        stages_.slots();
        const auto velocity = stages_.velocity();
        for (size_t v = 0; v < voxels_.size(); ++v)
            for (const uint32_t i : voxels_[v])
                seen_.order_bias += (velocity[v].x() - static_cast<double>(i) / n_) / n_ / frames;
    }

    // Of a mean of squares of normal deviates, three a voxel, each with a variance of its own.
    void finish_spread() {
        if (!(expected_ > 0))
            return;
        seen_.spread = {std::sqrt(spread_ / expected_), 1,
                        0.5 * std::sqrt(2.0 / 3 * fourths_) / expected_};
    }

    double capacity() const { return options_.capacity; }

    const SlotOptions& options_;
    uint32_t n_;
    Stages stages_;
    std::mt19937 random_{7};
    std::uniform_real_distribution<double> within_{0.01, 0.99};
    std::normal_distribution<double> normal_;
    std::vector<Vertex> vertices_;
    std::vector<std::vector<uint32_t>> voxels_; // the vertices of each
    double one_ = 0, spread_ = 0, expected_ = 0, fourths_ = 0;
    Seen seen_;
};

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

namespace {

std::string head_of(const SlotOptions& options, uint32_t n) {
    const std::string voxels = std::to_string(options.edge_count);
    if (options.edge_count == 1 && options.positions.empty())
        return "slots, n = " + number_of("%g C: ", 1.0 * n / options.capacity, 0);
    return "slots, " + std::to_string(n) + " in " + voxels + "³ voxels of " +
           std::to_string(options.capacity) + ": ";
}

GridRow row_of(const std::string& title, const Sampled& sampled) {
    return {"24", title,         "standard errors",
            3.0,  sampled.off(), number_of("%.4f, expected %.4f", sampled.value, sampled.expected)};
}

// Of one voxel, where the table has it.
std::string order_note(const SlotOptions& options, uint32_t n) {
    for (const auto& row : load_table("slot_statistics.csv").rows)
        if (options.edge_count == 1 && row[0] == options.capacity && row[1] == n)
            return number_of("%+.3f if later writers always win", row.back(), 0);
    return "";
}

} // namespace

std::vector<GridRow> slot_rows(Device& device, const SlotOptions& options) {
    const uint32_t capacity = options.capacity;
    std::vector<uint32_t> counts = options.counts;
    if (!options.positions.empty())
        counts = {static_cast<uint32_t>(options.positions.size())};
    else if (counts.empty())
        counts = {std::max(1u, capacity / 4), capacity, 4 * capacity};
    std::vector<GridRow> rows;
    for (const uint32_t n : counts) {
        const std::string head = head_of(options, n);
        const Seen seen = Sampling(device, options, n).all();
        rows.push_back(row_of(head + "occupied share", seen.occupied));
        rows.push_back(row_of(head + "density over the exact one", seen.density));
        rows.push_back(row_of(head + "spread of V over what it should be", seen.spread));
        rows.push_back({"24", head + "bias of V where v = index/n", "", std::nullopt,
                        seen.order_bias, order_note(options, n)});
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
