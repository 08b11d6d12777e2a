// Hair on a head in uniform motion stays where it is in the head's frame, whatever is called: each call
// of the API that takes a sim, on a head that moves at 1, 6 and 30 m/s or turns three times a second.
#include "headers.hpp"
#include "support.hpp"

#include <algorithm>
#include <functional>
#include <regex>
#include <set>

namespace {

// Calls come ten seconds after the start, when the head is at the origin, where float32 has digits to spare.
constexpr double first = -600;
constexpr size_t vertices = 16;
constexpr float length = 0.3f;

// How the head moves: straight on, or round a vertical axis through its origin.
struct Motion {
    const char* name;
    double speed; // m/s
    double turns; // 1/s
};
constexpr Motion motions[] = {{"walks", 1, 0}, {"runs", 6, 0}, {"drives", 30, 0}, {"turns", 0, 3}};

struct Model {
    const char* name;
    plait_model model;
    uint32_t bdf2;
    uint32_t substeps = 1;
    bool wind = false; // of still air
    float beside = 0;  // m, the root, of the axis
};
constexpr Model models[] = {
    {"articulated_bdf2", PLAIT_MODEL_ARTICULATED, PLAIT_BDF2_OF_MODEL},
    {"articulated_bdf2_3_substeps", PLAIT_MODEL_ARTICULATED, PLAIT_BDF2_OF_MODEL, 3},
    {"articulated_euler", PLAIT_MODEL_ARTICULATED, 0},
    {"tressfx", PLAIT_MODEL_TRESSFX, 0}};

struct Pose {
    std::array<double, 4> q = {0, 0, 0, 1};
    std::array<double, 3> t = {0, 0, 0};
};

std::array<double, 3> rotated(const std::array<double, 4>& q, const std::array<double, 3>& v) {
    const std::array<double, 3> u = {2 * (q[1] * v[2] - q[2] * v[1]),
                                     2 * (q[2] * v[0] - q[0] * v[2]),
                                     2 * (q[0] * v[1] - q[1] * v[0])};
    return {v[0] + q[3] * u[0] + q[1] * u[2] - q[2] * u[1],
            v[1] + q[3] * u[1] + q[2] * u[0] - q[0] * u[2],
            v[2] + q[3] * u[2] + q[0] * u[1] - q[1] * u[0]};
}

// a after b; both turn about y only.
Pose after(const Pose& a, const Pose& b) {
    Pose pose;
    pose.q = {0, a.q[3] * b.q[1] + a.q[1] * b.q[3], 0, a.q[3] * b.q[3] - a.q[1] * b.q[1]};
    const auto t = rotated(a.q, b.t);
    for (size_t i = 0; i < 3; ++i)
        pose.t[i] = a.t[i] + t[i];
    return pose;
}

Pose turned(double angle, std::array<double, 3> t = {}) {
    return {{0, std::sin(angle / 2), 0, std::cos(angle / 2)}, t};
}

plait_pose as_floats(const Pose& pose) {
    plait_pose floats;
    std::copy(pose.q.begin(), pose.q.end(), floats.q);
    std::copy(pose.t.begin(), pose.t.end(), floats.t);
    return floats;
}

// A strand that hangs from the origin or beside it, and a body that goes along, out of its way.
class Ride {
  public:
    Ride(const plait::Context& context, const Motion& motion, const Model& model)
        : context_(context), motion_(motion), model_(model), sim_(make()) {
        auto body = smooth_collider();
        body.capsule.a[0] = body.capsule.b[0] = -0.3f;
        body.capsule.radius_a = body.capsule.radius_b = 0.05f;
        body_ = sim_.create_collider(body);
    }

    plait::Sim make() const {
        Strand strand;
        for (size_t i = 0; i < vertices; ++i)
            strand.push_back({model_.beside, -length * static_cast<float>(i) / (vertices - 1), 0});
        plait::SimDesc desc;
        desc.model = model_.model;
        desc.substeps = model_.substeps;
        desc.wetness.on = model_.model != PLAIT_MODEL_TRESSFX;
        desc.acceleration.on = true;
        desc.params.bdf2 = model_.bdf2;
        if (model_.model != PLAIT_MODEL_TRESSFX) {
            desc.params.air_with_head = 1;
            desc.params.drag = 4;
        } else { // whose hair stretches, and is braked against the world
            desc.params.gravity[1] = 0;
            desc.tressfx.damping = desc.tressfx.vsp_coeff = 0;
        }
        plait::Sim sim(context_, make_groom({strand}), desc);
        if (model_.wind)
            sim.set_wind(plait_wind_desc_defaults());
        return sim;
    }

    Pose pose() const {
        const double time = frame_ * frame;
        return after(base_, turned(2 * 3.14159265358979323846 * motion_.turns * time,
                                   {motion_.speed * time, 0, 0}));
    }
    void aim() {
        auto roots = plait_roots_defaults();
        roots.head = as_floats(pose());
        roots.scale = scale_;
        sim_.set_roots(roots);
        if (body_.value)
            sim_.set_collider_pose(body_, roots.head);
    }
    void step(int count = 1) {
        for (int i = 0; i < count; ++i)
            step_by(1);
    }
    void step_by(double frames) {
        frame_ += frames;
        aim();
        sim_.step(frames * frame);
    }
    // The head goes on from `by` after where it is, as it moved, turned as well.
    void displace(const Pose& by) { base_ = after(by, base_); }
    void resize(float scale) { scale_ = scale; }
    void teleport() {
        auto roots = plait_roots_defaults();
        roots.head = as_floats(pose());
        if (body_.value)
            sim_.set_collider_pose(body_, roots.head);
        roots.scale = scale_;
        sim_.teleport(roots);
    }

    // m, in the head's frame, of all vertices.
    std::vector<double> hair() {
        const auto world = sim_.read(PLAIT_FIELD_POSITION);
        const Pose head = pose();
        const std::array<double, 4> back = {-head.q[0], -head.q[1], -head.q[2], head.q[3]};
        std::vector<double> local;
        for (size_t i = 0; i < world.size(); i += 4) {
            const auto p = rotated(
                back, {world[i] - head.t[0], world[i + 1] - head.t[1], world[i + 2] - head.t[2]});
            local.insert(local.end(), p.begin(), p.end());
        }
        return local;
    }

    plait::Sim& sim() { return sim_; }
    plait_collider_id body() const { return body_; }
    const Model& model() const { return model_; }
    const plait::Context& context() const { return context_; }
    double speed() const { return motion_.speed; }
    void take(plait::Sim&& sim) { sim_ = std::move(sim); }
    void forget_body() { body_ = {}; }
    void wait(double frames) { frame_ += frames; }

  private:
    const plait::Context& context_;
    Motion motion_;
    Model model_;
    plait::Sim sim_;
    plait_collider_id body_{};
    double frame_ = first;
    float scale_ = 1;
    Pose base_;
};

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0;
    for (size_t i = 0; i < a.size(); i += 3)
        square = std::max(square, (a[i] - b[i]) * (a[i] - b[i]) +
                                      (a[i + 1] - b[i + 1]) * (a[i + 1] - b[i + 1]) +
                                      (a[i + 2] - b[i + 2]) * (a[i + 2] - b[i + 2]));
    return std::sqrt(square);
}

// What is called while the head moves, and the functions of the API that it stands for.
struct Call {
    const char* name;
    std::vector<const char*> functions;
    std::function<void(Ride&)> make;
    bool lanes_only = false; // of the model articulated
    bool rounds = false;     // places in the world are not those of a grid of float32 then
};

void with_params(Ride& ride, const std::function<void(plait_sim_params&)>& change) {
    auto params = ride.sim().params();
    change(params);
    ride.sim().set_params(params);
}

void with_settings(Ride& ride, uint32_t substeps, uint32_t iterations, uint32_t bdf2) {
    auto settings = plait_strand_settings_defaults();
    settings.substeps = substeps;
    settings.iterations = iterations;
    settings.bdf2 = bdf2;
    ride.sim().set_settings({settings});
}

void rewrite(Ride& ride, plait_field field) {
    ride.sim().write(field, ride.sim().read(field));
}

std::vector<Call> calls() {
    return {
        {"nothing",
         {"plait_sim_step", "plait_sim_set_roots", "plait_collider_set_pose"},
         [](Ride& r) { r.step(); }},
        {"teleport_to_where_it_is", {"plait_sim_teleport"}, [](Ride& r) { r.teleport(); }},
        {"teleport_by_an_offset",
         {"plait_sim_teleport"},
         [](Ride& r) {
             r.displace({{0, 0, 0, 1}, {3, 1, -2}});
             r.teleport();
         }},
        {"teleport_by_a_turn",
         {"plait_sim_teleport"},
         [](Ride& r) {
             r.displace(turned(2, {3, 1, -2}));
             r.teleport();
         }},
        {"teleport_in_place_of_an_aim",
         {"plait_sim_teleport"},
         [](Ride& r) {
             r.wait(1);
             r.teleport();
             r.sim().step(frame);
         }},
        {"teleport_and_an_aim_at_the_same_place",
         {"plait_sim_teleport"},
         [](Ride& r) {
             r.wait(1);
             r.teleport();
             r.aim();
             r.sim().step(frame);
         }},
        {"reset", {"plait_sim_reset"}, [](Ride& r) { r.sim().reset(); }},
        {"reset_and_a_step_without_an_aim",
         {"plait_sim_reset"},
         [](Ride& r) {
             r.sim().reset();
             r.sim().step(frame);
         }},
        {"write_positions",
         {"plait_sim_write", "plait_sim_read"},
         [](Ride& r) { rewrite(r, PLAIT_FIELD_POSITION); }},
        {"write_velocities",
         {"plait_sim_write"},
         [](Ride& r) { rewrite(r, PLAIT_FIELD_VELOCITY); }},
        {"write_positions_before",
         {"plait_sim_write"},
         [](Ride& r) { rewrite(r, PLAIT_FIELD_POSITION_PREV); }},
        {"write_accelerations",
         {"plait_sim_write"},
         [](Ride& r) { rewrite(r, PLAIT_FIELD_ACCELERATION); }},
        {"write_pins", {"plait_sim_write"}, [](Ride& r) { rewrite(r, PLAIT_FIELD_PIN); }, true},
        {"wet_and_dry",
         {"plait_sim_write"},
         [](Ride& r) {
             r.sim().write(PLAIT_FIELD_WETNESS, {0.5f});
             r.step();
             r.sim().write(PLAIT_FIELD_WETNESS, {0});
         },
         true},
        {"restore",
         {"plait_sim_save", "plait_sim_restore", "plait_sim_hash"},
         [](Ride& r) {
             const auto bytes = r.sim().save();
             r.sim().hash();
             r.sim().restore(bytes);
         }},
        {"restore_into_another_sim",
         {"plait_sim_restore", "plait_sim_destroy"},
         [](Ride& r) {
             const auto bytes = r.sim().save();
             r.take(r.make());
             r.sim().restore(bytes);
         }},
        {"restore_into_another_integrator",
         {"plait_sim_restore"},
         [](Ride& r) {
             const auto bytes = r.sim().save();
             with_params(r, [](auto& p) { p.bdf2 = p.bdf2 == 0 ? 1 : 0; });
             r.sim().restore(bytes);
         },
         true},
        {"begin_in_motion",
         {"plait_sim_create", "plait_sim_set_roots"},
         [](Ride& r) {
             r.take(r.make());
             r.forget_body();
         }},
        {"begin_late",
         {"plait_sim_create", "plait_sim_teleport"},
         [](Ride& r) {
             r.take(r.make());
             r.forget_body();
             r.sim().step(0.5);
             r.teleport();
         }},
        {"bdf2_off_and_on",
         {"plait_sim_set_params", "plait_sim_get_params"},
         [](Ride& r) {
             const uint32_t bdf2 = r.sim().params().bdf2;
             with_params(r, [](auto& p) { p.bdf2 = p.bdf2 == 0 ? 1 : 0; });
             r.step();
             with_params(r, [&](auto& p) { p.bdf2 = bdf2; });
         },
         true},
        {"iterations",
         {"plait_sim_set_params"},
         [](Ride& r) { with_params(r, [](auto& p) { p.iterations = 3; }); },
         true},
        {"drag",
         {"plait_sim_set_params"},
         [](Ride& r) { with_params(r, [](auto& p) { p.drag = 8; }); },
         true},
        {"drag_by_name",
         {"plait_sim_set_param", "plait_sim_get_param"},
         [](Ride& r) { r.sim().set_param("drag", {2 * r.sim().param("drag")[0] + 1}); },
         true},
        {"material_by_name",
         {"plait_sim_set_param"},
         [](Ride& r) { r.sim().set_param("bend_stiffness", {1e-7}); },
         true},
        {"preset",
         {"plait_sim_set_preset", "plait_preset_read", "plait_presets_list"},
         [](Ride& r) { r.sim().set_preset("bob"); },
         true},
        {"materials",
         {"plait_sim_set_materials"},
         [](Ride& r) {
             auto material = plait_material_defaults();
             material.line_density = 1e-5f;
             plait::check(plait_sim_set_materials(r.sim().get(), &material, 1, {}));
         },
         true},
        {"grid",
         {"plait_sim_set_grid"},
         [](Ride& r) {
             const auto grid = plait_grid_desc_defaults();
             r.sim().set_grid(&grid);
         }},
        {"grid_of_parts",
         {"plait_sim_set_reduce"},
         [](Ride& r) {
             auto grid = plait_grid_desc_defaults();
             grid.edge = 1;
             std::fill_n(grid.origin, 3, -0.5f);
             r.sim().set_grid(&grid);
             r.sim().set_reduce([](int64_t*, size_t, void*) { return 0; }, nullptr);
         }},
        {"volume_on_and_off",
         {"plait_sim_set_volume"},
         [](Ride& r) {
             const auto volume = plait_volume_desc_defaults();
             r.sim().set_volume(&volume);
             r.sim().set_volume(nullptr);
         },
         true},
        {"strand_contact",
         {"plait_sim_set_strand_contact"},
         [](Ride& r) {
             const auto contact = plait_strand_contact_desc_defaults();
             r.sim().set_strand_contact(&contact);
             r.step();
             r.sim().set_strand_contact(nullptr);
         },
         true},
        {"wetness_off_and_on",
         {"plait_sim_set_wetness"},
         [](Ride& r) {
             r.sim().set_wetness(nullptr);
             r.step();
             const auto wetness = plait_wetness_desc_defaults();
             r.sim().set_wetness(&wetness);
         },
         true},
        {"acceleration_off_and_on",
         {"plait_sim_set_acceleration"},
         [](Ride& r) {
             r.sim().set_acceleration(nullptr);
             r.step();
             const auto acceleration = plait_acceleration_desc_defaults();
             r.sim().set_acceleration(&acceleration);
         }},
        {"tressfx",
         {"plait_sim_set_tressfx"},
         [](Ride& r) { // refused by the other model
             auto desc = plait_tressfx_desc_defaults();
             desc.damping = desc.vsp_coeff = 0;
             desc.local_iterations = 3;
             (void)plait_sim_set_tressfx(r.sim().get(), &desc);
         }},
        {"substeps",
         {"plait_sim_set_settings", "plait_sim_get_settings"},
         [](Ride& r) {
             with_settings(r, 3, PLAIT_SETTING_OF_SIM, PLAIT_SETTING_OF_SIM);
             r.step(2);
             with_settings(r, 2, PLAIT_SETTING_OF_SIM, PLAIT_SETTING_OF_SIM);
             r.step(2);
             with_settings(r, 1, PLAIT_SETTING_OF_SIM, PLAIT_SETTING_OF_SIM);
         },
         true},
        {"integrator",
         {"plait_sim_set_settings"},
         [](Ride& r) {
             with_settings(r, 1, 2, 0);
             r.step();
             with_settings(r, 1, 2, 1);
         },
         true},
        {"pins",
         {"plait_sim_set_pins"},
         [](Ride& r) {
             plait_pin pin{};
             pin.vertex = 8;
             pin.stiffness = 1;
             r.sim().set_pins({pin});
             r.step(2);
             r.teleport();
             r.step(2);
             r.sim().set_pins({});
         },
         true},
        {"frame",
         {"plait_sim_set_frame"},
         [](Ride& r) {
             auto frame_of = plait_frame_desc_defaults();
             for (int i = 0; i < 8; ++i) {
                 r.wait(1);
                 r.aim();
                 frame_of.pose = as_floats(r.pose());
                 frame_of.felt_translation = frame_of.felt_rotation = i < 4 ? 0.0f : 0.5f;
                 r.sim().set_frame(frame_of);
                 r.sim().step(frame);
             }
             r.sim().no_frame();
         }},
        {"a_frame_that_is_told_after_a_teleport",
         {"plait_sim_set_frame", "plait_sim_teleport"},
         [](Ride& r) {
             auto frame_of = plait_frame_desc_defaults();
             for (int i = 0; i < 8; ++i) {
                 if (i == 4) {
                     r.displace(turned(1, {1, 0.5, -1}));
                     r.teleport();
                 }
                 r.wait(1);
                 r.aim();
                 frame_of.pose = as_floats(r.pose());
                 r.sim().set_frame(frame_of);
                 r.sim().step(frame);
             }
             r.sim().no_frame();
         },
         false,
         true},
        {"wind_off", {"plait_sim_set_wind"}, [](Ride& r) { r.sim().stop_wind(); }},
        {"detail_off",
         {"plait_sim_set_detail"},
         [](Ride& r) { (void)plait_sim_set_detail(r.sim().get(), nullptr); }},
        {"no_levels", // what they do to hair on its way is in levels_in_sim.cpp
         {"plait_sim_set_level", "plait_sim_get_level"},
         [](Ride& r) {
             const auto choice = plait_level_choice_defaults();
             auto state = plait_level_state_defaults();
             (void)plait_sim_set_level(r.sim().get(), &choice);
             (void)plait_sim_get_level(r.sim().get(), &state);
         }},
        {"colliders",
         {"plait_collider_create", "plait_collider_destroy", "plait_collider_set_shape",
          "plait_collider_describe", "plait_colliders_list"},
         [](Ride& r) {
             auto body = smooth_collider();
             body.capsule.a[1] = body.capsule.b[1] = 1;
             body.capsule.radius_a = body.capsule.radius_b = 0.1f;
             body.pose = as_floats(r.pose());
             const auto id = r.sim().create_collider(body);
             body.capsule.radius_a = 0.2f;
             r.sim().set_collider_shape(id, body);
             r.step();
             plait_collider_describe(r.sim().get(), id, &body);
             size_t count = 0;
             plait_colliders_list(r.sim().get(), nullptr, &count);
             r.sim().destroy_collider(id);
         }},
        {"place_a_body",
         {"plait_collider_place"},
         [](Ride& r) {
             const plait_pose pose = as_floats(r.pose());
             if (r.body().value)
                 plait::check(plait_collider_place(r.sim().get(), r.body(), &pose));
         }},
        {"share_colliders",
         {"plait_sim_share_colliders"},
         [](Ride& r) {
             auto other = r.make();
             other.share_colliders(r.sim());
             r.step();
             r.sim().share_colliders(nullptr);
         }},
        {"groom",
         {"plait_sim_set_params", "plait_sim_find_balance"},
         [](Ride& r) {
             with_params(r, [](auto& p) { p.groom = 0.5f; });
             (void)plait_sim_find_balance(r.sim().get()); // INVALID_STATE: no groom in balance
             r.step();
             with_params(r, [](auto& p) { p.groom = 0; });
         },
         true},
        {"free_roots",
         {"plait_sim_bind_roots"},
         [](Ride& r) { (void)plait_sim_bind_roots(r.sim().get(), nullptr, nullptr, 0); }},
        {"look",
         {"plait_sim_wait", "plait_sim_describe", "plait_sim_measure", "plait_sim_get_stage_times",
          "plait_sim_take_launches"},
         [](Ride& r) {
             r.sim().wait();
             r.sim().describe();
             r.sim().measure();
             r.sim().stage_times();
             size_t count = 0;
             (void)plait_sim_take_launches(r.sim().get(), nullptr, &count);
         }},
        {"read_later",
         {"plait_sim_read_later", "plait_sim_fence", "plait_sim_fence_reached",
          "plait_sim_fence_wait"},
         [](Ride& r) {
             std::vector<float> later;
             const auto fence = r.sim().read_later(PLAIT_FIELD_POSITION, later);
             (void)r.sim().fence_reached(r.sim().fence());
             r.sim().fence_wait(fence);
         }},
        {"dropped_steps", {"plait_sim_step"}, [](Ride& r) { r.step_by(30); }},
        {"a_long_sleep", {"plait_sim_step"}, [](Ride& r) { r.step_by(900); }},
        {"steps_of_no_time",
         {"plait_sim_step"},
         [](Ride& r) {
             for (int i = 1; i < 4; ++i) {
                 r.displace({{0, 0, 0, 1}, {0, 0.2, 0.1 * i}});
                 r.aim();
                 r.sim().step(i == 2 ? -1e-9 : 0);
             }
         }},
        {"scale",
         {"plait_sim_set_roots"},
         [](Ride& r) {
             for (const float scale : {2.0f, 2.0f, 0.5f, 0.7f, 1.0f}) {
                 r.resize(scale);
                 r.step();
             }
         },
         false,
         true},
        {"scale_by_a_teleport",
         {"plait_sim_teleport"},
         [](Ride& r) {
             r.resize(3);
             r.teleport();
             r.step();
             r.resize(1);
             r.teleport();
         },
         false,
         true},
        {"scale_between_steps",
         {"plait_sim_set_roots", "plait_sim_step"},
         [](Ride& r) {
             for (const float scale : {1.4f, 1.2f, 1.0f}) {
                 r.resize(scale);
                 r.step_by(0.7);
             }
         },
         false,
         true},
        {"uneven_steps",
         {"plait_sim_step"},
         [](Ride& r) {
             for (const double part : {0.4, 0.35, 0.25, 1.5, 2.0, 0.5, 2.5})
                 r.step_by(part);
         }},
    };
}

class History : public OnBackend {
  protected:
    // m: the farthest that hair goes in the second after the call, so many steps after one ended.
    double thrown(const Motion& motion, const Model& model, const Call& call, double late = 0) {
        Ride ride(context, motion, model);
        ride.step(static_cast<int>(-first));
        if (late > 0)
            ride.step_by(late);
        const auto before = ride.hair();
        call.make(ride);
        double most = 0;
        for (int f = 0; f < 60; ++f) {
            ride.step();
            most = std::max(most, farthest(ride.hair(), before));
        }
        return most;
    }
};
ON_EVERY_BACKEND(History);

TEST_P(History, NoCallThrowsHairInUniformMotion) {
    for (const Model& model : models)
        for (const Motion& motion : motions) {
            if (PLAIT_TEST_SEEDS < 24 && motion.turns == 0)
                continue; // sanitizers look at the code, which is the same
            if (model.substeps > 1 && motion.speed > 0 && motion.speed < 30)
                continue; // slower is easier
            const auto list = calls();
            // tressfx keeps places in the world, of which float32 loses some in every step
            const double rounding =
                model.model == PLAIT_MODEL_TRESSFX ? 2 * thrown(motion, model, list.front()) : 0;
            EXPECT_LE(rounding, 1e-4);
            for (const Call& call : list) {
                if (call.lanes_only && model.model == PLAIT_MODEL_TRESSFX)
                    continue;
                const bool rounds = call.rounds && model.model == PLAIT_MODEL_TRESSFX;
                // a third of the step makes thrice the speed of what places are rounded by
                const double bar =
                    motion.turns > 0 || rounds ? 5e-5 : (model.substeps > 1 ? 4e-5 : 1e-5);
                EXPECT_LE(thrown(motion, model, call), bar + rounding)
                    << call.name << ", the head " << motion.name << ", " << model.name;
            }
        }
}

// A game's frame ends where it does: no call is tied to the end of a step.
TEST_P(History, NoCallBetweenTwoStepsThrowsHair) {
    for (const Model& model : {models[0], models[3]})
        for (const Motion& motion : {motions[2], motions[3]})
            for (const Call& call : calls()) {
                const bool tressfx = model.model == PLAIT_MODEL_TRESSFX;
                if (tressfx && (call.lanes_only || motion.turns > 0))
                    continue; // places in the world are those of a grid of float32
                EXPECT_LE(thrown(motion, model, call, 0.4), tressfx ? 1e-4 : 5e-5)
                    << call.name << ", the head " << motion.name << ", " << model.name;
            }
}

// Hair that is swung out goes round, and what leaves it as it is lets it.
TEST_P(History, HairBesideTheAxisGoesOnRound) {
    const std::set<std::string> keep = {"nothing",
                                        "teleport_to_where_it_is",
                                        "teleport_by_an_offset",
                                        "write_positions",
                                        "teleport_by_a_turn",
                                        "write_positions_before",
                                        "write_velocities",
                                        "write_accelerations",
                                        "restore_into_another_sim",
                                        "restore",
                                        "steps_of_no_time",
                                        "uneven_steps",
                                        "look"};
    for (Model model : {models[0], models[2]})
        for (const double late : {0.0, 0.4})
            for (const Call& call : calls()) {
                model.beside = 0.1f;
                if (keep.count(call.name) > 0) {
                    EXPECT_LE(thrown(motions[3], model, call, late), 5e-5)
                        << call.name << ", " << model.name << ", " << late << " of a step late";
                }
            }
}

// Wind is sheltered by the hair as a step begins, wherever it was put before: by what puts it.
TEST_P(History, NoCallInStillWindThrowsHair) {
    const std::set<std::string> put = {"teleport_by_a_turn",
                                       "reset",
                                       "begin_in_motion",
                                       "frame",
                                       "a_frame_that_is_told_after_a_teleport",
                                       "dropped_steps",
                                       "scale"};
    Model model = models[0];
    model.wind = true;
    for (const Call& call : calls())
        if (put.count(call.name) > 0) {
            EXPECT_LE(thrown(motions[1], model, call), 2e-5) << call.name;
        }
}

// Hair that swings and slides on a body: m, in the head's frame, on a head that nods as it goes along.
std::vector<float> on_a_body(const plait::Context& context, float speed) {
    plait::SimDesc desc;
    desc.params.drag = 0; // to the world's air
    plait::Sim sim(context, make_groom(tuft(6, 12)), desc);
    auto body = smooth_collider();
    body.capsule.a[0] = body.capsule.b[0] = 0.08f;
    body.capsule.a[1] = body.capsule.b[1] = -0.08f;
    body.capsule.a[2] = -0.2f;
    body.capsule.b[2] = 0.2f;
    body.capsule.radius_a = body.capsule.radius_b = 0.03f;
    const auto id = sim.create_collider(body);
    float x = 0;
    for (int f = 0; f < 60; ++f) {
        x = speed * static_cast<float>(f - 60) / 64;
        const float nod = 0.01f * std::sin(0.3f * static_cast<float>(std::max(f - 3, 0)));
        const auto roots = head_at({x + nod, 0, 0});
        if (f == 0)
            sim.teleport(roots);
        sim.set_roots(roots);
        sim.set_collider_pose(id, roots.head);
        sim.step(frame);
    }
    auto positions = sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < positions.size(); i += 4)
        positions[i] -= x;
    return positions;
}

// Only a head that speeds up is felt, on a body, too.
TEST_P(History, HairOnABodyMovesAlikeAtAnySpeed) {
    const auto standing = on_a_body(context, 0);
    for (const float speed : {2.0f, -5.0f, 15.0f, 20.0f})
        EXPECT_LE(largest_difference(on_a_body(context, speed), standing), 1e-4f)
            << speed << " m/s";
}

// A game gives bones or poses in every frame, in that of a teleport, too: the same ones at the same place
// say nothing of the way.
TEST_P(History, RootsWithPosesOfTheirOwnSayNoWayTwice) {
    plait::SimDesc desc;
    desc.params.drag = 0; // to the world's air
    desc.sag_free = PLAIT_SAG_FREE_STIFFEN;
    plait::Sim sim(context, make_groom(tuft(3, 12)), desc);
    const std::vector<plait_pose> own(3, {{0, 0, 0, 1}, {0.01f, 0, 0}});
    float x = -6;
    const auto roots = [&] {
        auto all = head_at({x, 0, 0});
        all.root_poses = plait::view(own);
        return all;
    };
    const auto shape = [&] {
        auto positions = sim.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < positions.size(); i += 4)
            positions[i] -= x;
        return positions;
    };
    sim.teleport(roots());
    for (int f = 0; f < 60; ++f) {
        x += 0.1f;
        sim.set_roots(roots());
        sim.step(frame);
    }
    const auto before = shape();
    x = 5;
    sim.teleport(roots());
    for (int f = 0; f < 30; ++f) {
        sim.set_roots(roots());
        sim.step(frame);
        EXPECT_LE(largest_difference(shape(), before), 2e-5f) << "frame " << f;
        x += 0.1f;
    }
}

// A call that is new must be among those above, or say here why it needs none.
TEST(HistoryCalls, EveryCallOnASimIsTried) {
    std::string headers;
    for (const std::string& name : names_of_headers())
        headers += text_of_header(name);
    std::set<std::string> tried = {
        "plait_collider_create_mesh", "plait_collider_create_hull", // as plait_collider_create
        "plait_collider_set_positions",                             // in the collider's own frame
    };
    for (const Call& call : calls())
        tried.insert(call.functions.begin(), call.functions.end());
    const std::regex function(R"((plait_\w+)\((?:const )?plait_sim\*)");
    size_t found = 0;
    for (std::sregex_iterator it(headers.begin(), headers.end(), function), end; it != end; ++it) {
        EXPECT_TRUE(tried.count((*it)[1])) << (*it)[1] << " is not tried on a head that moves";
        ++found;
    }
    EXPECT_GT(found, 30u);
}

} // namespace
