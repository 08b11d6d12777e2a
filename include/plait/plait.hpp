// Owning handles over plait.h, plait_levels.h, plait_offline.h and plait_profile.h, for C++17. The only exceptions of
// plait are thrown here.
//
// Each class owns one handle: movable, not copyable, convertible to the C handle, so every function
// of these headers stays within reach. A failed call throws plait::Error with its code and sentence.
#ifndef PLAIT_HPP
#define PLAIT_HPP

#include <plait/plait.h>
#include <plait/plait_async.h>
#include <plait/plait_cluster.h>
#include <plait/plait_levels.h>
#include <plait/plait_offline.h>
#include <plait/plait_presets.h>
#include <plait/plait_profile.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace plait {
// A namespace of its own, since plait linked as a static library has internal classes of the same
// names, and the linker would take their members for these. Users write plait::Sim.
inline namespace handles {

class Error : public std::runtime_error {
  public:
    Error(plait_result code, const char* message) : std::runtime_error(message), code_(code) {}
    plait_result code() const noexcept { return code_; }

  private:
    plait_result code_;
};

inline void check(plait_result result) {
    if (result != PLAIT_OK)
        throw Error(result, plait_last_error());
}

// A view of anything with data() and size(): std::vector, std::array, std::span. `width`
// consecutive values make one element, so floats in threes are view(floats, 3). The container
// outlives the call it is passed to.
template <typename Range> plait_view view(const Range& range, std::size_t width = 1) {
    using Value = std::remove_cv_t<std::remove_pointer_t<decltype(range.data())>>;
    static_assert(std::is_trivially_copyable_v<Value>, "plait copies elements as bytes");
    if (width == 0 || range.size() % width != 0)
        throw Error(PLAIT_INVALID_ARGUMENT, "plait::view: size is not a multiple of width");
    return {range.data(), range.size() / width, width * sizeof(Value)};
}

namespace detail {
template <auto Destroy> struct Destroyer {
    template <typename Handle> void operator()(Handle* handle) const { Destroy(handle); }
};
template <typename Handle, auto Destroy> class Owner {
  public:
    explicit Owner(Handle* handle) : handle_(handle) {}
    Handle* get() const noexcept { return handle_.get(); }
    operator Handle*() const noexcept { return get(); }

  private:
    std::unique_ptr<Handle, Destroyer<Destroy>> handle_;
};
} // namespace detail

inline std::vector<plait_device_info> devices() {
    std::size_t count = 0;
    check(plait_devices_list(nullptr, &count));
    std::vector<plait_device_info> list(count, plait_device_info_defaults());
    check(plait_devices_list(list.data(), &count));
    list.resize(count);
    return list;
}

inline std::vector<plait_param_info> params_list() {
    std::size_t count = 0;
    check(plait_params_list(nullptr, &count));
    std::vector<plait_param_info> list(count, plait_param_info_defaults());
    check(plait_params_list(list.data(), &count));
    list.resize(count);
    return list;
}

class Context : public detail::Owner<plait_context, plait_context_destroy> {
  public:
    explicit Context(const plait_context_desc& desc = plait_context_desc_defaults())
        : Owner(create(desc)) {}

    plait_device_info describe() const {
        auto info = plait_device_info_defaults();
        check(plait_context_describe(get(), &info));
        return info;
    }

    void prepare(const plait_prepare_desc& desc = plait_prepare_desc_defaults()) const {
        check(plait_context_prepare(get(), &desc));
    }

    // Sims of this context: context.step({head, beard}, dt).
    void step(const std::vector<plait_sim*>& sims, double dt) const {
        check(plait_context_step(get(), sims.data(), sims.size(), dt));
    }
    // Once a frame, before.
    plait_director_info direct(const std::vector<plait_character>& characters,
                               const plait_director_desc& desc, double dt) const {
        auto info = plait_director_info_defaults();
        check(plait_context_direct(get(), characters.data(), characters.size(), &desc, dt, &info));
        return info;
    }

  private:
    static plait_context* create(const plait_context_desc& desc) {
        plait_context* handle = nullptr;
        check(plait_context_create(&desc, &handle));
        return handle;
    }
};

class FollowMap;
class Levels;
struct Guides;

class Groom : public detail::Owner<plait_groom, plait_groom_destroy> {
  public:
    explicit Groom(const plait_groom_desc& desc,
                   const plait_import_options& options = plait_import_options_defaults())
        : Owner(create(desc, options)) {}

    static Groom load(const std::string& path,
                      const plait_import_options& options = plait_import_options_defaults()) {
        plait_groom* handle = nullptr;
        check(plait_groom_load(path.c_str(), &options, &handle));
        return Groom(handle);
    }
    void save(const std::string& path) const { check(plait_groom_save(get(), path.c_str())); }

    plait_groom_info describe() const {
        auto info = plait_groom_info_defaults();
        check(plait_groom_describe(get(), &info));
        return info;
    }

    // T: float for positions, uv, thickness and weights, std::uint32_t for counts and indices.
    template <typename T> std::vector<T> read(plait_groom_field field) const {
        std::size_t size = 0;
        check(plait_groom_read(get(), field, nullptr, &size));
        std::vector<T> values(size / sizeof(T));
        check(plait_groom_read(get(), field, values.data(), &size));
        return values;
    }

    // `count` strands of it as guides, and the map by which the others follow.
    inline Guides guides(std::size_t count, std::uint64_t seed = 0) const;

  private:
    friend class Levels;
    explicit Groom(plait_groom* handle) : Owner(handle) {}
    static plait_groom* create(const plait_groom_desc& desc, const plait_import_options& options) {
        plait_groom* handle = nullptr;
        check(plait_groom_create(&desc, &options, &handle));
        return handle;
    }
};

class FollowMap : public detail::Owner<plait_follow_map, plait_follow_map_destroy> {
  public:
    explicit FollowMap(const plait_follow_map_desc& desc) : Owner(create(desc)) {}

    // T: float for WEIGHTS, else std::uint32_t.
    template <typename T> std::vector<T> read(plait_follow_map_field field) const {
        std::size_t size = 0;
        check(plait_follow_map_read(get(), field, nullptr, &size));
        std::vector<T> values(size / sizeof(T));
        check(plait_follow_map_read(get(), field, values.data(), &size));
        return values;
    }

    // Bound where all strands of `groom` are.
    FollowMap bind(const Groom& groom, const plait_roots& roots,
                   const plait_view& positions) const {
        plait_follow_map* handle = nullptr;
        check(plait_follow_map_bind(get(), groom.get(), &roots, positions, &handle));
        return FollowMap(handle);
    }

  private:
    friend class Groom;
    friend class FollowLearner;
    friend class Levels;
    explicit FollowMap(plait_follow_map* handle) : Owner(handle) {}
    static plait_follow_map* create(const plait_follow_map_desc& desc) {
        plait_follow_map* handle = nullptr;
        check(plait_follow_map_create(&desc, &handle));
        return handle;
    }
};

struct Guides {
    Groom groom;
    FollowMap map;
};

inline Guides Groom::guides(std::size_t count, std::uint64_t seed) const {
    plait_groom* groom = nullptr;
    plait_follow_map* map = nullptr;
    check(plait_groom_guides(get(), count, seed, &groom, &map));
    return {Groom(groom), FollowMap(map)};
}

class FollowLearner : public detail::Owner<plait_follow_learner, plait_follow_learner_destroy> {
  public:
    FollowLearner(const Groom& groom, const FollowMap& map) : Owner(create(groom, map)) {}

    void add_frame(const plait_roots& roots, const plait_view& positions) {
        check(plait_follow_learner_add_frame(get(), &roots, positions));
    }
    FollowMap learn(plait_follow_fit_info* info = nullptr) const {
        plait_follow_map* map = nullptr;
        check(plait_follow_learner_learn(get(), &map, info));
        return FollowMap(map);
    }

  private:
    static plait_follow_learner* create(const Groom& groom, const FollowMap& map) {
        plait_follow_learner* handle = nullptr;
        check(plait_follow_learner_create(groom.get(), map.get(), &handle));
        return handle;
    }
};

// Levels of detail of a groom: `desc.levels` of a sim, or guides and map of one level.
class Levels : public detail::Owner<plait_levels, plait_levels_destroy> {
  public:
    explicit Levels(const plait_levels_desc& desc) : Owner(create(desc)) {}

    std::vector<plait_level> list() const {
        std::size_t count = 0;
        check(plait_levels_list(get(), nullptr, &count));
        std::vector<plait_level> list(count, plait_level_defaults());
        check(plait_levels_list(get(), list.data(), &count));
        return list;
    }
    Guides take(std::size_t level) const {
        plait_groom* groom = nullptr;
        plait_follow_map* map = nullptr;
        check(plait_levels_take(get(), level, &groom, &map));
        return {Groom(groom), FollowMap(map)};
    }

  private:
    static plait_levels* create(const plait_levels_desc& desc) {
        plait_levels* handle = nullptr;
        check(plait_levels_create(&desc, &handle));
        return handle;
    }
};

class Mesh : public detail::Owner<plait_mesh, plait_mesh_destroy> {
  public:
    explicit Mesh(const plait_mesh_desc& desc,
                  const plait_import_options& options = plait_import_options_defaults())
        : Owner(create(desc, options)) {}

    static Mesh load(const std::string& path,
                     const plait_import_options& options = plait_import_options_defaults()) {
        plait_mesh* handle = nullptr;
        check(plait_mesh_load(path.c_str(), &options, &handle));
        return Mesh(handle);
    }

    plait_mesh_info describe() const {
        auto info = plait_mesh_info_defaults();
        check(plait_mesh_describe(get(), &info));
        return info;
    }

    // T: float for POSITIONS and BONE_WEIGHTS, std::uint32_t for the others.
    template <typename T> std::vector<T> read(plait_mesh_field field) const {
        std::size_t size = 0;
        check(plait_mesh_read(get(), field, nullptr, &size));
        std::vector<T> values(size / sizeof(T));
        check(plait_mesh_read(get(), field, values.data(), &size));
        return values;
    }

    plait_mesh_bone_info bone(std::uint32_t index) const {
        auto info = plait_mesh_bone_info_defaults();
        check(plait_mesh_read_bone(get(), index, &info));
        return info;
    }
    // Where bones (float[12] each) put its vertices, xyz.
    std::vector<float> pose(const plait_view& bones) const {
        std::size_t size = 0;
        check(plait_mesh_read(get(), PLAIT_MESH_FIELD_POSITIONS, nullptr, &size));
        std::vector<float> positions(size / sizeof(float));
        check(plait_mesh_pose(get(), &bones, positions.data()));
        return positions;
    }

    // Capsules whose union comes near it.
    std::vector<plait_capsule> fit(std::size_t count, plait_mesh_fit_info* info = nullptr) const {
        std::vector<plait_capsule> capsules(count);
        check(plait_mesh_fit(get(), capsules.data(), count, info));
        return capsules;
    }

  private:
    explicit Mesh(plait_mesh* handle) : Owner(handle) {}
    static plait_mesh* create(const plait_mesh_desc& desc, const plait_import_options& options) {
        plait_mesh* handle = nullptr;
        check(plait_mesh_create(&desc, &options, &handle));
        return handle;
    }
};

// A feature of a sim, and whether it is on.
template <typename Desc> struct Feature : Desc {
    bool on = false;
    Feature(const Desc& desc, bool is_on = true) : Desc(desc), on(is_on) {}
    // Null where it is off, as plait_sim_set_<feature> takes it.
    const Desc* desc() const noexcept { return on ? this : nullptr; }
};

// All that a sim is made with, in one value: `desc.grid.on = true; desc.grid.edge_count = 16;`.
struct SimDesc : plait_sim_desc {
    SimDesc() : plait_sim_desc(plait_sim_desc_defaults()) {}

    // Of all strands, where the C struct's `materials` are none.
    plait_material material = plait_material_defaults();
    plait_tressfx_desc tressfx = plait_tressfx_desc_defaults(); // read by this model alone
    Feature<plait_grid_desc> grid{plait_grid_desc_defaults(), false};
    Feature<plait_volume_desc> volume{plait_volume_desc_defaults(), false};
    Feature<plait_strand_contact_desc> strand_contact{plait_strand_contact_desc_defaults(), false};
    Feature<plait_wetness_desc> wetness{plait_wetness_desc_defaults(), false};
    Feature<plait_acceleration_desc> acceleration{plait_acceleration_desc_defaults(), false};
};

// Where `desc` has a parameter: `info.count` values of 4 bytes each. Null of what it does not know.
inline void* field_of(SimDesc& desc, const plait_param_info& info) noexcept {
    const auto in = [&](auto& in_struct) -> void* {
        return reinterpret_cast<unsigned char*>(&in_struct) + info.offset;
    };
    const std::string_view feature = info.feature;
    return feature == "params"           ? in(desc.params)
           : feature == "material"       ? in(desc.material)
           : feature == "tressfx"        ? in(desc.tressfx)
           : feature == "grid"           ? in(desc.grid)
           : feature == "volume"         ? in(desc.volume)
           : feature == "strand_contact" ? in(desc.strand_contact)
           : feature == "wetness"        ? in(desc.wetness)
           : feature == "acceleration"   ? in(desc.acceleration)
                                         : nullptr;
}

// Whether a sim of `desc` has the feature that a parameter belongs to.
inline bool has_feature(const SimDesc& desc, const plait_param_info& info) noexcept {
    const std::string_view feature = info.feature;
    const bool tressfx = desc.model == PLAIT_MODEL_TRESSFX;
    return feature == "params" || (feature == "material" && !tressfx) ||
           (feature == "tressfx" && tressfx) || (feature == "grid" && desc.grid.on) ||
           (feature == "volume" && desc.volume.on) ||
           (feature == "strand_contact" && desc.strand_contact.on) ||
           (feature == "wetness" && desc.wetness.on) ||
           (feature == "acceleration" && desc.acceleration.on);
}

// The features of `desc`, on or off; what fails ends it. The volume goes off first and comes on last,
// since it does not go with every grid.
inline plait_result set_features(plait_sim* sim, const SimDesc& desc) noexcept {
    plait_result result = PLAIT_OK;
    if (!desc.volume.on)
        result = plait_sim_set_volume(sim, nullptr);
    if (result == PLAIT_OK && desc.model == PLAIT_MODEL_TRESSFX)
        result = plait_sim_set_tressfx(sim, &desc.tressfx);
    if (result == PLAIT_OK)
        result = plait_sim_set_grid(sim, desc.grid.desc());
    if (result == PLAIT_OK)
        result = plait_sim_set_strand_contact(sim, desc.strand_contact.desc());
    if (result == PLAIT_OK)
        result = plait_sim_set_wetness(sim, desc.wetness.desc());
    if (result == PLAIT_OK)
        result = plait_sim_set_acceleration(sim, desc.acceleration.desc());
    if (result == PLAIT_OK && desc.volume.on)
        result = plait_sim_set_volume(sim, desc.volume.desc());
    return result;
}

// Its params, its features and, where it has one for all, its material.
inline plait_result set_all(plait_sim* sim, const SimDesc& desc) noexcept {
    plait_result result = plait_sim_set_params(sim, &desc.params);
    if (result == PLAIT_OK && desc.model == PLAIT_MODEL_ARTICULATED && desc.material_count == 0)
        result = plait_sim_set_materials(sim, &desc.material, 1, plait_view{});
    return result == PLAIT_OK ? set_features(sim, desc) : result;
}

// plait_sim_create with all of `desc`.
inline plait_result create_sim(plait_context* context, const plait_groom* groom,
                               const SimDesc& desc, plait_sim** out) noexcept {
    plait_sim_desc own = desc;
    if (own.material_count == 0 && own.model == PLAIT_MODEL_ARTICULATED) {
        own.materials = &desc.material;
        own.material_count = 1;
    }
    plait_sim* sim = nullptr;
    plait_result result = plait_sim_create(context, groom, &own, &sim);
    if (result == PLAIT_OK)
        result = set_features(sim, desc);
    if (result == PLAIT_OK)
        *out = sim;
    else
        plait_sim_destroy(sim);
    return result;
}

// Its context, its groom and its map may go before it.
class Sim : public detail::Owner<plait_sim, plait_sim_destroy> {
  public:
    Sim(const Context& context, const Groom& groom,
        const plait_sim_desc& desc = plait_sim_desc_defaults())
        : Owner(create(context, groom, desc)) {}
    Sim(const Context& context, const Groom& groom, const SimDesc& desc)
        : Owner(create(context, groom, desc)) {}

    void step(double dt) { check(plait_sim_step(get(), dt)); }
    void wait() { check(plait_sim_wait(get())); }
    void reset() { check(plait_sim_reset(get())); }
    void find_balance() { check(plait_sim_find_balance(get())); }
    // Of every guide, where its root is bound now.
    std::vector<plait_root_place> bind_roots(const Mesh& mesh) {
        std::vector<plait_root_place> places(describe().guides);
        check(plait_sim_bind_roots(get(), mesh.get(), places.data(), places.size()));
        return places;
    }
    void free_roots() { check(plait_sim_bind_roots(get(), nullptr, nullptr, 0)); }
    void set_roots(const plait_roots& roots) { check(plait_sim_set_roots(get(), &roots)); }
    void teleport(const plait_roots& roots) { check(plait_sim_teleport(get(), &roots)); }

    void set_params(const plait_sim_params& params) { check(plait_sim_set_params(get(), &params)); }
    plait_sim_params params() const {
        auto params = plait_sim_params_defaults();
        check(plait_sim_get_params(get(), &params));
        return params;
    }
    void set_material(const plait_material& material) {
        check(plait_sim_set_materials(get(), &material, 1, {}));
    }
    // Null: off.
    void set_tressfx(const plait_tressfx_desc* desc) { check(plait_sim_set_tressfx(get(), desc)); }
    void set_grid(const plait_grid_desc* desc) { check(plait_sim_set_grid(get(), desc)); }
    // Null: none.
    void set_reduce(plait_reduce_fn reduce, void* user) {
        check(plait_sim_set_reduce(get(), reduce, user));
    }
    void set_volume(const plait_volume_desc* desc) { check(plait_sim_set_volume(get(), desc)); }
    void set_strand_contact(const plait_strand_contact_desc* desc) {
        check(plait_sim_set_strand_contact(get(), desc));
    }
    void set_wetness(const plait_wetness_desc* desc) { check(plait_sim_set_wetness(get(), desc)); }
    void set_acceleration(const plait_acceleration_desc* desc) {
        check(plait_sim_set_acceleration(get(), desc));
    }
    void set_all(const SimDesc& desc) { check(handles::set_all(get(), desc)); }
    // sim.set_param("gravity", {0, -1.62, 0}): every component of the field.
    void set_param(const std::string& name, const std::vector<double>& values) {
        check(plait_sim_set_param(get(), name.c_str(), values.data(), values.size()));
    }
    // Hair of a kind: "curly".
    void set_preset(const std::string& name) { check(plait_sim_set_preset(get(), name.c_str())); }
    std::vector<double> param(const std::string& name) const {
        std::size_t count = 0;
        check(plait_sim_get_param(get(), name.c_str(), nullptr, &count));
        std::vector<double> values(count);
        check(plait_sim_get_param(get(), name.c_str(), values.data(), &count));
        return values;
    }

    void set_pins(const std::vector<plait_pin>& pins) {
        check(plait_sim_set_pins(get(), pins.data(), pins.size()));
    }

    void set_frame(const plait_frame_desc& desc) { check(plait_sim_set_frame(get(), &desc)); }
    void no_frame() { check(plait_sim_set_frame(get(), nullptr)); }
    void set_wind(const plait_wind_desc& desc) { check(plait_sim_set_wind(get(), &desc)); }
    void stop_wind() { check(plait_sim_set_wind(get(), nullptr)); }

    void set_detail(const plait_detail_desc& desc) { check(plait_sim_set_detail(get(), &desc)); }
    void drop_detail() { check(plait_sim_set_detail(get(), nullptr)); }

    // Of desc.levels, from the next step on.
    void set_level(const plait_level_choice& choice) { check(plait_sim_set_level(get(), &choice)); }
    plait_level_state level() const {
        auto state = plait_level_state_defaults();
        check(plait_sim_get_level(get(), &state));
        return state;
    }

    // `of`: [guides], into `settings`; empty: the first for all.
    void set_settings(const std::vector<plait_strand_settings>& settings,
                      const std::vector<std::uint32_t>& of = {}) {
        check(plait_sim_set_settings(get(), settings.data(), settings.size(), view(of)));
    }
    std::vector<plait_strand_settings> settings() const { // of every guide
        std::size_t count = 0;
        check(plait_sim_get_settings(get(), nullptr, &count));
        std::vector<plait_strand_settings> list(count, plait_strand_settings_defaults());
        check(plait_sim_get_settings(get(), list.data(), &count));
        return list;
    }

    // T: std::uint32_t for VERTEX_COUNT, else float.
    template <typename T = float> std::vector<T> read(plait_field field) const {
        std::size_t size = 0;
        check(plait_sim_read(get(), field, nullptr, &size));
        std::vector<T> values(size / sizeof(T));
        check(plait_sim_read(get(), field, values.data(), &size));
        return values;
    }
    // Into `values`, once the fence that this gives is reached: till then they stay as they are.
    template <typename T = float>
    std::uint64_t read_later(plait_field field, std::vector<T>& values) const {
        std::size_t size = 0;
        check(plait_sim_read(get(), field, nullptr, &size));
        values.resize(size / sizeof(T));
        std::uint64_t fence = 0;
        check(plait_sim_read_later(get(), field, values.data(), size, &fence));
        return fence;
    }
    std::uint64_t fence() const {
        std::uint64_t fence = 0;
        check(plait_sim_fence(get(), &fence));
        return fence;
    }
    bool fence_reached(std::uint64_t fence) const {
        std::uint32_t reached = 0;
        check(plait_sim_fence_reached(get(), fence, &reached));
        return reached != 0;
    }
    void fence_wait(std::uint64_t fence) const { check(plait_sim_fence_wait(get(), fence)); }
    void write(plait_field field, const std::vector<float>& values) {
        check(plait_sim_write(get(), field, values.data(), values.size() * sizeof(float)));
    }

    plait_sim_info describe() const {
        auto info = plait_sim_info_defaults();
        check(plait_sim_describe(get(), &info));
        return info;
    }
    plait_sim_measures measure() const {
        auto measures = plait_sim_measures_defaults();
        check(plait_sim_measure(get(), &measures));
        return measures;
    }
    std::vector<plait_stage_time> stage_times(bool reset = false) {
        std::size_t count = 0;
        check(plait_sim_get_stage_times(get(), nullptr, &count, 0));
        std::vector<plait_stage_time> times(count);
        check(plait_sim_get_stage_times(get(), times.data(), &count, reset));
        times.resize(count);
        return times;
    }
    std::vector<plait_launch> take_launches() {
        std::size_t count = 0;
        check(plait_sim_take_launches(get(), nullptr, &count));
        std::vector<plait_launch> launches(count, plait_launch_defaults());
        check(plait_sim_take_launches(get(), launches.data(), &count));
        launches.resize(count);
        return launches;
    }

    std::vector<unsigned char> save() const {
        std::size_t size = 0;
        check(plait_sim_save(get(), nullptr, &size));
        std::vector<unsigned char> bytes(size);
        check(plait_sim_save(get(), bytes.data(), &size));
        return bytes;
    }
    void restore(const std::vector<unsigned char>& bytes) {
        check(plait_sim_restore(get(), bytes.data(), bytes.size()));
    }
    std::uint64_t hash() const {
        std::uint64_t value = 0;
        check(plait_sim_hash(get(), &value));
        return value;
    }

    plait_collider_id create_collider(const plait_collider_desc& desc) {
        plait_collider_id id{};
        check(plait_collider_create(get(), &desc, &id));
        return id;
    }
    plait_collider_id
    create_collider(const Mesh& mesh,
                    const plait_collider_mesh_desc& desc = plait_collider_mesh_desc_defaults()) {
        plait_collider_id id{};
        check(plait_collider_create_mesh(get(), mesh, &desc, &id));
        return id;
    }
    plait_collider_id
    create_hull(const Mesh& mesh,
                const plait_collider_hull_desc& desc = plait_collider_hull_desc_defaults()) {
        plait_collider_id id{};
        check(plait_collider_create_hull(get(), mesh, &desc, &id));
        return id;
    }
    void set_collider_pose(plait_collider_id id, const plait_pose& pose) {
        check(plait_collider_set_pose(get(), id, &pose));
    }
    void place_collider(plait_collider_id id, const plait_pose& pose) {
        check(plait_collider_place(get(), id, &pose));
    }
    void set_collider_positions(plait_collider_id id, const plait_view& positions) {
        check(plait_collider_set_positions(get(), id, &positions));
    }
    void set_collider_shape(plait_collider_id id, const plait_collider_desc& desc) {
        check(plait_collider_set_shape(get(), id, &desc));
    }
    plait_collider_desc describe_collider(plait_collider_id id) const {
        auto desc = plait_collider_desc_defaults();
        check(plait_collider_describe(get(), id, &desc));
        return desc;
    }
    std::vector<plait_collider_id> colliders() const {
        std::size_t count = 0;
        check(plait_colliders_list(get(), nullptr, &count));
        std::vector<plait_collider_id> ids(count);
        check(plait_colliders_list(get(), ids.data(), &count));
        return ids;
    }
    void destroy_collider(plait_collider_id id) { check(plait_collider_destroy(get(), id)); }
    // NULL: with none from now on.
    void share_colliders(plait_sim* with) { check(plait_sim_share_colliders(get(), with)); }

  private:
    static plait_sim* create(plait_context* context, const plait_groom* groom,
                             const SimDesc& desc) {
        plait_sim* handle = nullptr;
        check(create_sim(context, groom, desc, &handle));
        return handle;
    }
    static plait_sim* create(plait_context* context, const plait_groom* groom,
                             const plait_sim_desc& desc) {
        plait_sim* handle = nullptr;
        check(plait_sim_create(context, groom, &desc, &handle));
        return handle;
    }
};

} // namespace handles
} // namespace plait

#endif
