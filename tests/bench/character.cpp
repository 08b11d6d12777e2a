// A frame as a character has it: long hair on the mannequin, whose head turns to and fro, alone, with
// the mannequin's capsules, and with these and the grid between strands.
#include "bench.hpp"
#include "sim.hpp"

#include <generator/generator.hpp>

#include <cmath>
#include <vector>

namespace bench {
namespace {

constexpr uint32_t strand_counts[] = {3000, 30000};
constexpr uint32_t settling = 30;       // frames before those that count
constexpr uint32_t frames_of_turn = 60; // there and back

Groom long_hair(uint32_t strands) {
    plait_generator::Style style = plait_generator::make_style(plait_generator::Hairstyle::Long);
    style.strands = strands;
    style.vertices = model_vertices;
    const plait_generator::Strands hair = plait_generator::make_groom(style);
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {hair.positions.data(), hair.positions.size() / 3, 0};
    desc.vertices_per_strand = model_vertices;
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, nullptr, &groom));
    return Groom(groom);
}

class Character {
  public:
    Character(const plait_device_info& device, plait_groom* groom, plait_model model, Scene scene)
        : context_(make_context(device)) {
        plait_sim_desc desc = plait_sim_desc_defaults();
        desc.model = model;
        desc.params.interhair =
            scene == Scene::everything ? PLAIT_INTERHAIR_EXACT : PLAIT_INTERHAIR_OFF;
        sim_ = make_sim(context_.get(), groom, desc);
        if (scene != Scene::alone)
            for (const auto& capsule : plait_generator::head_colliders())
                add(capsule);
        for (uint32_t i = 0; i < settling; ++i)
            frame();
    }

    // Seconds.
    double frame() {
        const float turn = static_cast<float>(number_++ % frames_of_turn) / frames_of_turn;
        const float half = 0.25f * std::sin(6.2831853f * turn); // rad, about y
        plait_roots roots = plait_roots_defaults();
        roots.head = {{0, std::sin(half), 0, std::cos(half)}, {0, 0, 0}};
        const auto start = std::chrono::steady_clock::now();
        check(plait_sim_set_roots(sim_.get(), &roots));
        for (const plait_collider_id collider : on_head_)
            check(plait_collider_set_pose(sim_.get(), collider, &roots.head));
        check(plait_sim_step(sim_.get(), 1.0 / 60 + 1e-9));
        check(plait_sim_wait(sim_.get()));
        return seconds_since(start);
    }

  private:
    void add(const plait_generator::Capsule& capsule) {
        plait_collider_desc desc = plait_collider_desc_defaults();
        for (int i = 0; i < 3; ++i) {
            desc.a[i] = capsule.a[i];
            desc.b[i] = capsule.b[i];
        }
        desc.radius_a = capsule.radius_a;
        desc.radius_b = capsule.radius_b;
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &desc, &id));
        if (capsule.moves_with_head)
            on_head_.push_back(id);
    }

    Context context_;
    Sim sim_;
    std::vector<plait_collider_id> on_head_;
    uint32_t number_ = 0;
};

// Over whole turns, since what touches changes with the turn.
void measure(benchmark::State& state, Character& character, double& seconds) {
    double total = 0;
    uint64_t frames = 0;
    for ([[maybe_unused]] auto _ : state) {
        double turn = 0;
        for (uint32_t i = 0; i < frames_of_turn; ++i)
            turn += character.frame();
        state.SetIterationTime(turn);
        total += turn;
        frames += frames_of_turn;
    }
    seconds = total / static_cast<double>(frames);
    state.counters["ms/frame"] = 1e3 * seconds;
}

} // namespace

void register_characters(uint32_t index, Results& results) {
    constexpr const char* scenes[] = {"alone", "bodies", "everything"};
    for (const uint32_t strands : strand_counts) {
        const auto groom = std::make_shared<Groom>(); // grown by the first row that is run
        for (const NamedModel& named : models)
            for (const Scene scene : {Scene::alone, Scene::bodies, Scene::everything})
                register_row("device:" + std::to_string(index) + "/character/strands:" +
                                 std::to_string(strands) + "/" + named.name + "/" +
                                 scenes[static_cast<int>(scene)],
                             results,
                             [=, &named, &results](benchmark::State& state) {
                                 DeviceResults& device = results.devices[index];
                                 if (!*groom)
                                     *groom = long_hair(strands);
                                 Character character(device.device, groom->get(), named.model,
                                                     scene);
                                 measure(state, character,
                                         device.character_seconds[{strands, named.name, scene}]);
                             });
    }
}

} // namespace bench
