#include "sim.hpp"

#include <generator/generator.hpp>

#include <cmath>
#include <stdexcept>

namespace bench {
namespace {

constexpr float far_away = 3; // m: farther than any strand reaches

plait_collider_desc desc_of(const plait_generator::Capsule& capsule) {
    plait_collider_desc desc = plait_collider_desc_defaults();
    desc.friction = 0;
    for (int i = 0; i < 3; ++i) {
        desc.capsule.a[i] = capsule.a[i];
        desc.capsule.b[i] = capsule.b[i];
    }
    desc.capsule.radius_a = capsule.radius_a;
    desc.capsule.radius_b = capsule.radius_b;
    return desc;
}

Groom grown(plait_generator::Hairstyle hairstyle, uint32_t strands) {
    plait_generator::Style style = plait_generator::make_style(hairstyle);
    style.strands = strands;
    style.vertices = model_vertices;
    return groom_of(plait_generator::make_groom(style).positions, model_vertices);
}

} // namespace

void check(plait_result result) {
    if (result != PLAIT_OK)
        throw std::runtime_error(plait_last_error());
}

Context make_context(const plait_device_info& device, const ContextOptions& options) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = "opencl";
    desc.device = device.name;
    desc.profile = options.profile ? 1 : 0;
    desc.stage_sources = options.sources.data();
    desc.stage_source_count = options.sources.size();
    plait_context* context = nullptr;
    check(plait_context_create(&desc, &context));
    return Context(context);
}

Sim make_sim(plait_context* context, plait_groom* groom, const plait::SimDesc& desc) {
    plait_sim* sim = nullptr;
    check(plait::create_sim(context, groom, desc, &sim));
    return Sim(sim);
}

Groom groom_of(const std::vector<float>& positions, uint32_t vertices) {
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {positions.data(), positions.size() / 3, 0};
    desc.vertices_per_strand = vertices;
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, nullptr, &groom));
    return Groom(groom);
}

Groom long_hair(uint32_t strands) {
    return grown(plait_generator::Hairstyle::Long, strands);
}

Groom ball_hair(uint32_t strands) {
    return grown(plait_generator::Hairstyle::Ball, strands);
}

plait_pose turned_head(uint32_t number) {
    const float turn = static_cast<float>(number % frames_of_turn) / frames_of_turn;
    const float half = 0.25f * std::sin(6.2831853f * turn); // rad, about y
    return {{0, std::sin(half), 0, std::cos(half)}, {0, 0, 0}};
}

Character::Character(plait_context* context, plait_groom* groom, const plait::SimDesc& sim,
                     Bodies bodies)
    : sim_(make_sim(context, groom, sim)), bodies_(bodies) {
    if (bodies.shape == Shape::capsules)
        add_capsules();
    else if (bodies.shape != Shape::none)
        add_mesh();
}

void Character::aim() {
    plait_roots roots = plait_roots_defaults();
    roots.head = turned_head(number_++);
    check(plait_sim_set_roots(sim_.get(), &roots));
    plait_pose pose = roots.head;
    pose.t[1] += bodies_.far ? far_away : 0;
    for (const plait_collider_id collider : on_head_)
        check(plait_collider_set_pose(sim_.get(), collider, &pose));
    if (!bodies_.bends)
        return;
    std::vector<float> posed = rest_;
    for (float& x : posed)
        x *= 1 + 0.01f * roots.head.q[1]; // grows and shrinks as it turns
    const plait_view vertices = {posed.data(), posed.size() / 3, 0};
    check(plait_collider_set_positions(sim_.get(), on_head_.front(), &vertices));
}

void Character::add_capsules() {
    for (const auto& capsule :
         bodies_.ball ? plait_generator::ball_colliders() : plait_generator::head_colliders()) {
        plait_collider_desc desc = desc_of(capsule);
        desc.pose.t[1] = bodies_.far ? far_away : 0;
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &desc, &id));
        if (capsule.moves_with_head)
            on_head_.push_back(id);
    }
}

void Character::add_mesh() {
    const plait_generator::HeadMesh mesh =
        bodies_.ball ? plait_generator::make_ball() : plait_generator::make_head_parts().head;
    plait_mesh_desc shape = plait_mesh_desc_defaults();
    shape.positions = {mesh.positions.data(), mesh.positions.size() / 3, 0};
    shape.triangles = {mesh.triangles.data(), mesh.triangles.size() / 3, 0};
    plait_collider_mesh_desc desc = plait_collider_mesh_desc_defaults();
    desc.form = bodies_.shape == Shape::field ? PLAIT_MESH_FORM_FIELD : PLAIT_MESH_FORM_NEAREST;
    desc.friction = 0;
    desc.pose.t[1] = bodies_.far ? far_away : 0;
    plait_collider_id id{};
    const plait::Mesh made(shape);
    check(plait_collider_create_mesh(sim_.get(), made.get(), &desc, &id));
    rest_ = made.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    on_head_.push_back(id);
}

std::map<std::string, StageSums> take_stage_sums(plait_sim* sim) {
    size_t count = 0;
    check(plait_sim_take_launches(sim, nullptr, &count));
    std::vector<plait_launch> launches(count, plait_launch_defaults());
    check(plait_sim_take_launches(sim, launches.data(), &count));
    launches.resize(count);
    std::map<std::string, StageSums> sums;
    for (const plait_launch& launch : launches) {
        StageSums& stage = sums[launch.stage];
        stage.seconds += 1e-9 * static_cast<double>(launch.end_ns - launch.begin_ns);
        stage.bytes += static_cast<double>(launch.bytes);
        stage.calls += 1;
    }
    return sums;
}

} // namespace bench
