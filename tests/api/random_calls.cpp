// Random calls about colliders of every kind, meshes and hulls among them, pins of every stiffness, frames
// of reference and winds, between frames long, short and of no time, in any order: hair, and what follows
// it, stays finite and near its head, comes to rest as itself once it is let alone, and the same calls give
// the same bits.
#include "random_makers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <ostream>

namespace {

struct Case {
    std::string backend, name;
    plait_model model;
    bool bdf2, mixed; // strands of several settings
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name << " on " << c.backend;
}

plait::SimDesc random_desc(const Case& c, Dice& dice) {
    plait::SimDesc desc;
    desc.model = c.model;
    desc.substeps = 1 + dice.below(3);
    desc.follows_per_guide = follows_per_guide;
    desc.wetness.on = c.model != PLAIT_MODEL_TRESSFX;
    desc.params.bdf2 = c.bdf2;
    desc.material.bend_stiffness = dice.one_in(5) ? 0 : dice.decade(-11, -6);
    desc.material.line_density = dice.decade(-6, -4);
    desc.params.iterations = 1 + dice.below(4);
    return desc;
}

class Scene {
  public:
    // Every second has follows by a map, every third shows what is between two steps.
    Scene(plait::Context& context, const Case& c, uint32_t seed)
        : case_(c), dice_(seed), mesh_dice_(seed + 1000), volume_dice_(seed + 2000),
          bend_dice_(seed + 5000), detail_dice_(seed + 3000), contact_dice_(seed + 4000),
          wet_dice_(seed + 6000), follow_dice_(seed + 7000), side_dice_(seed + 8000),
          time_dice_(seed + 9000), scale_dice_(seed + 10000), mapped_(seed % 2 == 1),
          sim_(make_sim(context, seed % 3 == 0)) {}

    void frame_of_calls() {
        for (uint32_t i = dice_.below(4); i > 0; --i)
            call();
        if (case_.model != PLAIT_MODEL_TRESSFX && mesh_dice_.one_in(5))
            add_mesh();
        if (follow_dice_.one_in(8))
            add_hull();
        if (bend_dice_.one_in(3))
            bend_mesh();
        if (case_.model != PLAIT_MODEL_TRESSFX && volume_dice_.one_in(6))
            change_volume();
        if (detail_dice_.one_in(6))
            change_detail();
        if (case_.model != PLAIT_MODEL_TRESSFX && contact_dice_.one_in(6))
            change_strand_contact();
        if (case_.model != PLAIT_MODEL_TRESSFX && wet_dice_.one_in(6))
            change_wetness();
        if (time_dice_.one_in(6))
            change_frame();
        if (time_dice_.one_in(10)) { // hair goes along, at once
            at_[1] += time_dice_.between(-0.2f, 0.2f);
            sim_.set_roots(roots());
            sim_.step(0);
        }
        at_ = {at_[0] + dice_.between(-0.03f, 0.03f), at_[1], at_[2]};
        if (scale_dice_.one_in(5))
            scale_ = std::exp2(scale_dice_.between(-1, 1));
        sim_.set_roots(roots());
        sim_.step(dice_.one_in(10) ? 0.04 : frame);
        if (time_dice_.one_in(20)) // most of it is dropped
            sim_.step(time_dice_.one_in(2) ? 0.5 : 1e6);
        for (uint32_t i = follow_dice_.one_in(6) ? 5 : 0; i > 0; --i) {
            at_[0] += 0.003f;
            sim_.set_roots(roots());
            sim_.step(frame / 4);
        }
    }
    // Nothing near it any more, at a drag near critical.
    void leave_alone(int steps) {
        for (const plait_collider_id id : colliders_)
            sim_.destroy_collider(id);
        colliders_.clear();
        sim_.stop_wind();
        sim_.no_frame();
        sim_.drop_detail();
        is_detailed_ = false;
        if (case_.model != PLAIT_MODEL_TRESSFX)
            sim_.set_pins({});
        auto params = sim_.params();
        params.drag = 15;
        sim_.set_params(params);
        sim_.set_volume(nullptr);
        sim_.set_strand_contact(nullptr);
        scale_ = 1;
        sim_.set_roots(roots());
        run(sim_, steps);
    }
    // m at the groom's size, of any vertex from the head.
    float farthest() const {
        const auto p = sim_.read(PLAIT_FIELD_POSITION);
        float most = 0;
        for (size_t i = 0; i < p.size(); i += 4) {
            const float away = std::hypot(p[i] - at_[0], p[i + 1] - at_[1], p[i + 2] - at_[2]);
            if (!std::isfinite(away))
                return INFINITY;
            most = std::max(most, away);
        }
        return most / scale_;
    }
    // Of what follows by a map, over that of its groom: of any segment. 0 with detail, which adds to it.
    float worst_follow_stretch() const {
        const auto p = sim_.read(PLAIT_FIELD_POSITION);
        const Strands groomed = tuft(follows, longest);
        float worst = 0;
        for (size_t f = 0; mapped_ && !is_detailed_ && f < follows; ++f)
            for (size_t k = 1; k < vertices_of[f % guides]; ++k) {
                const float* to = &p[4 * (longest * (guides + f) + k)];
                const Point &a = groomed[f][k - 1], &b = groomed[f][k];
                const float length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
                const float is = std::hypot(to[0] - to[-4], to[1] - to[-3], to[2] - to[-2]);
                worst = std::max(worst, std::fabs(is / (scale_ * length) - 1));
            }
        return worst;
    }
    plait::Sim& sim() { return sim_; }

  private:
    plait_roots roots(std::array<float, 4> turn = {0, 0, 0, 1}) const {
        plait_roots roots = head_at(at_, turn);
        roots.scale = scale_;
        return roots;
    }
    void teleport() {
        at_ = dice_.in_cube(1);
        sim_.teleport(roots(dice_.turn()));
    }
    static plait::Groom groom(size_t count) {
        Strands strands = tuft(count, longest);
        for (size_t i = 0; i < count; ++i)
            strands[i].resize(vertices_of[i % guides]);
        return make_groom(strands);
    }
    plait::Sim make_sim(plait::Context& context, bool interpolates) {
        auto desc = random_desc(case_, dice_);
        desc.interpolate_output = interpolates;
        if (!mapped_)
            return plait::Sim(context, groom(guides), desc);
        const auto hair = groom(follows);
        const auto map = random_map(follow_dice_, hair);
        desc.follows_per_guide = 0;
        desc.follow_map = map;
        return plait::Sim(context, groom(guides), desc);
    }
    void change_frame() {
        if (time_dice_.one_in(4))
            sim_.no_frame();
        else
            sim_.set_frame(random_frame(time_dice_, at_));
    }
    plait_collider_desc shape() {
        auto desc = random_collider(dice_);
        desc.inward = side_dice_.one_in(5);
        return desc;
    }
    void change_detail() {
        is_detailed_ = !detail_dice_.one_in(4);
        is_detailed_ ? sim_.set_detail(random_detail(detail_dice_)) : sim_.drop_detail();
    }
    void add_hull() {
        if (colliders_.size() >= 6)
            return;
        auto desc = plait_collider_hull_desc_defaults();
        const plait::Mesh mesh = random_hull(follow_dice_, desc);
        desc.inward = side_dice_.one_in(5);
        colliders_.push_back(sim_.create_hull(mesh, desc));
    }
    void add_mesh() {
        if (colliders_.size() >= 6)
            return;
        auto desc = plait_collider_mesh_desc_defaults();
        const plait::Mesh mesh = random_mesh(mesh_dice_, desc);
        desc.form = bend_dice_.one_in(2) ? PLAIT_MESH_FORM_NEAREST : PLAIT_MESH_FORM_FIELD;
        colliders_.push_back(sim_.create_collider(mesh, desc));
        if (desc.form == PLAIT_MESH_FORM_NEAREST)
            bending_[colliders_.back().value] = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    }
    // Of any collider: only those of form NEAREST take them.
    void bend_mesh() {
        if (colliders_.empty())
            return;
        const auto id = colliders_[bend_dice_.below(static_cast<uint32_t>(colliders_.size()))];
        const auto found = bending_.find(id.value);
        if (found == bending_.end()) {
            const plait_view none{};
            ASSERT_EQ(plait_collider_set_positions(sim_, id, &none), PLAIT_INVALID_STATE);
            return;
        }
        const auto positions = bent(bend_dice_, found->second);
        sim_.set_collider_positions(id, plait::view(positions, 3));
    }
    void call();
    void pins_wind_or_settings();
    void change_volume() {
        const bool on = !volume_dice_.one_in(3);
        auto grid = plait_grid_desc_defaults();
        auto volume = plait_volume_desc_defaults();
        grid.edge_count = 1 + volume_dice_.below(16);
        volume.share = volume_dice_.between(0, 4);
        volume.sweeps = 1 + volume_dice_.below(12);
        volume.viscosity = volume_dice_.one_in(2) ? 0 : volume_dice_.decade(-1, 2);
        volume.cohesion = volume_dice_.one_in(2) ? 0 : volume_dice_.decade(-2, 2);
        sim_.set_volume(on ? &volume : nullptr);
        sim_.set_grid(on ? &grid : nullptr);
    }
    void change_wetness() {
        auto desc = plait_wetness_desc_defaults();
        desc.drying_time = wet_dice_.one_in(3) ? 0 : wet_dice_.decade(-2, 3);
        desc.cohesion = wet_dice_.one_in(3) ? 0 : wet_dice_.decade(-2, 2);
        sim_.set_wetness(&desc);
        std::vector<float> wetness(sim_.read(PLAIT_FIELD_WETNESS).size());
        const bool dry = wet_dice_.one_in(5);
        for (float& w : wetness)
            w = dry || wet_dice_.one_in(3) ? 0 : wet_dice_.between(0, 1);
        sim_.write(PLAIT_FIELD_WETNESS, wetness);
    }
    void change_strand_contact() {
        auto params = sim_.params();
        auto desc = plait_strand_contact_desc_defaults();
        const bool on = !contact_dice_.one_in(3);
        desc.radius = contact_dice_.decade(-4, -1);
        desc.friction = contact_dice_.one_in(3) ? 0 : contact_dice_.between(0, 2);
        params.follow_contact = contact_dice_.one_in(3) ? 0 : 1;
        sim_.set_strand_contact(on ? &desc : nullptr);
        sim_.set_params(params);
    }
    std::optional<size_t> some_collider() {
        if (colliders_.empty())
            return {};
        return dice_.below(static_cast<uint32_t>(colliders_.size()));
    }

    const Case& case_;
    Dice dice_, mesh_dice_, volume_dice_, bend_dice_, detail_dice_, contact_dice_, wet_dice_,
        follow_dice_, side_dice_, time_dice_, scale_dice_;
    bool mapped_; // has follows by a map
    bool is_detailed_ = false;
    std::map<uint64_t, std::vector<float>> bending_; // as they were made, by id
    plait::Sim sim_;
    std::vector<plait_collider_id> colliders_;
    Point at_{0, 0, 0};
    float scale_ = 1;
};

void Scene::pins_wind_or_settings() {
    if (case_.model == PLAIT_MODEL_TRESSFX)
        return;
    if (dice_.one_in(3))
        dice_.one_in(4) ? sim_.stop_wind() : sim_.set_wind(random_wind(dice_));
    else
        sim_.set_pins(random_pins(dice_));
    if (!case_.mixed || !dice_.one_in(4))
        return;
    std::vector<plait_strand_settings> table(4, plait_strand_settings_defaults());
    for (plait_strand_settings& settings : table) {
        settings.substeps = dice_.one_in(2) ? 1 + dice_.below(4) : PLAIT_SETTING_OF_SIM;
        settings.bdf2 = dice_.one_in(2) ? dice_.below(2) : PLAIT_SETTING_OF_SIM;
    }
    std::vector<uint32_t> of(guides);
    for (uint32_t& strand : of)
        strand = dice_.below(4);
    sim_.set_settings(table, of);
}

void Scene::call() {
    const auto some = some_collider();
    switch (dice_.below(8)) {
    case 0:
    case 1:
        if (colliders_.size() < 6)
            colliders_.push_back(sim_.create_collider(shape()));
        break;
    case 2:
    case 3:
        if (some) {
            const plait_pose pose = random_pose(dice_);
            if (side_dice_.one_in(4))
                sim_.place_collider(colliders_[*some], pose);
            else
                sim_.set_collider_pose(colliders_[*some], pose);
        }
        break;
    case 4: // of another kind, too
        if (some) {
            const auto desc = shape();
            const auto id = colliders_[*some];
            const auto kind = sim_.describe_collider(id).kind;
            const bool shaped =
                kind == PLAIT_COLLIDER_KIND_MESH || kind == PLAIT_COLLIDER_KIND_HULL;
            ASSERT_EQ(plait_collider_set_shape(sim_, id, &desc),
                      shaped ? PLAIT_INVALID_STATE : PLAIT_OK)
                << plait_last_error();
        }
        break;
    case 5:
        if (some) {
            sim_.destroy_collider(colliders_[*some]);
            colliders_.erase(colliders_.begin() + static_cast<long>(*some));
        }
        break;
    case 6:
        if (dice_.one_in(6))
            sim_.restore(sim_.save()); // colliders and pins with it
        else
            pins_wind_or_settings();
        break;
    default:
        if (dice_.one_in(8))
            teleport();
        else if (dice_.one_in(8))
            sim_.reset();
    }
}

class RandomCalls : public testing::TestWithParam<Case> {
  protected:
    // m. What a plane has pushed tressfx keeps as its speed: only finite.
    static float far() {
        return GetParam().model == PLAIT_MODEL_TRESSFX ? 1e6f : 100 * spacing * longest;
    }

    // The float64 reference is slower by tens: it meets all of the calls in the long tests alone.
    static uint32_t seeds() {
        const bool first =
            GetParam().backend == "reference" && !std::getenv("PLAIT_TEST_ALL_SEEDS");
        return first ? (PLAIT_TEST_SEEDS + 7) / 8 : PLAIT_TEST_SEEDS;
    }

    plait::Context context_ = make_context(GetParam().backend);
};

TEST_P(RandomCalls, OfCollidersAndPinsLeaveHairWhole) {
    for (uint32_t seed = 1; seed <= seeds(); ++seed) {
        Scene scene(context_, GetParam(), seed);
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (int i = 0; i < 60; ++i) {
            scene.frame_of_calls();
            ASSERT_LT(scene.farthest(), far()) << "frame " << i;
            ASSERT_LT(scene.worst_follow_stretch(), 1e-4f) << "frame " << i;
        }
        scene.leave_alone(480);
        const plait_sim_measures stats = scene.sim().measure();
        EXPECT_EQ(stats.nonfinite, 0u);
        if (GetParam().model == PLAIT_MODEL_TRESSFX) // it is as stretched as before
            continue;
        EXPECT_LT(scene.farthest(), 1.1f * spacing * longest);
        EXPECT_LT(scene.worst_follow_stretch(), 1e-4f);
        EXPECT_LT(stats.max_stretch, 0.02f);
        EXPECT_LT(stats.max_speed, 0.1f);
    }
}

TEST_P(RandomCalls, TheSameCallsGiveTheSameBits) {
    uint64_t first = 0;
    for (int again = 0; again < 2; ++again) {
        Scene scene(context_, GetParam(), 7);
        for (int i = 0; i < 60; ++i)
            scene.frame_of_calls();
        const uint64_t hash = scene.sim().hash();
        if (again) {
            EXPECT_EQ(hash, first);
        }
        first = hash;
    }
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const std::string& backend : backends()) {
        all.push_back({backend, "tressfx", PLAIT_MODEL_TRESSFX, false, false});
        if (backend != "reference") // which is slow: there `mixed` has strands of both integrators
            all.push_back({backend, "backward_euler", PLAIT_MODEL_ARTICULATED, false, false});
        all.push_back({backend, "articulated", PLAIT_MODEL_ARTICULATED, true, false});
        all.push_back({backend, "mixed", PLAIT_MODEL_ARTICULATED, false, true});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(Backends, RandomCalls, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& each) {
                             return each.param.name + "_" + each.param.backend;
                         });

} // namespace
