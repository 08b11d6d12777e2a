#include "follows.hpp"

#include "measures.hpp"
#include "text.hpp"

#include "common/progress.hpp"
#include "generator/generator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace lab::follows {

namespace {

using MapHandle = std::unique_ptr<plait_follow_map, Destroyer<plait_follow_map_destroy>>;

constexpr double rate = 60;     // frames a second
constexpr double shakes = 1;    // a second
constexpr double swing = 0.5;   // rad to either side
constexpr uint64_t seed = 1;    // of the guides
constexpr uint32_t skipped = 2; // frames that are not timed

GroomHandle make_hair(const FollowOptions& options) {
    using namespace plait_generator;
    for (const Hairstyle style : {Hairstyle::Long, Hairstyle::Curly, Hairstyle::Short}) {
        if (hairstyle_name(style) != options.style)
            continue;
        Style chosen = make_style(style);
        chosen.strands = options.strands;
        const Strands made = make_groom(chosen);
        plait_groom_desc desc = plait_groom_desc_defaults();
        desc.positions = {made.positions.data(), made.positions.size() / 3, 3 * sizeof(float)};
        desc.vertex_counts = {made.vertex_counts.data(), made.vertex_counts.size(), 0};
        plait_groom* groom = nullptr;
        check(plait_groom_create(&desc, nullptr, &groom));
        return GroomHandle(groom);
    }
    throw Failure("--style is " + options.style + ", there are long, curly and short");
}

// One sim of the hair, on a head of its own.
class Run {
  public:
    Run(plait_context* context, const plait_groom* groom, uint32_t guides, uint32_t strands);

    void step(uint64_t number);
    Hair read() const;
    std::vector<bool> simulated() const;
    uint32_t guides() const { return guides_; }
    double wall() const; // s

  private:
    void add_colliders();

    uint32_t guides_;
    std::vector<uint32_t> origin_; // of each of the sim's strands, in the groom
    SimHandle sim_;
    std::vector<plait_collider_id> on_head_;
    std::vector<double> times_;
};

Run::Run(plait_context* context, const plait_groom* groom, uint32_t guides, uint32_t strands)
    : guides_(guides), origin_(strands) {
    plait_groom* chosen = nullptr;
    plait_follow_map* map = nullptr;
    check(plait_groom_guides(groom, guides, seed, &chosen, &map));
    const GroomHandle owned(chosen);
    const MapHandle owned_map(map);
    size_t size = origin_.size() * sizeof origin_[0];
    check(plait_follow_map_read(map, PLAIT_FOLLOW_MAP_FIELD_STRANDS, origin_.data(), &size));
    plait_sim_desc desc = plait_sim_desc_defaults();
    desc.follow_map = map;
    desc.sag_free = PLAIT_SAG_FREE_STIFFEN;
    plait_sim* sim = nullptr;
    check(plait_sim_create(context, chosen, &desc, &sim));
    sim_.reset(sim);
    add_colliders();
}

void Run::add_colliders() {
    for (const plait_generator::Capsule& capsule : plait_generator::head_colliders()) {
        plait_collider_desc desc = plait_collider_desc_defaults();
        std::copy_n(capsule.a, 3, desc.a);
        std::copy_n(capsule.b, 3, desc.b);
        desc.radius_a = capsule.radius_a;
        desc.radius_b = capsule.radius_b;
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &desc, &id));
        if (capsule.moves_with_head)
            on_head_.push_back(id);
    }
}

void Run::step(uint64_t number) {
    const double phase = 2 * pi * shakes * static_cast<double>(number) / rate;
    const double half = swing / 2 * std::sin(phase);
    plait_roots roots = plait_roots_defaults();
    roots.head.q[1] = static_cast<float>(std::sin(half));
    roots.head.q[3] = static_cast<float>(std::cos(half));
    const auto start = std::chrono::steady_clock::now();
    check(plait_sim_set_roots(sim_.get(), &roots));
    for (const plait_collider_id id : on_head_)
        check(plait_collider_set_pose(sim_.get(), id, &roots.head));
    check(plait_sim_step(sim_.get(), 1 / rate + 1e-9));
    check(plait_sim_wait(sim_.get()));
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (number > skipped)
        times_.push_back(spent.count());
}

Hair Run::read() const {
    plait_sim_info info = plait_sim_info_defaults();
    check(plait_sim_describe(sim_.get(), &info));
    Hair hair{info.vertices_per_strand, std::vector<uint32_t>(origin_.size()), {}};
    std::vector<uint32_t> counts(origin_.size());
    std::vector<float> floats(4 * origin_.size() * hair.row);
    size_t size = counts.size() * sizeof counts[0];
    check(plait_sim_read(sim_.get(), PLAIT_FIELD_VERTEX_COUNT, counts.data(), &size));
    size = floats.size() * sizeof floats[0];
    check(plait_sim_read(sim_.get(), PLAIT_FIELD_POSITION, floats.data(), &size));
    hair.x.resize(origin_.size() * hair.row);
    for (size_t s = 0; s < origin_.size(); ++s) {
        hair.counts[origin_[s]] = counts[s];
        for (uint32_t i = 0; i < hair.row; ++i)
            hair.x[size_t{origin_[s]} * hair.row + i] = Point(&floats[4 * (s * hair.row + i)]);
    }
    return hair;
}

std::vector<bool> Run::simulated() const {
    std::vector<bool> simulated(origin_.size());
    for (uint32_t s = 0; s < guides_; ++s)
        simulated[origin_[s]] = true;
    return simulated;
}

double Run::wall() const {
    if (times_.empty()) // interrupted
        return 0;
    std::vector<double> times = times_;
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
}

void check_guides(const FollowOptions& options) {
    for (const uint32_t guides : options.guides)
        if (guides < 1 || guides >= options.strands)
            throw Failure("--guides has " + std::to_string(guides) + ", range is [1, " +
                          std::to_string(options.strands - 1) + "], the strands less one");
}

} // namespace

// Frame by frame, so that a busy machine is busy for all of them.
std::vector<FollowRow> measure_follows(Contexts& contexts, const FollowOptions& options) {
    check_guides(options);
    const GroomHandle groom = make_hair(options);
    plait_context* const context = contexts.of(*find_model("articulated"));
    std::vector<uint32_t> numbers = options.guides;
    numbers.push_back(options.strands);
    std::vector<std::unique_ptr<Run>> runs;
    std::vector<Measures> measures;
    for (const uint32_t guides : numbers) {
        runs.push_back(std::make_unique<Run>(context, groom.get(), guides, options.strands));
        measures.emplace_back(runs.back()->read(), runs.back()->simulated());
    }
    const auto frames = static_cast<uint64_t>(std::max(4.0, options.seconds * rate));
    for (uint64_t frame = 1; frame <= frames && !interrupted(); ++frame) {
        for (const auto& run : runs)
            run->step(frame);
        const Hair truth = runs.back()->read();
        for (size_t i = 0; i < runs.size(); ++i)
            measures[i].add(runs[i]->read(), truth);
    }
    std::vector<FollowRow> rows;
    for (size_t i = 0; i < runs.size(); ++i) {
        rows.push_back({runs[i]->guides(), 1e3 * runs[i]->wall()});
        measures[i].finish(rows.back());
    }
    return rows;
}

std::string follows_csv(const std::vector<FollowRow>& rows) {
    std::string csv = "guides,ms,length,kink_deg,tip_step,beside,away_m\n";
    for (const FollowRow& row : rows)
        csv += text("%u,%.4g,%.3g,%.4g,%.3g,%.3g,%.4g\n", row.guides, row.wall, row.length,
                    row.kink, row.step, row.beside, row.away);
    return csv;
}

std::string follows_text(const std::vector<FollowRow>& rows) {
    std::string all =
        "guides   ms/frame  length error  kink, deg  tip step  neighbours  from all, mm\n";
    for (const FollowRow& row : rows)
        all += text("%6u %10.2f %13.1e %10.1f %9.2f %11.2f %13.1f\n", row.guides, row.wall,
                    row.length, row.kink, row.step, row.beside, 1e3 * row.away);
    return all +
           "tip step: of follows over the guides'; neighbours: least of 99 % of their distances, "
           "over that at rest\n";
}

} // namespace lab::follows
