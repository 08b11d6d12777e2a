// Bad arguments of every function: the code, and a sentence that names the argument.
#include "headers.hpp"
#include "support.hpp"

#include <plait/plait_formats.h>
#include <plait/plait_levels.h>
#include <plait/plait_recorder.h>

#ifdef PLAIT_TEST_OPENCL
#include <plait/plait_opencl.h>
#endif

#include <cstring>
#include <functional>
#include <regex>
#include <set>

namespace {

struct Objects {
    plait::Context context = make_context("reference");
    plait::Groom groom = make_groom(tuft(2, 4));
    plait::Sim sim{context, groom};
    plait_context* no_context = nullptr;
    plait_groom* no_groom = nullptr;
    plait_sim* no_sim = nullptr;
    plait_follow_map* no_map = nullptr;
    plait_levels* no_levels = nullptr;
    plait::FollowMap map = groom.guides(1).map;
    plait::FollowLearner learner{groom, map};
    plait_follow_learner* no_learner = nullptr;
    plait_mesh* no_mesh = nullptr;
    plait_recorder* no_recorder = nullptr;
    std::vector<float> floats = std::vector<float>(64, 0.0f);
    size_t size = 0;
};

struct Bad {
    const char* sentence; // a part of it
    std::function<plait_result(Objects&)> call;
    plait_result code = PLAIT_INVALID_ARGUMENT;
};

// The functions that refused, by what they say of themselves.
std::set<std::string> expect_refused(const std::vector<Bad>& table) {
    Objects o;
    std::set<std::string> functions;
    for (const Bad& bad : table) {
        const uint64_t hash = o.sim.hash();
        EXPECT_EQ(bad.call(o), bad.code) << bad.sentence << ": " << plait_last_error();
        EXPECT_NE(std::string(plait_last_error()).find(bad.sentence), std::string::npos)
            << "\"" << bad.sentence << "\" is not in: " << plait_last_error();
        EXPECT_EQ(o.sim.hash(), hash) << bad.sentence;
        EXPECT_TRUE(!o.no_context && !o.no_groom && !o.no_sim && !o.no_map && !o.no_mesh &&
                    !o.no_levels && !o.no_learner && !o.no_recorder)
            << "written on failure";
        const std::string text = plait_last_error();
        functions.insert(text.substr(0, text.find(':')));
    }
    return functions;
}

// Functions of a header that can fail.
std::set<std::string> declared(const std::string& header) {
    const std::string all = text_of_header(header);
    const std::regex declaration("PLAIT_API\\s+plait_result\\s+(\\w+)\\(");
    std::set<std::string> names;
    for (std::sregex_iterator i(all.begin(), all.end(), declaration), end; i != end; ++i)
        names.insert((*i)[1]);
    EXPECT_GT(names.size(), 0u) << header;
    return names;
}

// A value that C can put into an enum and C++ cannot.
template <typename Enum> void set_raw(Enum& value, uint32_t raw) {
    static_assert(sizeof value == sizeof raw);
    std::memcpy(&value, &raw, sizeof raw);
}

// Makes a call with one field of a default struct changed.
template <typename Change> Bad params(const char* sentence, Change change) {
    return {sentence, [change](Objects& o) {
                auto p = plait_sim_params_defaults();
                change(p);
                return plait_sim_set_params(o.sim, &p);
            }};
}
// The same of a feature.
template <typename Desc, typename Change>
Bad feature(const char* sentence, const Desc& defaults,
            plait_result (*set)(plait_sim*, const Desc*), Change change) {
    return {sentence, [=](Objects& o) {
                Desc desc = defaults;
                change(desc);
                return set(o.sim, &desc);
            }};
}
template <typename Change> Bad tressfx(const char* sentence, Change change) {
    return feature(sentence, plait_tressfx_desc_defaults(), plait_sim_set_tressfx, change);
}
template <typename Change> Bad grid(const char* sentence, Change change) {
    return feature(sentence, plait_grid_desc_defaults(), plait_sim_set_grid, change);
}
template <typename Change> Bad volume(const char* sentence, Change change) {
    return feature(sentence, plait_volume_desc_defaults(), plait_sim_set_volume, change);
}
template <typename Change> Bad strand_contact(const char* sentence, Change change) {
    return feature(sentence, plait_strand_contact_desc_defaults(), plait_sim_set_strand_contact,
                   change);
}
template <typename Change> Bad wetness(const char* sentence, Change change) {
    return feature(sentence, plait_wetness_desc_defaults(), plait_sim_set_wetness, change);
}
template <typename Change> Bad sim_desc(const char* sentence, Change change) {
    return {sentence, [change](Objects& o) {
                auto desc = plait_sim_desc_defaults();
                change(desc);
                return plait_sim_create(o.context, o.groom, &desc, &o.no_sim);
            }};
}
template <typename Change>
Bad groom_desc(const char* sentence, Change change, plait_result code = PLAIT_INVALID_ARGUMENT) {
    return {sentence,
            [change](Objects& o) {
                auto desc = plait_groom_desc_defaults();
                desc.positions = plait::view(o.floats, 4);
                desc.vertices_per_strand = 4;
                auto options = plait_import_options_defaults();
                change(desc, options);
                return plait_groom_create(&desc, &options, &o.no_groom);
            },
            code};
}
template <typename Change> Bad roots(const char* sentence, Change change) {
    return {sentence, [change](Objects& o) {
                auto r = plait_roots_defaults();
                change(r, o);
                const plait_result teleport = plait_sim_teleport(o.sim, &r);
                return teleport == PLAIT_INVALID_ARGUMENT ? plait_sim_set_roots(o.sim, &r)
                                                          : teleport;
            }};
}
template <typename Change> Bad collider(const char* sentence, Change change) {
    return {sentence, [change](Objects& o) {
                auto desc = plait_collider_desc_defaults();
                change(desc);
                plait_collider_id id{};
                return plait_collider_create(o.sim, &desc, &id);
            }};
}
template <typename Change> Bad plane(const char* sentence, Change change) {
    return collider(sentence, [change](plait_collider_desc& desc) {
        desc.kind = PLAIT_COLLIDER_KIND_PLANE;
        change(desc);
    });
}
template <typename Change> Bad box(const char* sentence, Change change) {
    return collider(sentence, [change](plait_collider_desc& desc) {
        desc.kind = PLAIT_COLLIDER_KIND_BOX;
        change(desc);
    });
}

TEST(Arguments, NullPointers) {
    using O = Objects;
    const auto context = plait_context_desc_defaults();
    const auto groom = plait_groom_desc_defaults();
    const auto params = plait_sim_params_defaults();
    const auto roots = plait_roots_defaults();
    const auto collider = plait_collider_desc_defaults();
    const plait_pose pose = collider.pose;
    const auto fibre = plait_fibre_defaults();
    const auto map = plait_follow_map_desc_defaults();
    const auto levels = plait_levels_desc_defaults();
    const auto mesh = plait_mesh_desc_defaults();
    const double one = 1;
    const auto refused = expect_refused({
        {"count is NULL", [](O&) { return plait_devices_list(nullptr, nullptr); }},
        {"out is NULL", [&](O&) { return plait_context_create(&context, nullptr); }},
        {"context is NULL", [](O&) { return plait_context_describe(nullptr, nullptr); }},
        {"out is NULL", [](O& o) { return plait_context_describe(o.context, nullptr); }},
        {"context is NULL", [](O&) { return plait_context_prepare(nullptr, nullptr); }},
        {"context is NULL", [](O&) { return plait_context_step(nullptr, nullptr, 0, 0); }},
        {"sims is NULL", [](O& o) { return plait_context_step(o.context, nullptr, 1, 0); }},
        {"context is NULL",
         [](O&) { return plait_context_direct(nullptr, nullptr, 0, nullptr, 0, nullptr); }},
        {"characters is NULL",
         [](O& o) { return plait_context_direct(o.context, nullptr, 1, nullptr, 0, nullptr); }},
        {"desc is NULL", [](O& o) { return plait_groom_create(nullptr, nullptr, &o.no_groom); }},
        {"out is NULL", [&](O&) { return plait_groom_create(&groom, nullptr, nullptr); }},
        {"path is NULL", [](O& o) { return plait_groom_load(nullptr, nullptr, &o.no_groom); }},
        {"out is NULL", [](O&) { return plait_groom_load("x.tfx", nullptr, nullptr); }},
        {"path is NULL",
         [](O& o) {
             return plait_groom_load_part(nullptr, PLAIT_STRAND_PART_ALL, nullptr, &o.no_groom);
         }},
        {"out is NULL",
         [](O&) {
             return plait_groom_load_part("x.abc", PLAIT_STRAND_PART_ALL, nullptr, nullptr);
         }},
        {"path is NULL",
         [](O& o) {
             return plait_groom_load_guides(nullptr, nullptr, &o.no_groom, &o.no_map);
         }},
        {"guides is NULL",
         [](O& o) { return plait_groom_load_guides("x.abc", nullptr, nullptr, &o.no_map); }},
        {"map is NULL",
         [](O& o) { return plait_groom_load_guides("x.abc", nullptr, &o.no_groom, nullptr); }},
        {"groom is NULL", [](O& o) { return plait_groom_read_notes(nullptr, nullptr, &o.size); }},
        {"size is NULL", [](O& o) { return plait_groom_read_notes(o.groom, nullptr, nullptr); }},
        {"path is NULL",
         [](O& o) { return plait_recorder_create(nullptr, nullptr, &o.no_recorder); }},
        {"out is NULL", [](O&) { return plait_recorder_create("x.abc", nullptr, nullptr); }},
        {"recorder is NULL", [](O& o) { return plait_recorder_add(nullptr, o.sim, 0); }},
        {"recorder is NULL",
         [](O&) { return plait_recorder_add_positions(nullptr, nullptr, nullptr, 0); }},
        {"recorder is NULL", [](O&) { return plait_recorder_close(nullptr); }},
        {"groom is NULL", [](O&) { return plait_groom_save(nullptr, "x.tfx"); }},
        {"path is NULL", [](O& o) { return plait_groom_save(o.groom, nullptr); }},
        {"groom is NULL", [](O&) { return plait_groom_describe(nullptr, nullptr); }},
        {"out is NULL", [](O& o) { return plait_groom_describe(o.groom, nullptr); }},
        {"groom is NULL",
         [](O& o) {
             return plait_groom_read(nullptr, PLAIT_GROOM_FIELD_POSITIONS, nullptr, &o.size);
         }},
        {"size is NULL",
         [](O& o) {
             return plait_groom_read(o.groom, PLAIT_GROOM_FIELD_POSITIONS, nullptr, nullptr);
         }},
        {"desc is NULL", [](O& o) { return plait_follow_map_create(nullptr, &o.no_map); }},
        {"out is NULL", [&](O&) { return plait_follow_map_create(&map, nullptr); }},
        {"map is NULL",
         [](O& o) {
             return plait_follow_map_read(nullptr, PLAIT_FOLLOW_MAP_FIELD_GUIDES, nullptr, &o.size);
         }},
        {"map is NULL",
         [&](O& o) { return plait_follow_map_bind(nullptr, o.groom, &roots, {}, &o.no_map); }},
        {"groom is NULL",
         [&](O& o) { return plait_follow_map_bind(o.map, nullptr, &roots, {}, &o.no_map); }},
        {"roots is NULL",
         [](O& o) { return plait_follow_map_bind(o.map, o.groom, nullptr, {}, &o.no_map); }},
        {"positions.data is NULL",
         [&](O& o) {
             return plait_follow_map_bind(o.map, o.groom, &roots, {nullptr, 8, 0}, &o.no_map);
         }},
        {"out is NULL",
         [&](O& o) { return plait_follow_map_bind(o.map, o.groom, &roots, {}, nullptr); }},
        {"desc is NULL", [](O& o) { return plait_levels_create(nullptr, &o.no_levels); }},
        {"out is NULL", [&](O&) { return plait_levels_create(&levels, nullptr); }},
        {"desc->groom is NULL", [&](O& o) { return plait_levels_create(&levels, &o.no_levels); }},
        {"levels is NULL", [](O& o) { return plait_levels_list(nullptr, nullptr, &o.size); }},
        {"levels is NULL",
         [](O& o) { return plait_levels_take(nullptr, 0, &o.no_groom, &o.no_map); }},
        {"groom is NULL",
         [](O& o) { return plait_groom_guides(nullptr, 1, 0, &o.no_groom, &o.no_map); }},
        {"out is NULL", [](O& o) { return plait_groom_guides(o.groom, 1, 0, nullptr, &o.no_map); }},
        {"map is NULL",
         [](O& o) { return plait_groom_guides(o.groom, 1, 0, &o.no_groom, nullptr); }},
        {"groom is NULL",
         [](O& o) { return plait_follow_learner_create(nullptr, o.map, &o.no_learner); }},
        {"map is NULL",
         [](O& o) { return plait_follow_learner_create(o.groom, nullptr, &o.no_learner); }},
        {"out is NULL", [](O& o) { return plait_follow_learner_create(o.groom, o.map, nullptr); }},
        {"learner is NULL",
         [&](O&) { return plait_follow_learner_add_frame(nullptr, &roots, {}); }},
        {"roots is NULL",
         [](O& o) { return plait_follow_learner_add_frame(o.learner, nullptr, {}); }},
        {"positions.data is NULL",
         [&](O& o) {
             return plait_follow_learner_add_frame(o.learner, &roots, {nullptr, 8, 0});
         }},
        {"learner is NULL",
         [](O& o) { return plait_follow_learner_learn(nullptr, &o.no_map, nullptr); }},
        {"out is NULL",
         [](O& o) { return plait_follow_learner_learn(o.learner, nullptr, nullptr); }},
        {"desc is NULL", [](O& o) { return plait_mesh_create(nullptr, nullptr, &o.no_mesh); }},
        {"out is NULL", [&](O&) { return plait_mesh_create(&mesh, nullptr, nullptr); }},
        {"path is NULL", [](O& o) { return plait_mesh_load(nullptr, nullptr, &o.no_mesh); }},
        {"out is NULL", [](O&) { return plait_mesh_load("x.obj", nullptr, nullptr); }},
        {"mesh is NULL", [](O&) { return plait_mesh_describe(nullptr, nullptr); }},
        {"mesh is NULL",
         [](O& o) {
             return plait_mesh_read(nullptr, PLAIT_MESH_FIELD_POSITIONS, nullptr, &o.size);
         }},
        {"mesh is NULL", [](O&) { return plait_mesh_read_bone(nullptr, 0, nullptr); }},
        {"mesh is NULL", [](O&) { return plait_mesh_pose(nullptr, nullptr, nullptr); }},
        {"mesh is NULL", [](O&) { return plait_mesh_fit(nullptr, nullptr, 1, nullptr); }},
        {"context is NULL",
         [](O& o) { return plait_sim_create(nullptr, o.groom, nullptr, &o.no_sim); }},
        {"groom is NULL",
         [](O& o) { return plait_sim_create(o.context, nullptr, nullptr, &o.no_sim); }},
        {"out is NULL",
         [](O& o) { return plait_sim_create(o.context, o.groom, nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_reset(nullptr); }},
        {"sim is NULL", [&](O&) { return plait_sim_set_params(nullptr, &params); }},
        {"params is NULL", [](O& o) { return plait_sim_set_params(o.sim, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_get_params(nullptr, nullptr); }},
        {"params is NULL", [](O& o) { return plait_sim_get_params(o.sim, nullptr); }},
        {"sim is NULL", [&](O&) { return plait_sim_set_roots(nullptr, &roots); }},
        {"roots is NULL", [](O& o) { return plait_sim_set_roots(o.sim, nullptr); }},
        {"sim is NULL", [&](O&) { return plait_sim_teleport(nullptr, &roots); }},
        {"roots is NULL", [](O& o) { return plait_sim_teleport(o.sim, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_step(nullptr, 0.1); }},
        {"sim is NULL", [](O&) { return plait_sim_wait(nullptr); }},
        {"sim is NULL",
         [](O& o) { return plait_sim_read(nullptr, PLAIT_FIELD_POSITION, nullptr, &o.size); }},
        {"size is NULL",
         [](O& o) { return plait_sim_read(o.sim, PLAIT_FIELD_POSITION, nullptr, nullptr); }},
        {"sim is NULL",
         [](O& o) { return plait_sim_write(nullptr, PLAIT_FIELD_POSITION, o.floats.data(), 4); }},
        {"src is NULL",
         [](O& o) { return plait_sim_write(o.sim, PLAIT_FIELD_POSITION, nullptr, 128); }},
        {"sim is NULL",
         [](O& o) {
             uint64_t fence = 0;
             return plait_sim_read_later(nullptr, PLAIT_FIELD_POSITION, o.floats.data(), 128,
                                         &fence);
         }},
        {"dst is NULL",
         [](O& o) {
             uint64_t fence = 0;
             return plait_sim_read_later(o.sim, PLAIT_FIELD_POSITION, nullptr, 128, &fence);
         }},
        {"fence is NULL",
         [](O& o) {
             return plait_sim_read_later(o.sim, PLAIT_FIELD_POSITION, o.floats.data(), 128,
                                         nullptr);
         }},
        {"sim is NULL", [](O&) { return plait_sim_fence(nullptr, nullptr); }},
        {"fence is NULL", [](O& o) { return plait_sim_fence(o.sim, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_fence_reached(nullptr, 1, nullptr); }},
        {"reached is NULL", [](O& o) { return plait_sim_fence_reached(o.sim, 1, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_fence_wait(nullptr, 1); }},
        {"sim is NULL", [](O&) { return plait_sim_measure(nullptr, nullptr); }},
        {"out is NULL", [](O& o) { return plait_sim_measure(o.sim, nullptr); }},
        {"sim is NULL",
         [](O& o) { return plait_sim_get_stage_times(nullptr, nullptr, &o.size, 0); }},
        {"count is NULL",
         [](O& o) { return plait_sim_get_stage_times(o.sim, nullptr, nullptr, 0); }},
        {"sim is NULL", [](O& o) { return plait_sim_take_launches(nullptr, nullptr, &o.size); }},
        {"count is NULL", [](O& o) { return plait_sim_take_launches(o.sim, nullptr, nullptr); }},
        {"sim is NULL", [](O& o) { return plait_sim_save(nullptr, nullptr, &o.size); }},
        {"size is NULL", [](O& o) { return plait_sim_save(o.sim, nullptr, nullptr); }},
        {"sim is NULL", [](O& o) { return plait_sim_restore(nullptr, o.floats.data(), 4); }},
        {"src is NULL", [](O& o) { return plait_sim_restore(o.sim, nullptr, 4); }},
        {"sim is NULL", [](O&) { return plait_sim_hash(nullptr, nullptr); }},
        {"out is NULL", [](O& o) { return plait_sim_hash(o.sim, nullptr); }},
        {"sim is NULL", [&](O&) { return plait_collider_create(nullptr, &collider, nullptr); }},
        {"out is NULL", [&](O& o) { return plait_collider_create(o.sim, &collider, nullptr); }},
        {"sim is NULL",
         [](O&) { return plait_collider_create_mesh(nullptr, nullptr, nullptr, nullptr); }},
        {"mesh is NULL",
         [](O& o) { return plait_collider_create_mesh(o.sim, nullptr, nullptr, nullptr); }},
        {"sim is NULL",
         [](O&) { return plait_collider_create_hull(nullptr, nullptr, nullptr, nullptr); }},
        {"mesh is NULL",
         [](O& o) { return plait_collider_create_hull(o.sim, nullptr, nullptr, nullptr); }},
        {"sim is NULL", [&](O&) { return plait_collider_set_pose(nullptr, {1}, &pose); }},
        {"pose is NULL", [](O& o) { return plait_collider_set_pose(o.sim, {1}, nullptr); }},
        {"sim is NULL", [&](O&) { return plait_collider_place(nullptr, {1}, &pose); }},
        {"pose is NULL", [](O& o) { return plait_collider_place(o.sim, {1}, nullptr); }},
        {"sim is NULL", [](O&) { return plait_collider_set_positions(nullptr, {1}, nullptr); }},
        {"positions is NULL",
         [](O& o) { return plait_collider_set_positions(o.sim, {1}, nullptr); }},
        {"sim is NULL", [](O&) { return plait_collider_destroy(nullptr, {1}); }},
        {"sim is NULL", [&](O&) { return plait_collider_set_shape(nullptr, {1}, &collider); }},
        {"desc is NULL", [](O& o) { return plait_collider_set_shape(o.sim, {1}, nullptr); }},
        {"sim is NULL", [](O&) { return plait_collider_describe(nullptr, {1}, nullptr); }},
        {"out is NULL", [](O& o) { return plait_collider_describe(o.sim, {1}, nullptr); }},
        {"sim is NULL", [](O& o) { return plait_colliders_list(nullptr, nullptr, &o.size); }},
        {"count is NULL", [](O& o) { return plait_colliders_list(o.sim, nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_share_colliders(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_describe(nullptr, nullptr); }},
        {"out is NULL", [](O& o) { return plait_sim_describe(o.sim, nullptr); }},
        {"count is NULL", [](O&) { return plait_params_list(nullptr, nullptr); }},
        {"count is NULL", [](O&) { return plait_presets_list(nullptr, nullptr); }},
        {"name is NULL", [](O& o) { return plait_preset_read(nullptr, nullptr, &o.size); }},
        {"count is NULL", [](O&) { return plait_preset_read("bob", nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_preset(nullptr, "bob"); }},
        {"name is NULL", [](O& o) { return plait_sim_set_preset(o.sim, nullptr); }},
        {"sim is NULL", [&](O&) { return plait_sim_set_param(nullptr, "drag", &one, 1); }},
        {"name is NULL", [&](O& o) { return plait_sim_set_param(o.sim, nullptr, &one, 1); }},
        {"values is NULL", [](O& o) { return plait_sim_set_param(o.sim, "drag", nullptr, 1); }},
        {"sim is NULL",
         [](O& o) { return plait_sim_get_param(nullptr, "drag", nullptr, &o.size); }},
        {"name is NULL",
         [](O& o) { return plait_sim_get_param(o.sim, nullptr, nullptr, &o.size); }},
        {"count is NULL",
         [](O& o) { return plait_sim_get_param(o.sim, "drag", nullptr, nullptr); }},
        {"material is NULL", [&](O&) { return plait_material_set_fibre(nullptr, &fibre); }},
        {"fibre is NULL",
         [](O&) {
             auto into = plait_material_defaults();
             return plait_material_set_fibre(&into, nullptr);
         }},
        {"sim is NULL", [](O&) { return plait_sim_set_materials(nullptr, nullptr, 0, {}); }},
        {"materials is NULL", [](O& o) { return plait_sim_set_materials(o.sim, nullptr, 1, {}); }},
        {"sim is NULL", [](O&) { return plait_sim_set_pins(nullptr, nullptr, 0); }},
        {"sim is NULL", [](O&) { return plait_sim_bind_roots(nullptr, nullptr, nullptr, 0); }},
        {"pins is NULL", [](O& o) { return plait_sim_set_pins(o.sim, nullptr, 1); }},
        {"sim is NULL", [](O&) { return plait_sim_set_wind(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_frame(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_tressfx(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_grid(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_reduce(nullptr, nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_volume(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_strand_contact(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_wetness(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_acceleration(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_find_balance(nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_detail(nullptr, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_level(nullptr, nullptr); }},
        {"the sim has no levels",
         [](O& o) {
             const auto choice = plait_level_choice_defaults();
             return plait_sim_set_level(o.sim, &choice);
         },
         PLAIT_INVALID_STATE},
        {"choice is NULL", [](O& o) { return plait_sim_set_level(o.sim, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_get_level(nullptr, nullptr); }},
        {"state is NULL", [](O& o) { return plait_sim_get_level(o.sim, nullptr); }},
        {"sim is NULL", [](O&) { return plait_sim_set_settings(nullptr, nullptr, 1, {}); }},
        {"settings is NULL", [](O& o) { return plait_sim_set_settings(o.sim, nullptr, 1, {}); }},
        {"sim is NULL", [](O& o) { return plait_sim_get_settings(nullptr, nullptr, &o.size); }},
        {"count is NULL", [](O& o) { return plait_sim_get_settings(o.sim, nullptr, nullptr); }},
        {"api is NULL", [](O&) { return plait_backend_register(nullptr); }},
        {"path is NULL", [](O&) { return plait_backend_load(nullptr); }},
    });
    std::set<std::string> functions;
    for (const std::string& header : names_of_headers())
        functions.merge(declared(header));
    EXPECT_EQ(refused, functions) << "a function has no row above";
}

#ifdef PLAIT_TEST_OPENCL
TEST(Arguments, NullPointersOfInterop) {
    using O = Objects;
    const plait_opencl_handles none{};
    const auto refused = expect_refused({
        {"handles is NULL",
         [](O& o) { return plait_opencl_context_create(nullptr, nullptr, &o.no_context); }},
        {"out is NULL", [&](O&) { return plait_opencl_context_create(&none, nullptr, nullptr); }},
        {"must all be set",
         [&](O& o) { return plait_opencl_context_create(&none, nullptr, &o.no_context); }},
        {"sim is NULL",
         [](O&) {
             cl_mem memory = nullptr;
             return plait_opencl_sim_get_field(nullptr, PLAIT_FIELD_POSITION, &memory);
         }},
        {"out is NULL",
         [](O& o) { return plait_opencl_sim_get_field(o.sim, PLAIT_FIELD_POSITION, nullptr); }},
        {"sim is NULL",
         [](O&) { return plait_opencl_sim_copy_field(nullptr, PLAIT_FIELD_POSITION, nullptr, 0); }},
        {"to is NULL",
         [](O& o) { return plait_opencl_sim_copy_field(o.sim, PLAIT_FIELD_POSITION, nullptr, 0); }},
        {"sim is NULL",
         [](O&) { return plait_opencl_collider_set_positions(nullptr, {1}, nullptr); }},
        {"positions is NULL",
         [](O& o) { return plait_opencl_collider_set_positions(o.sim, {1}, nullptr); }},
        {"sim is NULL", [](O&) { return plait_opencl_sim_set_roots(nullptr, nullptr, nullptr); }},
        {"positions is NULL",
         [](O& o) { return plait_opencl_sim_set_roots(o.sim, nullptr, nullptr); }},
        {"context is NULL",
         [](O&) {
             cl_command_queue queue = nullptr;
             return plait_opencl_context_get_queue(nullptr, &queue);
         }},
        {"out is NULL", [](O& o) { return plait_opencl_context_get_queue(o.context, nullptr); }},
    });
    EXPECT_EQ(refused, declared("plait_opencl.h")) << "a function has no row above";
}
#endif

TEST(Arguments, DestroyingNothingDoesNothing) {
    plait_context_destroy(nullptr);
    plait_groom_destroy(nullptr);
    plait_follow_map_destroy(nullptr);
    plait_levels_destroy(nullptr);
    plait_follow_learner_destroy(nullptr);
    plait_mesh_destroy(nullptr);
    plait_sim_destroy(nullptr);
}

TEST(Arguments, ParametersOutsideTheirRanges) {
    expect_refused({
        params("gravity[2] is nan", [](auto& p) { p.gravity[2] = NAN; }),
        params("gravity[0] is -20000, range is [-10000, 10000]",
               [](auto& p) { p.gravity[0] = -2e4f; }),
        tressfx("damping", [](auto& p) { p.damping = 101; }),
        tressfx("local_stiffness", [](auto& p) { p.local_stiffness = 1.01f; }),
        tressfx("local_iterations is 65, range is [0, 64]",
                [](auto& p) { p.local_iterations = 65; }),
        tressfx("global_stiffness", [](auto& p) { p.global_stiffness = -0.01f; }),
        tressfx("global_range", [](auto& p) { p.global_range = 2; }),
        tressfx("length_iterations", [](auto& p) { p.length_iterations = 257; }),
        tressfx("vsp_coeff", [](auto& p) { p.vsp_coeff = 1.01f; }),
        tressfx("vsp_accel_threshold", [](auto& p) { p.vsp_accel_threshold = -1; }),
        tressfx("max_displacement is 0, range is (0,", [](auto& p) { p.max_displacement = 0; }),
        params("tip_separation", [](auto& p) { p.tip_separation = 101; }),
        tressfx("wind_form", [](auto& p) { set_raw(p.wind_form, 2); }),
        params("follow_form", [](auto& p) { set_raw(p.follow_form, 2); }),
        tressfx("shock_form", [](auto& p) { set_raw(p.shock_form, 2); }),
        tressfx("order", [](auto& p) { set_raw(p.order, 2); }),
        tressfx("wind[1]", [](auto& p) { p.wind[1] = 1001; }),
        tressfx("air_drag", [](auto& p) { p.air_drag = INFINITY; }),
        volume("volume_share", [](auto& p) { p.share = 4.1f; }),
        volume("volume_sweeps", [](auto& p) { p.sweeps = 0; }),
        volume("volume_sweeps", [](auto& p) { p.sweeps = 65; }),
        volume("volume_rate", [](auto& p) { p.rate = -1; }),
        volume("volume_viscosity", [](auto& p) { p.viscosity = 1001; }),
        volume("volume_cohesion", [](auto& p) { p.cohesion = NAN; }),
        wetness("wetness_drying_time", [](auto& p) { p.drying_time = -1; }),
        wetness("wetness_drying_time", [](auto& p) { p.drying_time = INFINITY; }),
        wetness("wetness_cohesion", [](auto& p) { p.cohesion = 10001; }),
        strand_contact("strand_contact_radius is 0, range is (0, 0.1]",
                       [](auto& p) { p.radius = 0; }),
        strand_contact("strand_contact_radius", [](auto& p) { p.radius = 0.11f; }),
        strand_contact("strand_contact_friction", [](auto& p) { p.friction = -0.1f; }),
        strand_contact("strand_contact_friction", [](auto& p) { p.friction = 10.1f; }),
        params("follow_contact", [](auto& p) { p.follow_contact = 2; }),
        tressfx("wind_cone", [](auto& p) { p.wind_cone = 1.6f; }),
        grid("grid_edge_count", [](auto& p) { p.edge_count = 0; }),
        grid("grid_slot_capacity", [](auto& p) { p.slot_capacity = 65537; }),
        grid("grid_slot_hash", [](auto& p) { set_raw(p.slot_hash, 2); }),
        grid("grid_tent", [](auto& p) { set_raw(p.tent, 2); }),
        grid("grid_diffuse_rule", [](auto& p) { set_raw(p.diffuse_rule, 2); }),
        grid("grid_diffuse_ratio", [](auto& p) { p.diffuse_ratio = -1; }),
        grid("grid_diffuse_factor", [](auto& p) { p.diffuse_factor = 1.5f; }),
        grid("grid_diffuse_floor", [](auto& p) { p.diffuse_floor = NAN; }),
        grid("grid_in_world", [](auto& p) { p.in_world = 2; }),
        grid("grid_origin[0]", [](auto& p) { p.origin[0] = NAN; }),
        grid("grid_edge", [](auto& p) { p.edge = -1; }),
        grid("grid_form", [](auto& p) { set_raw(p.form, 2); }),
        grid("edge_count^3 * slot_capacity",
             [](auto& p) {
                 p.form = PLAIT_GRID_FORM_SLOTS;
                 p.edge_count = 64;
                 p.slot_capacity = 65536;
             }),
    });
}

TEST(Arguments, SimDescriptorsOutsideTheirRanges) {
    using D = plait_sim_desc;
    expect_refused({
        sim_desc("model", [](D& d) { set_raw(d.model, 77); }),
        sim_desc("step is 0, range is [1e-05, 1]", [](D& d) { d.step = 0; }),
        sim_desc("substeps", [](D& d) { d.substeps = 0; }),
        sim_desc("max_steps_per_call", [](D& d) { d.max_steps_per_call = 0; }),
        sim_desc("interpolate_output", [](D& d) { d.interpolate_output = 3; }),
        sim_desc("keep_last_frame", [](D& d) { d.keep_last_frame = 2; }),
        sim_desc("follows_per_guide", [](D& d) { d.follows_per_guide = 65; }),
        sim_desc("strand_stiffness.count is 1, the groom has 2",
                 [](D& d) {
                     static const float one = 1.0f;
                     d.strand_stiffness = {&one, 1, 0};
                 }),
        sim_desc("strand_stiffness[1]",
                 [](D& d) {
                     static const float scales[] = {1.0f, -1.0f};
                     d.strand_stiffness = {scales, 2, 0};
                 }),
        sim_desc("sag_free", [](D& d) { set_raw(d.sag_free, 3); }),
        sim_desc("sag_free",
                 [](D& d) {
                     d.model = PLAIT_MODEL_TRESSFX;
                     d.sag_free = PLAIT_SAG_FREE_REST;
                 }),
        sim_desc("follow_radius", [](D& d) { d.follow_radius = NAN; }),
        sim_desc("drag", [](D& d) { d.params.drag = -1; }),
        sim_desc("params.struct_size", [](D& d) { d.params.struct_size += 8; }),
    });
}

TEST(Arguments, GroomsThatDoNotAddUp) {
    using D = plait_groom_desc;
    using I = plait_import_options;
    static const uint32_t counts[2] = {3, 4};
    static const float weights[8] = {0.5f, 0.2f, 0, 0, 1, 0, 0, 0};
    expect_refused({
        groom_desc("positions.data is NULL", [](D& d, I&) { d.positions.data = nullptr; }),
        groom_desc("positions.stride is 8", [](D& d, I&) { d.positions.stride = 8; }),
        groom_desc("more than memory", [](D& d, I&) { d.positions.count = SIZE_MAX / 2; }),
        groom_desc("not a multiple", [](D& d, I&) { d.vertices_per_strand = 3; }),
        groom_desc("vertices_per_strand is 0", [](D& d, I&) { d.vertices_per_strand = 0; }),
        groom_desc("add up to 7",
                   [](D& d, I&) {
                       d.vertex_counts = {counts, 2, 0};
                   }),
        groom_desc("thickness.count is 2, there are 4 strands",
                   [](D& d, I&) {
                       d.thickness = {weights, 2, 0};
                   }),
        groom_desc("both or neither",
                   [](D& d, I&) {
                       d.positions.count = 8;
                       d.bone_weights = {weights, 2, 0};
                   }),
        groom_desc(
            "no strand can be kept", [](D&, I&) {}, PLAIT_BAD_DATA),
        groom_desc("policy", [](D&, I& i) { set_raw(i.policy, 2); }),
        groom_desc("min_segment", [](D&, I& i) { i.min_segment = 0.6f; }),
        groom_desc("scale", [](D&, I& i) { i.scale = 0; }),
        groom_desc("resample is 1", [](D&, I& i) { i.resample = 1; }),
        groom_desc("options->allocator: allocate is NULL",
                   [](D&, I& i) { i.allocator.release = [](void*, size_t, size_t, void*) {}; }),
    });
}

TEST(Arguments, RootsThatCannotBe) {
    static const plait_pose poses[3] = {};
    static const float matrices[24] = {};
    expect_refused({
        roots("head: quaternion norm is 0", [](plait_roots& r, Objects&) { r.head.q[3] = 0; }),
        roots("head: translation nan", [](plait_roots& r, Objects&) { r.head.t[1] = NAN; }),
        roots("root_poses: quaternion norm is 0, range is 1 +- 0.001, at index 0",
              [](plait_roots& r, Objects&) {
                  r.root_poses = {poses, 2, 0};
              }),
        roots("both given",
              [](plait_roots& r, Objects&) {
                  r.root_poses = {poses, 2, 0};
                  r.bones = {matrices, 1, 0};
              }),
        roots("root_poses and roots->mesh_positions are both given",
              [](plait_roots& r, Objects&) {
                  r.root_poses = {poses, 2, 0};
                  r.mesh_positions = {matrices, 2, 0};
              }),
        roots("bound to no mesh",
              [](plait_roots& r, Objects&) {
                  r.mesh_positions = {matrices, 2, 0};
              }),
        roots("no skin",
              [](plait_roots& r, Objects&) {
                  r.bones = {matrices, 2, 0};
              }),
        roots("root_poses.count is 1, the sim has 2 guides",
              [](plait_roots& r, Objects&) {
                  static const plait_pose one = {{0, 0, 0, 1}, {0, 0, 0}};
                  r.root_poses = {&one, 1, 0};
              }),
    });
}

TEST(Arguments, TheRest) {
    using O = Objects;
    using C = plait_collider_desc;
    expect_refused({
        {"dt is nan, range is [0, 1e9]", [](O& o) { return plait_sim_step(o.sim, NAN); }},
        {"dt is -1", [](O& o) { return plait_sim_step(o.sim, -1); }},
        {"dt is 1.1e+09", [](O& o) { return plait_sim_step(o.sim, 1.1e9); }},
        {"field is 14",
         [](O& o) { return plait_sim_read(o.sim, PLAIT_FIELD_COUNT, nullptr, &o.size); }},
        {"the grid (plait_sim_set_grid) is off",
         [](O& o) { return plait_sim_read(o.sim, PLAIT_FIELD_GRID_DENSITY, nullptr, &o.size); },
         PLAIT_INVALID_STATE},
        {"*size is 4 bytes, 128 are needed",
         [](O& o) {
             size_t size = 4;
             return plait_sim_read(o.sim, PLAIT_FIELD_POSITION, o.floats.data(), &size);
         }},
        {"*size is 4 bytes",
         [](O& o) {
             size_t size = 4;
             return plait_sim_save(o.sim, o.floats.data(), &size);
         }},
        {"*size is 4 bytes",
         [](O& o) {
             size_t size = 4;
             return plait_groom_read(o.groom, PLAIT_GROOM_FIELD_POSITIONS, o.floats.data(), &size);
         }},
        {"field is 7",
         [](O& o) {
             return plait_groom_read(o.groom, static_cast<plait_groom_field>(7), nullptr, &o.size);
         }},
        {"field is 1, only",
         [](O& o) { return plait_sim_write(o.sim, PLAIT_FIELD_TANGENT, o.floats.data(), 128); }},
        {"size is 64 bytes, the guides take 128",
         [](O& o) { return plait_sim_write(o.sim, PLAIT_FIELD_VELOCITY, o.floats.data(), 64); }},
        {"x.tfx", [](O& o) { return plait_groom_load("/nowhere/x.tfx", nullptr, &o.no_groom); },
         PLAIT_NOT_FOUND},
        {"x.xyz", [](O& o) { return plait_groom_save(o.groom, "x.xyz"); }, PLAIT_UNSUPPORTED},
        collider("radius_a is 0, range is (0, 1000]", [](C& c) { c.capsule.radius_a = 0; }),
        collider("radius_b", [](C& c) { c.capsule.radius_b = NAN; }),
        collider("friction", [](C& c) { c.friction = 11; }),
        collider("a[1]", [](C& c) { c.capsule.a[1] = NAN; }),
        collider("desc->pose: quaternion", [](C& c) { c.pose.q[0] = 1; }),
        collider("kind is 3, range is [0, 2]",
                 [](C& c) { c.kind = static_cast<plait_collider_kind>(3); }),
        plane("length of normal is 0, range is [1e-06, 2e+06]",
              [](C& c) { c.plane.normal[1] = 0; }),
        plane("normal[2] is nan, range is [-1e+06, 1e+06]", [](C& c) { c.plane.normal[2] = NAN; }),
        plane("point[0] is nan", [](C& c) { c.plane.point[0] = NAN; }),
        plane("friction is -1", [](C& c) { c.friction = -1; }),
        box("half_extents[1] is -1, range is [0, 1000]", [](C& c) { c.box.half_extents[1] = -1; }),
        box("half_extents[2] is 2000", [](C& c) { c.box.half_extents[2] = 2000; }),
        box("rounding is -0.5, range is [0, 1000]", [](C& c) { c.box.rounding = -0.5f; }),
        box("orientation: quaternion norm is 1.41421, range is 1 +- 0.001",
            [](C& c) { c.box.orientation[0] = 1; }),
        {"radius_a is 0, range is (0, 1000]",
         [](O& o) {
             auto desc = plait_collider_desc_defaults();
             desc.capsule.radius_a = 0;
             return plait_collider_set_shape(o.sim, {1}, &desc);
         }},
        {"profile is 2",
         [](O& o) {
             auto desc = plait_context_desc_defaults();
             desc.profile = 2;
             return plait_context_create(&desc, &o.no_context);
         }},
        {"desc->lanes is 3; it is 1, 4, 8, 16 or 0",
         [](O& o) {
             auto desc = plait_context_desc_defaults(); // of no backend: none is passed over
             desc.lanes = 3;
             return plait_context_create(&desc, &o.no_context);
         }},
        {"stage_sources is NULL",
         [](O& o) {
             auto desc = plait_context_desc_defaults();
             desc.stage_source_count = 1;
             return plait_context_create(&desc, &o.no_context);
         }},
    });
}

// ---- versioned structs

TEST(Structs, ASizeThatWasNeverSetIsRefused) {
    Objects o;
    plait_sim_params params = plait_sim_params_defaults();
    params.struct_size = 0;
    EXPECT_EQ(plait_sim_set_params(o.sim, &params), PLAIT_INVALID_ARGUMENT);
    plait_sim_measures stats{};
    EXPECT_EQ(plait_sim_measure(o.sim, &stats), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("struct_size"), std::string::npos);
}

TEST(Structs, AShorterStructKeepsTheDefaultsOfTheRest) {
    Objects o;
    plait_sim_params params;
    std::memset(&params, 0x55, sizeof params); // what lies beyond must not be read
    plait_sim_params_init(&params, offsetof(plait_sim_params, drag));
    params.gravity[1] = -1;
    ASSERT_EQ(plait_sim_set_params(o.sim, &params), PLAIT_OK) << plait_last_error();
    const auto now = o.sim.params();
    EXPECT_EQ(now.gravity[1], -1);
    EXPECT_EQ(now.drag, plait_sim_params_defaults().drag);
    EXPECT_EQ(now.bdf2, PLAIT_BDF2_OF_MODEL);
}

TEST(Structs, ASizeBeyondThatOfAnyStructIsRefusedUnread) {
    Objects o;
    plait_sim_params params = plait_sim_params_defaults();
    params.struct_size = 0xcccccccc; // memory that nobody wrote
    EXPECT_EQ(plait_sim_set_params(o.sim, &params), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("3435973836, range is [4, 4096]"),
              std::string::npos)
        << plait_last_error();
    auto info = plait_sim_info_defaults();
    info.struct_size = PLAIT_STRUCT_SIZE_MAX + 8;
    EXPECT_EQ(plait_sim_describe(o.sim, &info), PLAIT_INVALID_ARGUMENT);
}

// Callers of a plait.h from before `text` have shorter elements.
TEST(Structs, ElementsOfAListMayBeShorter) {
    constexpr uint32_t size = offsetof(plait_param_info, text);
    std::vector<uint64_t> memory(3 * size / sizeof(uint64_t) + 1, 77);
    const auto element = [&](size_t i) {
        return reinterpret_cast<plait_param_info*>(memory.data() + i * size / sizeof(uint64_t));
    };
    for (size_t i = 0; i < 3; ++i)
        plait_param_info_init(element(i), size);
    size_t count = 3;
    ASSERT_EQ(plait_params_list(element(0), &count), PLAIT_OK) << plait_last_error();
    EXPECT_STREQ(element(1)->name, "follow_contact");
    EXPECT_STREQ(element(2)->name, "tip_separation");
    EXPECT_EQ(element(2)->struct_size, size);
    EXPECT_EQ(memory.back(), 77u);
}

struct LongerInfo {
    plait_param_info known;
    uint64_t unknown;
};

TEST(Structs, ElementsOfAListLieAsFarApartAsTheirSizeSays) {
    std::vector<LongerInfo> list(3);
    for (LongerInfo& info : list) {
        plait_param_info_init(&info.known, sizeof info);
        info.unknown = 77;
    }
    size_t count = list.size();
    ASSERT_EQ(plait_params_list(&list[0].known, &count), PLAIT_OK) << plait_last_error();
    EXPECT_STREQ(list[0].known.name, "gravity");
    EXPECT_STREQ(list[2].known.name, "tip_separation");
    EXPECT_EQ(list[1].unknown, 77u);
    EXPECT_EQ(list[1].known.struct_size, sizeof(LongerInfo));
}

struct Longer {
    plait_sim_params known;
    float unknown[2];
};

TEST(Structs, ALongerStructIsTakenOnlyIfTheUnknownPartIsZero) {
    Objects o;
    Longer longer;
    plait_sim_params_init(&longer.known, sizeof longer);
    EXPECT_EQ(longer.unknown[0], 0);
    longer.known.groom = 0.5f;
    EXPECT_EQ(plait_sim_set_params(o.sim, &longer.known), PLAIT_OK) << plait_last_error();
    EXPECT_EQ(o.sim.params().groom, 0.5f);
    longer.unknown[1] = 1;
    longer.known.groom = 0.25f;
    EXPECT_EQ(plait_sim_set_params(o.sim, &longer.known), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(o.sim.params().groom, 0.5f);
}

TEST(Structs, OutputsAreWrittenNoFurtherThanTheirSize) {
    Objects o;
    plait_sim_measures stats;
    std::memset(&stats, 0x55, sizeof stats);
    stats.struct_size = offsetof(plait_sim_measures, mean_stretch);
    ASSERT_EQ(plait_sim_measure(o.sim, &stats), PLAIT_OK);
    EXPECT_GE(stats.max_stretch, 0);
    EXPECT_LT(stats.max_stretch, 1);
    uint32_t beyond;
    std::memcpy(&beyond, &stats.mean_stretch, sizeof beyond);
    EXPECT_EQ(beyond, 0x55555555u);
    EXPECT_EQ(stats.struct_size, offsetof(plait_sim_measures, mean_stretch));
}

TEST(Structs, SizesAreQueriedWithoutADestination) {
    Objects o;
    size_t size = 0;
    EXPECT_EQ(plait_sim_read(o.sim, PLAIT_FIELD_TANGENT, nullptr, &size), PLAIT_OK);
    EXPECT_EQ(size, 2u * 4 * 16);
    EXPECT_EQ(plait_groom_read(o.groom, PLAIT_GROOM_FIELD_THICKNESS, nullptr, &size), PLAIT_OK);
    EXPECT_EQ(size, 0u);
    EXPECT_EQ(plait_sim_save(o.sim, nullptr, &size), PLAIT_OK);
    EXPECT_EQ(size, o.sim.save().size());
}

} // namespace
