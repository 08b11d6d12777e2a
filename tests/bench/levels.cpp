// What levels and their director are for: a hero near the camera and twenty others behind, all of long hair
// with bodies, simulated in full and within a budget.
#include "bench.hpp"
#include "sim.hpp"

#include <plait/plait_levels.h>

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

constexpr uint32_t heads = 21, strands = 4000;
constexpr uint32_t settling = 60; // frames before those that count
constexpr double frame = 1.0 / 60;

using Levels = std::unique_ptr<plait_levels, Destroy<plait_levels_destroy>>;

Levels levels_of(const plait_groom* groom) {
    plait_levels_desc desc = plait_levels_desc_defaults();
    desc.groom = groom;
    plait_levels* levels = nullptr;
    check(plait_levels_create(&desc, &levels));
    return Levels(levels);
}

// 1080 lines, a view of 40 degrees.
float pixels_per_metre(double metres) {
    return static_cast<float>(1080 / (2 * std::tan(0.349) * metres));
}

class Crowd {
  public:
    Crowd(const plait_device_info& device, double budget)
        : context_(make_context(device)), groom_(long_hair(strands)),
          levels_(levels_of(groom_.get())) {
        director_.budget_ms = static_cast<float>(budget);
        director_.tolerance_px = 1;
        plait::SimDesc desc;
        if (budget > 0)
            desc.levels = levels_.get();
        for (uint32_t i = 0; i < heads; ++i) {
            characters_.emplace_back(context_.get(), groom_.get(), desc, Bodies{Shape::capsules});
            sims_.push_back(characters_.back().sim());
            plait_character directed = plait_character_defaults();
            directed.sim = sims_.back();
            directed.pixels_per_metre = pixels_per_metre(i == 0 ? 0.6 : 2 + 2 * (i - 1));
            directed_.push_back(directed);
        }
    }

    double seconds_of_frame() {
        const auto start = std::chrono::steady_clock::now();
        for (Character& character : characters_)
            character.aim();
        if (director_.budget_ms > 0)
            check(plait_context_direct(context_.get(), directed_.data(), heads, &director_, frame,
                                       &info_));
        check(plait_context_step(context_.get(), sims_.data(), heads, frame + 1e-9));
        for (plait_sim* sim : sims_)
            check(plait_sim_wait(sim));
        const double seconds = seconds_since(start);
        director_.last_ms = static_cast<float>(1e3 * seconds);
        return seconds;
    }
    float worst_px() const { return info_.worst_px; }

  private:
    Context context_;
    Groom groom_;
    Levels levels_;
    std::vector<Character> characters_;
    std::vector<plait_sim*> sims_;
    std::vector<plait_character> directed_;
    plait_director_desc director_ = plait_director_desc_defaults();
    plait_director_info info_ = plait_director_info_defaults();
};

} // namespace

void register_levels(uint32_t index, Results& results) {
    for (const uint32_t budget : {0u, 4u, 2u})
        register_row("device:" + std::to_string(index) + "/levels/budget:" + std::to_string(budget),
                     results, [=, &results](benchmark::State& state) {
                         DeviceResults& device = results.devices[index];
                         Crowd crowd(device.device, budget);
                         for (uint32_t i = 0; i < settling; ++i)
                             crowd.seconds_of_frame();
                         std::vector<double> seconds;
                         for ([[maybe_unused]] auto _ : state) {
                             seconds.push_back(crowd.seconds_of_frame());
                             state.SetIterationTime(seconds.back());
                         }
                         std::ranges::sort(seconds);
                         const LevelsRow row{seconds[seconds.size() / 2],
                                             seconds[seconds.size() * 19 / 20], crowd.worst_px()};
                         device.levels[budget] = row;
                         state.counters["ms"] = 1e3 * row.median;
                         state.counters["ms_95"] = 1e3 * row.slow;
                         state.counters["worst_px"] = row.worst_px;
                     });
}

} // namespace bench
