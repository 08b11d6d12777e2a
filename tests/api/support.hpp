// Small grooms and sims for the tests of the C API.
#pragma once

#include <plait/plait.hpp>
#include <plait/plait_backend.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using Point = std::array<float, 3>;
using Strand = std::vector<Point>;
using Strands = std::vector<Strand>;

// A strand of `count` vertices `spacing` m apart, leaving `root` along x with a curl of its own.
inline Strand curl(Point root, size_t count, float spacing = 0.02f, float phase = 0) {
    Strand strand{root};
    for (size_t i = 1; i < count; ++i) {
        const float angle = 0.35f * static_cast<float>(i) + phase;
        const Point& last = strand.back();
        strand.push_back({last[0] + 0.9f * spacing, last[1] + 0.3f * spacing * std::cos(angle),
                          last[2] + 0.3f * spacing * std::sin(angle)});
    }
    return strand;
}

inline Strands tuft(size_t strands, size_t vertices) {
    Strands tuft;
    for (size_t i = 0; i < strands; ++i)
        tuft.push_back(curl({0, 0.01f * static_cast<float>(i), 0}, vertices, 0.02f,
                            0.5f * static_cast<float>(i)));
    return tuft;
}

// Curls of different lengths, 5 mm apart.
inline Strands field(size_t side) {
    Strands strands;
    for (size_t i = 0; i < side * side; ++i)
        strands.push_back(
            curl({0.005f * static_cast<float>(i / side), 0, 0.005f * static_cast<float>(i % side)},
                 7 + i % 5, 0.02f, 0.3f * static_cast<float>(i)));
    return strands;
}

struct GroomArrays {
    std::vector<float> positions;
    std::vector<uint32_t> counts;

    explicit GroomArrays(const Strands& strands) {
        for (const Strand& strand : strands) {
            counts.push_back(static_cast<uint32_t>(strand.size()));
            for (const Point& p : strand)
                positions.insert(positions.end(), p.begin(), p.end());
        }
    }
    plait_groom_desc desc() const {
        auto desc = plait_groom_desc_defaults();
        desc.positions = plait::view(positions, 3);
        desc.vertex_counts = plait::view(counts);
        return desc;
    }
};

inline plait::Groom make_groom(const Strands& strands) {
    return plait::Groom(GroomArrays(strands).desc());
}

inline plait::Context make_context(const std::string& backend) {
    auto desc = plait_context_desc_defaults();
    desc.backend = backend.c_str();
    return plait::Context(desc);
}

inline plait_roots head_at(Point t, std::array<float, 4> q = {0, 0, 0, 1}) {
    auto roots = plait_roots_defaults();
    std::copy(t.begin(), t.end(), roots.head.t);
    std::copy(q.begin(), q.end(), roots.head.q);
    return roots;
}

// A collider without friction.
inline plait_collider_desc smooth_collider() {
    auto desc = plait_collider_desc_defaults();
    desc.friction = 0;
    return desc;
}

// The ways of the grid between strands.
enum class Grid { off, slots, exact };

inline void set_grid(plait::SimDesc& desc, Grid grid) {
    desc.grid.on = grid != Grid::off;
    desc.grid.form = grid == Grid::slots ? PLAIT_GRID_FORM_SLOTS : PLAIT_GRID_FORM_EXACT;
}

// The parity model, for what only it has: two vertices that the root holds, and stages by option.
inline plait::SimDesc tressfx_desc() {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_TRESSFX;
    return desc;
}

// Backends with a device here; `reference` always.
inline std::vector<std::string> backends() {
    std::vector<std::string> names;
    for (const plait_device_info& info : plait::devices())
        if (names.empty() || names.back() != info.backend)
            names.push_back(info.backend);
    return names;
}

// One context per test on each backend.
class OnBackend : public testing::TestWithParam<std::string> {
  protected:
    plait::Context context = make_context(GetParam());
};
#define ON_EVERY_BACKEND(suite)                                                                    \
    INSTANTIATE_TEST_SUITE_P(Backends, suite, testing::ValuesIn(backends()),                       \
                             [](const auto& backend) { return backend.param; })

inline void expect_failure(plait_result result, plait_result expected, const char* text) {
    EXPECT_EQ(result, expected) << plait_last_error();
    EXPECT_NE(std::string(plait_last_error()).find(text), std::string::npos) << plait_last_error();
}

constexpr double frame = 1.0 / 60;

inline void run(plait::Sim& sim, int steps) {
    for (int i = 0; i < steps; ++i)
        sim.step(frame);
}

// Names and calls of the stages of three steps.
inline std::vector<std::pair<std::string, uint64_t>> stages_of(plait::Sim& sim) {
    sim.stage_times(true);
    run(sim, 3);
    std::vector<std::pair<std::string, uint64_t>> list;
    for (const plait_stage_time& time : sim.stage_times())
        list.emplace_back(time.stage, time.calls);
    return list;
}

// The stages launched since they were taken last, in their order; of a context that profiles.
inline std::vector<std::string> launched_stages(plait::Sim& sim) {
    std::vector<std::string> names;
    for (const plait_launch& launch : sim.take_launches())
        names.emplace_back(launch.stage);
    return names;
}

inline float largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    float largest = 0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(
            largest, std::isfinite(a[i]) && std::isfinite(b[i]) ? std::abs(a[i] - b[i]) : INFINITY);
    return largest;
}

// Settings with so many substeps and nothing else.
inline plait_strand_settings of_substeps(uint32_t substeps) {
    auto settings = plait_strand_settings_defaults();
    settings.substeps = substeps;
    return settings;
}
// Each guide in so many substeps, 1 to 4.
inline void take_substeps(plait::Sim& sim, const std::vector<uint32_t>& substeps) {
    std::vector<uint32_t> of;
    for (const uint32_t n : substeps)
        of.push_back(n - 1);
    sim.set_settings({of_substeps(1), of_substeps(2), of_substeps(3), of_substeps(4)}, of);
}
inline std::vector<uint32_t> substeps_of(const plait::Sim& sim) {
    std::vector<uint32_t> substeps;
    for (const plait_strand_settings& settings : sim.settings())
        substeps.push_back(settings.substeps);
    return substeps;
}
