#include "run.hpp"
#include "common/progress.hpp"
#include "restart.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace simulate {

namespace {

ContextHandle make_context(const Scene& scene, std::vector<std::string>& said) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = scene.backend.empty() ? nullptr : scene.backend.c_str();
    desc.device = scene.device.empty() ? nullptr : scene.device.c_str();
    desc.profile = scene.crowd.heads == 1; // with it one head is stepped after another
    desc.log_user = &said;
    desc.log = [](plait_log_level level, const char* text, void* user) {
        if (level >= PLAIT_LOG_LEVEL_WARNING)
            static_cast<std::vector<std::string>*>(user)->emplace_back(text);
    };
    plait_context* context = nullptr;
    check(plait_context_create(&desc, &context));
    return ContextHandle(context);
}

// The model tressfx takes no pins: what a hairstyle is held by, it does without.
bool pins_hair(const Scene& scene) {
    return !scene.pins.empty() && scene.sim.model != PLAIT_MODEL_TRESSFX;
}

template <typename T> void read_field(plait_sim* sim, plait_field field, std::vector<T>& into) {
    size_t size = 0;
    check(plait_sim_read(sim, field, nullptr, &size));
    into.resize(size / sizeof(T));
    check(plait_sim_read(sim, field, into.data(), &size));
}

} // namespace

double Measurements::percentile_ms(double share) const {
    if (frame_ms.empty())
        return 0.0;
    std::vector<double> sorted = frame_ms;
    const auto rank = static_cast<size_t>(share * static_cast<double>(sorted.size()));
    const auto at = sorted.begin() + static_cast<ptrdiff_t>(std::min(rank, sorted.size() - 1));
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

Simulation::Simulation(const Scene& scene, const Figure& figure, Simulated which,
                       const Simulation* nearest)
    : scene_(scene), figure_(figure), which_(which),
      context_(nearest ? nearest->context_ : make_context(scene, said_)),
      levels_(nearest ? nearest->levels_ : make_levels()), sim_(make_sim()) {
    row_ = describe().vertices_per_strand;
    read_field(sim_.get(), PLAIT_FIELD_VERTEX_COUNT, vertex_count_);
    read_field(sim_.get(), PLAIT_FIELD_POSITION, rest_);
    neighbours_ = std::make_unique<Neighbours>(rest_, vertex_count_, row_);
    add_colliders();
    bind_roots();
    if (pins_hair(scene))
        add_pins();
    if (scene.wind && scene.sim.model != PLAIT_MODEL_TRESSFX) // which has none
        check(plait_sim_set_wind(sim_.get(), &*scene.wind));
    if (!scene.wetness.empty() && scene.sim.model != PLAIT_MODEL_TRESSFX)
        add_wetness();
    if (scene.detail && which == Simulated::guides)
        check(plait_sim_set_detail(sim_.get(), &*scene.detail));
    if (which == Simulated::guides && scene.crowd.directed()) {
        if (!nearest)
            add_crowd();
    } else if (changes_level()) {
        begin_level();
    }
}

void Simulation::add_crowd() {
    std::vector<plait_sim*> sims{sim_.get()};
    for (uint32_t head = 1; head < scene_.crowd.heads; ++head) {
        farther_.emplace_back(new Simulation(scene_, figure_, which_, this));
        sims.push_back(farther_.back()->sim_.get());
    }
    crowd_ = std::make_unique<Crowd>(context_.get(), sims, scene_.crowd);
}

// Materials are not for TressFX, in a comparison.
SimHandle Simulation::make_sim() {
    plait::SimDesc desc = scene_.sim;
    FollowMapHandle map;
    if (follows()) {
        map = take_level(scene_, levels_.get()).second;
        desc.follow_map = map.get();
    } else if (levels_) {
        desc.levels = levels_.get();
    }
    const auto of_strands =
        of_simulated(strand_materials(scene_.materials, figure_.groom.get(), scene_.seed));
    std::vector<plait_material> materials;
    for (const MaterialChoice& choice : scene_.materials)
        materials.push_back(choice.material);
    materials.push_back(desc.material); // of the rest
    if (!scene_.materials.empty() && desc.model != PLAIT_MODEL_TRESSFX) {
        desc.materials = materials.data();
        desc.material_count = materials.size();
        desc.strand_material = {of_strands.data(), of_strands.size(), 0};
    }
    const plait_groom* const groom = follows() ? figure_.simulated() : figure_.groom.get();
    plait_sim* sim = nullptr;
    check(plait::create_sim(context_.get(), groom, desc, &sim));
    return SimHandle(sim);
}

std::vector<uint32_t> Simulation::of_simulated(const std::vector<uint32_t>& of_strands) const {
    return follows() ? figure_.of_simulated(of_strands) : of_strands;
}

// Roots that a mesh carries have no poses, which hair is bound by.
bool Simulation::binds(const Scene& scene, const Figure& figure) {
    const bool by_skin = figure.body && figure.body->roots() == Carrier::Skin;
    return scene.bind != Bind::groomed && scene.settle > 0 && !by_skin;
}

// Of hair where it hangs before the motion, or, where nothing settles it, as groomed.
LevelsHandle Simulation::make_levels() const {
    if (which_ != Simulated::guides || !(changes_level() || follows()))
        return nullptr;
    if (!binds(scene_, figure_))
        return simulate::make_levels(scene_, figure_);
    Simulation all(scene_, figure_, Simulated::all);
    plait_roots roots = plait_roots_defaults();
    if (figure_.body)
        roots.head = figure_.body->head(0);
    all.settle(roots.head);
    return simulate::make_levels(
        scene_, figure_, {all.positions_.data(), all.positions_.size() / 4, 4 * sizeof(float)},
        &roots);
}

void Simulation::begin_level() const {
    plait_level_choice choice = plait_level_choice_defaults();
    choice.level = scene_.groom.level.value_or(0);
    choice.blend = 0;
    check(plait_sim_set_level(sim_.get(), &choice));
}

// Before the step that ends with the frame.
void Simulation::switch_level(uint32_t frame) {
    const auto& list = scene_.groom.switches;
    const float time = static_cast<float>(frame) / static_cast<float>(scene_.rate);
    for (; changes_level() && next_switch_ < list.size() && list[next_switch_].second <= time;
         ++next_switch_) {
        plait_level_choice choice = plait_level_choice_defaults();
        choice.level = list[next_switch_].level;
        check(plait_sim_set_level(sim_.get(), &choice));
    }
}

plait_sim_measures Simulation::measure() const {
    plait_sim_measures measures = plait_sim_measures_defaults();
    check(plait_sim_measure(sim_.get(), &measures));
    return measures;
}

plait_sim_info Simulation::describe() const {
    plait_sim_info info = plait_sim_info_defaults();
    check(plait_sim_describe(sim_.get(), &info));
    return info;
}

void Simulation::add_wetness() {
    const size_t strands = figure_.info.strands;
    if (scene_.wetness.size() > 1 && scene_.wetness.size() != strands)
        throw Failure("wetness has " + std::to_string(scene_.wetness.size()) +
                      " numbers, the groom has " + std::to_string(strands) + " strands");
    if (changes_level() && scene_.wetness.size() > 1)
        throw Failure("wetness has a number for each strand, and levels change, too");
    std::vector<uint32_t> all(strands);
    for (uint32_t i = 0; i < all.size(); ++i)
        all[i] = i;
    std::vector<float> wetness;
    for (const uint32_t strand : of_simulated(all))
        wetness.push_back(scene_.wetness[std::min<size_t>(strand, scene_.wetness.size() - 1)]);
    check(plait_sim_write(sim_.get(), PLAIT_FIELD_WETNESS, wetness.data(),
                          wetness.size() * sizeof wetness[0]));
}

void Simulation::add_pins() {
    const auto guides = static_cast<uint32_t>(describe().guides);
    std::vector<char> held(rest_.size() / 4, 0); // by a tie before
    std::vector<plait_pin> pins;
    for (size_t i = 0; i < scene_.pins.size(); ++i) {
        const Tie& tie = scene_.pins[i];
        const size_t before = pins.size();
        for (uint32_t strand = 0; strand < guides; ++strand)
            for (uint32_t vertex = 1; vertex < vertex_count_[strand]; ++vertex) {
                const size_t at = size_t{strand} * row_ + vertex;
                const float* const p = &rest_[4 * at];
                if (held[at] ||
                    std::hypot(p[0] - tie.at[0], p[1] - tie.at[1], p[2] - tie.at[2]) > tie.radius)
                    continue;
                held[at] = 1;
                pins.push_back({strand,
                                vertex,
                                tie.moves_with_head ? PLAIT_PIN_FRAME_REST : PLAIT_PIN_FRAME_WORLD,
                                {p[0], p[1], p[2]},
                                tie.stiffness});
            }
        if (pins.size() == before)
            throw Failure(
                "pins[" + std::to_string(i) +
                "] hold nothing: no vertex but roots lies within its radius of its place");
    }
    check(plait_sim_set_pins(sim_.get(), pins.data(), pins.size()));
}

void Simulation::add_colliders() {
    const auto create = [&](const plait_collider_desc& shape) {
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &shape, &id));
        return id;
    };
    const auto add = [&](const std::vector<Collider>& colliders) {
        for (const Collider& collider : colliders) {
            if (!collider.keyframes.empty())
                continue;
            const plait_collider_id id = create(collider.shape);
            if (collider.moves_with_head)
                moving_.push_back({id, 1});
        }
    };
    add(figure_.colliders);
    if (scene_.sim.model == PLAIT_MODEL_TRESSFX)
        add(figure_.stand_ins);
    else
        add_meshes();
    for (const Hand& hand : figure_.hands)
        hands_.push_back(create(hand.shape()));
}

namespace {

plait_result create_collider(plait_sim* sim, const LoadedMesh& mesh, plait_collider_id& id) {
    const plait_collider_mesh_desc& given = mesh.choice.desc;
    if (!mesh.choice.hull)
        return plait_collider_create_mesh(sim, mesh.mesh.get(), &given, &id);
    plait_collider_hull_desc hull = plait_collider_hull_desc_defaults();
    hull.margin = given.margin;
    hull.friction = given.friction;
    hull.tolerance = mesh.choice.tolerance;
    hull.pose = given.pose;
    return plait_collider_create_hull(sim, mesh.mesh.get(), &hull, &id);
}

} // namespace

// In the pose in which the groom lies on them.
void Simulation::add_meshes() {
    const auto create = [&](const LoadedMesh& mesh) {
        plait_collider_id id{};
        if (create_collider(sim_.get(), mesh, id) != PLAIT_OK)
            throw Failure(mesh.choice.place + ": " + plait_last_error());
        return id;
    };
    for (const LoadedMesh& mesh : figure_.meshes) {
        const plait_collider_id id = create(mesh);
        if (mesh.head_share > 0)
            moving_.push_back({id, mesh.head_share});
    }
    if (figure_.body)
        body_ = create(figure_.body->mesh());
}

template <typename Work>
void Simulation::timed(Timeline& timeline, HostCall call, const Work& work) const {
    call.begin_ns = keeps_timeline() ? Timeline::now_ns() : 0;
    work();
    if (keeps_timeline()) {
        call.end_ns = Timeline::now_ns();
        timeline.add(call);
    }
}

plait_pose Simulation::head_at(const Motion& motion, float time) const {
    return figure_.body ? figure_.body->head(time) : to_pose(motion.at(time), figure_.pivot);
}

void Simulation::bind_roots() {
    const bool by_skin = figure_.body && figure_.body->roots() == Carrier::Skin;
    if (by_skin)
        check(plait_sim_bind_roots(sim_.get(), figure_.body->mesh().mesh.get(), nullptr, 0));
}

void Simulation::pose_roots(const plait_pose& head, float time) {
    plait_roots roots = plait_roots_defaults();
    std::vector<std::array<float, 3>> posed;
    if (figure_.body && figure_.body->roots() == Carrier::Skin) {
        posed = figure_.body->positions(time);
        roots.mesh_positions = {posed.data(), posed.size(), 0};
    } else {
        roots.head = head;
    }
    check(plait_sim_set_roots(sim_.get(), &roots));
    for (const auto& other : farther_)
        other->pose_roots(head, time);
}

void Simulation::pose_colliders(const plait_pose& head, float time) {
    for (const auto& [collider, share] : moving_) {
        const plait_pose pose = share < 1 ? figure_.pose_of_share(head, share) : head;
        check(plait_collider_set_pose(sim_.get(), collider, &pose));
    }
    if (body_) {
        const auto posed = figure_.body->positions(time);
        const plait_view view{posed.data(), posed.size(), 0};
        check(plait_collider_set_positions(sim_.get(), *body_, &view));
    }
    for (size_t i = 0; i < hands_.size(); ++i) {
        const plait_pose pose = figure_.hands[i].pose(time);
        check(plait_collider_set_pose(sim_.get(), hands_[i], &pose));
    }
    for (const auto& other : farther_)
        other->pose_colliders(head, time);
}

// A step of all heads, enqueued.
void Simulation::step() {
    if (crowd_)
        crowd_->step(scene_.sim.step);
    else
        check(plait_sim_step(sim_.get(), scene_.sim.step));
}

void Simulation::wait() {
    if (crowd_)
        crowd_->wait();
    else
        check(plait_sim_wait(sim_.get()));
}

// Of a frame; the director hears of it.
template <typename Work> double Simulation::timed_ms(const Work& work) const {
    const auto start = std::chrono::steady_clock::now();
    work();
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    if (crowd_)
        crowd_->took(ms);
    return ms;
}

double Simulation::step_ms(Timeline& timeline, uint32_t frame, const plait_pose& head) {
    const float time = static_cast<float>(frame + 1) / static_cast<float>(scene_.rate);
    const auto call = [&](const char* name, bool enqueues, const auto& work) {
        timed(timeline, {name, frame, enqueues, true, 0, 0}, work);
    };
    switch_level(frame);
    return timed_ms([&] {
        if (crowd_)
            call("direct", false, [&] { crowd_->direct(scene_.sim.step); });
        call("set_roots", true, [&] { pose_roots(head, time); });
        call("set_colliders", false, [&] { pose_colliders(head, time); });
        call("step", true, [&] { step(); });
        call("wait", false, [&] { wait(); });
    });
}

void Simulation::take_launches(Timeline& timeline, uint32_t frame) {
    size_t count = 0;
    check(plait_sim_take_launches(sim_.get(), nullptr, &count));
    std::vector<plait_launch> launches(count, plait_launch_defaults());
    check(plait_sim_take_launches(sim_.get(), launches.data(), &count));
    for (size_t i = 0; i < count; ++i)
        timeline.add(Launch{frame, launches[i]});
}

// What ran to make the sim, or to look at it, is of no frame.
void Simulation::forget_launches() {
    Timeline nothing;
    take_launches(nothing, 0);
}

// What the hair does until it hangs is no part of the run, and is not measured.
void Simulation::settle(const plait_pose& start) {
    const long frames = std::lround(scene_.settle * static_cast<float>(scene_.rate));
    if (frames == 0)
        return;
    pose_roots(start, 0.0f);
    pose_colliders(start, 0.0f);
    check(plait_sim_reset(sim_.get()));
    for (const auto& other : farther_)
        check(plait_sim_reset(other->sim_.get()));
    Progress progress("settling  ", static_cast<uint32_t>(frames));
    for (long frame = 0; frame < frames && !interrupted(); ++frame) {
        timed_ms([&] {
            if (crowd_)
                crowd_->direct(scene_.sim.step);
            step();
            wait();
        });
        progress.update(static_cast<uint32_t>(frame + 1));
    }
    read_field(sim_.get(), PLAIT_FIELD_POSITION, positions_);
    neighbours_->start(positions_);
    stage_times(true);
}

void Simulation::measure(Measurements& measurements, uint32_t frame) {
    const auto call = [&](const char* name, const auto& work) {
        timed(measurements.timeline, {name, frame, false, false, 0, 0}, work);
    };
    call("measure", [&] { measurements.last = measure(); });
    call("read", [&] { read_field(sim_.get(), PLAIT_FIELD_POSITION, positions_); });
    measurements.stretched_frames += measurements.last.max_stretch > 0.1f;
    if (measurements.last.max_stretch > measurements.max_stretch) {
        measurements.max_stretch = measurements.last.max_stretch;
        find_worst(measurements, frame);
    }
    if (!changes_level()) {
        neighbours_->add(positions_, scene_.sim.step);
        measurements.neighbour_speed = neighbours_->rms_speed();
    }
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
    Shot shot{frame, time, head, positions_, vertex_count_, row_};
    if (changes_level())
        show_level(shot);
    for (const Watcher& watcher : watchers)
        if (watcher.wanted(frame))
            watcher.see(shot);
}

// Only strands that are placed.
void Simulation::show_level(Shot& shot) const {
    plait_level_state now = plait_level_state_defaults();
    check(plait_sim_get_level(sim_.get(), &now));
    const size_t all = vertex_count_.size();
    shot.vertex_count = shot.vertex_count.first(now.shown);
    shot.positions = shot.positions.first(size_t{4} * row_ * now.shown);
    shot.widen = static_cast<float>(all) / static_cast<float>(now.shown);
    shot.level = ", level " + std::to_string(now.level);
    if (!crowd_)
        return;
    char text[64];
    std::snprintf(text, sizeof text, ", %u strands, %.1f ms", now.shown, crowd_->last_ms());
    shot.level += text;
}

std::vector<plait_stage_time> Simulation::stage_times(bool reset) {
    size_t count = 0;
    check(plait_sim_get_stage_times(sim_.get(), nullptr, &count, 0));
    std::vector<plait_stage_time> times(count);
    check(plait_sim_get_stage_times(sim_.get(), times.data(), &count, reset));
    times.resize(count);
    return times;
}

// Hair that goes with the head goes through all else.
void Simulation::warn_of_rigid(const CrowdHead& nearest) {
    size_t count = 0;
    check(plait_levels_list(levels_.get(), nullptr, &count));
    const auto rigid = [&](const LevelChange& change) { return change.level + 1 == count; };
    if (std::none_of(nearest.levels.begin(), nearest.levels.end(), rigid))
        return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "the budget of %g ms is too small for %u heads: the nearest went rigid, and its "
                  "hair passes through what it meets; give more, or fewer heads",
                  static_cast<double>(scene_.crowd.budget_ms), scene_.crowd.heads);
    said_.push_back(text);
}

void Simulation::finish(Measurements& measurements) {
    measurements.stages = stage_times(false);
    add_stages_before(measurements.stages);
    check(plait_sim_hash(sim_.get(), &measurements.hash));
    if (crowd_) {
        measurements.crowd = crowd_->heads();
        warn_of_rigid(measurements.crowd.front());
    }
    measurements.info = describe();
    measurements.device = describe_device();
}

plait_device_info Simulation::describe_device() const {
    plait_device_info device{};
    device.struct_size = sizeof device;
    check(plait_context_describe(context_.get(), &device));
    return device;
}

std::vector<float> Simulation::read_positions() const {
    std::vector<float> positions;
    read_field(sim_.get(), PLAIT_FIELD_POSITION, positions);
    return positions;
}

Measurements Simulation::run(const Motion& motion, const std::vector<Watcher>& watchers,
                             const std::string& label) {
    Measurements measurements;
    measurements.info = describe();
    measurements.last = measure(); // for a run that is interrupted before its first frame
    if (restart_ && restart_->begin())
        take_up(measurements);
    else
        settle(head_at(motion, 0.0f));
    const uint32_t frames = scene_.frames();
    Progress progress(label, frames);
    for (uint32_t frame = measurements.frames; frame < frames && !interrupted(); ++frame) {
        const float time = static_cast<float>(frame + 1) / static_cast<float>(scene_.rate);
        const plait_pose head = head_at(motion, time);
        if (keeps_timeline())
            forget_launches();
        measurements.frame_ms.push_back(step_ms(measurements.timeline, frame, head));
        if (crowd_)
            crowd_->record(frame);
        if (keeps_timeline())
            take_launches(measurements.timeline, frame);
        measure(measurements, frame);
        show(frame, head, watchers);
        measurements.frames = frame + 1;
        if (restart_ && restart_->is_due(frame + 1))
            keep(measurements);
        progress.update(frame + 1);
    }
    if (restart_ && restart_->kept() < measurements.frames)
        keep(measurements);
    finish(measurements);
    return measurements;
}

} // namespace simulate
