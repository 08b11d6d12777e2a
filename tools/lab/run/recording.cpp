#include "recording.hpp"

#include "methods/settings.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

namespace {

void to_floats(const Vec3& from, float* to) {
    for (int i = 0; i < 3; ++i)
        to[i] = static_cast<float>(from[i]);
}

GroomHandle make_groom(const std::vector<std::vector<Vec3>>& strands, uint32_t copies) {
    std::vector<float> positions;
    std::vector<uint32_t> counts;
    for (uint32_t copy = 0; copy < copies; ++copy)
        for (const auto& strand : strands) {
            counts.push_back(static_cast<uint32_t>(strand.size()));
            for (const Vec3& x : strand) {
                positions.resize(positions.size() + 3);
                to_floats(x, &positions[positions.size() - 3]);
            }
        }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {positions.data(), positions.size() / 3, 3 * sizeof(float)};
    desc.vertex_counts = {counts.data(), counts.size(), 0};
    plait_import_options options = plait_import_options_defaults();
    options.min_segment = 1e-6f; // a scene may ask for uneven segments
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, &options, &groom));
    return GroomHandle(groom);
}

// What scales each strand's stiffness; none where all have the material's.
std::vector<float> stiffness_of(const Scene& scene, uint32_t copies) {
    const auto& strands = scene.strands;
    if (std::none_of(strands.begin(), strands.end(),
                     [](const Strand& strand) { return strand.gamma.has_value(); }))
        return {};
    std::vector<float> scales;
    for (uint32_t copy = 0; copy < copies; ++copy)
        for (const Strand& strand : strands)
            scales.push_back(
                static_cast<float>(scene.bend_stiffness(strand) / scene.material.bend_stiffness));
    return scales;
}

SimHandle make_sim(plait_context* context, const plait_groom* groom, plait::SimDesc desc,
                   const std::vector<float>& stiffness) {
    desc.strand_stiffness = {stiffness.data(), stiffness.size(), 0};
    plait_sim* sim = nullptr;
    check(plait::create_sim(context, groom, desc, &sim));
    return SimHandle(sim);
}

plait_roots roots_at(const Pose& pose) {
    plait_roots roots = plait_roots_defaults();
    roots.head = to_plait(pose);
    return roots;
}

std::vector<std::vector<Vec3>> shapes_of(const Scene& scene, const Model& model) {
    std::vector<std::vector<Vec3>> shapes;
    for (const Strand& strand : scene.strands)
        shapes.push_back(rest_shape(strand, model.pinned, model.half_tip));
    return shapes;
}

constexpr double limp = 1e5; // gamma beyond which bending is not to be seen

// TressFX damps by e^(-60 d h), has iterations of its own, and a stiffness without a modulus.
void describe_tressfx(const Scene& scene, const Setting& setting, plait_tressfx_desc& p) {
    p.length_iterations = setting.iterations;
    p.damping = static_cast<float>(scene.drag / 60);
    if (scene.gamma() > limp)
        p.local_stiffness = p.global_stiffness = 0;
}

uint64_t count_nonfinite(const Frame& frame) {
    uint64_t count = 0;
    for (const auto& strand : frame.x)
        for (const Vec3& x : strand)
            count += !x.allFinite();
    return count;
}

} // namespace

plait::SimDesc describe(const Scene& scene, const Method& method) {
    if (scene.tip_pin && !method.model->pins)
        throw Failure("the scene has a tip_pin, and " + method.model->label + " takes no pins");
    plait::SimDesc desc = scene.sim;
    desc.model = method.model->model;
    desc.step = static_cast<float>(1 / scene.rate);
    desc.substeps = resolved(*method.model, method.setting, scene).substeps;
    desc.max_steps_per_call = 1;
    desc.follows_per_guide = scene.follows_per_guide;
    plait_sim_params& p = desc.params;
    plait_material& material = desc.material;
    to_floats(scene.gravity, p.gravity);
    p.iterations = std::min(method.setting.iterations, 64u);
    p.bdf2 = method.setting.bdf2;
    material.line_density = static_cast<float>(scene.material.line_density);
    material.bend_stiffness = static_cast<float>(scene.material.bend_stiffness);
    material.stretch_stiffness = static_cast<float>(scene.material.stretch_stiffness);
    for (size_t k = 0; k < 4; ++k)
        material.stiffness_ramp[k] =
            static_cast<float>(1 + (scene.material.tip_stiffness - 1) * double(k) / 3);
    if (scene.material.twist_ratio > 0 && method.model->twists)
        material.twist_stiffness =
            static_cast<float>(scene.material.twist_ratio * scene.material.bend_stiffness);
    p.drag = static_cast<float>(scene.drag);
    if (desc.model == PLAIT_MODEL_TRESSFX)
        describe_tressfx(scene, method.setting, desc.tressfx);
    return desc;
}

Method method_of(const Scene& scene) {
    const Model& model = *find_model(scene.model);
    Setting setting = default_setting(model, scene);
    setting.substeps = scene.substeps.value_or(setting.substeps);
    setting.iterations = scene.iterations.value_or(setting.iterations);
    setting.bdf2 = scene.bdf2.value_or(setting.bdf2);
    return {&model, setting};
}

Stage::Stage(plait_context* context, const Scene& scene, const Method& method, uint32_t copies)
    : scene_(scene), desc_(describe(scene, method)),
      groom_(make_groom(shapes_of(scene, *method.model), copies)),
      sim_(make_sim(context, groom_.get(), desc_, stiffness_of(scene, copies))),
      rest_(shapes_of(scene, *method.model)), copies_(copies), pose_(scene.motion.at(0)) {
    plait_sim_info info = plait_sim_info_defaults();
    check(plait_sim_describe(sim_.get(), &info));
    row_ = info.vertices_per_strand;
    if (!scene.motion.still())
        start_at(pose_);
    for (const SceneCollider& collider : scene.colliders) {
        plait_collider_desc shape = collider.shape;
        shape.pose = to_plait(collider.motion.at(0));
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &shape, &id));
        colliders_.push_back(id);
    }
    if (scene.tip_pin)
        pin_tips(*scene.tip_pin);
    if (copies == 1)
        rest_ = read_field(PLAIT_FIELD_POSITION);
}

void Stage::pin_tips(const TipPin& pin) {
    std::vector<plait_pin> pins;
    for (size_t k = 0; k < copies_ * scene_.strands.size(); ++k) {
        const size_t vertices = rest_[k % scene_.strands.size()].size();
        pins.push_back({static_cast<uint32_t>(k),
                        static_cast<uint32_t>(vertices - 1),
                        PLAIT_PIN_FRAME_WORLD,
                        {},
                        static_cast<float>(pin.stiffness)});
        to_floats(pin.at, pins.back().target);
    }
    check(plait_sim_set_pins(sim_.get(), pins.data(), pins.size()));
}

void Stage::start_at(const Pose& pose) {
    const plait_roots roots = roots_at(pose);
    check(plait_sim_teleport(sim_.get(), &roots));
}

uint64_t Stage::vertices() const {
    plait_sim_info info = plait_sim_info_defaults();
    check(plait_sim_describe(sim_.get(), &info));
    return info.guides * info.vertices_per_strand;
}

void Stage::set_params(double drag, const Vec3& gravity) {
    plait_sim_params p = desc_.params;
    p.drag = static_cast<float>(drag);
    to_floats(gravity, p.gravity);
    check(plait_sim_set_params(sim_.get(), &p));
    if (desc_.model != PLAIT_MODEL_TRESSFX)
        return;
    plait_tressfx_desc tressfx = desc_.tressfx;
    tressfx.damping = static_cast<float>(drag / 60);
    check(plait_sim_set_tressfx(sim_.get(), &tressfx));
}

void Stage::settle(bool begin) {
    set_params(begin ? scene_.settle_drag : scene_.drag,
               begin ? scene_.settle_gravity : scene_.gravity);
}

void Stage::pose_colliders(double time) {
    for (size_t i = 0; i < colliders_.size(); ++i) {
        const plait_pose pose = to_plait(scene_.colliders[i].motion.at(time));
        check(plait_collider_set_pose(sim_.get(), colliders_[i], &pose));
    }
}

// How far the call moved any vertex in the roots' frame.
double Stage::teleport(const Pose& to) {
    const plait_roots roots = roots_at(to);
    if (copies_ > 1) {
        check(plait_sim_teleport(sim_.get(), &roots));
        return 0;
    }
    const auto before = read_field(PLAIT_FIELD_POSITION);
    check(plait_sim_teleport(sim_.get(), &roots));
    const auto after = read_field(PLAIT_FIELD_POSITION);
    double change = 0;
    for (size_t s = 0; s < before.size(); ++s)
        for (size_t i = 0; i < before[s].size(); ++i) {
            const Vec3 was = pose_.q.conjugate() * (before[s][i] - pose_.t);
            const Vec3 is = to.q.conjugate() * (after[s][i] - to.t);
            change = std::max(change, (is - was).norm());
        }
    return change;
}

double Stage::step_to(double time) {
    const Pose pose = scene_.motion.at(time);
    double change = 0;
    if (scene_.motion.teleports(time_, time))
        change = teleport(pose);
    const plait_roots roots = roots_at(pose);
    check(plait_sim_set_roots(sim_.get(), &roots));
    pose_colliders(time);
    check(plait_sim_step(sim_.get(), static_cast<double>(desc_.step)));
    pose_ = pose;
    time_ = time;
    return change;
}

void Stage::wait() {
    check(plait_sim_wait(sim_.get()));
}

std::vector<std::vector<Vec3>> Stage::read_field(plait_field field) const {
    size_t size = 0;
    check(plait_sim_read(sim_.get(), field, nullptr, &size));
    std::vector<float> values(size / sizeof(float));
    check(plait_sim_read(sim_.get(), field, values.data(), &size));
    std::vector<std::vector<Vec3>> strands(rest_.size());
    for (size_t s = 0; s < rest_.size(); ++s)
        for (size_t i = 0; i < rest_[s].size(); ++i) {
            const float* x = &values[4 * (s * row_ + i)];
            strands[s].emplace_back(static_cast<double>(x[0]), static_cast<double>(x[1]),
                                    static_cast<double>(x[2]));
        }
    return strands;
}

void Stage::read(Frame& frame) const {
    frame.time = time_;
    frame.root = pose_;
    frame.x = read_field(PLAIT_FIELD_POSITION);
    frame.v = read_field(PLAIT_FIELD_VELOCITY);
}

Recording record(Contexts& contexts, const Scene& scene, const Method& method,
                 const std::function<void(double)>& watch) {
    Stage stage(contexts.of(*method.model), scene, method);
    Recording recording;
    recording.rest = stage.rest();
    const uint32_t settle = scene.settle_frames(), frames = scene.frames();
    const auto done = [&](uint32_t k) {
        if (watch && settle + frames > 0)
            watch(static_cast<double>(k) / (settle + frames));
        return recording.interrupted = interrupted();
    };
    if (settle > 0)
        stage.settle(true);
    for (uint32_t k = 0; k < settle && !done(k); ++k)
        stage.step_to(0);
    if (settle > 0)
        stage.settle(false);
    for (uint32_t k = 0; k <= frames && !done(settle + k); ++k) {
        if (k > 0) {
            const double change = stage.step_to(k / scene.rate);
            recording.teleport_change = std::max(recording.teleport_change, change);
        }
        stage.read(recording.frames.emplace_back());
        const uint64_t bad = count_nonfinite(recording.frames.back());
        recording.nonfinite = std::max(recording.nonfinite, bad);
    }
    return recording;
}

} // namespace lab
