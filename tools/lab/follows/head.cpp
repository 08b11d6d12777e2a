#include "head.hpp"
#include "common/collider_reader.hpp"

#include "generator/generator.hpp"

#include <plait/plait.hpp>
#include <plait/plait_offline.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace lab::follows {

namespace {

constexpr uint64_t seed = 1;    // of the guides
constexpr uint32_t skipped = 2; // frames that are not timed

} // namespace

plait_roots turned(double turn, double nod, double tilt) {
    const Quat q = Quat(Eigen::AngleAxisd(turn, Vec3::UnitY())) *
                   Quat(Eigen::AngleAxisd(nod, Vec3::UnitX())) *
                   Quat(Eigen::AngleAxisd(tilt, Vec3::UnitZ()));
    plait_roots roots = plait_roots_defaults();
    for (int i = 0; i < 4; ++i)
        roots.head.q[i] = static_cast<float>(q.coeffs()[i]);
    return roots;
}

double wave(double seconds, double hertz) {
    return std::sin(2 * pi * hertz * seconds);
}

uint64_t frames_of(double seconds) {
    return static_cast<uint64_t>(std::max(4.0, seconds * rate));
}

plait_roots shaking(double seconds) {
    return turned(0.45 * wave(seconds, 0.9), 0.15 * wave(seconds, 0.31), 0.2 * wave(seconds, 0.53));
}

plait_roots nodding(double seconds) {
    return turned(0.6 * wave(seconds, 0.4), 0.3 * wave(seconds, 0.7), 0);
}

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

Choice choose(const plait_groom* groom, uint32_t guides, uint32_t strands) {
    plait_groom* chosen = nullptr;
    plait_follow_map* map = nullptr;
    check(plait_groom_guides(groom, guides, seed, &chosen, &map));
    return make_choice(guides, chosen, map, strands);
}

Choice make_choice(uint32_t guides, plait_groom* chosen, plait_follow_map* map, uint32_t strands) {
    Choice choice{guides, GroomHandle(chosen), MapHandle(map), std::vector<uint32_t>(strands)};
    size_t size = choice.origin.size() * sizeof choice.origin[0];
    check(plait_follow_map_read(map, PLAIT_FOLLOW_MAP_FIELD_STRANDS, choice.origin.data(), &size));
    return choice;
}

Choice choose_all(GroomHandle groom, uint32_t strands) {
    Choice all{strands, std::move(groom), nullptr, std::vector<uint32_t>(strands)};
    std::iota(all.origin.begin(), all.origin.end(), 0u);
    return all;
}

Run::Run(plait_context* context, const Choice& choice, const plait_follow_map* map, RunOptions how)
    : choice_(choice) {
    plait::SimDesc desc;
    desc.substeps = how.substeps;
    desc.follow_map = map;
    desc.sag_free = how.sag_free;
    plait_sim* sim = nullptr;
    check(plait::create_sim(context, choice.groom.get(), desc, &sim));
    sim_.reset(sim);
    add_colliders();
}

void Run::add_colliders() {
    for (const plait_generator::Capsule& capsule : plait_generator::head_colliders()) {
        plait_collider_desc desc = common::smooth_collider();
        std::copy_n(capsule.a, 3, desc.capsule.a);
        std::copy_n(capsule.b, 3, desc.capsule.b);
        desc.capsule.radius_a = capsule.radius_a;
        desc.capsule.radius_b = capsule.radius_b;
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &desc, &id));
        (capsule.moves_with_head ? on_head_ : below_).push_back(id);
    }
}

void Run::step(uint64_t number, const Motion& motion) {
    const plait_roots roots = motion(static_cast<double>(number) / rate);
    plait_pose body = plait_roots_defaults().head;
    std::copy_n(roots.head.t, 3, body.t);
    const auto start = std::chrono::steady_clock::now();
    check(plait_sim_set_roots(sim_.get(), &roots));
    for (const plait_collider_id id : on_head_)
        check(plait_collider_set_pose(sim_.get(), id, &roots.head));
    for (const plait_collider_id id : below_)
        check(plait_collider_set_pose(sim_.get(), id, &body));
    check(plait_sim_step(sim_.get(), 1 / rate + 1e-9));
    check(plait_sim_wait(sim_.get()));
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (number > skipped)
        times_.push_back(spent.count());
}

void Run::stand() {
    const plait_roots roots = plait_roots_defaults();
    for (const auto* ids : {&on_head_, &below_})
        for (const plait_collider_id id : *ids)
            check(plait_collider_set_pose(sim_.get(), id, &roots.head));
    check(plait_sim_teleport(sim_.get(), &roots));
    check(plait_sim_reset(sim_.get()));
}

void Run::blow(float speed) {
    plait_wind_desc wind = plait_wind_desc_defaults();
    wind.velocity[0] = speed;
    check(plait_sim_set_wind(sim_.get(), speed > 0 ? &wind : nullptr));
}

Hair Run::read() const {
    plait_sim_info info = plait_sim_info_defaults();
    check(plait_sim_describe(sim_.get(), &info));
    const auto& origin = choice_.origin;
    Hair hair{info.vertices_per_strand, std::vector<uint32_t>(origin.size()), {}};
    std::vector<uint32_t> counts(origin.size());
    std::vector<float> floats(4 * origin.size() * hair.row);
    size_t size = counts.size() * sizeof counts[0];
    check(plait_sim_read(sim_.get(), PLAIT_FIELD_VERTEX_COUNT, counts.data(), &size));
    size = floats.size() * sizeof floats[0];
    check(plait_sim_read(sim_.get(), PLAIT_FIELD_POSITION, floats.data(), &size));
    hair.x.resize(origin.size() * hair.row);
    for (size_t s = 0; s < origin.size(); ++s) {
        hair.counts[origin[s]] = counts[s];
        for (uint32_t i = 0; i < hair.row; ++i)
            hair.x[size_t{origin[s]} * hair.row + i] = Point(&floats[4 * (s * hair.row + i)]);
    }
    return hair;
}

std::vector<bool> Run::simulated() const {
    std::vector<bool> simulated(choice_.origin.size());
    for (uint32_t s = 0; s < choice_.guides; ++s)
        simulated[choice_.origin[s]] = true;
    return simulated;
}

double Run::wall() const {
    const auto least = std::min_element(times_.begin(), times_.end());
    return least == times_.end() ? 0 : *least; // none: interrupted
}

} // namespace lab::follows
