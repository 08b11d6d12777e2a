// Weights of follows that are learnt from hair in motion: known ones come back, new motion is met
// better, and what is refused.
#include "support.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <random>

namespace {

using Field = plait_follow_map_field;

class FollowLearner : public OnBackend {};
ON_EVERY_BACKEND(FollowLearner);

constexpr double slightly_more = frame + 1e-9; // so that every call makes one step

// Curls of different lengths on a slope, 5 mm apart.
Strands field(size_t side) {
    Strands strands;
    for (size_t i = 0; i < side * side; ++i) {
        const float x = 0.005f * static_cast<float>(i / side),
                    z = 0.005f * static_cast<float>(i % side);
        strands.push_back(
            curl({x, 0.3f * z, z}, 9 + i % 5, 0.012f + 0.1f * (x + z), 40 * x - 60 * z));
    }
    return strands;
}

// A head that shakes, or that nods and goes to and fro.
plait_roots shaken(int i) {
    const float angle = 0.4f * std::sin(0.35f * static_cast<float>(i));
    const float tilt = 0.2f * std::sin(0.23f * static_cast<float>(i));
    return head_at({0, 0, 0},
                   {std::cos(angle) * std::sin(tilt), std::sin(angle) * std::cos(tilt),
                    std::sin(angle) * std::sin(tilt) * -1, std::cos(angle) * std::cos(tilt)});
}
plait_roots nodding(int i) {
    const float angle = 0.35f * std::sin(0.17f * static_cast<float>(i));
    return head_at({0.03f * std::sin(0.3f * static_cast<float>(i)), 0, 0},
                   {std::sin(angle), 0, 0, std::cos(angle)});
}
using Motion = plait_roots (*)(int);

struct Mapped {
    std::vector<uint32_t> guides, origin;
    std::vector<float> weights;

    explicit Mapped(const plait::FollowMap& map)
        : guides(map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_GUIDES)),
          origin(map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS)),
          weights(map.read<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS)) {}
    size_t follows() const { return weights.size() / 4; }
    size_t guide_count() const { return origin.size() - follows(); }
    float of(size_t follow, uint32_t guide) const {
        float weight = 0;
        for (size_t k = 4 * follow; k < 4 * follow + 4; ++k)
            weight += guides[k] == guide ? weights[k] : 0;
        return weight;
    }
};

// The same follows and guides, weights of any kind, a quarter of them 0.
plait::FollowMap made_up(const Strands& strands, const Mapped& from) {
    std::mt19937 random(3);
    std::vector<float> weights(from.weights.size());
    for (size_t f = 0; f < from.follows(); ++f) {
        float sum = 0;
        for (size_t k = 4 * f; k < 4 * f + 4; ++k) {
            const auto drawn = static_cast<float>(random() % 1000) / 1000;
            weights[k] = from.weights[k] > 0 && drawn > 0.25f ? drawn : 0;
            sum += weights[k];
        }
        weights[4 * f] += sum > 0 ? 0.0f : 1.0f;
        for (size_t k = 4 * f; sum > 0 && k < 4 * f + 4; ++k)
            weights[k] /= sum;
    }
    Strands follows;
    for (size_t f = 0; f < from.follows(); ++f)
        follows.push_back(strands[from.origin[from.guide_count() + f]]);
    const plait::Groom groom = make_groom(follows);
    auto desc = plait_follow_map_desc_defaults();
    desc.follows = groom;
    desc.guide_count = static_cast<uint32_t>(from.guide_count());
    desc.guides = plait::view(from.guides, 4);
    desc.weights = plait::view(weights, 4);
    return plait::FollowMap(desc);
}

// A sim's positions, with its strands in the groom's order.
std::vector<float> in_order(plait::Sim& sim, const std::vector<uint32_t>& origin) {
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    const size_t row = positions.size() / origin.size();
    std::vector<float> ordered(positions.size());
    for (size_t s = 0; s < origin.size(); ++s)
        std::copy_n(positions.begin() + static_cast<std::ptrdiff_t>(s * row), row,
                    ordered.begin() + static_cast<std::ptrdiff_t>(origin[s] * row));
    return ordered;
}

plait_view points(const std::vector<float>& rows) {
    return {rows.data(), rows.size() / 4, 16};
}

plait::SimDesc with(const plait::FollowMap& map) {
    plait::SimDesc desc;
    desc.follow_map = map;
    return desc;
}

TEST_P(FollowLearner, FindsTheWeightsThatMovedTheHair) {
    const Strands strands = field(7);
    const plait::Groom all = make_groom(strands);
    const auto [groom, map] = all.guides(6);
    const Mapped near(map), given(made_up(strands, near));
    plait::Sim sim(context, groom, with(made_up(strands, near)));
    plait::FollowLearner learner(all, map);
    for (int i = 0; i < 40; ++i) {
        sim.set_roots(shaken(i));
        sim.step(slightly_more);
        learner.add_frame(shaken(i), points(in_order(sim, near.origin)));
    }
    auto info = plait_follow_fit_info_defaults();
    const Mapped learnt(learner.learn(&info));
    float most = 0, first = 0;
    for (size_t f = 0; f < near.follows(); ++f)
        for (uint32_t g = 0; g < 6; ++g) {
            most = std::max(most, std::abs(learnt.of(f, g) - given.of(f, g)));
            first = std::max(first, std::abs(near.of(f, g) - given.of(f, g)));
        }
    EXPECT_LT(most, 1e-3f);
    EXPECT_GT(first, 0.3f) << "nothing to learn";
    EXPECT_EQ(info.frames, 40u);
    EXPECT_LT(info.rms_after, 2e-6);
    EXPECT_GT(info.rms_before, 1e-3);
    EXPECT_EQ(learnt.origin, near.origin);
}

// rms distance of the follows from where all strands are simulated, m, and what the learner says.
double away(const plait::Context& context, const plait::Groom& all, const plait::Groom& groom,
            const plait::FollowMap& map, Motion motion, plait::FollowLearner* learner = nullptr) {
    const Mapped mapped(map);
    const auto counts = plait::Sim(context, all).read<uint32_t>(PLAIT_FIELD_VERTEX_COUNT);
    plait::Sim truth(context, all), sim(context, groom, with(map));
    double squares = 0, vertices = 0;
    for (plait::Sim* each : {&truth, &sim}) { // at rest before it is shaken
        each->set_roots(motion(0));
        each->step(slightly_more);
    }
    for (int i = 0; i < 60; ++i) {
        for (plait::Sim* each : {&truth, &sim}) {
            each->set_roots(motion(i));
            each->step(slightly_more);
        }
        const auto x = in_order(sim, mapped.origin), aim = truth.read(PLAIT_FIELD_POSITION);
        if (learner)
            learner->add_frame(motion(i), points(aim));
        const size_t row = x.size() / 4 / counts.size();
        for (size_t f = 0; f < mapped.follows(); ++f) {
            const size_t s = mapped.origin[mapped.guide_count() + f];
            for (size_t v = row * s; v < row * s + counts[s]; ++v)
                squares += std::pow(x[4 * v] - aim[4 * v], 2) +
                           std::pow(x[4 * v + 1] - aim[4 * v + 1], 2) +
                           std::pow(x[4 * v + 2] - aim[4 * v + 2], 2);
            vertices += counts[s];
        }
    }
    return std::sqrt(squares / vertices);
}

// Guides among all strands move as they do alone: strands do not meet here.
TEST_P(FollowLearner, IsNearerInMotionThatItHasNotSeen) {
    const plait::Groom all = make_groom(field(10));
    const auto [groom, map] = all.guides(8);
    plait::FollowLearner learner(all, map);
    const double seen = away(context, all, groom, map, shaken, &learner);
    auto info = plait_follow_fit_info_defaults();
    const plait::FollowMap learnt = learner.learn(&info);
    EXPECT_NEAR(info.rms_before, seen, 1e-3 * seen);
    EXPECT_LT(info.rms_after, 0.85 * info.rms_before);
    EXPECT_NEAR(away(context, all, groom, learnt, shaken), info.rms_after, 0.03 * seen);
    const double near = away(context, all, groom, map, nodding),
                 taught = away(context, all, groom, learnt, nodding);
    EXPECT_LT(taught, 0.95 * near);
    RecordProperty("near_mm", std::to_string(1e3 * near));
    RecordProperty("learnt_mm", std::to_string(1e3 * taught));
}

// All poses of its own: the same as a head that goes there, and a map without STRANDS.
TEST(FollowLearners, TakePosesOfRootsAndMapsOfYourOwn) {
    const auto context = make_context("reference");
    const Strands strands = field(4);
    const plait::Groom all = make_groom(strands);
    const auto [groom, map] = all.guides(3);
    const Mapped near(map);
    const plait::FollowMap own = made_up(strands, near);
    Strands ordered;
    for (const uint32_t strand : near.origin)
        ordered.push_back(strands[strand]);
    const plait::Groom sorted = make_groom(ordered);
    plait::FollowLearner with_head(all, map), with_poses(all, map), of_own(sorted, own);
    plait::Sim sim(context, groom, with(made_up(strands, near)));
    for (int i = 0; i < 20; ++i) {
        sim.set_roots(shaken(i));
        sim.step(slightly_more);
        const auto x = in_order(sim, near.origin);
        auto roots = plait_roots_defaults();
        const std::vector<plait_pose> poses(16, shaken(i).head);
        roots.root_poses = plait::view(poses);
        with_head.add_frame(shaken(i), points(x));
        with_poses.add_frame(roots, points(x));
        of_own.add_frame(shaken(i), points(sim.read(PLAIT_FIELD_POSITION)));
    }
    const Mapped a(with_head.learn()), b(with_poses.learn());
    for (size_t k = 0; k < a.weights.size(); ++k)
        EXPECT_NEAR(a.weights[k], b.weights[k], 1e-5f);
    auto info = plait_follow_fit_info_defaults();
    of_own.learn(&info);
    EXPECT_LT(info.rms_before, 1e-6) << "its own weights moved it";
}

// Hair that stands still tells guides apart by nothing.
TEST(FollowLearners, KeepWeightsWhereNothingMoves) {
    const Strands strands = field(4);
    const plait::Groom all = make_groom(strands);
    const auto [groom, map] = all.guides(3);
    plait::FollowLearner learner(all, map);
    const size_t row = all.describe().max_vertices;
    std::vector<float> rest;
    for (const Strand& strand : strands)
        for (size_t i = 0; i < row; ++i)
            for (const float x : strand[std::min(i, strand.size() - 1)])
                rest.push_back(x);
    for (int i = 0; i < 5; ++i)
        learner.add_frame(plait_roots_defaults(), plait::view(rest, 3));
    const Mapped before(map), after(learner.learn());
    EXPECT_EQ(before.guides, after.guides);
    for (size_t k = 0; k < before.weights.size(); ++k)
        EXPECT_NEAR(before.weights[k], after.weights[k], 0.02f);
}

struct Input {
    Strands strands = field(3);
    plait::Groom all = make_groom(strands);
    plait::Guides guides = all.guides(2);
    plait::FollowLearner learner{all, guides.map};
    size_t row = all.describe().max_vertices;
    std::vector<float> x = std::vector<float>(4 * 9 * row, 0.25f);
    plait_roots roots = plait_roots_defaults();
    std::vector<plait_pose> poses;
    std::vector<float> bones, mesh;
    size_t points = 9 * row, stride = 16;

    plait_result add() {
        roots.root_poses = plait::view(poses);
        roots.bones = plait::view(bones, 12);
        roots.mesh_positions = plait::view(mesh, 3);
        return plait_follow_learner_add_frame(learner.get(), &roots, {x.data(), points, stride});
    }
};

TEST(FollowLearners, SayWhatIsWrongWithAFrame) {
    const auto refused = [](const char* sentence, const std::function<void(Input&)>& change,
                            plait_result code = PLAIT_INVALID_ARGUMENT) {
        Input input;
        change(input);
        EXPECT_EQ(input.add(), code) << sentence;
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << "\"" << sentence << "\" is not in: " << plait_last_error();
        plait_follow_map* map = nullptr; // nothing was added
        EXPECT_EQ(plait_follow_learner_learn(input.learner.get(), &map, nullptr),
                  PLAIT_INVALID_STATE);
        EXPECT_NE(std::string(plait_last_error()).find("no frame was added"), std::string::npos);
        EXPECT_EQ(map, nullptr);
    };
    Input good;
    EXPECT_EQ(good.add(), PLAIT_OK) << plait_last_error();
    ++good.row;
    good.x.resize(4 * 9 * good.row);
    good.points = 9 * good.row;
    EXPECT_EQ(good.add(), PLAIT_OK) << "longer rows: " << plait_last_error();
    const std::string last = "positions[8][8][1], of strand, vertex and axis, is nan, range is "
                             "[-1e6, 1e6] m";
    refused(last.c_str(), [](Input& i) { i.x[4 * (8 * i.row + 8) + 1] = NAN; });
    refused("positions[0][2][0], of strand, vertex and axis, is -2e+06",
            [](Input& i) { i.x[8] = -2e6f; });
    refused("positions.count is 116, range is 9 strands times one number of vertices, at least the "
            "longest's 13",
            [](Input& i) { i.points = 116; });
    refused("positions.count is 108", [](Input& i) { i.points = 108; });
    refused("positions.stride is 8, range is 0 or at least 12", [](Input& i) { i.stride = 8; });
    refused("roots->head: quaternion norm is 2", [](Input& i) { i.roots.head.q[3] = 2; });
    refused("roots->root_poses.count is 2, the groom has 9 strands",
            [](Input& i) { i.poses.assign(2, i.roots.head); });
    refused(
        "roots->bones are given: give root_poses", [](Input& i) { i.bones.assign(12, 1.0f); },
        PLAIT_UNSUPPORTED);
    refused(
        "roots->mesh_positions are given: give root_poses",
        [](Input& i) { i.mesh.assign(9, 1.0f); }, PLAIT_UNSUPPORTED);
    Input padded;
    padded.x[4 * (padded.row - 1)] = NAN; // past the tip of a strand of 9
    EXPECT_EQ(padded.add(), PLAIT_OK) << plait_last_error();
}

TEST(FollowLearners, AreOfTheirMapsStrands) {
    const Input input;
    plait_follow_learner* none = nullptr;
    const auto refused = [&](const Strands& strands, const char* sentence) {
        const plait::Groom other = make_groom(strands);
        EXPECT_EQ(plait_follow_learner_create(other, input.guides.map, &none),
                  PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << "\"" << sentence << "\" is not in: " << plait_last_error();
        EXPECT_EQ(none, nullptr);
    };
    refused(field(4), "the groom has 16 strands, the map is of 2 guides and 7 follows");
    Strands shorter = input.strands;
    const auto origin = input.guides.map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    shorter[origin[4]].pop_back();
    refused(shorter, ("strand " + std::to_string(origin[4]) + " of the groom has").c_str());
    auto info = plait_follow_fit_info_defaults();
    info.struct_size = 3;
    plait_follow_map* map = nullptr;
    EXPECT_EQ(plait_follow_learner_learn(input.learner.get(), &map, &info), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("info->struct_size is 3"), std::string::npos);
}

} // namespace
