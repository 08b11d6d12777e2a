#include "sim.hpp"

#include "results.hpp"

#include <generator/generator.hpp>

#include <cmath>
#include <stdexcept>

namespace bench {
namespace {

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

} // namespace

void check(plait_result result) {
    if (result != PLAIT_OK)
        throw std::runtime_error(plait_last_error());
}

Context make_context(const plait_device_info& device) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = "opencl";
    desc.device = device.name;
    plait_context* context = nullptr;
    check(plait_context_create(&desc, &context));
    return Context(context);
}

Sim make_sim(plait_context* context, plait_groom* groom, const plait::SimDesc& desc) {
    plait_sim* sim = nullptr;
    check(plait::create_sim(context, groom, desc, &sim));
    return Sim(sim);
}

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

plait_pose turned_head(uint32_t number) {
    const float turn = static_cast<float>(number % frames_of_turn) / frames_of_turn;
    const float half = 0.25f * std::sin(6.2831853f * turn); // rad, about y
    return {{0, std::sin(half), 0, std::cos(half)}, {0, 0, 0}};
}

Character::Character(plait_context* context, plait_groom* groom, const plait::SimDesc& sim,
                     bool bodies)
    : sim_(make_sim(context, groom, sim)) {
    if (!bodies)
        return;
    for (const auto& capsule : plait_generator::head_colliders()) {
        const plait_collider_desc desc = desc_of(capsule);
        plait_collider_id id{};
        check(plait_collider_create(sim_.get(), &desc, &id));
        if (capsule.moves_with_head)
            on_head_.push_back(id);
    }
}

void Character::aim() {
    plait_roots roots = plait_roots_defaults();
    roots.head = turned_head(number_++);
    check(plait_sim_set_roots(sim_.get(), &roots));
    for (const plait_collider_id collider : on_head_)
        check(plait_collider_set_pose(sim_.get(), collider, &roots.head));
}

} // namespace bench
