// What each feature adds to a frame, and on which stages a frame's time goes. Hair on a head that turns to
// and fro; a frame's time is measured without a profile, that of its stages with one.
#include "bench.hpp"
#include "sim.hpp"

#include <algorithm>
#include <memory>

namespace bench {
namespace {

constexpr uint32_t settling = 30; // frames before those that count
constexpr uint32_t followed = 10; // strands for each guide, of follows

struct Feature {
    const char* name;
    const char* over; // the feature, one before, that its time is held against
    plait_model model = PLAIT_MODEL_ARTICULATED;
    uint32_t share = 1;   // of the strands, one in so many
    bool follows = false; // and the others follow
    Bodies bodies = {};
    void (*choose)(plait::SimDesc&) = [](plait::SimDesc&) {};
    void (*set)(plait_sim*) = [](plait_sim*) {};
};

template <uint32_t edge_count> void with_volume(plait::SimDesc& desc) {
    desc.volume.on = desc.grid.on = true;
    desc.grid.edge_count = edge_count;
}

void with_wetness(plait::SimDesc& desc) {
    with_volume<16>(desc);
    desc.wetness.on = true;
}

void with_slots(plait::SimDesc& desc) {
    desc.grid.on = true;
    desc.grid.form = PLAIT_GRID_FORM_SLOTS;
}

template <bool shelter, bool eddies> void blow(plait_sim* sim) {
    plait_wind_desc wind = plait_wind_desc_defaults();
    wind.velocity[0] = 3;
    wind.shelter = shelter ? 1 : 0;
    wind.turbulence = eddies ? 1 : 0;
    check(plait_sim_set_wind(sim, &wind));
}

void curl(plait_sim* sim) {
    plait_detail_desc detail = plait_detail_desc_defaults();
    constexpr float knots[] = {0, 0.3f, 0.7f, 0.9f};
    std::ranges::copy(knots, detail.clump);
    std::ranges::transform(knots, detail.curl, [](float knot) { return 0.005f * knot; }); // m
    check(plait_sim_set_detail(sim, &detail));
}

void pin_middles(plait_sim* sim) {
    plait_sim_info info = plait_sim_info_defaults();
    check(plait_sim_describe(sim, &info));
    std::vector<plait_pin> pins(info.strands);
    for (uint32_t strand = 0; strand < info.strands; ++strand)
        pins[strand] = {strand, model_vertices / 2, PLAIT_PIN_FRAME_REST, {}, PLAIT_PIN_HELD};
    check(plait_sim_set_pins(sim, pins.data(), pins.size()));
}

const Feature features[] = {
    {.name = "alone", .over = "alone"},
    {.name = "capsules", .over = "alone", .bodies = {Shape::capsules}},
    {.name = "field", .over = "alone", .bodies = {Shape::field}},
    {.name = "field:far", .over = "alone", .bodies = {.shape = Shape::field, .far = true}},
    {.name = "nearest", .over = "alone", .bodies = {Shape::nearest}},
    {.name = "nearest:far", .over = "alone", .bodies = {.shape = Shape::nearest, .far = true}},
    {.name = "nearest:bends", .over = "alone", .bodies = {.shape = Shape::nearest, .bends = true}},
    {.name = "ball:alone", .over = "ball:alone", .bodies = {.ball = true}},
    {.name = "ball:capsule",
     .over = "ball:alone",
     .bodies = {.shape = Shape::capsules, .ball = true}},
    {.name = "ball:field", .over = "ball:alone", .bodies = {.shape = Shape::field, .ball = true}},
    {.name = "ball:nearest",
     .over = "ball:alone",
     .bodies = {.shape = Shape::nearest, .ball = true}},
    {.name = "grid", .over = "alone", .choose = [](plait::SimDesc& desc) { desc.grid.on = true; }},
    {.name = "volume:16", .over = "alone", .choose = with_volume<16>},
    {.name = "volume:32", .over = "alone", .choose = with_volume<32>},
    {.name = "wetness", .over = "volume:16", .choose = with_wetness},
    {.name = "wind", .over = "alone", .set = blow<false, false>},
    {.name = "shelter", .over = "alone", .set = blow<true, false>},
    {.name = "eddies", .over = "alone", .set = blow<true, true>},
    {.name = "pins", .over = "alone", .set = pin_middles},
    {.name = "guides", .over = "guides", .share = followed},
    {.name = "strand_contact",
     .over = "guides",
     .share = followed,
     .choose = [](plait::SimDesc& desc) { desc.strand_contact.on = true; }},
    {.name = "follows", .over = "guides", .share = followed, .follows = true},
    {.name = "detail", .over = "guides", .share = followed, .follows = true, .set = curl},
    {.name = "detail+capsules",
     .over = "guides",
     .share = followed,
     .follows = true,
     .bodies = {Shape::capsules},
     .set = curl},
    {.name = "tressfx", .over = "tressfx", .model = PLAIT_MODEL_TRESSFX},
    {.name = "tressfx+capsules",
     .over = "tressfx",
     .model = PLAIT_MODEL_TRESSFX,
     .bodies = {Shape::capsules}},
    {.name = "tressfx+slots",
     .over = "tressfx",
     .model = PLAIT_MODEL_TRESSFX,
     .choose = with_slots},
};

// One of them, ready to go on frame by frame.
class Hair {
  public:
    Hair(const plait_device_info& device, const Feature& feature, uint32_t strands, bool profile)
        : context_(make_context(device, {.profile = profile})) {
        Groom groom = feature.bodies.ball
                          ? ball_hair(strands)
                          : long_hair(feature.follows ? strands : strands / feature.share);
        plait::SimDesc desc;
        desc.model = feature.model;
        feature.choose(desc);
        plait_follow_map* map = nullptr;
        if (feature.follows) {
            plait_groom* guides = nullptr;
            check(plait_groom_guides(groom.get(), strands / feature.share, 1, &guides, &map));
            groom.reset(guides);
        }
        const std::unique_ptr<plait_follow_map, Destroy<plait_follow_map_destroy>> owned(map);
        desc.follow_map = map;
        character_ = std::make_unique<Character>(context_.get(), groom.get(), desc, feature.bodies);
        feature.set(character_->sim());
        for (uint32_t i = 0; i < settling; ++i)
            seconds_of_frame();
    }

    double seconds_of_frame() {
        const auto start = std::chrono::steady_clock::now();
        character_->aim();
        check(plait_sim_step(sim(), 1.0 / 60 + 1e-9));
        check(plait_sim_wait(sim()));
        return seconds_since(start);
    }

    plait_sim* sim() const { return character_->sim(); }

  private:
    Context context_;
    std::unique_ptr<Character> character_;
};

// Of a frame, in the mean of a turn.
std::map<std::string, StageSums> stages_of_frame(Hair hair) {
    take_stage_sums(hair.sim());
    for (uint32_t i = 0; i < frames_of_turn; ++i)
        hair.seconds_of_frame();
    auto sums = take_stage_sums(hair.sim());
    for (auto& [stage, sum] : sums) {
        sum.seconds /= frames_of_turn;
        sum.calls /= frames_of_turn;
        sum.bytes /= frames_of_turn;
    }
    return sums;
}

void measure(benchmark::State& state, uint32_t index, const Feature& feature, Results& results) {
    DeviceResults& device = results.devices[index];
    const uint32_t strands = std::max(results.options.strands, followed);
    FeatureRow row{feature.name, feature.over, 0,
                   stages_of_frame(Hair(device.device, feature, strands, true))};
    Hair hair(device.device, feature, strands, false);
    for ([[maybe_unused]] auto _ : state) {
        double turn = 0;
        for (uint32_t i = 0; i < frames_of_turn; ++i)
            turn += hair.seconds_of_frame();
        state.SetIterationTime(turn);
        row.seconds += turn / frames_of_turn;
    }
    row.seconds /= static_cast<double>(state.iterations());
    state.counters["ms/frame"] = 1e3 * row.seconds;
    for (const auto& [stage, sum] : row.stages)
        state.counters["us:" + stage] = 1e6 * sum.seconds;
    std::erase_if(device.features, [&](const FeatureRow& one) { return one.name == row.name; });
    device.features.push_back(row);
}

} // namespace

void register_features(uint32_t device, Results& results) {
    for (const Feature& feature : features)
        register_row("device:" + std::to_string(device) + "/feature/" + feature.name, results,
                     [device, &feature, &results](benchmark::State& state) {
                         measure(state, device, feature, results);
                     });
}

} // namespace bench
