// A frame as a character has it: long hair on the mannequin, whose head turns to and fro, alone,
// with the mannequin's capsules, and with these and the grid between strands. Then little hair,
// where what a frame costs whatever its size is most of it, and many characters beside one of as
// many strands.
#include "bench.hpp"
#include "sim.hpp"

#include <map>
#include <vector>

namespace bench {
namespace {

constexpr uint32_t strand_counts[] = {3000, 30000};
constexpr uint32_t few_strands = 100;
constexpr uint32_t settling = 30; // frames before those that count
constexpr const char* scenes[] = {"alone", "bodies", "everything"};

struct Crowd {
    uint32_t sims, strands; // of each
    bool together;          // in one call, else one after another
};
constexpr Crowd crowds[] = {{100, 500, true}, {100, 500, false}, {1, 50000, true}};

plait::SimDesc desc_of(plait_model model, Scene scene) {
    plait::SimDesc desc;
    desc.model = model;
    desc.grid.on = scene == Scene::everything;
    return desc;
}

// All characters of one context.
class Stage {
  public:
    Stage(const plait_device_info& device, plait_groom* groom, plait_model model, Scene scene,
          const Crowd& crowd)
        : context_(make_context(device)), together_(crowd.together) {
        for (uint32_t i = 0; i < crowd.sims; ++i) {
            characters_.emplace_back(context_.get(), groom, desc_of(model, scene),
                                     Bodies{scene == Scene::alone ? Shape::none : Shape::capsules});
            sims_.push_back(characters_.back().sim());
        }
    }

    double seconds_of_frame() {
        const auto start = std::chrono::steady_clock::now();
        for (Character& character : characters_)
            character.aim();
        step(1.0 / 60 + 1e-9);
        check(plait_sim_wait(sims_.back())); // waits for all that was put on the device
        return seconds_since(start);
    }

  private:
    void step(double dt) {
        if (together_)
            check(plait_context_step(context_.get(), sims_.data(), sims_.size(), dt));
        else
            for (plait_sim* sim : sims_)
                check(plait_sim_step(sim, dt));
    }

    Context context_;
    std::vector<Character> characters_;
    std::vector<plait_sim*> sims_;
    bool together_;
};

std::string row_name(uint32_t device, const std::string& group, uint32_t strands, const char* model,
                     Scene scene) {
    return "device:" + std::to_string(device) + "/" + group +
           "/strands:" + std::to_string(strands) + "/" + model + "/" +
           scenes[static_cast<int>(scene)];
}

// Grooms, grown by the first row that is run.
using Grooms = std::map<uint32_t, Groom>;

// Seconds of a frame, a mean over whole turns, since what touches changes with the turn.
double measure_turns(benchmark::State& state, Stage& stage) {
    for (uint32_t i = 0; i < settling; ++i)
        stage.seconds_of_frame();
    double total = 0;
    uint64_t frames = 0;
    for ([[maybe_unused]] auto _ : state) {
        double turn = 0;
        for (uint32_t i = 0; i < frames_of_turn; ++i)
            turn += stage.seconds_of_frame();
        state.SetIterationTime(turn);
        total += turn;
        frames += frames_of_turn;
    }
    const double seconds = total / static_cast<double>(frames);
    state.counters["ms/frame"] = 1e3 * seconds;
    return seconds;
}

void register_crowd(uint32_t index, const Crowd& crowd, const NamedModel& named, Scene scene,
                    const std::shared_ptr<Grooms>& grooms, Results& results) {
    const std::string group =
        "sims:" + std::to_string(crowd.sims) + (crowd.together ? "" : "/apart");
    register_row(
        row_name(index, group, crowd.strands, named.name, scene), results,
        [=, &named, &results](benchmark::State& state) {
            Groom& groom = (*grooms)[crowd.strands];
            if (!groom)
                groom = long_hair(crowd.strands);
            DeviceResults& device = results.devices[index];
            Stage stage(device.device, groom.get(), named.model, scene, crowd);
            device.crowd_seconds[{crowd.sims, crowd.strands, named.name, scene, crowd.together}] =
                measure_turns(state, stage);
        });
}

} // namespace

void register_characters(uint32_t index, Results& results) {
    const auto grooms = std::make_shared<Grooms>();
    for (const uint32_t strands : strand_counts)
        for (const NamedModel& named : models)
            for (const Scene scene : {Scene::alone, Scene::bodies, Scene::everything})
                register_row(row_name(index, "character", strands, named.name, scene), results,
                             [=, &named, &results](benchmark::State& state) {
                                 Groom& groom = (*grooms)[strands];
                                 if (!groom)
                                     groom = long_hair(strands);
                                 DeviceResults& device = results.devices[index];
                                 Stage one(device.device, groom.get(), named.model, scene,
                                           {1, strands, true});
                                 device.character_seconds[{strands, named.name, scene}] =
                                     measure_turns(state, one);
                             });
    for (const NamedModel& named : models)
        register_crowd(index, {1, few_strands, true}, named, Scene::everything, grooms, results);
    for (const NamedModel& named : models)
        if (named.model == plait::SimDesc().model)
            for (const Scene scene : {Scene::alone, Scene::bodies, Scene::everything})
                for (const Crowd& crowd : crowds)
                    register_crowd(index, crowd, named, scene, grooms, results);
}

} // namespace bench
