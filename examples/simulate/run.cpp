#include "run.hpp"
#include "common/progress.hpp"

#include <algorithm>
#include <chrono>

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
    check(plait_sim_stats_get(sim, &stats));
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
    add_colliders();
}

void Simulation::add_colliders() {
    for (const Collider& collider : figure_.colliders) {
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &collider.shape, &id));
        if (collider.moves_with_head)
            moving_.push_back(id);
    }
}

void Simulation::pose_all(const plait_pose& head) {
    plait_roots roots = plait_roots_defaults();
    roots.head = head;
    check(plait_sim_set_roots(sim_.get(), &roots));
    for (const plait_collider_id collider : moving_)
        check(plait_collider_set_pose(sim_.get(), collider, &head));
}

double Simulation::step_ms(const plait_pose& head) {
    const auto start = std::chrono::steady_clock::now();
    pose_all(head);
    check(plait_sim_step(sim_.get(), scene_.sim.step));
    check(plait_sim_wait(sim_.get()));
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

void Simulation::measure(Measurements& measurements) {
    measurements.last = stats_of(sim_.get());
    measurements.max_stretch = std::max(measurements.max_stretch, measurements.last.max_stretch);
    measurements.mean_stretch = measurements.last.mean_stretch;
    measurements.nonfinite = std::max(measurements.nonfinite, measurements.last.nonfinite);
}

void Simulation::show(uint32_t frame, const plait_pose& head,
                      const std::vector<Watcher>& watchers) {
    const auto wanted = [&](const Watcher& watcher) { return watcher.wanted(frame); };
    if (std::none_of(watchers.begin(), watchers.end(), wanted))
        return;
    read_field(sim_.get(), PLAIT_FIELD_POSITION, positions_);
    const float time = static_cast<float>(frame) / static_cast<float>(scene_.rate);
    for (const Watcher& watcher : watchers)
        if (watcher.wanted(frame))
            watcher.see({frame, time, head, positions_, vertex_count_, row_});
}

void Simulation::finish(Measurements& measurements) {
    size_t count = 0;
    check(plait_sim_stage_times(sim_.get(), nullptr, &count, 0));
    measurements.stages.resize(count);
    check(plait_sim_stage_times(sim_.get(), measurements.stages.data(), &count, 0));
    measurements.stages.resize(count);
    check(plait_sim_hash(sim_.get(), &measurements.hash));
    measurements.device.struct_size = sizeof measurements.device;
    check(plait_context_describe(context_.get(), &measurements.device));
}

Measurements Simulation::run(const Motion& motion, const std::vector<Watcher>& watchers,
                             const std::string& label) {
    Measurements measurements;
    const uint32_t frames = scene_.frames();
    Progress progress(label, frames);
    for (uint32_t frame = 0; frame < frames && !interrupted(); ++frame) {
        const float time = static_cast<float>(frame + 1) / static_cast<float>(scene_.rate);
        const plait_pose head = to_pose(motion.at(time), figure_.pivot);
        measurements.frame_ms.push_back(step_ms(head));
        measure(measurements);
        show(frame, head, watchers);
        measurements.frames = frame + 1;
        progress.update(frame + 1);
    }
    finish(measurements);
    return measurements;
}

} // namespace simulate
