#include "run.hpp"
#include "common/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace simulate {

namespace {

ContextHandle make_context(const Scene& scene) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = scene.backend.empty() ? nullptr : scene.backend.c_str();
    desc.device = scene.device.empty() ? nullptr : scene.device.c_str();
    desc.profile = 1;
    plait_context* context = nullptr;
    check(plait_context_create(&desc, &context));
    return ContextHandle(context);
}

SimHandle make_sim(plait_context* context, const plait_groom* groom, const plait_sim_desc& desc) {
    plait_sim* sim = nullptr;
    check(plait_sim_create(context, groom, &desc, &sim));
    return SimHandle(sim);
}

plait_sim_stats stats_of(plait_sim* sim) {
    plait_sim_stats stats{};
    stats.struct_size = sizeof stats;
    check(plait_sim_get_stats(sim, &stats));
    return stats;
}

template <typename T> void read_field(plait_sim* sim, plait_field field, std::vector<T>& into) {
    size_t size = 0;
    check(plait_sim_read(sim, field, nullptr, &size));
    into.resize(size / sizeof(T));
    check(plait_sim_read(sim, field, into.data(), &size));
}

} // namespace

double Measurements::median_ms() const {
    if (frame_ms.empty())
        return 0.0;
    std::vector<double> sorted = frame_ms;
    const auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

Simulation::Simulation(const Scene& scene, const Figure& figure)
    : scene_(scene), figure_(figure), context_(make_context(scene)),
      sim_(make_sim(context_.get(), figure.groom.get(), scene.sim)) {
    row_ = stats_of(sim_.get()).vertices_per_strand;
    read_field(sim_.get(), PLAIT_FIELD_VERTEX_COUNT, vertex_count_);
    read_field(sim_.get(), PLAIT_FIELD_POSITION, rest_);
    neighbours_ = std::make_unique<Neighbours>(rest_, vertex_count_, row_);
    add_colliders();
}

plait_sim_stats Simulation::stats() const {
    return stats_of(sim_.get());
}

void Simulation::add_colliders() {
    const auto create = [&](const plait_collider_desc& shape) {
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &shape, &id));
        return id;
    };
    for (const Collider& collider : figure_.colliders) {
        if (!collider.keyframes.empty())
            continue;
        const plait_collider_id id = create(collider.shape);
        if (collider.moves_with_head)
            moving_.push_back(id);
    }
    for (const Hand& hand : figure_.hands)
        hands_.push_back(create(hand.shape()));
}

void Simulation::pose_all(const plait_pose& head, float time) {
    plait_roots roots = plait_roots_defaults();
    roots.head = head;
    check(plait_sim_set_roots(sim_.get(), &roots));
    for (const plait_collider_id collider : moving_)
        check(plait_collider_set_pose(sim_.get(), collider, &head));
    for (size_t i = 0; i < hands_.size(); ++i) {
        const plait_pose pose = figure_.hands[i].pose(time);
        check(plait_collider_set_pose(sim_.get(), hands_[i], &pose));
    }
}

double Simulation::step_ms(const plait_pose& head, float time) {
    const auto start = std::chrono::steady_clock::now();
    pose_all(head, time);
    check(plait_sim_step(sim_.get(), scene_.sim.step));
    check(plait_sim_wait(sim_.get()));
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

void Simulation::measure(Measurements& measurements, uint32_t frame) {
    measurements.last = stats();
    read_field(sim_.get(), PLAIT_FIELD_POSITION, positions_);
    measurements.stretched_frames += measurements.last.max_stretch > 0.1f;
    if (measurements.last.max_stretch > measurements.max_stretch) {
        measurements.max_stretch = measurements.last.max_stretch;
        find_worst(measurements, frame);
    }
    neighbours_->add(positions_, scene_.sim.step);
    measurements.neighbour_speed = neighbours_->rms_speed();
    measurements.mean_stretch = measurements.last.mean_stretch;
    measurements.nonfinite = std::max(measurements.nonfinite, measurements.last.nonfinite);
}

// The segment that is farthest from its length at rest, now.
void Simulation::find_worst(Measurements& measurements, uint32_t frame) {
    const auto length = [](const std::vector<float>& from, size_t vertex) {
        const float* const a = &from[4 * vertex];
        return std::hypot(a[4] - a[0], a[5] - a[1], a[6] - a[2]);
    };
    float worst = -1.0f;
    for (uint32_t strand = 0; strand < vertex_count_.size(); ++strand)
        for (uint32_t segment = 0; segment + 1 < vertex_count_[strand]; ++segment) {
            const size_t vertex = size_t{strand} * row_ + segment;
            const float stretch =
                std::abs(length(positions_, vertex) / length(rest_, vertex) - 1.0f);
            if (stretch > worst) {
                worst = stretch;
                measurements.worst = {frame, strand, segment};
            }
        }
}

void Simulation::show(uint32_t frame, const plait_pose& head,
                      const std::vector<Watcher>& watchers) {
    const auto wanted = [&](const Watcher& watcher) { return watcher.wanted(frame); };
    if (std::none_of(watchers.begin(), watchers.end(), wanted))
        return;
    const float time = static_cast<float>(frame) / static_cast<float>(scene_.rate);
    for (const Watcher& watcher : watchers)
        if (watcher.wanted(frame))
            watcher.see({frame, time, head, positions_, vertex_count_, row_});
}

void Simulation::finish(Measurements& measurements) {
    size_t count = 0;
    check(plait_sim_get_stage_times(sim_.get(), nullptr, &count, 0));
    measurements.stages.resize(count);
    check(plait_sim_get_stage_times(sim_.get(), measurements.stages.data(), &count, 0));
    measurements.stages.resize(count);
    check(plait_sim_hash(sim_.get(), &measurements.hash));
    measurements.device.struct_size = sizeof measurements.device;
    check(plait_context_describe(context_.get(), &measurements.device));
}

Measurements Simulation::run(const Motion& motion, const std::vector<Watcher>& watchers,
                             const std::string& label) {
    Measurements measurements;
    measurements.last = stats(); // for a run that is interrupted before its first frame
    const uint32_t frames = scene_.frames();
    Progress progress(label, frames);
    for (uint32_t frame = 0; frame < frames && !interrupted(); ++frame) {
        const float time = static_cast<float>(frame + 1) / static_cast<float>(scene_.rate);
        const plait_pose head = to_pose(motion.at(time), figure_.pivot);
        measurements.frame_ms.push_back(step_ms(head, time));
        measure(measurements, frame);
        show(frame, head, watchers);
        measurements.frames = frame + 1;
        progress.update(frame + 1);
    }
    finish(measurements);
    return measurements;
}

} // namespace simulate
