#include "ball.hpp"
#include "common/collider_reader.hpp"

#include "generator/generator.hpp"

#include <algorithm>
#include <chrono>

namespace lab::volume {

namespace {

constexpr double lead = 0.16; // m, of free hair: from the root to the first vertex in the grid
constexpr double line_density = 5e-6; // kg/m; of a hair, and only ratios are measured

double now_ms() {
    const std::chrono::duration<double, std::milli> now =
        std::chrono::steady_clock::now().time_since_epoch();
    return now.count();
}

plait::SimDesc desc_of(const Method& method, const std::string& model, bool free) {
    plait::SimDesc desc;
    desc.model = find_model(model)->model;
    desc.step = static_cast<float>(1 / rate);
    desc.substeps = 1;
    desc.params.bdf2 = 0; // a velocity that is written is all the history there is
    desc.acceleration.on = true;
    plait_sim_params& params = desc.params;
    params.drag = free ? 0.0f : 1.0f;
    if (free) { // nor held by their roots: there is no pull along strands, or next to none
        std::fill_n(params.gravity, 3, 0.0f);
        desc.material.stretch_stiffness = 1e-9f;
        desc.material.bend_stiffness = 0;
    }
    desc.grid.edge = static_cast<float>(cube.edge);
    desc.grid.edge_count = cube.nodes;
    for (int axis = 0; axis < 3; ++axis)
        desc.grid.origin[axis] = static_cast<float>(cube.origin[axis]);
    method.set(desc);
    return desc;
}

GroomHandle groom_of(const Hair& hair) {
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {hair.positions.data(), hair.positions.size() / 3, 0};
    desc.vertices_per_strand = hair.row;
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, nullptr, &groom));
    return GroomHandle(groom);
}

void add_ball(plait_sim* sim) {
    plait_collider_desc desc = common::smooth_collider();
    std::fill_n(desc.capsule.a, 3, 0.0f);
    std::fill_n(desc.capsule.b, 3, 0.0f);
    desc.capsule.radius_a = desc.capsule.radius_b =
        static_cast<float>(plait_generator::ball_radius);
    desc.friction = 0.2f;
    plait_collider_id id{};
    check(plait_collider_create(sim, &desc, &id));
}

} // namespace

const Cube cube{Vec3(-0.3, -0.39, -0.3), 0.6, 32};

Hair ball_hair(uint32_t strands) {
    auto style = plait_generator::make_style(plait_generator::Hairstyle::Ball);
    style.strands = strands;
    return {make_groom(style).positions, style.vertices};
}

Hair free_hair(uint32_t strands) {
    const Hair ball = ball_hair(strands);
    Hair free{{}, ball.row + 1};
    for (size_t s = 0; s < ball.strands(); ++s) {
        const float* const first = &ball.positions[3 * ball.row * s];
        free.positions.insert(free.positions.end(),
                              {first[0], first[1] + static_cast<float>(lead), first[2]});
        free.positions.insert(free.positions.end(), first, first + size_t{3} * ball.row);
    }
    return free;
}

Run::Run(plait_context* context, const Hair& hair, const Method& method, const std::string& model,
         bool free)
    : method_(method) {
    const GroomHandle groom = groom_of(hair);
    const plait::SimDesc desc = desc_of(method, model, free);
    plait_sim* sim = nullptr;
    check(plait::create_sim(context, groom.get(), desc, &sim));
    sim_.reset(sim);
    const double radius = free ? 0 : plait_generator::ball_radius;
    if (!free)
        add_ball(sim);
    if (method.program)
        program_ = method.program(cube, radius);
    measure_rest(hair);
}

// Half of both segments beside a vertex, and the density of such hair around it.
void Run::measure_rest(const Hair& hair) {
    const size_t count = hair.positions.size() / 3;
    const auto at = [&](size_t i) {
        const float* const p = &hair.positions[3 * i];
        return Vec3(double(p[0]), double(p[1]), double(p[2]));
    };
    rest_.mass.assign(count, 0.0);
    rest_.moves.assign(count, 1);
    rest_.wanted.assign(count, 0.0);
    rest_.v.assign(count, Vec3::Zero());
    for (size_t i = 0; i < count; ++i) {
        rest_.x.push_back(at(i));
        rest_.moves[i] = i % hair.row != 0;
        if (!rest_.moves[i])
            continue;
        const double half = 0.5 * line_density * (at(i) - at(i - 1)).norm();
        rest_.mass[i] += half;
        rest_.mass[i - 1] += half;
    }
    Nodes nodes(cube, 0);
    nodes.add_up(rest_);
    std::vector<double> density(nodes.count());
    for (size_t n = 0; n < density.size(); ++n)
        density[n] = nodes.density(n);
    for (size_t i = 0; i < count; ++i)
        rest_.wanted[i] = nodes.gather(density, rest_.x[i], 0.0);
}

std::vector<float> Run::field(plait_field which) const {
    std::vector<float> values(4 * rest_.size());
    size_t size = values.size() * sizeof values[0];
    check(plait_sim_read(sim_.get(), which, values.data(), &size));
    return values;
}

Cloud Run::read() const {
    Cloud cloud = rest_;
    const auto x = field(PLAIT_FIELD_POSITION), v = field(PLAIT_FIELD_VELOCITY);
    for (size_t i = 0; i < cloud.size(); ++i) {
        cloud.x[i] = Vec3(double(x[4 * i]), double(x[4 * i + 1]), double(x[4 * i + 2]));
        cloud.v[i] = Vec3(double(v[4 * i]), double(v[4 * i + 1]), double(v[4 * i + 2]));
    }
    return cloud;
}

void Run::write(plait_field which, const std::vector<Vec3>& values) {
    // Past what the library takes only hair that has come apart is: it goes on, and shows.
    constexpr double most = 9.9e3;
    std::vector<float> floats(4 * values.size(), 0.0f);
    for (size_t i = 0; i < values.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            floats[4 * i + static_cast<size_t>(axis)] =
                static_cast<float>(std::clamp(values[i][axis], -most, most));
    check(plait_sim_write(sim_.get(), which, floats.data(), floats.size() * sizeof floats[0]));
}

void Run::set_velocities(const std::vector<Vec3>& v) {
    write(PLAIT_FIELD_VELOCITY, v);
}

void Run::step() {
    const double begin = now_ms();
    check(plait_sim_step(sim_.get(), 1 / rate + 1e-9));
    check(plait_sim_wait(sim_.get()));
    step_ms_ = now_ms() - begin;
}

std::optional<Change> Run::change(const Cloud& cloud) {
    if (!program_)
        return std::nullopt;
    const double begin = now_ms();
    Change change = program_->act(cloud, 1 / rate);
    program_ms_ = now_ms() - begin;
    return change;
}

void Run::apply(const Cloud& cloud, const Change& change) {
    if (!change.velocity.empty()) {
        std::vector<Vec3> v = cloud.v;
        for (size_t i = 0; i < v.size(); ++i)
            v[i] += change.velocity[i];
        set_velocities(v);
    }
    if (!change.acceleration.empty())
        write(PLAIT_FIELD_ACCELERATION, change.acceleration);
}

} // namespace lab::volume
